#!/usr/bin/env bash
# newer.sh, in a build: sources compile against the libraries of another release of Debian, with the flags and warnings
# that they are built with. Its headers are those below the folder SPRAYPLAN_HEADERS, unpacked packages of any system;
# else, where SPRAYPLAN_LONG is set, those of the release SPRAYPLAN_RELEASE (trixie), which apt fetches from where it
# fetches this machine's into a scratch folder. The compiler and its own libraries stay the machine's. Minutes.
set -euo pipefail
source=$(cd "$(dirname "$0")/../.." && pwd)
release=${SPRAYPLAN_RELEASE:-trixie}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

skip() { echo "$1"; exit 77; }

# All that packages.txt names for building, and what these need of one another's headers.
fetch() {
    command -v apt-get >/dev/null || skip "apt-get is not here"
    local from
    from=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | head -1)
    [ -n "$from" ] || skip "apt knows no packages of Debian here: apt-get update"
    mkdir -p "$work"/state/lists/partial "$work"/cache/archives/partial "$1"
    echo "deb $from $release main" >"$work/sources"
    touch "$work/status"
    local apt=(apt-get -qq -o APT::Sandbox::User=root -o "Dir::State=$work/state" -o "Dir::State::status=$work/status"
               -o "Dir::Cache=$work/cache" -o "Dir::Etc::SourceList=$work/sources" -o Dir::Etc::SourceParts=/dev/null)
    "${apt[@]}" update || skip "apt does not get at $release"
    local wanted packages
    wanted=$(awk '$2 ~ /^z?lib.*-dev$/ && $2 !~ /cmocka|embree/ {print $2}' "$source/packages.txt")
    packages=$("${apt[@]}" install -s --no-install-recommends $wanted | sed -n 's/^Inst \([^ ]*-dev\) .*/\1/p' |
        grep -v -E '^(libc6|libcrypt|linux-libc|libgcc|libgfortran|libstdc)')
    (cd "$work/cache/archives" && "${apt[@]}" download $packages)
    for package in "$work"/cache/archives/*.deb; do
        dpkg-deb -x "$package" "$1"
        dpkg-deb -W --showformat '${Package} ${Version}\n' "$package"
    done | grep -E "^($(echo $wanted | tr ' ' '|')) "
}

headers=${SPRAYPLAN_HEADERS:-}
if [ -z "$headers" ]; then
    [ -n "${SPRAYPLAN_LONG:-}" ] || skip "neither SPRAYPLAN_HEADERS nor SPRAYPLAN_LONG is set"
    headers=$work/headers
    fetch "$headers"
fi
[ -d "$headers/usr/include" ] || { echo "no usr/include below $headers"; exit 1; }

. "$source/tests/stability/commands.sh"
commands "$work" >"$work/commands"
[ "$(wc -l <"$work/commands")" -gt 200 ] || { echo "too few commands here"; exit 1; }
triplet=$(gcc -print-multiarch)
mkdir "$work/read"
sed -E "s, (-I|-isystem )/usr/, \\1$headers/usr/,g" "$work/commands" | while read -r command; do
    file=${command##* }
    compiler=gcc
    [ "${file%.cc}" = "$file" ] || compiler=g++
    read=${file#"$source/"}
    echo "exec $compiler -fsyntax-only -Werror -MD -MF $work/read/${read//\//-} -isystem $headers/usr/include" \
        "-isystem $headers/usr/include/$triplet $command"
done | xargs -d '\n' -P "$(nproc)" -n 1 sh -c

# What was read: of a header that is among the others no other is to be taken, and of no library all may be lacking.
cat "$work"/read/* | tr -s ' \\\n' '\n' | grep '^/' | sort -u >"$work/all"
grep '^/usr/' "$work/all" | while read -r file; do
    [ ! -e "$headers$file" ] || { echo "$file was read, not $headers$file"; exit 1; }
done
missing=0
for header in ceres/ceres.h OpenImageIO/imageio.h libfyaml.h udunits2.h jansson.h zlib.h webp/encode.h sha2.h \
              STEPCAFControl_Reader.hxx mpi.h; do
    grep -q "^$headers/.*/$header\$" "$work/all" && continue
    grep -q "/$header\$" "$work/all" && { echo "$header is not below $headers: this machine's was read"; missing=1; }
done
echo "$(wc -l <"$work/commands") sources, $(grep -c "^$headers/" "$work/all") headers of the others"
exit $missing
