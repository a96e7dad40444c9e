#!/usr/bin/env python3
"""Checks libpacini as those who link it get it.

check_library.py LIBRARY HEADER FIRST_VIBRATION PACINI CLIP CONFIGURATION COMPILER
What it shows, what it needs, how large it is, that its header is C99 and C++, and that the example of the header's first
lines gives what the command renders.
"""
import array
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LIBRARY, HEADER, EXAMPLE, PACINI, CLIP = (Path(path) for path in sys.argv[1:6])
CONFIGURATION, COMPILER = sys.argv[6:8]
LARGEST = 975_000  # bytes, stripped; the aim is 900 000


def run(*command, **options):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, **options).stdout


class Library(unittest.TestCase):
    def test_only_functions_of_the_header_are_visible(self):
        visible = set()
        for line in run("nm", "-D", "--defined-only", LIBRARY).decode().splitlines():
            *_, kind, name = line.split()
            if kind == "T":
                visible.add(name)
        declared = {name.split("(")[0] for name in HEADER.read_text().replace("\n", " ").split()
                    if name.startswith("pacini_") and "(" in name}
        functions = {name for name in visible if name.startswith("pacini_")}
        self.assertEqual(visible - functions, set())
        self.assertTrue(functions <= declared, functions - declared)
        self.assertGreater(len(functions), 25)

    def test_it_needs_the_libraries_of_every_system_only(self):
        needed = re.findall(r"\(NEEDED\).*\[(\w+)", run("readelf", "--dynamic", LIBRARY).decode())
        self.assertEqual(set(needed) - {"libstdc", "libc", "libm", "libgcc_s", "ld"}, set())

    @unittest.skipUnless(CONFIGURATION == "Release" and COMPILER == "GNU", "other builds are larger")
    def test_it_is_small(self):
        with tempfile.TemporaryDirectory() as folder:
            stripped = Path(folder) / "libpacini.so"
            run("strip", "--strip-unneeded", LIBRARY, "-o", stripped)
            self.assertLess(stripped.stat().st_size, LARGEST)

    def test_the_header_is_c99_and_cpp(self):
        with tempfile.TemporaryDirectory() as folder:
            for language, standard in (("c", "c99"), ("c", "c17"), ("c++", "c++98"), ("c++", "c++20")):
                source = Path(folder) / "t"
                source.write_text('#include "pacini.h"\nint main(void) { return PACINI_OK; }\n')
                more = ["-Wno-long-long"] if standard == "c++98" else []
                run("cc", "-x", language, f"-std={standard}", "-pedantic-errors", "-Wall", "-Wextra", "-Werror", *more,
                    "-fsyntax-only", "-I", HEADER.parent, source)

    def test_the_first_vibration_is_what_the_command_renders(self):
        played = array.array("f", run(EXAMPLE, CLIP))
        with tempfile.TemporaryDirectory() as folder:
            wave = Path(folder) / "r.wav"
            run(PACINI, "render", CLIP, "-o", wave, "--profile", "lra-175")
            import wave as reader  # of no use for floats: only its header is read
            data = wave.read_bytes()
            self.assertEqual(data[:4], b"RIFF")
            start = data.index(b"data") + 8
            rendered = array.array("f", data[start:start + 4 * ((len(data) - start) // 4)])
        n = min(len(played), len(rendered))
        self.assertGreater(n, 20000)
        self.assertGreater(max(map(abs, played)), 0.05)
        # The command leaves out what nobody feels and filters behind the decoder at its own rate.
        self.assertLess(max(abs(a - b) for a, b in zip(played[:n], rendered[:n])), 2e-3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
