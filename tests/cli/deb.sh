#!/usr/bin/env bash
# deb.sh BUILD: the Debian packages of a build. Each has what its name says, lintian finds neither errors nor warnings,
# and what they unpack to runs every example where it lies. Skipped where Debian's tools are not there.
set -euo pipefail
for tool in dpkg-deb dpkg-shlibdeps lintian; do
    command -v $tool >/dev/null || { echo "$tool is not here"; exit 77; }
done
build=$1
scratch=$(mktemp -d "$build/tests/cli-XXXXXX")
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

status=0
wrong() {
    echo "$@"
    status=1
}

# has PACKAGE PATTERN..: every file and link of the package is one of these, and each of these is there
has() {
    local package=$1 documents=/usr/share/doc/$1 file pattern
    shift
    dpkg-deb -c "$package"_*.deb | awk '!/^d/ {print substr($6, 2)}' >files
    for pattern in "$@" $documents/{copyright,changelog.Debian.gz}; do
        grep -Eqx "$pattern" files || wrong "$package lacks $pattern"
    done
    while read -r file; do
        pattern=$(printf '%s|' "$@")
        [[ $file =~ ^($pattern$documents/.*)$ ]] || wrong "$package has $file"
    done <files
}

# depends PACKAGE: on what
depends() { dpkg-deb -f "$1"_*.deb Depends; }

cpack --config "$build/CPackConfig.cmake" -G DEB -B . -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip >log 2>&1 ||
    { cat log; exit 1; }
lib="/usr/lib/[^/]*"
has sprayplan /usr/bin/sprayplan "$lib/sprayplan/sprayplan-(ceres|images)\.so" /usr/share/man/man1/sprayplan.1.gz \
    "/usr/share/man/man5/sprayplan-(scene|catalogue|result|files|outputs).5.gz" /usr/share/doc/sprayplan/examples/CONCEPTS.md \
    /usr/share/bash-completion/completions/sprayplan
has libsprayplan0 "$lib/libsprayplan\.so\.0" "$lib/libsprayplan\.so\.0\.[0-9.]*"
has libsprayplan-dev "$lib/libsprayplan\.so" "$lib/libsprayplan\.a" "/usr/include/sprayplan/[a-z]*\.h" \
    "$lib/pkgconfig/sprayplan\.pc" "$lib/cmake/sprayplan/sprayplan(Config|Static|Targets)[a-zA-Z-]*\.cmake"
built() { grep -q "CPACK_COMPONENTS_ALL.*\b$1\b" "$build/CPackConfig.cmake"; }
! built cad || has sprayplan-cad /usr/libexec/sprayplan/sprayplan-cad
! built mpi || has sprayplan-mpi "$lib/sprayplan/sprayplan-mpi\.so"
! depends sprayplan | grep -E 'occt|mpi' || wrong "sprayplan alone needs what its parts need"
depends libsprayplan-dev | grep -q 'libsprayplan0 (= ' || wrong "libsprayplan-dev goes with any library"

lintian --allow-root --fail-on error,warning ./*.deb || status=1

for package in *.deb; do
    dpkg-deb -x "$package" root
done
program=$(find "$PWD/root" -type f -name sprayplan -perm -u+x)
cd "$(find root -type d -name examples)"
for scene in $(grep -l ^geometry: *.yaml); do
    [ "$scene" != vessel.yaml ] || pictures="-o $scratch/out"
    "$program" check "$scene" --set "simulate.texel=200 mm" ${pictures:-} >"$scratch/log" 2>&1 ||
        { cat "$scratch/log"; wrong "$scene does not run"; }
done
[ -s "$scratch/out/wet.png" ] || wrong "there is no picture of the vessel"
exit $status
