#!/bin/sh
# make coverage: builds with g++'s counters, runs the unit tests, the laws and the verification, counts lines and branches with gcovr.
# Without optimisation (preset `coverage`): g++ merges branches even with -O1 and -Og, before it counts them, so that lines that no test reaches
# are not listed at all.
#   build-coverage/coverage.json   by file; coverage.md: by room of src, the table that the run of CI shows
#
#   run.sh [JOBS] [EXECUTABLE ...]     executables: a part of the tests, for example test_modal
set -eu
jobs=${1:-2}
[ $# = 0 ] || shift
cd "$(dirname "$0")/../.."
command -v gcovr >/dev/null 2>&1 || {
  echo "coverage: gcovr is not here: apt-get install --no-install-recommends gcovr" >&2
  exit 2
}
cmake --preset coverage >build-coverage.log 2>&1 || { cat build-coverage.log; exit 1; }
rm -f build-coverage.log
tests=${*:-$(tr ';' ' ' <build-coverage/unit_tests.txt) test_verification test_laws}
# shellcheck disable=SC2086  # the list is meant to be split
cmake --build build-coverage -j "$jobs" --target $tests
find build-coverage -name '*.gcda' -delete  # counts of earlier runs
failed=
for name in $tests; do
  (cd build-coverage && "bin/$name" --gtest_brief=1) || failed="$failed $name"
done
gcovr --root . --filter src/ --exclude-throw-branches --exclude-unreachable-branches --json-summary build-coverage/coverage.json build-coverage
/usr/bin/python3 tests/coverage/rooms.py build-coverage/coverage.json >build-coverage/coverage.md
cat build-coverage/coverage.md
[ -z "$failed" ] || { echo "coverage: failed:$failed" >&2; exit 1; }
