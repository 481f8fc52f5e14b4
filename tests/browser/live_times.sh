#!/usr/bin/env bash
# live_times.sh REPORT.html: how long the report's page takes to evaluate a layout of which a nozzle was moved, and one
# of which a nozzle was turned or took another angle or flow, in headless chromium.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: live_times.sh REPORT.html" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
browser=
finish() {
    [ -z "$browser" ] || { kill "$browser" && wait "$browser"; } 2>/dev/null || true
    rm -rf "$folder"
}
trap finish EXIT
{
    cat "$1"
    echo "<script>"
    cat "$here/live_times.js"
    echo "</script>"
} >"$folder/page.html"
chromium --headless --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader \
    --disable-dev-shm-usage --user-data-dir="$folder/profile" --enable-logging=stderr "file://$folder/page.html" \
    >/dev/null 2>"$folder/messages" &
browser=$!
for _ in $(seq 240); do
    if grep -o 'live-times [^"]*' "$folder/messages"; then
        exit 0
    fi
    sleep 1
done
echo "no answer from the page" >&2
exit 1
