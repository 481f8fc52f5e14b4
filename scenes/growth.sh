#!/usr/bin/env bash
# How seconds and memory of `place` grow, as tables: processor seconds by stage and peak memory, and each stage's exponent, the
# slope of least squares over the logarithms.
#   scenes/growth.sh SCENE [points|texels|triangles|nozzles ..] [-- options of place]
# SCENE is vessel or hall. $BUILD is the build directory (build). What was measured before, in out/growth, is kept.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build} out=out/growth
export OMP_WAIT_POLICY=passive
what=${1:?vessel or hall}
shift
growing=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do growing+=("$1") && shift; done
options=("${@:2}")
mkdir -p $out
cp scenes/catalogue.yaml $out

"$build/scenes/vessel" $out/vessel.obj >/dev/null
"$build/scenes/hall" $out/hall-coarse.obj
[ -e $out/hall.obj ] || "$build/scenes/refine_mesh" $out/hall-coarse.obj 30000 $out/hall.obj 0
texel=$([ "$what" = vessel ] && echo 20 || echo 200)

# measure NAME SEDS OPTIONS..: one placement of the scene edited so
measure() {
    local name=$what-$1 edit=$2 status=0
    shift 2
    [ -e "$out/$name.kib" ] && return
    sed -e "$edit" "scenes/$what.yaml" >"$out/$name.yaml"
    env time -f %M -o "$out/$name.time" "$build/sprayplan" place "$out/$name.yaml" --quiet --json --set "simulate.texel=$texel mm" \
        "$@" "${options[@]}" >"$out/$name.json" 2>"$out/$name.txt" || status=$?
    [ $status -eq 0 ] || [ $status -eq 4 ] || { cat "$out/$name.txt" >&2 && exit $status; }
    tail -1 "$out/$name.time" >"$out/$name.kib"
}

# stages NAME: each stage with its seconds
stages() {
    awk -F'[:,]' '/"name"/ {name = $2; gsub(/^ *"|" *$/, "", name)} /"processor_seconds"/ {print name ";" $2}' "$out/$what-$1.json"
    awk '{print "peak memory, MiB;" $1 / 1024}' "$out/$what-$1.kib"
}

# table TITLE X:NAME ..: a row a stage, a column a run; by X the exponent
table() {
    local title=$1 pair
    shift
    for pair in "$@"; do stages "${pair#*:}" | sed "s/^/${pair%%:*};/"; done | awk -F';' -v title="$title" '
        !($1 in column) {column[$1] = ++columns; x[columns] = $1}
        !($2 in row) {row[$2] = ++rows; name[rows] = $2}
        {cell[row[$2], column[$1]] += $3}
        END {
            printf "| %s |", title; for (c = 1; c <= columns; c++) printf " %s |", x[c]; print " exponent |"
            printf "|---|"; for (c = 0; c <= columns; c++) printf "---|"; print ""
            for (r = 1; r <= rows; r++) {
                n = sx = sy = sxx = sxy = most = 0
                for (c = 1; c <= columns; c++) {
                    v = cell[r, c]; if (v > most) most = v
                    if (v > 0) {n++; a = log(x[c]); b = log(v); sx += a; sy += b; sxx += a * a; sxy += a * b}
                    if (name[r] !~ /memory/) sum[c] += v
                }
                if (most < .05) continue
                printf "| %s |", name[r]; for (c = 1; c <= columns; c++) printf " %.*f |", name[r] ~ /memory/ ? 0 : 2, cell[r, c]
                d = n * sxx - sx * sx; if (d > 0) printf " %.2f |\n", (n * sxy - sx * sy) / d; else print " |"
            }
            printf "| all |"; n = sx = sy = sxx = sxy = 0
            for (c = 1; c <= columns; c++) {printf " %.2f |", sum[c]; n++; a = log(x[c]); b = log(sum[c]); sx += a; sy += b; sxx += a * a; sxy += a * b}
            printf " %.2f |\n\n", (n * sxy - sx * sy) / (n * sxx - sx * sx)
        }'
}

points() {
    local by
    for by in 1 4 16; do
        if [ "$what" = vessel ]; then # along a lance all of it is one direction, on the shell two
            measure points-$by "s/spacing: 100 mm/spacing: $(awk "BEGIN {print 100 / $by}") mm/
                                s/spacing: 300 mm/spacing: $(awk "BEGIN {print 300 / sqrt($by)}") mm/"
        else
            measure points-$by "s/spacing: 2 m/spacing: $(awk "BEGIN {print 2 / sqrt($by)}") m/"
        fi
    done
    table "mounting points, times" 1:points-1 4:points-4 16:points-16
}

texels() {
    local by
    for by in 1 4 16; do
        measure texels-$by "" --set "simulate.texel=$(awk "BEGIN {print $texel / sqrt($by)}") mm"
    done
    table "texels, times" 1:texels-1 4:texels-4 16:texels-16
}

triangles() {
    local count
    for count in 30000 500000 8000000; do
        [ -e "$out/$what-$count.obj" ] || "$build/scenes/refine_mesh" "$out/$what.obj" $count "$out/$what-$count.obj" 0
        measure triangles-$count "s/file: .*\.obj/file: $what-$count.obj/"
    done
    table triangles 30000:triangles-30000 500000:triangles-500000 8000000:triangles-8000000
}

nozzles() {
    local most list=()
    for most in 4 8 16 32 64; do
        # so much liquid is asked for that all of them are wanted
        measure nozzles-$most "s/flux: [0-9.]* L/flux: $([ "$what" = vessel ] && echo 16 || echo 1.5) L/" \
            --set place.objective=max_coverage --set place.max_nozzles=$most --set "place.max_water=10000 L/min" \
            --set "place.types=[full-cone-90-12, full-cone-60-9, flat-fan-90-10, hollow-cone-80-8]"
        list+=("$most:nozzles-$most")
    done
    table nozzles "${list[@]}"
}

[ ${#growing[@]} -gt 0 ] || growing=(points texels triangles nozzles)
for each in "${growing[@]}"; do $each; done
