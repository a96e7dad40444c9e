"""What becomes of tests that cannot be made: they count neither as passed nor as failed, and are listed with their reasons."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

from folder_test import FolderTest

HERE = Path(__file__).resolve().parent
TESTS = os.environ["PACINI_TESTS"]


def run(*arguments, **options):
    return subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=300, **options)


class Skips(FolderTest):
    def python(self, name, *bodies):
        methods = "".join(f"    def test_{i}(self):\n        {body}\n" for i, body in enumerate(bodies))
        (self.folder / f"{name}.py").write_text(f"import unittest\n\nclass Some(unittest.TestCase):\n    pass\n{methods}")
        return run(sys.executable, "-B", HERE / "run_tests.py", self.folder / f"{name}.py")

    def test_in_python(self):
        skip, fine, broken = "self.skipTest('no moon')", "pass", "self.fail('as it should')"
        done = self.python("some", fine, skip)
        self.assertEqual(done.returncode, 77, done.stderr)
        self.assertIn("SKIPPED: test_1: no moon\n", done.stdout)
        self.assertEqual(self.python("all_passed", fine, fine).returncode, 0)
        self.assertEqual(self.python("one_fails", skip, broken).returncode, 1)
        self.assertEqual(self.python("none").returncode, 1, "a file without tests has not passed")

    def test_in_catch(self):
        done = run(TESTS, "A test that is skipped")
        self.assertEqual(done.returncode, 77)
        self.assertIn("SKIPPED: there is nothing to test\n", done.stdout)
        self.assertEqual(run(TESTS, "[.skips]").returncode, 1, "a failure is not hidden by a skip")

    def test_the_list_of_a_run(self):
        (self.folder / "CTestTestfile.cmake").write_text(
            'add_test(passes sh -c "echo SKIPPED: not at all")\n'
            'add_test(skips sh -c "echo SKIPPED: no moon; echo SKIPPED: no sun; exit 77")\n'
            'add_test(dumb sh -c "exit 77")\n'
            "set_tests_properties(passes skips dumb PROPERTIES SKIP_RETURN_CODE 77)\n")
        for chosen, code, listed in (("passes", 0, ""),
                                     ("s", 1, "  skips: no moon; no sun\n"),
                                     ("dumb", 1, "  dumb: no reason given\n")):
            run("ctest", "--test-dir", self.folder, "-R", chosen, "--output-junit", self.folder / "results.xml")
            done = run(sys.executable, "-B", HERE / "list_skipped.py", self.folder / "results.xml")
            self.assertEqual((done.returncode, done.stdout, done.stderr), (code, listed, ""))


if __name__ == "__main__":
    unittest.main()
