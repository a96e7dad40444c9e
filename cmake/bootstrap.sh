#!/usr/bin/env bash
# From a bare machine to a running Pacini. Safe to repeat: installs only what is missing, builds only what changed.
#
#   bash cmake/bootstrap.sh demo    install, build, encode and render the demo sounds, print the report
#   bash cmake/bootstrap.sh test    install, build, run every test (release build, then with sanitizers)
#   bash cmake/bootstrap.sh build   install and build the command: build/release/bin/pacini
#   bash cmake/bootstrap.sh plugin  install and build the plugin and the standalone: build/release/plugins
#   bash cmake/bootstrap.sh deps    only install what building and testing need
set -euo pipefail
help=$(sed -n '2,8p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//')
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build_packages=(g++ cmake ninja-build ccache pkg-config nlohmann-json3-dev libfmt-dev libcli11-dev libsndfile1-dev
    libkissfft-dev libeigen3-dev libcairo2-dev libhidapi-dev)
# The plugin, the hosts that it is tried in, and a game controller that does not exist.
plugin_packages=(juce-modules-source libjack-jackd2-dev fonts-dejavu-core)
host_packages=(python3-venv liblilv-dev lv2-dev xvfb xauth xdotool imagemagick x11-utils jackd2 jack-tools ardour
    umockdev gir1.2-umockdev-1.0 python3-gi)
host_modules=(dawdreamer==0.9.0 pedalboard==0.9.26 'numpy<3' 'soundfile<1')
test_packages=(catch2 python3 python3-jsonschema clang-format "${plugin_packages[@]}" "${host_packages[@]}")

say() { printf '\n== %s\n' "$*"; }
usage() { printf '%s\n' "$help"; }
fail() { printf 'bootstrap: %s\n' "$*" >&2; exit 1; }

install_packages() {
    if [ "$(uname -s)" != Linux ] || ! command -v apt-get >/dev/null; then
        cat <<'TEXT'
bootstrap: installs by itself on Debian and Ubuntu only. Elsewhere, install a C++20 compiler, CMake 3.25, Ninja, pkg-config,
nlohmann-json, fmt, CLI11, libsndfile, kissfft, Eigen and cairo (for the tests also Catch2 and Python 3 with jsonschema), then run
    cmake --workflow --preset test
  macOS (Homebrew):  brew install cmake ninja pkg-config nlohmann-json fmt cli11 libsndfile kissfft eigen cairo catch2 python
  Windows (vcpkg):   vcpkg install nlohmann-json fmt cli11 libsndfile kissfft eigen3 cairo catch2 pkgconf
TEXT
        exit 1
    fi
    local missing=()
    for package in "$@"; do
        # What is there already, from a package or otherwise, is left alone.
        case "$package" in
        g++) command -v g++ >/dev/null && continue ;;
        cmake) command -v cmake >/dev/null && continue ;;
        ninja-build) command -v ninja >/dev/null && continue ;;
        esac
        dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    local root=()
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null || fail "these packages are missing and neither root nor sudo is at hand: ${missing[*]}"
        root=(sudo)
    fi
    say "Installing ${missing[*]}"
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# Hosts that come as Python modules, in a place of their own.
install_host_modules() {
    local venv=build/hosts-venv
    [ "$(cat "$venv/modules" 2>/dev/null)" != "${host_modules[*]}" ] || return 0
    say "Installing ${host_modules[*]} in $venv"
    if python3 -m venv "$venv" && "$venv/bin/python" -m pip install -q --disable-pip-version-check "${host_modules[@]}"; then
        printf '%s' "${host_modules[*]}" >"$venv/modules"
    else
        printf 'bootstrap: these modules cannot be installed; the tests in DawDreamer and Pedalboard will be SKIPPED\n' >&2
    fi
}

build() { # preset, target
    cmake --preset "$1" "${@:3}" >/dev/null || { cmake --preset "$1" "${@:3}"; fail "cannot configure the preset $1"; }
    cmake --build --preset "$1" --target "$2"
}

case "${1:-}" in
deps)
    install_packages "${build_packages[@]}" "${test_packages[@]}"
    install_host_modules
    ;;
build)
    install_packages "${build_packages[@]}"
    say "Building"
    build release pacini -DPACINI_BUILD_TESTS=OFF -DPACINI_BUILD_PLUGIN=OFF
    ;;
demo)
    install_packages "${build_packages[@]}"
    say "Building"
    build release pacini -DPACINI_BUILD_TESTS=OFF -DPACINI_BUILD_PLUGIN=OFF
    pacini=build/release/bin/pacini
    say "Encoding Resources/demo to build/demo/clips"
    "$pacini" encode Resources/demo -o build/demo/clips --format packed --force --overwrite
    say "Rendering the clips for the L5 wristband to build/demo/wristband"
    "$pacini" render build/demo/clips -o build/demo/wristband --profile l5-wristband --force --overwrite
    say "Rendering a scene of the clips for three actuators to build/demo/workshop.wav"
    "$pacini" render Resources/demo/workshop.scene.json --clips build/demo/clips -o build/demo/workshop.wav --explain
    say "What the clips hold"
    "$pacini" info build/demo/clips/*.pacb
    say "How close their drive signals are to the sounds"
    "$pacini" render build/demo/clips -o build/demo/flat --overwrite >/dev/null
    "$pacini" compare Resources/demo build/demo/flat
    ;;
plugin)
    install_packages "${build_packages[@]}" "${plugin_packages[@]}"
    say "Building the plugin"
    build release pacini_plugin_All -DPACINI_BUILD_TESTS=OFF -DPACINI_BUILD_PLUGIN=ON
    say "VST3, LV2 and the standalone program are in build/release/plugins"
    ;;
test)
    install_packages "${build_packages[@]}" "${test_packages[@]}"
    install_host_modules
    say "Building"
    build release all -DPACINI_BUILD_TESTS=ON -DPACINI_BUILD_PLUGIN=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=8
    say "Compiling every header on its own"
    cmake --build --preset release --target all_verify_interface_header_sets
    say "Testing"
    ctest --preset release
    say "Building with the address and undefined-behaviour sanitizers"
    build asan all
    say "Testing with sanitizers"
    ctest --preset asan
    say "All tests passed"
    ;;
-h | --help | help)
    usage
    ;;
*)
    [ $# -eq 0 ] || printf "bootstrap: '%s' is not one of demo, test, build, plugin and deps\n\n" "$1" >&2
    usage >&2
    exit 2
    ;;
esac
