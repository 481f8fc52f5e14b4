#!/usr/bin/env bash
# times.sh live|open REPORT.html: how long the report's page takes in headless chromium to evaluate changed layouts
# (live_times.js), or until what it shows is drawn and layouts can be changed (open_times.js).
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: times.sh live|open REPORT.html" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
browser=
finish() {
    [ -z "$browser" ] || { kill "$browser" && wait "$browser"; } 2>/dev/null || true
    rm -rf "$folder"
}
trap finish EXIT
{
    cat "$2"
    echo "<script>"
    cat "$here/$1_times.js"
    echo "</script>"
} >"$folder/page.html"
chromium --headless --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader \
    --disable-dev-shm-usage --user-data-dir="$folder/profile" --enable-logging=stderr "file://$folder/page.html" \
    >/dev/null 2>"$folder/messages" &
browser=$!
for _ in $(seq 240); do
    if grep -o "$1-times [^\"]*" "$folder/messages"; then
        exit 0
    fi
    sleep 1
done
echo "no answer from the page" >&2
exit 1
