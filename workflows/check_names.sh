#!/bin/sh
# Names that are given to make, held against a white list: 'KIND VARIABLE=value' each. Kinds: name (of a study, a step), folder
# (a path without blanks), path, words.
# The first that does not pass ends with one line and exit code 2. Nothing here is expanded or run.
set -eu
LC_ALL=C
export LC_ALL
longest_name=100 # bytes: folders and files are named after it, and a file system takes 255

refuse() {
  shown=$(printf '%s' "$value" | tr -c ' -~' '?' | cut -c 1-60)
  echo "$variable is '$shown', expected $1" >&2
  exit 2
}

for given in "$@"; do
  kind=${given%% *} given=${given#* }
  variable=${given%%=*} value=${given#*=}
  case $kind in
    name)
      allowed="a name of at most $longest_name letters, digits, _, - and ., beginning with a letter, a digit or _"
      case $value in
        *[!A-Za-z0-9_.-]* | [.-]*) refuse "$allowed" ;;
        '') [ "$variable" != STUDY ] || refuse "$allowed" ;;
      esac
      [ ${#value} -le $longest_name ] || refuse "$allowed" ;;
    folder)
      case $value in -* | *[!A-Za-z0-9_./-]*) refuse "a path of letters, digits and _ - . / that does not begin with -" ;; esac ;;
    path)
      [ "$variable" != GOALS ] || variable="what is made"
      case $value in
        -*) refuse "a path that does not begin with -" ;;
        *[!A-Za-z0-9_./\ -]*)
          # Letters beyond ASCII are bytes above 177 octal.
          [ -z "$(printf '%s.' "$value" | tr -d 'A-Za-z0-9_./ \200-\377-' | tr -c ' -~' '?')" ] ||
            refuse "letters, digits, blanks and _ - . / alone (give a link to a folder of another name)" ;;
      esac ;;
    words)
      case $value in
        *[!A-Za-z0-9_.,:=/+\ -]*) refuse "letters, digits, blanks and _ - . , : = / + alone" ;;
      esac ;;
  esac
done
