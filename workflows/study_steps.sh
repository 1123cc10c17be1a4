#!/bin/sh
# The steps of a study, as `steps = [...]` of its study.toml lists them (comments do not count), one a line. A study that is not there, one
# that lists no steps and a step that does not exist end with one line that names what there is.
# Usage: study_steps.sh workflows/my_bridge
set -eu
workflow=$1 file=$1/study.toml
if [ ! -f "$file" ]; then
  here=$(for study in workflows/*/study.toml; do [ ! -f "$study" ] || printf ' %s' "$(basename "$(dirname "$study")")"; done)
  echo "there is no study '$(basename "$workflow")' ($file); there are:${here:- none}" >&2
  exit 2
fi
awk -v file="$file" -v known="s0_campaign s1_model s2_sensors s3_identification s4_refinement s5_sensitivity s6_updating s7_aerodynamics s8_validation s9_diagnosis s10_reliability" '
  function fault(what) { print file ":" NR ": steps: " what | "cat >&2"; failed = 1; exit 2 }
  !inside && /^[ \t]*steps[ \t]*=/ {
    sub(/^[^=]*=[ \t]*/, "")
    if (!/^\[/) fault("expected a list in brackets, as in steps = [\"s1_model\"]")
    inside = 1
    sub(/^\[/, "")
  }
  inside {
    while (match($0, /["\047#\]]/)) {  # a quote, a comment or the end of the list
      mark = substr($0, RSTART, 1)
      if (mark == "#") break
      if (mark == "]") exit 0
      $0 = substr($0, RSTART + 1)
      end = index($0, mark)
      if (!end) fault("a quote is not closed")
      step = substr($0, 1, end - 1)
      $0 = substr($0, end + 1)
      if (step == "" || !index(" " known " ", " " step " ")) fault("there is no step \047" step "\047; there are: " known)
      steps = steps step "\n"
    }
  }
  END {
    if (!failed && steps == "") { print file ": lists no steps, as in steps = [\"s1_model\"]" | "cat >&2"; failed = 1 }
    close("cat >&2")
    if (failed) exit 2
    printf "%s", steps
  }' "$file"
