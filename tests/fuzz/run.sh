#!/usr/bin/env bash
# Feeds the readers of strangers' files with libFuzzer's inputs, one reader after the other, and prints a table of it.
#
#   tests/fuzz/run.sh [-a] [-j JOBS] (-n INPUTS | -m MINUTES) [READER...]
#
# -n, -m: for each reader. -a: under the address sanitizer too, four times slower; without it memory is counted instead.
# -j: so many readers at a time. What was found interesting is kept for the next run, and inputs that failed, below
# $SPRAYPLAN_FUZZ_CORPUS (~/.cache/sprayplan-fuzz). Needs clang with its compiler-rt. Fails where anything was found.
set -euo pipefail
cd "$(dirname "$0")/../.."

usage() { sed -n '4s/^# *//p' tests/fuzz/run.sh >&2; exit 2; }
preset=fuzz-fast jobs=1 limit=
while getopts aj:n:m: option; do
    case $option in
        a) preset=fuzz ;;
        j) jobs=$OPTARG ;;
        n) limit=-runs=$OPTARG ;;
        m) limit=-max_total_time=$((60 * OPTARG)) ;;
        *) usage ;;
    esac
done
shift $((OPTIND - 1))
[ -n "$limit" ] || usage
readers=("$@")
[ $# -gt 0 ] || mapfile -t readers < <(ls tests/fuzz/seeds)
corpus=${SPRAYPLAN_FUZZ_CORPUS:-${XDG_CACHE_HOME:-$HOME/.cache}/sprayplan-fuzz}

cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --parallel "$(nproc)" >&2

# From a folder of its own, so that nothing that an input names is there by chance.
run() {
    local reader=$1 program=$PWD/build-$preset/tests/fuzz/fuzz-$1 seeds=$PWD/tests/fuzz/seeds/$1
    local dictionary=$PWD/tests/fuzz/dictionaries/$1 log=$corpus/$1.log options=()
    [ ! -f "$dictionary" ] || options=(-dict="$dictionary")
    mkdir -p "$corpus/$reader" "$corpus/found"
    TIMEFORMAT='seconds: %U %S'
    { time (cd "$corpus" && nice -n 19 "$program" "$limit" -timeout=5 -rss_limit_mb=1024 -print_final_stats=1 \
        -artifact_prefix="found/$reader-" "${options[@]}" "$reader" "$seeds" 2>&1); } >"$log" 2>&1 || true
    awk -v reader="$reader" '/number_of_executed_units/ {inputs = $2} /^seconds:/ {seconds = $2 + $3}
        /^SUMMARY/ {found = 1; what = $0} END {
        printf "%-10s %12d %10d %9d  %s\n", reader, inputs, inputs / seconds, found, what; exit found}' "$log"
}
export -f run
export corpus preset limit

printf '%-10s %12s %10s %9s\n' reader inputs "per CPU s" findings
printf '%s\n' "${readers[@]}" | xargs -P "$jobs" -I{} bash -euc 'run {}'
