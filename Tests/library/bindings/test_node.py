"""The package for Node.js, with koffi from npm in build/bindings-node."""
import os
import re
import shutil
import unittest

from bindings import BINDINGS, HERE, KNOCK, LIBRARY, ROOT, BindingTest

MODULES = ROOT / "build/bindings-node/node_modules"


class Node(BindingTest):
    def setUp(self):
        super().setUp()
        self.needs("node")
        if not (MODULES / "koffi").is_dir():
            self.skipTest(f"koffi is not in {MODULES} - cmake/bootstrap.sh installs it for the slow tests")
        modules = self.folder / "node_modules"
        modules.mkdir()
        for module in MODULES.iterdir():
            (modules / module.name).symlink_to(module)
        shutil.copytree(BINDINGS / "node", modules / "pacini")

    def test_plays_what_the_c_program_plays(self):
        example = self.folder / "node_modules/pacini/example/first_vibration.js"
        self.assert_same_samples(self.run_program("node", example, KNOCK), self.expected())

    def test_every_function_works_and_errors_are_exceptions(self):
        shutil.copy(HERE / "node/pacini.test.js", self.folder / "pacini.test.mjs")
        _, rendered = self.scene()
        self.run_program("node", "--expose-gc", "pacini.test.mjs", PACINI_LIBRARY=str(LIBRARY), LD_LIBRARY_PATH="")
        self.assert_same_layout((self.folder / "layout.txt").read_text().splitlines())
        self.assert_same_samples((self.folder / "two.raw").read_bytes(), rendered)


class Installed(BindingTest):
    def test_the_command_in_its_page_installs_it_with_what_it_needs(self):
        self.needs("node", "npm")
        if not (MODULES / "koffi").is_dir():
            self.skipTest(f"koffi is not in {MODULES}, nor in npm's cache")
        [command] = re.findall(r"`(npm install[^`]*) PATH`", (ROOT / "Resources/docs/node.md").read_text())
        self.run_program(*command.split(), BINDINGS / "node", "--prefer-offline", "--no-audit", "--no-fund",
                         HOME=os.environ["HOME"])
        (self.folder / "app.mjs").write_text(f"import {{ Clip }} from 'pacini'; Clip.load({str(KNOCK)!r})")
        self.run_program("node", "app.mjs", PACINI_LIBRARY=str(LIBRARY))


if __name__ == "__main__":
    unittest.main()
