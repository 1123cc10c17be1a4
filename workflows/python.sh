#!/bin/sh
# Runs the first Python 3 that can import what the reports need: the one first on PATH may be another than Debian's.
# Modules come from beside this script: the source tree, or what was installed.
home=$(cd "$(dirname "$0")/.." && pwd)
modules=$home/paper:$home/python:$home/workflows/common
for candidate in ${TWINDECK_PYTHON:-} /usr/bin/python3 python3; do
  if "$candidate" -c 'import pandas, matplotlib, jinja2' >/dev/null 2>&1; then
    PYTHONPATH=$modules${PYTHONPATH:+:$PYTHONPATH} exec "$candidate" "$@"
  fi
done
echo "python: no interpreter here imports pandas, matplotlib and jinja2; run 'make deps' or set TWINDECK_PYTHON" >&2
exit 2
