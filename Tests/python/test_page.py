"""The code on the page of the package runs, from top to bottom, and prints what the page says."""

import contextlib
import importlib.util
import inspect
import io
import json
import os
import re
import unittest

import numpy as np
import pacini
import pacini.ray
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


def doc(thing):
    return inspect.getdoc(thing) or ""


def documented(thing):
    """The names that a docstring explains below "Parameters"."""
    parts = re.split(r"^(\w[\w ]*)\n-+\n", doc(thing), flags=re.MULTILINE)
    listed = dict(zip(parts[1::2], parts[2::2])).get("Parameters", "")
    rows = re.findall(r"^([\w*, ]+?)(?: :.*)?$", listed, re.MULTILINE)
    return {name.strip("* ") for row in rows if not row.startswith(" ") for name in row.split(",")}


class Page(FolderTest):
    def test_its_code_runs(self):
        blocks = code()
        self.assertGreater(len(blocks), 8)
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        pacini.write_audio("door.wav", knocks(2.0), 48000)
        pacini.write_audio("rain.wav", knocks(2.0, seed=2), 48000)
        os.mkdir("sounds")
        os.mkdir("clips")
        pacini.write_audio("sounds/door.wav", knocks(2.0), 48000)
        pacini.encode("door.wav").save("clips/door.pacb")
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

    def test_docstrings_have_every_parameter_in_the_form_of_numpy(self):
        functions = [getattr(pacini, name) for name in pacini.__all__ if callable(getattr(pacini, name))]
        functions += [getattr(pacini.measure, name) for name in ("sweep", "simulate", "analyse", "fit", "verify")]
        functions += [pacini.ray.encode, pacini.Clip.load, pacini.Clip.save, pacini.Scene.save, pacini.Profile.save]
        for function in functions:
            if inspect.isclass(function) and (
                issubclass(function, (Exception, tuple)) or "Attributes" in doc(function)
            ):
                continue  # its attributes are what it is made of
            own = [
                name
                for name, one in inspect.signature(getattr(function, "__wrapped__", function)).parameters.items()
                if name not in ("self", "cls") and one.kind is not inspect.Parameter.VAR_KEYWORD
            ]
            if function is pacini.encode:  # whose options follow as a list
                own = own[: own.index("progress") + 1]
            with self.subTest(function.__qualname__):
                self.assertEqual(set(own) - documented(function), set())
                if not inspect.isclass(function) and inspect.signature(function).return_annotation != "None":
                    self.assertRegex(doc(function), r"\n(Returns|Yields)\n-+\n")

    def test_ranges_and_defaults_are_those_that_are_described(self):
        native = pacini._native
        translator, live = native.translator_setup_parameters(), native.translator_parameters()
        tried = ranges = 0
        for function, described in (
            (pacini.render, native.render_parameters()),
            (pacini.felt, native.render_parameters()),
            (pacini.felt, native.felt_parameters()),
            (pacini.explain, native.render_parameters()),
            (pacini.Translator, translator),
        ):
            known = {one["name"]: one for one in json.loads(described)}
            for name, parameter in inspect.signature(function).parameters.items():
                words = name.split("_")
                one = known.get("".join([words[0], *(word.capitalize() for word in words[1:])]))
                if one is None:
                    continue
                with self.subTest(f"{function.__qualname__} {name}"):
                    usual = one.get("default")
                    self.assertEqual(parameter.default, usual)
                    told = doc(pacini.render if f"{name} :" not in doc(function) else function)
                    entry = re.search(rf"^(\w+, )*{name}(, \w+)* :.*\n((    .*)?\n)+?(?=\S|$)", told, re.M)
                    if entry is not None and "lowest" in one and "As of" not in entry[0]:
                        self.assertIn(f"{one['lowest']} to {one['highest']}", entry[0])
                        ranges += 1
                    tried += 1
        self.assertGreater(tried, 20)
        self.assertGreater(ranges, 12)
        types = (SOURCE / "Source/web/package/translator.d.ts").read_text()
        bands = json.loads(translator)[0]
        self.assertIn(f"Number of bands, {bands['lowest']} to {bands['highest']}.", types)
        names = [one["name"] for one in json.loads(live) + json.loads(translator)]
        self.assertEqual(len(names), len(set(names)))

    def test_everything_public_is_documented_and_named_there(self):
        text = (SOURCE / "Resources/docs/python.md").read_text()
        for name in pacini.__all__:
            thing = getattr(pacini, name)
            if callable(thing):
                self.assertTrue(thing.__doc__, name)
        for name in re.findall(r'(?<!")pacini\.([A-Za-z_]+)', text):  # formats are in quotes
            there = hasattr(pacini, name) or importlib.util.find_spec(f"pacini.{name}") is not None
            self.assertTrue(there, name)


if __name__ == "__main__":
    unittest.main()
