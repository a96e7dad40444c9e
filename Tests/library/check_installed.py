#!/usr/bin/env python3
"""Installs libpacini into a prefix and builds its example there in every way: check_installed.py BUILD EXAMPLE

EXAMPLE is the example as the build made it: the others play the same, bit by bit.
"""
import sys
import tempfile
import unittest
from pathlib import Path

import installed
from installed import run

BUILD, EXAMPLE = Path(sys.argv[1]), Path(sys.argv[2])


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.prefix = Path(folder.name) / "prefix"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix, "--component", "library", "--strip")
        cls.programs = installed.built(cls.prefix, Path(folder.name) / "example")

    def test_nothing_but_the_library_is_installed(self):
        self.assertFalse((self.prefix / "bin").exists())
        self.assertEqual([path.name for path in (self.prefix / "include").rglob("*")], ["pacini.h"])

    def test_every_way_plays_the_same(self):
        expected = run(EXAMPLE, installed.CLIP)
        self.assertGreater(len(expected), 100000)
        for way, samples in installed.played(self.prefix, self.programs).items():
            self.assertTrue(samples == expected, way)

    def test_static_programs_need_no_library_of_ours(self):
        for way, program in self.programs.items():
            self.assertEqual(installed.needs_shared_library(program), "static" not in way, way)

    def test_the_static_library_shows_nothing_but_the_functions_of_the_header(self):
        names = [line.split()[-1] for line in run("nm", "--defined-only", "--extern-only",
                                                  installed.library_folder(self.prefix) / "libpacini.a").decode().splitlines()
                 if len(line.split()) == 3]
        self.assertGreater(len(names), 25)
        self.assertEqual([name for name in names if not name.startswith("pacini_")], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
