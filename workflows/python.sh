#!/bin/sh
# Runs the first Python 3 that can import what the reports need: the one first on PATH may be another than Debian's.
for candidate in ${TWINDECK_PYTHON:-} /usr/bin/python3 python3; do
  if "$candidate" -c 'import pandas, matplotlib, jinja2' >/dev/null 2>&1; then
    PYTHONPATH=paper:python${PYTHONPATH:+:$PYTHONPATH} exec "$candidate" "$@"
  fi
done
echo "python: no interpreter here imports pandas, matplotlib and jinja2; run 'make deps' or set TWINDECK_PYTHON" >&2
exit 2
