#!/bin/sh
# make new STUDY=name, twindeck new name: a study of one's own, copied from the template (a small frame that runs as it stands).
set -eu
name=${1:-}
home=$(dirname "$0")/..
new=${TWINDECK_NEW:-make new STUDY=} run=${TWINDECK_RUN:-make all STUDY=}
case $name in
  '' | *[!a-z0-9_]* | [!a-z]*)
    echo "new: '$name' is no name for a study, expected small letters, digits and _, beginning with a letter: ${new}my_bridge" >&2
    exit 2 ;;
esac
for place in "workflows/$name" "data/$name"; do
  [ ! -e "$place" ] || { echo "new: $place is there already; choose another name, or remove it yourself" >&2; exit 2; }
done
mkdir -p "workflows/$name" "data/$name"
cp -R "$home/workflows/template/." "workflows/$name/"
cp -R "$home/data/template/." "data/$name/"
for file in "workflows/$name"/*.toml; do
  sed "s#template#$name#g" "$file" >"$file.new" && mv "$file.new" "$file"
done
echo "workflows/$name/   study.toml and a configuration per step, with comments"
echo "data/$name/        model/, campaign/ and features/ of a small frame: put your own in their place"
echo "next: ${run}$name, then open results/$name/report/report.html; ${TWINDECK_GUIDES:-docs/README.md} lists the guides"
