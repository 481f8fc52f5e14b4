# Sourced by scenes/quickstart.sh and tests/run.sh, from the top of the checkout. Needs bash.

# require_packages KIND...: installs what packages.txt marks with one of these kinds and the machine lacks.
require_packages() {
    local kinds=" $* " kind name missing=()
    while read -r kind name; do
        case "$kind" in '' | '#'*) continue ;; esac
        if [[ "$kinds" == *" $kind "* && "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" != installed ]]; then
            missing+=("$name")
        fi
    done <packages.txt
    [ ${#missing[@]} -gt 0 ] || return 0

    if ! command -v apt-get >/dev/null; then
        echo "These Debian packages (or what they are called here) are missing: ${missing[*]}" >&2
        return 1
    fi
    local root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "These packages are missing and can only be installed by root: ${missing[*]}" >&2
            return 1
        fi
        root=(sudo)
    fi
    echo "Installing ${missing[*]}" >&2
    "${root[@]}" apt-get update -q >&2 &&
        "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 install -q -y --no-install-recommends "${missing[@]}" >&2 || {
        echo "Could not install ${missing[*]}" >&2
        return 1
    }
}
