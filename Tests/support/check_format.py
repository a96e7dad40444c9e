#!/usr/bin/env python3
"""Checks that every source file is as .clang-format wants it.

check_format.py ROOT       exit 1 and a list of files, 77 when clang-format 14 is missing, or 0
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

VERSION = "14"  # others format a few constructs otherwise
FOLDERS = ("Core", "Source", "Tests")
BATCH = 20


def formatter():
    """The path of clang-format of that version, or None."""
    for name in ("clang-format-" + VERSION, "clang-format"):
        if path := shutil.which(name):
            text = subprocess.run([path, "--version"], capture_output=True, text=True).stdout
            if re.search(rf"version {VERSION}\.", text):
                return path
    return None


def main():
    root = Path(sys.argv[1])
    command = formatter()
    if command is None:
        print(f"SKIPPED: clang-format {VERSION} is missing (Debian 12: apt-get install clang-format)")
        return 77
    files = sorted(str(path) for folder in FOLDERS for path in (root / folder).rglob("*") if path.suffix in {".h", ".cpp"})
    wrong = set()
    for start in range(0, len(files), BATCH):
        done = subprocess.run([command, "--dry-run", "-Werror", "--ferror-limit=1", *files[start:start + BATCH]],
                              capture_output=True, text=True, cwd=root)
        found = re.findall(r"^(.+?):\d+:\d+: error: ", done.stderr, re.M)
        wrong.update(found)
        if done.returncode != 0 and not found:
            print(done.stderr)
            return 1
    for path in sorted(wrong):
        print(f"{Path(path).relative_to(root)}: run clang-format -i on it")
    print(f"{len(files)} files, {len(wrong)} badly formatted")
    return 1 if wrong or not files else 0


if __name__ == "__main__":
    sys.exit(main())
