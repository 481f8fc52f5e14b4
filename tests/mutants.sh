#!/usr/bin/env bash
# Breaks the program on purpose, one way at a time, and tells which breaks the tests notice.
#   tests/mutants.sh [ID ..]
# tests/mutants/list says what is broken and which tests belong to it; without ids all are tried, which takes an hour or
# more. This happens in a copy of the tree, build-mutants, that later runs go on with. Fails where a mutant survives or
# cannot be tried.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
copy=$root/build-mutants/tree
build=$copy/build-strict
export OMP_WAIT_POLICY=passive

. tests/mutants/read.sh
[ $# -eq 0 ] || ids=("$@")

# What differs gets the time of now, so that nothing built of a mutant that was cut short is kept.
refresh() {
    mkdir -p "$copy"
    git ls-files -z --cached --others --exclude-standard | while IFS= read -rd '' name; do
        [ -e "$name" ] && ! cmp -s "$name" "$copy/$name" || continue
        mkdir -p "$copy/$(dirname "$name")"
        cp "$name" "$copy/$name"
    done
    (cd "$copy" && find include src optimizer tests scenes -type f -name '*.[ch]') | while read -r name; do
        [ -e "$name" ] || rm "$copy/$name"
    done
    [ ! -e "$root/../shared" ] || ln -sfn "$root/../shared" "$copy/../shared"
}

# The tests of these names, a line each.
names() { ctest --test-dir "$build" -N -R "$1" | sed -n 's/^ *Test *#[0-9]*: //p'; }

# make NAME ..: these tests, and the program, which some of them run.
make() {
    local targets
    targets=$(cmake --build "$build" --target help | sed -n 's/: phony$//p' | grep -Fx "$(printf '%s\n' "$@")" || true)
    cmake --build "$build" --parallel "$(nproc)" --target sprayplan-program meshes $targets >"$build/mutant.log" 2>&1
}

# run REGEX: succeeds where all these tests pass.
run() { ctest --test-dir "$build" -R "$1" --output-on-failure --stop-on-failure >"$build/mutant.log" 2>&1; }

# The first test that failed, and its first case that did.
complaint() {
    sed -nE -e 's/.*Test +#[0-9]+: ([^ ]+) .*\*\*\*.*/\1/p' "$build/mutant.log" | head -n 1
    sed -nE -e 's/^\[ *FAILED *\] ([a-z_0-9]+)$/\1/p' "$build/mutant.log" | head -n 1
}

refresh
cmake -S "$copy" --preset strict >"$copy/../configure.log" 2>&1 || { cat "$copy/../configure.log" >&2 && exit 2; }

status=0
declare -A passes # of what is not broken
for id in "${ids[@]}"; do
    [ -n "${tests[$id]:-}" ] || { echo "$id: no such mutant, or no tests belong to it" >&2 && exit 2; }
    mapfile -t named < <(names "${tests[$id]}")
    [ ${#named[@]} -gt 0 ] || { echo "$id: no test is called ${tests[$id]}" >&2 && exit 2; }
    fresh=()
    for test in "${named[@]}"; do
        [ -n "${passes[$test]:-}" ] || fresh+=("$test")
        passes[$test]=yes
    done
    if [ ${#fresh[@]} -gt 0 ]; then
        make "${fresh[@]}" && run "^($(IFS='|' && echo "${fresh[*]}"))\$" ||
            { tail -n 40 "$build/mutant.log" >&2 && echo "${fresh[*]}: not built, or not passed as it is" >&2 && exit 2; }
    fi
    name=${file[$id]}
    trap 'cp "$root/$name" "$copy/$name"' EXIT
    sed -E -i "${edit[$id]}" "$copy/$name"
    if cmp -s "$name" "$copy/$name"; then
        echo "$id: CHANGES NOTHING in $name"
        status=1
    elif ! make "${named[@]}"; then
        echo "$id: DOES NOT BUILD: $(grep -m 1 'error:' "$build/mutant.log")"
        status=1
    elif run "${tests[$id]}"; then
        echo "$id: SURVIVES ${named[*]}: ${says[$id]}"
        status=1
    else
        echo "$id: killed by" $(complaint)
    fi
    cp "$root/$name" "$copy/$name"
    trap - EXIT
done
exit $status
