# Sourced by tools/demo and tools/test: installs what is missing and builds. Debian 12 or newer; as root or with sudo.
# shellcheck shell=bash

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '\n== %s\n' "$*"; }

# What the program is built with, and what its tests want besides.
build_packages=(clang lld g++ cmake ninja-build pkg-config libserialport-dev nlohmann-json3-dev libfmt-dev
                libcli11-dev libncurses-dev libre2-dev libpng-dev libmicrohttpd-dev libjs-dygraphs
                libfreetype-dev fonts-dejavu-core libmd-dev)
test_packages=(doctest-dev libbenchmark-dev libclang-rt-dev printrun-common python3-serial
               clang-format)
lint_packages=(clang-tidy)
# Of these only the files are taken: what they depend on is for uses that nobody has here.
header_packages=(libvalijson-dev)

# as_root COMMAND...
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    else
        sudo "$@"
    fi
}

# install PACKAGE...: those of them that are missing.
install() {
    local package missing=()
    for package in "$@"; do
        [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" = installed ] || missing+=("$package")
    done
    if [ ${#missing[@]} -eq 0 ]; then
        say "All packages are there"
        unpack
        return
    fi
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "Please install: ${missing[*]}" >&2; exit 1; }
    fi
    say "Installing ${missing[*]}"
    as_root apt-get update -qq
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
    unpack
}

# fetch PACKAGE: its file into this folder; the lists of what there is may be missing, or old.
fetch() {
    apt-get download -qq "$1" 2>/dev/null || { as_root apt-get update -qq && apt-get download -qq "$1"; }
}

# The files of the header packages, into .packages in this checkout, if nobody has installed them.
unpack() {
    local package folder
    for package in "${header_packages[@]}"; do
        [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" != installed ] || continue
        [ ! -e "$top/.packages/$package" ] || continue
        say "Unpacking the headers of $package"
        folder=$(mktemp -d)
        chmod 755 "$folder"  # apt fetches as a user of its own
        if ! (cd "$folder" && fetch "$package" && dpkg-deb -x ./*.deb "$top/.packages"); then
            as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$package"
        fi
        rm -rf "$folder"
        touch "$top/.packages/$package"
    done
}

# build PRESET [CMAKE BUILD ARGUMENT...], with a low priority: tests may run beside it. `tests` says whether they are
# wanted, and with them what only they need.
tests=ON
build() {
    local preset=$1
    shift
    say "Building, preset $preset"
    (cd "$top" && cmake --preset "$preset" -DBUILD_TESTING="$tests" >/dev/null && nice cmake --build --preset "$preset" "$@")
}
