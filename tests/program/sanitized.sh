#!/usr/bin/env bash
# Builds the program and some unit tests with the address and undefined-behaviour sanitizers, and runs these and small scenes;
# tools/test --preset sanitize runs all of them.
set -euo pipefail
# shellcheck source=tools/setup.sh
source "$GFB_SOURCE/tools/setup.sh"
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=0} # as tools/test
lock_build
build_program sanitize few_tests
unlock_build
exec ctest --test-dir "$root/build/sanitize" --output-on-failure --no-tests=error --parallel "$(getconf _NPROCESSORS_ONLN)" -L '^few$'
