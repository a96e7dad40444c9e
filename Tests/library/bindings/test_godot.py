"""The addon for Godot 3, in Godot's server."""
import shutil
import unittest

from bindings import BINDINGS, HEADER, HERE, KNOCK, LIBRARY, BindingTest

GODOT = BINDINGS / "godot/godot3"


class Godot(BindingTest):
    def test_plays_what_the_c_program_plays_and_reports_errors(self):
        self.needs("godot3-server")
        _, rendered = self.scene()
        expected = self.expected()
        addon = self.folder / "addons/pacini"
        shutil.copytree(GODOT / "addons/pacini", addon)
        shutil.copy(LIBRARY, addon / "libpacini.so.1")
        for source in (GODOT / "example/first_vibration.gd", HERE / "godot/test.gd"):
            shutil.copy(source, self.folder)
        (self.folder / "project.godot").write_text("config_version=4\n")
        for source in GODOT.glob("*.[ch]"):
            shutil.copy(source, self.folder)
        self.run_program("cc", "-std=c99", "-Wall", "-Wextra", "-Wshadow", "-Wconversion", "-Werror", "-fsyntax-only",
                         "-I", HEADER.parent, "pacini_godot.c")
        self.run_lines_of_page("godot.md")
        said = self.run_program("godot3-server", "--path", self.folder, "-s", "test.gd", LD_LIBRARY_PATH="")
        self.assertIn(b"failures: 0", said)
        self.assertNotIn(b"SCRIPT ERROR", said)
        self.assertNotIn(b"leaked", said)
        self.assert_same_samples((self.folder / "played.raw").read_bytes(), expected)
        self.assert_same_samples((self.folder / "two.raw").read_bytes(), rendered)


if __name__ == "__main__":
    unittest.main()
