#!/usr/bin/env python3
"""Compiles every source and every Core header of its own, without making code: no file hides behind another, as it can
where many are compiled as one, and every warning is an error. What ccache has seen before takes no time.

check_warnings.py BUILD [-j N] [--only REGEX] [--minutes M]    BUILD: a folder configured with the preset `ci`. Exit 1 and
what the compiler says, or 0. With --minutes, as many as that time allows, those that changed last first: all of them where
ccache knows most
"""
import argparse
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# As cmake/PaciniCompiler.cmake calls it; compile_commands.json leaves it out.
CCACHE = ["env", "CCACHE_SLOPPINESS=pch_defines,time_macros", f"CCACHE_BASEDIR={ROOT}", "CCACHE_NOHASHDIR=1",
          "ccache"] if shutil.which("ccache") else []
LONE_HEADER = "_verify_interface_header_sets"  # CMake writes a source for each header, which includes only that


def of_kind(path, build):
    """'source' and 'header': to be compiled alone. 'made': what those include. None: other people's."""
    if LONE_HEADER in path:
        return "header"
    if Path(path).is_relative_to(build):
        return "made"
    if Path(path).is_relative_to(ROOT / "build"):  # modules of Python that are compiled with ours
        return None
    return "source" if Path(path).is_relative_to(ROOT) else None


def newest_first():
    """Paths below the checkout, by the last commit that changed them; those that no commit has yet come first."""
    def lines(*command):
        done = subprocess.run(["git", "-c", f"safe.directory={ROOT}", *command], cwd=ROOT, capture_output=True, text=True)
        return done.stdout.splitlines() if done.returncode == 0 else []
    if lines("rev-list", "--count", "-n", "2", "HEAD") != ["2"]:
        return None  # a copy, or a clone without its history
    return dict.fromkeys([*lines("diff", "--name-only", "HEAD"), *lines("ls-files", "-o", "--exclude-standard"),
                          *(line for line in lines("log", "--no-merges", "--format=", "--name-only") if line)])


class Compilation:
    """An entry of compile_commands.json."""

    def __init__(self, entry, build):
        self.folder = entry["directory"]
        self.path = os.path.relpath(entry["file"], ROOT)
        self.kind = of_kind(entry["file"], build)
        words = CCACHE + shlex.split(entry["command"])
        at = words.index("-o")
        self.output = words[at + 1]
        self.command = words[:at] + words[at + 2:]

    def is_precompiled(self):
        return self.output.endswith(".gch")

    def make(self):
        return subprocess.run([*self.command, "-o", self.output], cwd=self.folder).returncode == 0

    def warnings(self):
        return [word for word in self.command if word.startswith("-W")]


def in_order(all_of_them):
    """Those that changed last first."""
    newest = {path: place for place, path in enumerate(newest_first() or ())}

    def place(one):
        own = "Core/" + one.path.split(LONE_HEADER + "/", 1)[1].removesuffix(".cxx") if LONE_HEADER in one.path else one.path
        return newest.get(own, len(newest))
    return sorted(all_of_them, key=place)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--only", default="", help="files whose path below the checkout has this, to try a part")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="how long it may take")
    options = parser.parse_args()
    build = options.build.resolve()
    everything = [Compilation(entry, build) for entry in json.loads((build / "compile_commands.json").read_text())]
    started = time.monotonic()

    # What the programs have packed into them, with its headers.
    made = [one for one in everything if one.kind == "made" and not one.is_precompiled()]
    if subprocess.run(["cmake", "--build", str(build), "-j", str(options.jobs), "--target", *(one.output for one in made)],
                      stdout=subprocess.DEVNULL).returncode != 0:
        return 1
    # Precompiled headers by hand: as targets they wait for programs that their tests run.
    with ThreadPoolExecutor(options.jobs) as workers:
        if not all(workers.map(Compilation.make, filter(Compilation.is_precompiled, everything))):
            return 1

    own = [one for one in everything if one.kind in ("source", "header") and re.search(options.only, one.path)]
    # A library of headers has no warnings of its own to be compiled with: they get those of the command.
    usual = next(one.warnings() for one in everything if one.path == "Source/cli/main.cpp")

    def check(one):
        extra = usual if one.kind == "header" else []
        done = subprocess.run([*one.command, *extra, "-fsyntax-only", "-Werror"], cwd=one.folder,
                              capture_output=True, text=True)
        if done.returncode != 0:
            print(done.stderr, flush=True)
        return done.returncode == 0

    end = started + 60 * options.minutes
    own = in_order(own)
    with ThreadPoolExecutor(options.jobs) as workers:
        good = list(workers.map(lambda one: check(one) if time.monotonic() < end else None, own))
    for one, fine in zip(own, good):
        if fine is False:
            print("warnings in", one.path)
    seen = len(own) - good.count(None)
    print(f"{seen} of {len(own)} sources and headers compiled alone, {good.count(False)} with warnings, "
          f"{time.monotonic() - started:.0f} s")
    return 1 if seen == 0 or False in good else 0


if __name__ == "__main__":
    sys.exit(main())
