"""The code on the page of the package runs, from top to bottom, and prints what the page says."""

import contextlib
import importlib.util
import io
import os
import re
import unittest

import numpy as np
import pacini
from sounds import SOURCE, FolderTest, knocks


def code():
    """The indented blocks, with the number of the line where each begins."""
    blocks, started = [], False
    for number, line in enumerate((SOURCE / "Resources/docs/python.md").read_text().splitlines(), 1):
        if line.startswith("    "):
            if not started:
                blocks.append((number, []))
                started = True
            blocks[-1][1].append(line[4:])
        elif line.strip():
            started = False
        elif started:
            blocks[-1][1].append("")
    return [(number, "\n".join(lines)) for number, lines in blocks]


class Page(FolderTest):
    def test_its_code_runs(self):
        blocks = code()
        self.assertGreater(len(blocks), 8)
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        pacini.write_audio("door.wav", knocks(2.0), 48000)
        pacini.write_audio("rain.wav", knocks(2.0, seed=2), 48000)
        names = {}
        for number, text in blocks:
            said = io.StringIO()
            with contextlib.redirect_stdout(said):
                exec(compile(text, f"python.md, block in line {number}", "exec"), names)
            for shown in re.findall(r"print\(.*\)\s+# (.+)", text):
                self.assertIn(shown.removesuffix("..."), said.getvalue())
        self.assertEqual(names["left"].shape, names["right"].shape)
        self.assertEqual(names["again"].name, "door")
        self.assertLess(np.abs(names["skin"]).max(), 1000.0)

    def test_everything_public_is_documented_and_named_there(self):
        text = (SOURCE / "Resources/docs/python.md").read_text()
        for name in pacini.__all__:
            thing = getattr(pacini, name)
            if callable(thing):
                self.assertTrue(thing.__doc__, name)
        for name in re.findall(r"pacini\.([A-Za-z_]+)", text):
            there = hasattr(pacini, name) or importlib.util.find_spec(f"pacini.{name}") is not None
            self.assertTrue(there, name)


if __name__ == "__main__":
    unittest.main()
