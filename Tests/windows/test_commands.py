"""The end-to-end tests of the command, which run it as a program of Linux, with the command for Windows in wine; and
the commands of the README."""
import importlib
import os
import sys
import tempfile
import unittest

import wine

wine.prepare()
FOLDER = tempfile.TemporaryDirectory()
os.environ["PACINI_COMMAND"] = str(wine.command(FOLDER.name))
sys.path.insert(0, str(wine.ROOT / "Tests/cli"))
command = importlib.import_module("command")


def with_slashes(text):
    """What a command prints, with the paths of Linux."""
    if not text or b"\0" in text:
        return text
    backslash = b"\\\\" if text.lstrip().startswith(b"{") else b"\\"
    return text.replace(backslash, b"/").replace(b"Z:/", b"/")


def run_command(self, *arguments, run=command.CommandTest.run_command, **options):
    done = run(self, *arguments, **options)
    if type(self).__module__ == "test_clips":  # where texts have backslashes that are none of paths
        return done
    done.stdout, done.stderr = with_slashes(done.stdout), with_slashes(done.stderr)
    return done


command.CommandTest.run_command = run_command

MODULES = [importlib.import_module(f"test_{name}") for name in (
    "clips", "convert", "dry_run", "encode", "formats", "json", "lint", "markers", "overwrite", "profiles", "render",
    "scenes")]
readme = importlib.import_module("test_readme")

# What is not so here, each with its reason. It must fail: nothing stands here for longer than it has to.
NOT_HERE = {
    "test_hundreds_of_megabytes_of_brackets_are_refused_soon": "wine does not start within the limit of memory",
    "test_a_picture_beside_its_clip_is_not_drawn_over_another": "pictures are SVG alone, this is a PNG",
    "test_every_command_reports_its_success": "likewise the picture of a clip",
    "test_a_program_without_profiles_says_so": "copies the program, which is a script here",
}


class Readme(readme.Documents):
    def commands_run(self):
        blocks = [block for block in self.readme.commands()
                  if any(one.command.startswith("pacini ") for one in block)]
        self.assertGreater(len(blocks), 0)
        for block in blocks:
            self.runs(block)


def fails_here(test, name):
    method = unittest.expectedFailure(getattr(type(test), name))
    setattr(type(test), name, method)
    return type(test)(name)


# One part for each commit, in turn; without a turn: all.
PARTS = 3
TURN = os.environ.get("PACINI_WINDOWS_TURN")


def load_tests(loader, _standard, _pattern):
    part = MODULES if not TURN else MODULES[int(TURN) % PARTS::PARTS]
    suite = unittest.TestSuite([Readme("commands_run")] if not TURN or int(TURN) % PARTS == 0 else [])
    for module in part:
        for group in loader.loadTestsFromModule(module):
            for test in group:
                name = test.id().rpartition(".")[2]
                suite.addTest(fails_here(test, name) if name in NOT_HERE else test)
    return suite


if __name__ == "__main__":
    unittest.main()
