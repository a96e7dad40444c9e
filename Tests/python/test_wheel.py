"""`pip install .` makes a wheel that has all it needs and nothing else, by the same CMake as the tests."""

import importlib.util
import os
import re
import subprocess
import sys
import unittest
import zipfile
from pathlib import Path

from sounds import COMMAND, DEMO, SOURCE, FolderTest, run

PYTHON = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}


class Wheel(FolderTest):
    def test_a_wheel_is_built_and_works_by_itself(self):
        done = subprocess.run(
            [
                sys.executable,
                "-m",
                "pip",
                "wheel",
                SOURCE,
                "--no-deps",
                "--no-build-isolation",
                "-q",
                "--disable-pip-version-check",
                "-w",
                self.folder,
                "-C",
                f"build-dir={SOURCE / 'build/wheel'}",  # below the sources, where ccache knows it from other checkouts
            ],
            capture_output=True,
            text=True,
            env=PYTHON,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        [wheel] = self.folder.glob("*.whl")
        version = re.search(r"project\(Pacini VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)
        self.assertTrue(wheel.name.startswith(f"pacini-{version}-cp"), wheel.name)
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(self.folder / "site")
            names = archive.namelist()
        self.assertTrue(all(name.startswith(("pacini/", f"pacini-{version}.dist-info/")) for name in names), names)
        for wanted in ("pacini/py.typed", "pacini/_native.pyi", "pacini/__init__.py"):
            self.assertIn(wanted, names)
        self.assertEqual(len([name for name in names if name.endswith(".so")]), 1)
        metadata = (self.folder / f"site/pacini-{version}.dist-info/METADATA").read_text()
        self.assertIn("License-Expression: MIT", metadata)
        self.assertIn("Requires-Dist: numpy", metadata)
        self.assertTrue(any(name.endswith("LICENSE") for name in names), names)
        self.assertLess(wheel.stat().st_size, 6_000_000)

        run("encode", DEMO[0], "-o", self.folder / "clip.pacb", "-q")
        script = "import pacini, sys; sys.stdout.buffer.write(pacini.encode(sys.argv[1]).to_bytes())"
        made = subprocess.run(
            [sys.executable, "-c", script, DEMO[0]],
            capture_output=True,
            env={**PYTHON, "PYTHONPATH": str(self.folder / "site")},
        )
        self.assertEqual(made.stderr, b"")
        self.assertEqual(made.stdout, (self.folder / "clip.pacb").read_bytes())
        self.repaired(wheel)
        version_said = subprocess.run([COMMAND, "--version"], capture_output=True, text=True).stdout
        self.assertIn(version, version_said)

    def repaired(self, wheel: Path) -> None:
        """With auditwheel the wheel carries the libraries that it needs, for machines that have none of them."""
        if importlib.util.find_spec("auditwheel") is None:
            return
        tools = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
        done = subprocess.run(
            [sys.executable, "-m", "auditwheel", "repair", wheel, "-w", self.folder / "repaired"],
            capture_output=True,
            text=True,
            env={**PYTHON, "PATH": tools},
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        [carrying] = (self.folder / "repaired").glob("*.whl")
        self.assertIn("manylinux", carrying.name)
        with zipfile.ZipFile(carrying) as archive:
            archive.extractall(self.folder / "carried")
            names = archive.namelist()
        self.assertTrue(any(re.match(r"pacini\.libs/libsndfile-", name) for name in names), names)
        script = (
            "import pacini, sys; clip = pacini.encode(sys.argv[1]); "
            "print([line.split()[-1] for line in open('/proc/self/maps') if 'libsndfile' in line][0])"
        )
        environment = {**PYTHON, "PYTHONPATH": str(self.folder / "carried")}
        made = subprocess.run([sys.executable, "-c", script, DEMO[0]], capture_output=True, text=True, env=environment)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("pacini.libs", made.stdout)


if __name__ == "__main__":
    unittest.main()
