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

# One command a line, of which compiler, output and the compiler's own options are left out; a file once.
commands() {
    sed -n 's/^ *"command": "\(.*\)",\{0,1\}$/\1/p' compile_commands.json | sed 's/\\\(.\)/\1/g' |
        grep -E " -c $source/(src|optimizer)/[^ ]*\$" |
        awk -v from="^$source/src/" 'NR == FNR {page[$0]; next}
            {name = $NF; sub(from, "", name); gsub("/", "-", name)} !(name in page) && !seen[$NF]++' "$work/page" - |
        sed -E "s,^([^ ]*ccache )?[^ ]+ (.*) -o [^ ]+ -c ([^ ]+)\$,\2 \3,"
}
{ echo none && find src/live -name '*.o' | sed 's,.*/\(.*\)\.o$,\1,'; } >"$work/page"
commands >"$work/commands"
[ "$(wc -l <"$work/commands")" -gt 200 ] || { echo "too few commands here"; exit 1; }
sed "s,^,exec clang -fsyntax-only -Werror -idirafter $work ," "$work/commands" |
    xargs -d '\n' -P "$(nproc)" -n 1 sh -c
