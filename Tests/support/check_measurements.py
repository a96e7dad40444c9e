#!/usr/bin/env python3
"""Checks that the published measurements are of this Pacini, or of one with the same minor version.

check_measurements.py FOLDER VERSION    FOLDER: Resources/docs. Exit 1 when a page is older or does not say, or 0
"""
import re
import sys
from pathlib import Path

PAGES = ("measurements.md",)
AGAIN = "make it anew: python3 Resources/docs/make_measurements.py"


def minor(version):
    return tuple(int(number) for number in version.split(".")[:2])


def complaint(text, version):
    """What is wrong with a page, or None."""
    made = re.search(r"^Made by Pacini (\d+\.\d+\.\d+) with$", text, re.M)
    if made is None:
        return "does not say which Pacini made it; " + AGAIN
    if minor(made[1]) != minor(version):
        return f"was made by Pacini {made[1]}, this is {version}; " + AGAIN
    empty = re.search(r"^\|[-|: ]+\|\n(?!\|)", text, re.M)
    if empty:
        return f"has a table without rows: line {text.count(chr(10), 0, empty.start()) + 1}; " + AGAIN
    return None


def main():
    page = "# Measurements\n\nMade by Pacini 1.2.3 with\n"
    assert complaint(page, "1.2.0") is None and complaint(page, "1.3.0") and complaint(page, "2.2.3")
    table = "\n| a | b |\n|---|---:|\n"
    assert complaint(page + table, "1.2.3") and complaint(page + table + "| 1 | 2 |\n", "1.2.3") is None
    assert complaint("# Measurements\n", "1.2.3")
    wrong = [(name, why) for name in PAGES if (why := complaint((Path(sys.argv[1]) / name).read_text(), sys.argv[2]))]
    for name, why in wrong:
        print(name, why)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
