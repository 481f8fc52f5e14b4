#!/usr/bin/env bash
# That every change of tests/mutants/list still fits the file that it breaks: tests/mutants.sh takes too long to be run
# with every change of the program. Prints those that do not fit.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/mutants/read.sh

[ "${#ids[@]}" -ge 50 ] || { echo "tests/mutants/list: only ${#ids[@]} mutants" >&2 && exit 1; }
status=0
for id in "${ids[@]}"; do
    if [ ! -f "${file[$id]}" ]; then
        echo "$id: there is no ${file[$id]}"
        status=1
    elif sed -E "${edit[$id]}" "${file[$id]}" | cmp -s - "${file[$id]}"; then
        echo "$id: changes nothing in ${file[$id]}"
        status=1
    fi
done
exit $status
