#!/usr/bin/env bash
# Builds the program with GCC and Clang at -O0, -O2 and -O3, and compares what each finds: the same hits but for ties,
# and the same coverage to 1e-9 outside of what is borderline. Takes half an hour of processor time, so that it runs
# only where SPRAYPLAN_LONG is set; a compiler that is not here is left out. Builds stay in the folder given, if any.
set -euo pipefail
[[ -n ${SPRAYPLAN_LONG:-} ]] || { echo "SPRAYPLAN_LONG is not set"; exit 77; }
source=$(cd "$(dirname "$0")/../.." && pwd)
work=${1:-$(mktemp -d)}
[[ $# -gt 0 ]] || trap 'rm -rf "$work"' EXIT
mkdir -p "$work"

# build COMPILER C++COMPILER LEVEL: the program, in $work/COMPILER-LEVEL; fails where the compiler or its OpenMP is not
# there
build() {
    local to=$work/$1-$3
    command -v "$1" >/dev/null && command -v "$2" >/dev/null || return 1
    cmake -S "$source" -B "$to" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_C_COMPILER="$1" -DCMAKE_CXX_COMPILER="$2" \
          -DCMAKE_C_FLAGS="-$3" -DCMAKE_CXX_FLAGS="-$3" >"$to.log" 2>&1 || return 1
    cmake --build "$to" --target sprayplan-program vessel >>"$to.log" 2>&1 || { tail -5 "$to.log" >&2; exit 1; }
}

# From within the vessel in all directions, in mm as its file is: a golden spiral (as on a sunflower).
rays() {
    awk 'BEGIN { for (i = 0; i < 20000; i++) {
        z = 1 - (2 * i + 1) / 20000; r = 9000 * sqrt(1 - z * z); a = 2.399963229728653 * i
        printf "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", 300 + 100 * sin(i), 100 * cos(i), 600 + 200 * sin(3 * i),
               r * cos(a), r * sin(a), 9000 * z } }'
}

# look BUILD: its answers, beside it
look() {
    local program=$work/$1/sprayplan answers=$work/$1-answers
    mkdir -p "$answers"
    "$program" trace "$work/scene/vessel.obj" --rays "$work/rays.csv" >"$answers/lines.csv"
    "$program" trace "$work/scene/vessel.obj" --rays "$work/rays.csv" --gravity 0,0,-9810 >"$answers/parabolas.csv"
    for trajectory in line parabola; do
        "$program" simulate "$work/scene/vessel.yaml" --json --set simulate.trajectory=$trajectory \
            >"$answers/$trajectory.json"
    done
}

# Prints how many hits differ, how many of them are ties (as early to 1e-9), and by how much times do.
compare_hits() {
    paste -d, "$1" "$2" | awk -F, -v what="$3" 'NR > 1 {
        n++; off = $2 == "" || $12 == "" ? ($2 == $12 ? 0 : 1) : ($2 - $12) / $2; off = off < 0 ? -off : off
        if (off > worst) worst = off
        if ($3 != $13) { differ++; if (off <= 1e-9 && $2 != "") ties++ } }
        END { printf "%s: %d of %d hits on another triangle, %d of them ties; times differ by %.1e at most\n", what,
                     differ, n, ties, worst; exit differ > ties || worst > 1e-9 }'
}

figure() { grep -o "\"$2\": *[0-9.eE+-]*" "$1" | head -1 | sed 's/.*: *//'; }

compare_coverage() {
    awk -v a="$(figure "$1" coverage)" -v b="$(figure "$2" coverage)" -v area="$(figure "$1" clean_area_m2)" \
        -v edge="$(figure "$1" borderline_m2)" -v other="$(figure "$2" borderline_m2)" -v what="$3" 'BEGIN {
        off = a - b; off = off < 0 ? -off : off; edge = edge > other ? edge : other
        printf "%s: coverage differs by %.1e, borderline is %.1e of the area\n", what, off, edge / area
        exit off > 1e-9 + edge / area || edge > 1e-6 * area || !(area > 0) }'
}

built=()
for level in O0 O2 O3; do
    build gcc g++ $level && built+=("gcc-$level")
    build clang clang++ $level && built+=("clang-$level")
done
[[ ${#built[@]} -ge 2 ]] || { echo "fewer than two compilers here"; exit 77; }
mkdir -p "$work/scene"
cp "$source"/scenes/*.yaml "$work/scene/"
"$work/${built[0]}/scenes/vessel" "$work/scene/vessel.obj" >/dev/null
rays >"$work/rays.csv"
first=$work/${built[0]}-answers status=0
for name in "${built[@]}"; do
    look "$name"
    for kind in lines parabolas; do
        compare_hits "$first/$kind.csv" "$work/$name-answers/$kind.csv" "$name, $kind" || status=1
    done
    for kind in line parabola; do
        compare_coverage "$first/$kind.json" "$work/$name-answers/$kind.json" "$name, $kind" || status=1
    done
done
exit $status
