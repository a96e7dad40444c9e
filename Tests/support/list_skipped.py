#!/usr/bin/env python3
"""Lists the tests that ctest did not run, with their reasons.

list_skipped.py RESULTS.xml...    written by ctest --output-junit. Exit 1 when there are any, or 0
"""
import re
import sys
import xml.etree.ElementTree as ElementTree


def skipped(path):
    """(name, reasons) of each."""
    for case in ElementTree.parse(path).iter("testcase"):
        if case.get("status") in ("notrun", "disabled"):
            reasons = re.findall(r"^\W*SKIPPED: (.*)", case.findtext("system-out", ""), re.M)
            yield case.get("name"), "; ".join(reasons) or "no reason given"


def main():
    found = [entry for path in sys.argv[1:] for entry in skipped(path)]
    for name, why in found:
        print(f"  {name}: {why}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
