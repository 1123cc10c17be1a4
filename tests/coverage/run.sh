#!/bin/sh
# make coverage: builds with g++'s counters, runs the unit tests, the laws, the verification and the smoke chain, and counts lines and branches with gcovr.
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
# The highest rooms, whose tests take longest, come first.
tests=${*:-test_verification $(tr ';' '\n' <build-coverage/unit_tests.txt | tac) test_laws}
steps=$([ $# -gt 0 ] || workflows/study_steps.sh workflows/smoke)
# shellcheck disable=SC2086  # the lists are meant to be split
cmake --build build-coverage -j "$jobs" --target $tests $steps
find build-coverage -name '*.gcda' -delete  # counts of earlier runs
failures=build-coverage/failures.txt
: >"$failures"
# JOBS tests at a time, each with one thread. An executable is run in shards of its tests, so that a long one does not keep the others waiting.
export OMP_NUM_THREADS=1
export GTEST_TOTAL_SHARDS=4
# shellcheck disable=SC2016  # the inner shell expands them
for test in $tests; do seq -f "$test %g" 0 $((GTEST_TOTAL_SHARDS - 1)); done |
  xargs -P "$jobs" -L 1 sh -c 'cd build-coverage && GTEST_SHARD_INDEX=$1 "bin/$0" --gtest_brief=1 || echo "$0" >>failures.txt'
results=build-coverage/smoke
rm -rf "$results"
for step in $steps; do
  "build-coverage/bin/$step" --study workflows/smoke --results "$results" --out "$results/$step" --threads "$jobs" --quiet || echo "$step" >>"$failures"
done
# Threads count a line at the same time, so that a branch may have a negative count, which gcovr does not read.
gcovr --root . --filter src/ --exclude-throw-branches --exclude-unreachable-branches --gcov-ignore-parse-errors --json-summary build-coverage/coverage.json build-coverage
/usr/bin/python3 tests/coverage/rooms.py build-coverage/coverage.json >build-coverage/coverage.md
cat build-coverage/coverage.md
[ ! -s "$failures" ] || { echo "coverage: failed: $(tr "\n" " " <"$failures")" >&2; exit 1; }
