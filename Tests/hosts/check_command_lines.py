#!/usr/bin/env python3
"""The command lines of the programs with windows, without a screen.

check_command_lines.py PROGRAM OPTION [PROGRAM OPTION]...    OPTION: one that the help has to name. Exit 0, or 1 on a
failed check.
"""
import os
import subprocess
import sys
import tempfile

from host_test import check, failures


def answer(program, *arguments):
    """Exit code, what is on the output, what is on the error output."""
    with tempfile.TemporaryDirectory() as home:
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        done = subprocess.run([program, *arguments], env=dict(environment, HOME=home), capture_output=True, text=True,
                              timeout=60)
        check(f"{program} {' '.join(arguments)} writes no settings", set(os.listdir(home)) <= {".cache"})  # of the desktop, which JUCE asks
    return done.returncode, done.stdout, done.stderr


def main():
    for program, option in zip(sys.argv[1::2], sys.argv[2::2]):
        code, text, _ = answer(program, "--help")
        check(f"{program} --help explains {option}", code == 0 and option in text and "--fresh" in text)
        code, text, _ = answer(program, "--version")
        check(f"{program} --version is a number", code == 0 and text.strip().replace(".", "").isdigit())
        code, text, problem = answer(program, "--nonsense")
        check(f"{program} refuses an unknown option and names it", code == 2 and "--nonsense" in problem)
        code, _, problem = answer(program)
        check(f"{program} says in one line that there is no display", code == 1 and problem.count("\n") == 1 and
              "display" in problem, f"code {code}: {problem}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
