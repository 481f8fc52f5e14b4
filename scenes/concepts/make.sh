#!/usr/bin/env bash
# Draws those pictures of scenes/CONCEPTS.md that come from the program (the others are drawings), in some five minutes:
#   scenes/concepts/make.sh
# $BUILD is the build directory (build). Needs chromium.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${BUILD:-build} out=out/concepts to=scenes/concepts
mkdir -p $out

# picture NAME PAGE SCRIPT: what the script leaves of the page
picture() {
    sed '/http-equiv="Content-Security-Policy"/d' "$2" >$out/page.html
    { echo '<script>' && cat $to/pictures.js && echo "$3" && echo '</script>'; } >>$out/page.html
    chromium --headless=new --no-sandbox --disable-gpu --virtual-time-budget=60000 --dump-dom "file://$PWD/$out/page.html" 2>/dev/null |
        grep -o 'PICTURE:[A-Za-z0-9+/=]*:' | cut -d: -f2 | base64 -d >"$to/$1"
    [ -s "$to/$1" ]
}

# run COMMAND SCENE NAME OPTIONS..: status 4, less covered than asked for, is none to stop at
run() {
    local command=$1 scene=$2 name=$3 status=0
    shift 3
    "$build/sprayplan" "$command" "$scene" -o "$out/$name" --quiet "$@" >/dev/null || status=$?
    [ $status -eq 0 ] || [ $status -eq 4 ]
}

# views: from the front, from behind and below, from above; of several layouts each from the front before the next
views="const view = [...document.querySelectorAll('svg.view')], bar = document.querySelector('svg.bar');"

"$build/scenes/vessel" scenes/vessel.obj >/dev/null
"$build/scenes/plain_vessel" scenes/plain_vessel.obj >/dev/null

run check scenes/vessel.yaml check
echo "<style></style><img src=\"data:image/png;base64,$(base64 -w0 $out/check/wet.png)\">" >$out/wet.html
picture wet.webp $out/wet.html \
    "const of = document.querySelector('img'); sheet([{of, crop: [.08, .08, .18, .42]}, {of, crop: [.41, .03, .18, .42]}, {of, crop: [.08, .5, .18, .49]}], 420);"

run simulate scenes/vessel.yaml charts --no-live --set report.quantity=charts --set "simulate.texel=30 mm"
echo "<style></style><img src=\"data:image/png;base64,$(base64 -w0 $out/charts/coverage.png)\">" >$out/atlas.html
picture atlas.webp $out/atlas.html "sheet([{of: document.querySelector('img'), crop: [0, 0, .5, 1]}], 400);"
picture charts.webp $out/charts/report.html "$views sheet([{of: view[0]}, {of: view[1]}], 400);"

run simulate scenes/vessel.yaml flux --no-live
picture flux.webp $out/flux/report.html "$views sheet([{of: view[0]}, {of: view[1]}, {of: view[2]}], 400, bar);"
picture shadows.webp $out/flux/report.html "$views sheet([{of: view[1], crop: [.3, .3, .7, .65]}, {of: view[2], crop: [.25, .3, .5, .55]}], 400);"
run simulate scenes/vessel.yaml incidence --no-live --set report.quantity=incidence
picture incidence.webp $out/incidence/report.html "$views sheet([{of: view[0]}, {of: view[1]}, {of: view[2]}], 400, bar);"

run simulate scenes/spray_ball.yaml film --no-live
picture film.webp $out/film/report.html "$views sheet([{of: view[0]}, {of: view[1]}], 400, bar);"
run simulate scenes/tunnel_washer.yaml dose --no-live
picture dose.webp $out/dose/report.html "$views sheet([{of: view[1]}, {of: view[2]}], 360, bar);"

run place scenes/vessel.yaml place --no-live --time-limit 200
picture layouts.webp $out/place/report.html "$views sheet([{of: view[0]}, {of: view[1]}, {of: view[2]}], 460);"
picture front.svg $out/place/report.html "leave(btoa(unescape(encodeURIComponent(alone(document.querySelector('#front svg'))))));"
