# Sourced by tools/demo and tools/test: installs what is missing and builds. Debian 12 or newer; as root or with sudo.
# shellcheck shell=bash

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '\n== %s\n' "$*"; }

build_packages=(clang g++ cmake ninja-build pkg-config libserialport-dev nlohmann-json3-dev libfmt-dev
                libcli11-dev libvalijson-dev libncurses-dev libre2-dev libpng-dev doctest-dev libbenchmark-dev)
test_packages=(libclang-rt-dev)

# install PACKAGE...: those of them that are missing.
install() {
    local package missing=() as_root=()
    for package in "$@"; do
        [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" = installed ] || missing+=("$package")
    done
    if [ ${#missing[@]} -eq 0 ]; then
        say "All packages are there"
        return
    fi
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "Please install: ${missing[*]}" >&2; exit 1; }
        as_root=(sudo)
    fi
    say "Installing ${missing[*]}"
    "${as_root[@]}" apt-get update -qq
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

# build PRESET [CMAKE BUILD ARGUMENT...]
build() {
    local preset=$1
    shift
    say "Building, preset $preset"
    (cd "$top" && cmake --preset "$preset" >/dev/null && cmake --build --preset "$preset" "$@")
}
