#!/usr/bin/env bash
# sanitized.sh [units]: builds the program and some unit tests with the address and undefined-behaviour sanitizers, and runs these and
# small scenes; units: those tests alone, without the program. tools/test --preset sanitize runs all of them.
set -euo pipefail
# shellcheck source=tools/setup.sh
source "$GFB_SOURCE/tools/setup.sh"
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=0} # as tools/test
few=few_tests chosen=(-L '^few$')
if [[ ${1:-} == units ]]; then
  few=few_unit_tests
  chosen+=(-L '^unit$')
fi
lock_build
build_program sanitize "$few"
unlock_build
exec ctest --test-dir "$root/build/sanitize" --output-on-failure --no-tests=error --parallel "$(getconf _NPROCESSORS_ONLN)" "${chosen[@]}"
