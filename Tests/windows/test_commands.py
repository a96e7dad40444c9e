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

MODULES = [importlib.import_module(f"test_{name}") for name in (
    "clips", "convert", "dry_run", "encode", "formats", "json", "lint", "markers", "overwrite", "profiles", "render",
    "scenes")]
readme = importlib.import_module("test_readme")

# What asks for Linux, each with its reason.
LINKS = "wine shows what a link of Linux leads to, not the link"
NOT_HERE = {
    "test_a_clip_is_not_converted_onto_itself": LINKS,
    "test_a_link_in_a_folder_is_encoded_where_it_stands": LINKS,
    "test_a_sound_is_never_overwritten_by_its_clip": LINKS,
    "test_a_named_file_is_replaced_but_never_an_input": LINKS,
    "test_a_link_is_not_followed_to_what_is_not_ours": LINKS,
    "test_a_hard_link_of_a_recording_keeps_it": LINKS,
    "test_hundreds_of_megabytes_of_brackets_are_refused_soon": "wine needs more memory than the limit",
    "test_several_files_do_not_go_to_standard_output": "/dev/stdout",
    "test_a_report_that_cannot_be_printed_is_told": "/dev/full",
    "test_a_picture_beside_its_clip_is_not_drawn_over_another": "pictures are SVG alone",
    "test_a_signal_half_way_leaves_no_output": "signals; test_files.py has Ctrl+C",
}


class Readme(readme.Documents):
    def commands_run(self):
        for block in self.readme.commands():
            if any(one.command.startswith("pacini ") for one in block):
                self.runs(block)


def load_tests(loader, _standard, _pattern):
    suite = unittest.TestSuite([Readme("commands_run")])
    for module in MODULES:
        for group in loader.loadTestsFromModule(module):
            for test in group:
                if test.id().rpartition(".")[2] not in NOT_HERE:
                    suite.addTest(test)
    return suite


if __name__ == "__main__":
    unittest.main()
