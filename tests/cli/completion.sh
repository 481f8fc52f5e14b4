#!/usr/bin/env bash
# completion.sh PROGRAM: what bash offers for the program is what its help lists and its errors name.
set -u # not -e: completion runs in shells that go on
program=$1
. "$(dirname "$0")/../../src/install/completion/sprayplan" || exit 1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
mkdir -p out/deeper 'with blanks'
touch a.yaml B.YML result.json c.obj d.STL e.stp f.txt out/g.yaml 'with blanks/h.yaml'

status=0
# expect WHAT WORD..: that it is offered (sorted, in one line) for the last of the words
expect() {
    local what=$1
    shift
    COMP_WORDS=("$program" "$@")
    COMP_CWORD=$#
    _sprayplan "$program" "${*: -1}" "${COMP_WORDS[$# - 1]}"
    local offered
    offered=$(printf '%s\n' "${COMPREPLY[@]}" | sort -u | paste -sd ' ')
    [[ $offered == "$what" ]] || { printf '%s:\n  offered  %s\n  expected %s\n' "$*" "$offered" "$what"; status=1; }
}
sorted() { tr ' ' '\n' | sed '/^$/d' | sort -u | paste -sd ' '; }

# The program itself knows the commands, and which options each takes.
commands=$("$program" --help | sed -n '/^commands:/,/^$/p' | grep -oE '^  [a-z]+' | sorted)
[[ " $commands " == *" place "* ]] || { echo "no commands in the help"; exit 1; }
expect "$commands" ''
expect 'check compare' c
for command in $commands; do
    options=$("$program" "$command" --help | grep -oE '^  --?[a-zA-Z].{21}' | grep -oE -- '(^| )--?[a-zA-Z][a-z-]*' | sorted)
    [[ $options == *--json* ]] || { echo "no options in the help of $command"; status=1; }
    expect "$options" "$command" -
    for option in $options; do
        ! "$program" "$command" "$option" 2>&1 | grep -E 'unknown|unrecognized|does not take' || status=1
    done
done

# Choices are those that the program asks for when it finds another.
chosen() {
    local option=$1
    shift
    "$program" "$@" 2>&1 | sed -n "s/.*$option: found .*, expected //p" | sed 's/, / /g; s/ or / /' | sorted
}
expect "$(chosen --pack atlas c.obj --pack no)" atlas --pack ''
expect "$(chosen --accel trace c.obj --rays f.txt --accel no)" trace --accel ''
expect "$(chosen --mode bench c.obj --mode no)" bench --mode ''
expect "$(chosen --trajectory bench c.obj --trajectory no)" bench --trajectory ''
expect skyline atlas --pack s
expect skyline atlas --pack = s
expect 'pixels skyline' atlas --pack =

# Files by what is asked for, and folders.
expect 'B.YML a.yaml out with blanks' place ''
expect 'B.YML a.yaml out with blanks' --threads 2 place --json ''
expect 'out/deeper out/g.yaml' place out/
expect 'with blanks/h.yaml' place 'with\ blanks/'
expect 'B.YML a.yaml out result.json with blanks' compare a.yaml ''
expect 'c.obj d.STL e.stp out with blanks' bench ''
expect 'out with blanks' place a.yaml -o ''
expect 'c.obj out with blanks' atlas c.obj -o ''
expect 'c.obj out with blanks' check a.yaml --repair ''
expect 'B.YML a.yaml c.obj d.STL e.stp f.txt out result.json with blanks' trace --rays ''
expect '' bench --rays ''
expect '' place --time-limit ''
expect '--memory' place a.yaml --mem
topics=$("$program" --help | sed -n '/^sprayplan help TOPIC:/,/^$/s/^  \([a-z]*\)  .*/\1/p' | sorted)
expect "$(echo "$commands $topics" | sorted)" help ''
exit $status
