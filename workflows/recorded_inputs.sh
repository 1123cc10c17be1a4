#!/bin/sh
# What the steps that ran have read, as their manifests list it: one word `target:file` an input, which is a rule of make as it stands.
# A word `file:` beside it makes a file that is gone count as new, so that the step runs again. What lies in an earlier step's folder stands
# for that step's manifest. A blank in a name is written {blank}; names with signs that make would take for its own are left out.
# Files whose content changed while their time did not are told by changed_inputs.py.
# Usage: recorded_inputs.sh results/my_bridge "s1_model s4_refinement"
set -eu
results=$1 steps=$2
set --
for manifest in "$results"/*/manifest.json; do
  case $manifest in *[!A-Za-z0-9_./-]*) continue ;; esac # no folder that a step or a rule of a study writes
  [ ! -f "$manifest" ] || set -- "$@" "$manifest"
done
[ $# -gt 0 ] || exit 0
awk -v results="$results/" -v steps=" $steps " '
  FNR == 1 { step = ""; inside = 0 }
  /^ *"step": "s[0-9]+_[a-z]*"/ { split($0, word, "\""); step = word[4] }
  /^ *"inputs": *\{/ { inside = !/\}/; next }
  inside && /^ *\}/ { inside = 0 }
  inside && step != "" {
    if (!match($0, /^ *"/)) next
    name = substr($0, RLENGTH + 1)
    if (!match(name, /": *"[0-9a-f]*",?$/)) next
    name = substr(name, 1, RSTART - 1)
    if (name ~ /[$*?;|&~=%:#{}\\\[\]]/) next
    gsub(/ /, "{blank}", name)
    if (index(name, results) == 1) {
      earlier = substr(name, length(results) + 1)
      sub(/\/.*/, "", earlier)
      if (index(steps, " " earlier " ")) {
        if (earlier >= step) next
        name = results earlier "/manifest.json"
      }
    }
    if (!((FILENAME, name) in said)) print FILENAME ":" name
    said[FILENAME, name] = 1
    if (name !~ /\/manifest\.json$/) gone[name] = 1
  }
  END { for (name in gone) print name ":" }' "$@"
exec python3 -IS "$(dirname "$0")/changed_inputs.py" "$results" "$@"
