#!/usr/bin/env python3
"""Runs clang-tidy (.clang-tidy) on the sources and Core headers that changed last, as on all of them it would take an hour.

check_tidy.py BUILD [--newest N] [--all] [-j N] [--only REGEX]    BUILD: a folder configured with the preset `ci` in which
check_warnings.py has run. Exit 1 and what clang-tidy says, or 0
"""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from check_warnings import LONE_HEADER, ROOT, newest_first

NEWEST = 16


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--newest", type=int, default=NEWEST, help=f"how many ({NEWEST})")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--only", default="", help="files whose path below the checkout has this")
    options = parser.parse_args()
    if shutil.which("clang-tidy") is None:
        sys.exit("check_tidy: clang-tidy is missing (Debian: apt-get install clang-tidy)")
    build = options.build.resolve()

    known = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = entry["file"]
        if LONE_HEADER in path:  # a source that includes one header of Core, and no more
            path = "Core/" + path.split(LONE_HEADER + "/", 1)[1].removesuffix(".cxx")
        elif Path(path).is_relative_to(build) or not Path(path).is_relative_to(ROOT):
            continue
        else:
            path = os.path.relpath(path, ROOT)
        # A header that GCC has precompiled means nothing to Clang, nor do options of GCC alone.
        entry["command"] = re.sub(r"-Winvalid-pch|-include \S*cmake_pch\.hxx|-fno-gnu-unique|-flto=auto|-ffat-lto-objects", "",
                                  entry["command"])
        known[path] = entry
    database = build / "tidy"
    database.mkdir(exist_ok=True)
    (database / "compile_commands.json").write_text(json.dumps(list(known.values())))

    newest = known if options.all else newest_first()
    if newest is None:
        print("check_tidy: without the history nobody knows what changed last; --all looks at all of it")
        return 0
    chosen = [path for path in newest if path in known and path.startswith(("Core/", "Source/"))]
    chosen = [path for path in chosen if re.search(options.only, path)]
    if not options.all:
        chosen = chosen[:options.newest]
    started = time.monotonic()

    def check(path):
        done = subprocess.run(["clang-tidy", "-p", str(database), "--quiet", "--extra-arg=-Wno-unknown-warning-option",
                               known[path]["file"]], capture_output=True, text=True)
        found = re.findall(r"^\S+:\d+:\d+: (?:error|warning): .*(?:\n(?!\S+:\d+:\d+: (?:error|warning)).*)*", done.stdout, re.M)
        return path, done.returncode, found or [done.stdout + done.stderr]

    said = {}
    failed = []
    with ThreadPoolExecutor(options.jobs) as workers:
        for path, code, found in workers.map(check, chosen):
            if code != 0:
                failed.append(path)
                said |= dict.fromkeys(found)
    print("\n".join(said))
    print(f"{len(chosen)} of {len(known)} sources and headers seen by clang-tidy, {len(failed)} with findings, "
          f"{time.monotonic() - started:.0f} s")
    return 1 if not chosen or failed else 0


if __name__ == "__main__":
    sys.exit(main())
