#!/usr/bin/env bash
# headers.sh: every public header compiles alone, as C17 and as C++17, where all that is no ISO C or C++ is an error, and
# so does an error that is declared as README does it.
set -euo pipefail
headers=$(cd "$(dirname "$0")/../../include" && pwd)
status=0
for compiler in gcc clang; do
    command -v $compiler >/dev/null || continue
    for header in "$headers"/sprayplan/*.h; do
        for language in c c++; do
            printf '#include <sprayplan/%s>\n#include <sprayplan/error.h>\nsp_error error = {0};\n' "${header##*/}" |
                $compiler -x $language -std=${language}17 -fsyntax-only -Wall -Werror -pedantic-errors -I "$headers" - || { echo "${header##*/} as ${language}17 by $compiler"; status=1; }
        done
    done
done
exit $status
