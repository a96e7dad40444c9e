"""Types are right: of the package by mypy and pyright, of the native module against its stubs, in code with both."""

import ast
import json
import re
import shutil
import subprocess
import sys
import textwrap
import unittest
from pathlib import Path

from sounds import SOURCE, FolderTest

PACKAGE = SOURCE / "Source/python/pacini"

RIGHT = """
import numpy as np
import numpy.typing as npt
import pacini

clip: pacini.Clip = pacini.encode(np.zeros(100, np.float32), 48000, axis=0, bands=4)
other: pacini.Clip = clip[0.1:0.2].transposed(3) + clip
times: npt.NDArray[np.float64] = clip.envelope["time"]
match: float | None = pacini.compare("a.wav", clip).match
error = pacini.Error("is wrong", "there")
where: str = error.where
bands: tuple[pacini.Band, ...] = clip.bands
clip.bands = [pacini.Band(90, 100, 110, amplitude=[(0, 1)], pitch=[[0, 100.5]]), bands[0]]
clip.noise = [pacini.NoiseBand(90, 100, [(0, 0.5)])]
strongest: float = pacini.Band(90, 100, 110, amplitude=[(0, 1)]).amplitude["amplitude"].max()
clip.save("a.haptic", points=20, events="transients", profile="lra-175", overwrite=True)
ahap: bytes = clip.to_bytes("ahap", split=False, quantise=None)
losses: list[pacini.Loss] = pacini.convert("a.pacb", "a.hapt", format="tact", sample_rate=8000, overwrite=False)
profile: pacini.Profile | None = pacini.measure.fit(pacini.Profile("lra-175")).profile
"""

WRONG = """
import pacini

pacini.encode("a.wav", bands="many")
clip: int = pacini.encode("a.wav")
clip2 = pacini.encode("a.wav")
clip2.nothing
clip2.save("a.haptic", points="many")
clip2.to_bytes("ahap", splitt=True)
pacini.convert("a.pacb", "a.haptic", strength="strong")
"""


def parameters_in_stub(node):
    return [argument.arg for argument in node.args.args]


def parameters_of(function):
    """The names of the parameters of a native function, from the signature that it carries."""
    [(signature, *_)] = function.__nb_signature__
    inside = signature[signature.index("(") + 1 :]
    names, depth, start = [], 0, True
    for match in re.finditer(r"[\[\](){}]|,|\w+", inside):
        token = match.group()
        if token in "[({":
            depth += 1
        elif token in "])}":
            depth -= 1
            if depth < 0:
                break
        elif token == ",":
            start = start or depth == 0
        elif start and depth == 0:
            names.append(token)
            start = False
    return names


def page_lines():
    """All code of the page."""
    page = (SOURCE / "Resources/docs/python.md").read_text()
    return textwrap.dedent("\n".join(re.findall(r"(?m)^    .*$|^$", page)))


def mypy(*arguments, folder):
    return subprocess.run(
        [sys.executable, "-m", "mypy", "--cache-dir", str(folder / "cache"), *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=folder,
    )


class Typing(FolderTest):
    def test_the_package_is_typed_strictly(self):
        done = mypy("--strict", PACKAGE, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_code_that_uses_it_is_checked(self):
        (self.folder / "right.py").write_text(RIGHT)
        done = mypy("--strict", "right.py", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        (self.folder / "wrong.py").write_text(WRONG)
        done = mypy("--strict", "wrong.py", folder=self.folder)
        self.assertEqual(
            [line.split(":")[1] for line in done.stdout.splitlines() if re.match(r"wrong\.py:\d+: error:", line)],
            ["4", "5", "7", "8", "9", "10"],
            done.stdout,
        )

    def test_every_line_of_the_page_is_typed(self):
        (self.folder / "page.py").write_text(page_lines())
        done = mypy("--strict", "page.py", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_pyright_finds_the_same(self):
        """The checker inside editors, which most users see."""
        pyright = SOURCE / "build/bindings-node/node_modules/pyright/index.js"
        if not shutil.which("node") or not pyright.exists():
            self.skipTest("pyright is missing: bash cmake/bootstrap.sh slow-tests installs it")
        (self.folder / "right.py").write_text(RIGHT)
        (self.folder / "wrong.py").write_text(WRONG)
        (self.folder / "page.py").write_text(page_lines())
        (self.folder / "package").symlink_to(PACKAGE)
        settings = {"include": ["."], "extraPaths": [str(PACKAGE.parent)], "pythonVersion": "3.11"}
        (self.folder / "pyrightconfig.json").write_text(json.dumps(settings))
        done = subprocess.run(
            ["node", str(pyright), "--pythonpath", sys.executable, "--outputjson"],
            capture_output=True,
            text=True,
            cwd=self.folder,
        )
        errors = [
            (Path(found["file"]).name, found["range"]["start"]["line"] + 1)
            for found in json.loads(done.stdout)["generalDiagnostics"]
            if found["severity"] == "error"
        ]
        self.assertEqual(errors, [("wrong.py", line) for line in (4, 5, 7, 8, 9, 10)], done.stdout[-3000:])

    def test_the_stubs_are_those_of_the_native_module(self):
        """By the names of everything and of all parameters."""
        from pacini import _native

        stub, module = {}, {}
        for node in ast.parse((PACKAGE / "_native.pyi").read_text()).body:
            if isinstance(node, ast.FunctionDef):
                stub[node.name] = parameters_in_stub(node)
            elif isinstance(node, ast.ClassDef):
                for inner in node.body:
                    if isinstance(inner, ast.FunctionDef) and inner.name != "__eq__":
                        stub[f"{node.name}.{inner.name}"] = parameters_in_stub(inner)
        for name, thing in vars(_native).items():
            if isinstance(thing, type):
                for inner, value in vars(thing).items():
                    if isinstance(value, property):
                        module[f"{name}.{inner}"] = ["self"]
                    elif hasattr(value, "__nb_signature__") and inner != "__eq__":
                        module[f"{name}.{inner}"] = parameters_of(value)
            elif hasattr(thing, "__nb_signature__"):
                module[name] = parameters_of(thing)
        self.assertGreater(len(module), 70)
        self.assertEqual(stub, module)

    def test_ruff_finds_nothing(self):
        done = subprocess.run(
            [
                sys.executable,
                "-m",
                "ruff",
                "check",
                "--no-cache",
                "--config",
                SOURCE / "pyproject.toml",
                PACKAGE,
                Path(__file__).parent,
            ],
            capture_output=True,
            text=True,
            cwd=SOURCE,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
