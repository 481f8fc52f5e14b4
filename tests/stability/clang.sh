#!/usr/bin/env bash
# clang.sh, in a build: clang finds nothing to warn of in what the build's compiler compiles for library, program and
# modules, those aside that it compiled for the report's page. It only reads, so that this takes seconds. Of OpenMP it
# gets the header that gcc has, unless it has one.
set -euo pipefail
command -v clang >/dev/null || { echo "clang is not here"; exit 77; }
source=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$(gcc -print-file-name=include/omp.h)" "$work/omp.h"

. "$source/tests/stability/commands.sh"
commands "$work" >"$work/commands"
[ "$(wc -l <"$work/commands")" -gt 200 ] || { echo "too few commands here"; exit 1; }
sed "s,^,exec clang -fsyntax-only -Werror -idirafter $work ," "$work/commands" |
    xargs -d '\n' -P "$(nproc)" -n 1 sh -c
