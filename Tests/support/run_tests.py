#!/usr/bin/env python3
"""Runs the unittest classes of a file. Unlike unittest's own main it does not take a skipped test for a passed one.

run_tests.py FILE.py      exit 0 when all passed, 1 when one failed, 77 when none failed but some were skipped
"""
import importlib
import sys
import unittest
from pathlib import Path


def main():
    path = Path(sys.argv[1]).resolve()
    sys.path.insert(0, str(path.parent))
    result = unittest.TextTestRunner(verbosity=2).run(
        unittest.defaultTestLoader.loadTestsFromModule(importlib.import_module(path.stem)))
    for test, why in result.skipped:
        print(f"SKIPPED: {test.id().rpartition('.')[2]}: {why}")
    if not result.wasSuccessful() or result.testsRun == 0:
        return 1
    return 77 if result.skipped else 0


if __name__ == "__main__":
    sys.exit(main())
