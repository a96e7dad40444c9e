"""The package for Node.js, with koffi from npm in build/bindings-node."""
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


if __name__ == "__main__":
    unittest.main()
