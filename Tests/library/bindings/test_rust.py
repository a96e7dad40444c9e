"""The crate, with Cargo alone: it has no dependencies."""
import os
import shutil
import unittest

from bindings import BINDINGS, KNOCK, LIBRARY, BindingTest


class Rust(BindingTest):
    def test_its_tests_pass_and_it_plays_what_the_c_program_plays(self):
        self.needs("cargo", "rustc")
        shutil.copytree(BINDINGS / "rust", self.folder / "crate")

        def cargo(*words):
            return self.run_program("cargo", *words, "--quiet", "--offline", "--manifest-path", "crate/Cargo.toml",
                                    *rest, timeout=600, HOME=os.environ.get("HOME", "/root"), RUSTFLAGS="-D warnings",
                                    PACINI_LIB_DIR=str(LIBRARY.parent), LD_LIBRARY_PATH="")

        rest = ("--", "--nocapture")
        said = cargo("test").decode()
        self.assert_same_layout([line for line in said.splitlines() if line.startswith("pacini_")])
        rest = ("--", str(KNOCK))
        self.assert_same_samples(cargo("run", "--example", "first_vibration"), self.expected())


if __name__ == "__main__":
    unittest.main()
