"""The crate, with Cargo alone: it has no dependencies."""
import os
import shutil
import subprocess
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

    def test_pkg_config_finds_the_library_and_who_has_none_hears_of_pacini_lib_dir(self):
        self.needs("cargo", "rustc", "pkg-config")
        shutil.copytree(BINDINGS / "rust", self.folder / "crate")

        def build(**environment):
            home = os.environ.get("HOME", "/root")
            return subprocess.run(["cargo", "build", "--offline", "--example", "first_vibration", "--manifest-path",
                                   "crate/Cargo.toml"], cwd=self.folder, capture_output=True, text=True, timeout=600,
                                  env={"PATH": os.environ["PATH"], "HOME": home, **environment})

        (self.folder / "pacini.pc").write_text(
            f"Name: pacini\nDescription: Pacini\nVersion: 1.0.0\nLibs: -L{LIBRARY.parent} -lpacini\n")
        done = build(PKG_CONFIG_PATH=str(self.folder))
        self.assertEqual((done.returncode, "warning" in done.stderr), (0, False), done.stderr)
        if subprocess.run(["pkg-config", "--exists", "pacini"]).returncode == 0:
            self.skipTest("libpacini is installed here")
        for environment in ({"PKG_CONFIG": "false"}, {}, {"PACINI_LIB_DIR": str(self.folder)}):
            done = build(**environment)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("PACINI_LIB_DIR", done.stderr)


if __name__ == "__main__":
    unittest.main()
