#!/bin/sh
# make why s6: which files make the step run again, as make itself sees it. Nothing is built.
set -eu
step=${1:-} study=$2 makefile=${3:-Makefile}
if [ -z "$step" ]; then
  echo "why: name a step: make why s6" >&2
  exit 2
fi
steps=$(sed -n '/^steps *=/,/\]/p' "workflows/$study/study.toml" | grep -o 's[0-9]_[a-z]*' || true)
token=$(printf '%s\n' "$steps" | grep -E "^$step(_|\$)" || true)
if [ -z "$token" ]; then
  echo "why: study $study has no step '$step'; it has: $(printf '%s\n' "$steps" | tr '\n' ' ')" >&2
  exit 2
fi
reasons=$(make -f "$makefile" --no-print-directory -n --debug=b "$token" STUDY="$study" NO_BUILD=1 2>/dev/null |
  sed -n -e "s/^ *Prerequisite '\(.*\)' is newer than target '\(.*\)'\./\2: older than \1/p" -e "s/^ *File '\(.*manifest.json\)' does not exist\./\1: not there yet/p" || true)
if [ -z "$reasons" ]; then
  echo "$token: up to date"
else
  printf '%s\n' "$reasons"
fi
