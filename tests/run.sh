#!/usr/bin/env bash
# Builds and runs all tests, as users run the program and with warnings as errors, and under the sanitizers. The second
# build and its tests begin while the first tests run: some of these wait, and the last of them would leave cores idle.
set -euo pipefail
cd "$(dirname "$0")/.."
. tests/packages.sh
require_packages build test

build() {
    cmake --preset "$1"
    cmake --build --preset "$1" --parallel "$(nproc)"
}
run() { ctest --preset "$1" --parallel "$(nproc)" 2>&1 | sed -u "s/^/$1: /"; }

build strict
run strict &
strict=$!
trap 'trap - TERM; kill 0' INT TERM
status=0
build sanitize && run sanitize || status=1
wait "$strict" || status=1
exit "$status"
