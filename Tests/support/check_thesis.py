#!/usr/bin/env python3
"""Checks that every test which Resources/docs/thesis.md names as a proof exists.

check_thesis.py SOURCE    SOURCE: the repository. Exit 1 when a test is missing, or a row has none and does not say why.
"""
import re
import sys
from pathlib import Path

WITHOUT_PROOF = "out of reach"


def tests_of(texts):
    """Names of the tests in sources of C++ and Python."""
    names = set()
    for text in texts:
        for literals in re.findall(r'TEST_CASE\(\s*((?:"(?:[^"\\]|\\.)*"\s*)+)', text):
            names.add("".join(re.findall(r'"((?:[^"\\]|\\.)*)"', literals)).replace('\\"', '"'))
        names.update(re.findall(r"^\s*(?:async )?def (test_\w+)", text, re.M))
    return names


def complaints(page, tests):
    """What is wrong with a page, line by line."""
    found = []
    rows = 0
    for number, line in enumerate(page.splitlines(), 1):
        if not line.startswith("|") or set(line) <= set("|- ") or line.endswith("| proven by |"):
            continue
        rows += 1
        names = re.findall(r'"([^"]+)"', line.strip("|").split("|")[-1])
        if not names and WITHOUT_PROOF not in line:
            found.append(f"line {number}: names no test")
        found.extend(f"line {number}: no test is named '{name}'" for name in names if name not in tests)
    return found if rows else ["no table is there"]


def main():
    tests = tests_of(['TEST_CASE("One thing", "[a]")\nTEST_CASE("A " "whole")', "    def test_it(self):\n"])
    assert tests == {"One thing", "A whole", "test_it"}, tests
    head = "| in the thesis | in Pacini | proven by |\n|---|---|---|\n"
    assert not complaints(head + '| a | b | "One thing" |\n| a | out of reach | |\n| a | b | "test_it" |\n', tests)
    assert complaints(head + '| a | b | "Another" |\n', tests) == ["line 3: no test is named 'Another'"]
    assert complaints(head + "| a | b | |\n", tests) == ["line 3: names no test"]
    assert complaints("# Nothing\n", tests)

    source = Path(sys.argv[1])
    files = [path for ending in ("*.cpp", "*.py") for path in (source / "Tests").rglob(ending)]
    wrong = complaints((source / "Resources/docs/thesis.md").read_text(encoding="utf-8"),
                       tests_of(path.read_text(encoding="utf-8", errors="replace") for path in files))
    for line in wrong:
        print("Resources/docs/thesis.md:", line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
