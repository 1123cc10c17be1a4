#!/bin/sh
# make sanitize: builds with sanitizers and runs under them
#   address, undefined   unit tests, the kept inputs of the fuzz targets, the broken inputs, the steps of the smoke study;
#   thread               what runs in parallel (core/parallel.hpp on std::thread, which ThreadSanitizer understands): wind, dynamics,
#                        updating, buffeting, diagnosis, and every step once on a small sound input.
# A report ends the program that it is about, and with it this script. Reports on libraries that are not ours are left out by the files
# *.supp, each with its reason.
#
#   run.sh [JOBS] [address|thread]
set -eu
jobs=${1:-2}
only=${2:-}
cd "$(dirname "$0")/../.."
source=$PWD
export ASAN_OPTIONS="suppressions=$source/tests/sanitize/address.supp:detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1:check_initialization_order=1"
export LSAN_OPTIONS="suppressions=$source/tests/sanitize/leaks.supp:print_suppressions=0"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1"
export TSAN_OPTIONS="halt_on_error=1:second_deadlock_stack=1:suppressions=$source/tests/sanitize/thread.supp"
export OPENBLAS_NUM_THREADS=1


build() { # PRESET TARGET…
  preset=$1
  shift
  echo "sanitize: $preset: building $*"
  cmake --preset "$preset" >"build-$preset.log" 2>&1 || { cat "build-$preset.log"; exit 1; }
  cmake --build "build-$preset" -j "$jobs" --target "$@" >"build-$preset.log" 2>&1 || { tail -n 60 "build-$preset.log"; exit 1; }
  rm -f "build-$preset.log"
}

# Sanitizers of g++ 12 do not start where the kernel randomises addresses widely; setarch -R turns that off where it may.
run() { # LABEL COMMAND…
  label=$1
  shift
  if setarch -R true 2>/dev/null; then set -- setarch -R "$@"; fi
  log=$(mktemp)
  start=$(date +%s)
  if "$@" >"$log" 2>&1; then
    echo "sanitize: $label: clean, $(($(date +%s) - start)) s"
  else
    tail -n 80 "$log"
    echo "sanitize: $label: see above" >&2
    rm -f "$log"
    exit 1
  fi
  rm -f "$log"
}

if [ "$only" != thread ]; then
  build sanitize unit_tests executables fuzz_corpus test_broken_inputs
  bin=build-sanitize/bin
  for test in $(tr ';' ' ' <build-sanitize/unit_tests.txt); do run "$test" "$bin/$test" --gtest_brief=1; done
  run "kept inputs of the fuzz targets" "$bin/fuzz_corpus" tests/fuzz/corpus
  run "broken inputs" "$bin/test_broken_inputs" --gtest_brief=1
  results=build-sanitize/smoke
  rm -rf "$results"
  # shellcheck disable=SC2013  # names are words
  for step in $(workflows/study_steps.sh workflows/smoke); do
    run "smoke study, $step" "$bin/$step" --study workflows/smoke --results "$results" --out "$results/$step" --threads 2 --quiet
  done
fi
if [ "$only" != address ]; then
  build thread test_core test_wind test_fe test_dynamics test_updating test_buffeting test_diagnosis test_broken_inputs
  bin=build-thread/bin
  for test in core wind fe dynamics updating buffeting diagnosis; do run "threads, test_$test" "$bin/test_$test" --gtest_brief=1; done
  run "threads, every step on a sound input" "$bin/test_broken_inputs" --gtest_brief=1 '--gtest_filter=*sound*'
fi
echo "sanitize: no report"
