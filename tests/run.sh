#!/usr/bin/env bash
# Builds and runs all tests, first as users run the program and with warnings as errors, then under the sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
. tests/packages.sh
require_packages build test

status=0
for preset in strict sanitize; do
    cmake --preset "$preset"
    cmake --build --preset "$preset" --parallel "$(nproc)"
    ctest --preset "$preset" --parallel "$(nproc)" || status=1
done
exit "$status"
