#!/bin/sh
# make new STUDY=name, twindeck new name: a study of one's own, copied from the template (a small frame that runs as it stands; with --girder
# a footbridge in wind, steps 7, 8 and 10), or with --from FILES out of records, a table of sensors and a model.
set -eu
name=${1:-}
home=$(dirname "$0")/..
new=${TWINDECK_NEW:-make new STUDY=} run=${TWINDECK_RUN:-make all STUDY=}
case $name in
  --help | -h)
    echo "${new}NAME ${TWINDECK_FROM:-FROM=\"records.csv sensors.csv bridge.inp\"}: a study out of records, a table of sensors (channel, x, y, z, direction) and a deck or model folder"
    echo "${new}NAME: a small frame that runs as it stands; ${TWINDECK_GIRDER:-TEMPLATE=girder}: a footbridge in wind"
    echo "NAME has small letters, digits and _. It becomes workflows/NAME and data/NAME. Then: ${run}NAME"
    exit 0 ;;
  '' | *[!a-z0-9_]* | [!a-z]*)
    echo "new: '$name' is no name for a study, expected small letters, digits and _, beginning with a letter: ${new}my_bridge" >&2
    exit 2 ;;
esac
for place in "workflows/$name" "data/$name"; do
  [ ! -e "$place" ] || { echo "new: $place is there already; choose another name, or remove it yourself" >&2; exit 2; }
done
from=. what="model/, campaign/ and features/ of a small frame"
if [ "${2:-}" = --girder ] && [ $# = 2 ]; then
  from=girder what="model/, features/ and polar.csv of a footbridge"
elif [ $# -gt 1 ]; then
  if [ "$2" != --from ] || [ $# -lt 3 ]; then echo "new: expected files after the name: ${new}$name ${TWINDECK_FROM:-FROM=\"records.csv sensors.csv bridge.inp\"}, or for a footbridge in wind ${TWINDECK_GIRDER:-TEMPLATE=girder}" >&2; exit 2; fi
  bin=${TWINDECK_BIN:-build/bin}
  [ -x "$bin/s3_identification" ] || { echo "new: $bin/s3_identification is not there: run 'make build' first" >&2; exit 2; }
  exec "$home/workflows/python.sh" -m twindeck_new --bin "$bin" "$@"
fi
mkdir -p "workflows/$name" "data/$name"
for part in workflows data; do
  cp -R "$home/$part/template/$from/." "$part/$name/"
  rm -rf "${part:?}/$name/girder"
done
for file in "workflows/$name"/*.toml; do
  sed "s#template#$name#g" "$file" >"$file.new" && mv "$file.new" "$file"
done
echo "workflows/$name/   study.toml and a configuration per step, with comments"
echo "data/$name/        $what: put your own in their place"
echo "next: ${run}$name, then open results/$name/report/report.html; ${TWINDECK_GUIDES:-docs/README.md} lists the guides"
