"""The sources of the command and of libpacini compile for macOS as far as headers go: by the Clang within Zig, which
brings the headers of macOS's C library and those of libc++, and for the oldest macOS that .github/workflows/build.yml
asks for, of whose C++ library nothing may be used that came later. Headers of other libraries are Debian's. Nothing is
linked or run, and there are no headers of macOS's frameworks.

check_macos.py SOURCE BUILD    BUILD: a folder configured by CMake, which knows sources and definitions

All sources are compiled for ARM, and one of each target for x86, for which none has lines of its own. With
PACINI_MACOS_TURN, a number, every second one of those for ARM. Exit 0, 1 with what the compiler said, 77 where Zig is
missing.
"""
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SOURCE, BUILD = (Path(word).resolve() for word in sys.argv[1:3])
PYTHON = SOURCE / "build/zig-venv/bin/python"
# What people run on macOS without JUCE, with the fewest sources that each may have: none is lost unseen.
TARGETS = {"pacini_io": 15, "pacini_devices": 10, "pacini_study": 3, "pacini_phone": 1, "pacini_live": 1, "pacini_cli": 10,
           "pacini": 1, "pacini_benches": 1, "pacini-bench": 1, "pacini_library_control": 10, "pacini_library_render": 1}
# Headers of libraries that Debian has in the folder of the C library of Linux.
HEADERS = ("nlohmann", "fmt", "CLI", "boost", "sndfile.h", "expat.h", "expat_external.h", "zip.h", "zipconf.h",
           "hidapi", "qrcodegen", "qrcodegencpp")
# Of Linux alone.
LEFT_OUT = {"-DPACINI_HAS_PULSE=1", "-DPACINI_HAS_RTAUDIO=1"}
# What stops, and at which header of a library.
STOPPED = {"devices/HidapiList.cpp": "hidapi_darwin.h"}
# Read once for all sources but those of libpacini, which set what {fmt} leaves out.
COMMON = "".join(f"#include <{name}>\n" for name in (
    "CLI/CLI.hpp", "fmt/format.h", "nlohmann/json.hpp", "algorithm", "charconv", "filesystem", "fstream", "functional",
    "map", "span", "thread"))


def fail(why):
    sys.exit(f"failed: {why}")


def oldest():
    """The oldest macOS that is built for."""
    return re.search(r"CMAKE_OSX_DEPLOYMENT_TARGET=([\d.]+)", (SOURCE / ".github/workflows/build.yml").read_text())[1]


class Compiler:
    """Zig's Clang without what Zig does around it, which wants an object of each source."""

    def __init__(self, machine, folder):
        zig = [PYTHON, "-m", "ziglang"]
        empty = Path(folder, "empty.cpp")
        empty.write_text("")
        command = [*zig, "c++", "-target", f"{machine}-macos.{oldest()}", "-v", "-c", empty, "-o", f"{empty}.o"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        line = next((line for line in done.stderr.splitlines() if " -cc1 " in line), "")
        if done.returncode != 0 or not line:
            fail(f"Zig for {machine}: {done.stderr[-2000:]}")
        words = shlex.split(line)
        pairs = [(word, following) for word, following in zip(words, words[1:]) if word in ("-isystem", "-D")]
        name = "arm64" if machine == "aarch64" else machine
        self.command = [Path(words[0]), "clang", f"--target={name}-apple-macosx{oldest()}", "-std=c++20", "-nostdinc",
                        "-nostdinc++", "-ffp-contract=off", *(word for pair in pairs for word in pair),
                        "-Wno-macro-redefined", "-D_LIBCPP_HAS_VENDOR_AVAILABILITY_ANNOTATIONS=1",
                        "-isystem", Path(folder, "headers")]
        self.common = Path(folder, f"{machine}.pch")
        header = Path(folder, "common.h")
        header.write_text(COMMON)
        said = self.run("-isystem", "/usr/include/eigen3", "-x", "c++-header", header, "-o", self.common)
        if said:
            fail(said)

    def run(self, *words):
        """What it says; nothing if all is well."""
        done = subprocess.run([str(word) for word in (*self.command, *words)], capture_output=True, check=False,
                              text=True, cwd=SOURCE, timeout=600)
        return "" if done.returncode == 0 else done.stderr or str(done.returncode)

    def compile(self, target, source, flags):
        common = [] if "library" in target else ["-include-pch", self.common]
        return self.run(*common, *flags, "-w", "-fsyntax-only", source)


def sources():
    """Each source with its target and the flags that count: definitions, folders of headers."""
    for entry in json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8")):
        found = re.search(r" -o \S*CMakeFiles/([^/]+)\.dir/", entry["command"])
        if not found or found[1] not in TARGETS:
            continue
        words, flags = shlex.split(entry["command"]), []
        for word, following in zip(words, words[1:]):
            if word.startswith(("-D", "-I")) and word not in LEFT_OUT:
                flags.append(word)
            elif word == "-isystem" and "linux-gnu" not in following:
                flags += [word, following]
        yield found[1], Path(entry["directory"], entry["file"]), flags


def main():
    if not PYTHON.exists():
        print("SKIPPED: Zig is missing: bash cmake/bootstrap.sh slow-tests installs it")
        return 77
    found = list(sources())
    for target, least in TARGETS.items():
        count = sum(target == one for one, *_ in found)
        if count < least:
            fail(f"{target} has {count} sources in {BUILD}")
    turn = os.environ.get("PACINI_MACOS_TURN")
    firsts = [next(one for one in found if one[0] == target) for target in TARGETS]
    wrong, stopped = [], set()
    with tempfile.TemporaryDirectory() as folder:
        headers = Path(folder, "headers")
        headers.mkdir()
        for name in HEADERS:
            if Path("/usr/include", name).exists():
                (headers / name).symlink_to(Path("/usr/include", name))
        part = found[int(turn) % 2::2] if turn else found
        for machine, tried in (("aarch64", part), ("x86_64", firsts)):
            compiler = Compiler(machine, folder)
            with ThreadPoolExecutor(os.cpu_count()) as pool:
                said = list(pool.map(lambda one: compiler.compile(*one), tried))
            done = 0
            for (_, source, _), text in zip(tried, said):
                name = next((name for name in STOPPED if str(source).endswith(name)), None)
                if name and f"'{STOPPED[name]}' file not found" in text and text.count("error:") == 1:
                    stopped.add(name)
                elif text:
                    wrong.append(f"{source} for {machine}\n{text[:3000]}")
                else:
                    done += 1
            print(f"{machine}: {done} of {len(tried)} sources compile for macOS {oldest()}", flush=True)
    for name in sorted(stopped):
        print(f"not compiled: {name}, which needs {STOPPED[name]} of a library")
    expected = {name for name in STOPPED if any(str(source).endswith(name) for _, source, _ in part)}
    if stopped != expected:
        wrong.append(f"{', '.join(sorted(expected - stopped))}: does not stop any more; take it off the list")
    for text in wrong:
        print(f"failed: {text}", file=sys.stderr)
    used = os.times()
    print(f"{used.children_user + used.children_system:.0f} s of processor time")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
