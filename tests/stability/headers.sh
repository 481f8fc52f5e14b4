#!/usr/bin/env bash
# headers.sh: every public header compiles alone, as C17 and as C++17, where all that is no ISO C or C++ is an error, and
# so does an error that is declared as README does it. Clang, where it is here, gets all headers at once.
set -euo pipefail
headers=$(cd "$(dirname "$0")/../../include" && pwd)
status=0

# check COMPILER HEADER LANGUAGE
check() {
    printf '#include <sprayplan/%s>\n#include <sprayplan/error.h>\nsp_error error = {0};\n' "$2" |
        "$1" -x "$3" -std="${3}17" -fsyntax-only -Wall -Werror -pedantic-errors -I "$headers" - ||
        { echo "$2 is no ${3}17 to $1"; status=1; }
}

for language in c c++; do
    for header in "$headers"/sprayplan/*.h; do
        check gcc "${header##*/}" $language
    done
    ! command -v clang >/dev/null || check clang sprayplan.h $language
done
exit $status
