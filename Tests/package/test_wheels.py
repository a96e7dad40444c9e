"""Which wheels are made and tried by `bash cmake/bootstrap.sh wheels`, and what it says of those that are not."""

import contextlib
import io
import re
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "cmake"))
import make_wheels  # noqa: E402

HERE = {sys.version_info.minor: Path(sys.executable)}


class Wheels(unittest.TestCase):
    def test_from_the_stable_interface_on_one_wheel_is_for_all(self):
        self.assertEqual(
            [make_wheels.tag(minor) for minor in (9, 11, 12, 14)],
            ["cp39-cp39", "cp311-cp311", "cp312-abi3", "cp312-abi3"],
        )
        said = re.search(r'wheel\.py-api = "cp3(\d+)"', (ROOT / "pyproject.toml").read_text(encoding="utf-8"))[1]
        self.assertEqual(int(said), make_wheels.STABLE)
        oldest = re.search(r'requires-python = ">=3\.(\d+)"', (ROOT / "pyproject.toml").read_text(encoding="utf-8"))[1]
        self.assertEqual(int(oldest), make_wheels.VERSIONS[0])

    def test_what_no_python_makes_is_told(self):
        with mock.patch.object(make_wheels, "has_headers", lambda python: str(python) != "/old/python3.9"):
            made, missing = make_wheels.builders(
                {
                    9: Path("/old/python3.9"),
                    11: Path("/a/python3.11"),
                    13: Path("/b/python3.13"),
                    14: Path("/b/python3.14"),
                }
            )
            self.assertEqual(made, [("cp311-cp311", Path("/a/python3.11")), ("cp312-abi3", Path("/b/python3.13"))])
            self.assertEqual(missing, ["cp39-cp39", "cp310-cp310"])
            self.assertEqual(make_wheels.builders({}), ([], ["cp39-cp39", "cp310-cp310", "cp311-cp311", "cp312-abi3"]))

    def test_interpreters_at_hand_are_found_and_are_what_they_are_called(self):
        for minor, path in make_wheels.interpreters().items():
            said = make_wheels.run_version(path)
            self.assertEqual(said, (3, minor))

    def test_a_folder_without_wheels_is_no_success(self):
        said = io.StringIO()
        with (
            tempfile.TemporaryDirectory() as name,
            contextlib.redirect_stdout(said),
            mock.patch.object(make_wheels, "interpreters", lambda: HERE),
        ):
            self.assertEqual(make_wheels.attempt(Path(name)), 1)
        self.assertIn(f"NOT TRIED: Python 3.{sys.version_info.minor}: it has no wheel", said.getvalue())

    def test_a_wheel_that_does_not_work_is_told(self):
        said = io.StringIO()
        minor = sys.version_info.minor
        with (
            tempfile.TemporaryDirectory() as name,
            contextlib.redirect_stdout(said),
            mock.patch.object(make_wheels, "interpreters", lambda: HERE),
            mock.patch.object(make_wheels, "environment", lambda python, folder, *modules: Path(sys.executable)),
        ):
            (Path(name) / f"pacini-9.9.9-{make_wheels.tag(minor)}-manylinux_2_34_x86_64.whl").write_bytes(b"no wheel")
            self.assertEqual(make_wheels.attempt(Path(name)), 1)
        self.assertIn(f"FAILED: Python 3.{minor}", said.getvalue())


if __name__ == "__main__":
    unittest.main()
