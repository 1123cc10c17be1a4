#!/bin/sh
# make why s6: which files make the step run again, as make itself sees it. Nothing is built. What make cannot do is said in its own words.
set -eu
step=${1:-} study=$2 makefile=${3:-Makefile}
if [ -z "$step" ]; then
  echo "why: name a step: make why s6" >&2
  exit 2
fi
steps=$("$(dirname "$0")/study_steps.sh" "workflows/$study" 2>&1) || { echo "why: $steps" >&2; exit 2; }
token=$(printf '%s\n' "$steps" | grep -E "^$step(_|\$)" || true)
if [ -z "$token" ]; then
  echo "why: study $study has no step '$step'; it has: $(printf '%s\n' "$steps" | tr '\n' ' ')" >&2
  exit 2
fi
if ! said=$(make -f "$makefile" --no-print-directory -n --debug=b "$token" STUDY="$study" NO_BUILD=1 2>&1); then
  echo "why: make cannot make $token: $(printf '%s\n' "$said" | sed -n -e 's/ *Stop\.$//' -e 's/^[^ ]*: \*\*\* //p' | head -n 1)" >&2
  exit 2
fi
reasons=$(printf '%s\n' "$said" | sed -n -e "s/^ *Prerequisite '\(.*\)' is newer than target '\(.*\)'\./\2: older than \1/p" \
  -e "s/^ *Prerequisite '\(.*\) has changed' of target '\(.*\)' does not exist\./\2: \1 has changed/p" \
  -e "/^ *Prerequisite '.*manifest.json' of target/d" -e "s/^ *Prerequisite '\(.*\)' of target '\(.*\)' does not exist\./\2: \1 is not there/p" \
  -e "s/^ *File '\(.*manifest.json\)' does not exist\./\1: not there yet/p" | awk '!said[$0]++' |
  while read -r line; do
    file=${line#*: older than }
    [ "$file" = "$line" ] || [ -e "$file" ] || line="${line%: older than *}: $file is not there"
    printf '%s\n' "$line"
  done)
if [ -z "$reasons" ]; then
  echo "$token: up to date"
else
  printf '%s\n' "$reasons"
fi
