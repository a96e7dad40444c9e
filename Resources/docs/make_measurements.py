#!/usr/bin/env python3
"""Makes measurements.md beside this file, and corpus.md where its sounds are. Takes some minutes of a computer that does
nothing else: it measures times.

make_measurements.py [--corpus FOLDER] [--program PACINI] [--into FOLDER] [--quick]
    --corpus   the thirty other recordings, in a folder of this name; without it corpus.md stays as it is
    --program  else build/release/bin/pacini
    --into     another folder than this one
    --quick    every time is measured once and nothing is swept: to see that it works, not to be published
"""
import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n", 1)[1])
    parser.add_argument("--corpus", type=Path)
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/bin/pacini")
    parser.add_argument("--into", type=Path, default=HERE)
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    program, into = options.program.resolve(), options.into.resolve()
    if not program.exists():
        sys.exit(f"{program} is missing: bash cmake/bootstrap.sh build")

    pages = [("measurements.md", "all", ROOT, "Resources/demo", 5)]
    if options.corpus:
        corpus = options.corpus.resolve()
        pages.append(("corpus.md", "methods", corpus.parent, corpus.name, 3))
    for page, what, folder, sounds, repeats in pages:
        pace = ["--repeat", "1"] if options.quick else ["--repeat", str(repeats), "--sweep"]
        with tempfile.TemporaryDirectory() as tables:
            done = subprocess.run([program, "bench", what, sounds, *pace, "-o", tables, "--markdown", into / page],
                                  cwd=folder, stdout=subprocess.DEVNULL)
        if done.returncode != 0:
            return 1
        print("wrote", into / page)
    return 0


if __name__ == "__main__":
    sys.exit(main())
