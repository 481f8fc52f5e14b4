#!/usr/bin/env bash
# Compiles all C sources of library and program for aarch64, with warnings as errors, and runs two closed forms there,
# emulated. Headers of other libraries are those of this machine: they say nothing of the processor. Takes minutes, so
# that it runs only where SPRAYPLAN_LONG is set, and gcc-aarch64-linux-gnu and qemu-user are there.
set -euo pipefail
[[ -n ${SPRAYPLAN_LONG:-} ]] || { echo "SPRAYPLAN_LONG is not set"; exit 77; }
compiler=aarch64-linux-gnu-gcc
for tool in $compiler qemu-aarch64; do
    command -v $tool >/dev/null || { echo "$tool is not here"; exit 77; }
done
tests=$(cd "$(dirname "$0")/.." && pwd)
source=$(dirname "$tests")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/flags" <<FLAGS
-std=c17 -O2 -Wall -Wextra -Werror -Wno-psabi -ffp-contract=off -fno-math-errno -fno-trapping-math -fopenmp
-D_XOPEN_SOURCE=700 -I$source/include -I$source/src -I$source/optimizer -idirafter /usr/include
-DSPRAYPLAN_VIEWER="\"$source/src/report/viewer\"" -DSPRAYPLAN_MODULES_BELOW="\"lib\"" -DSPRAYPLAN_MODULES="\"/lib\""
-DSPRAYPLAN_PROGRAMS_BELOW="\"libexec\"" -DSPRAYPLAN_PROGRAMS="\"/libexec\""
FLAGS
cd "$source"
find src optimizer -name '*.c' ! -path 'src/ranks/mpi/*' ! -path 'src/cli/embree/*' ! -path 'src/cli/man/*' |
    while read -r file; do
        printf '%s\n' "@$work/flags" -c "$file" -o "$work/${file//\//-}.o"
    done | xargs -d '\n' -P "$(nproc)" -n 5 $compiler
cd "$work"
aarch64-linux-gnu-ar rc libsprayplan.a $(ls *.o | grep -v '^src-cli-')
echo "compiled $(ls *.o | wc -l) files"

# Tests as they are, with an own, small cmocka: of Debian's there is only this machine's.
for test in shadow reach; do
    $compiler @flags -DSPRAYPLAN_SANITIZE -I"$tests/stability/cross" "$tests/closed-form/$test.c" libsprayplan.a \
        -static -lm -o $test
    qemu-aarch64 ./$test
done
