#!/usr/bin/env bash
# Builds sprayplan and plans the nozzles of the example vessel. The last line printed is the path of the report.
set -euo pipefail
cd "$(dirname "$0")/.."
. tests/packages.sh
require_packages build

cmake --preset release
cmake --build build --parallel "$(nproc)"
build/scenes/vessel scenes/vessel.obj
mkdir -p out

# Status 4 means that the vessel cannot be covered as far as asked; the best layout has been written all the same.
status=0
build/sprayplan place scenes/vessel.yaml -o out/vessel || status=$?
if [ "$status" -ne 0 ] && [ "$status" -ne 4 ]; then
    exit "$status"
fi
echo "$PWD/out/vessel/report.html"
