#!/usr/bin/env python3
"""The bindings on a game controller that umockdev pretends to be there.

check_controllers.py       exit 1 when a claim fails, 77 when a program is missing; the environment is that of test_*.py
"""
import os
import shutil
import sys
import unittest
from pathlib import Path

sys.argv[1:] = sys.argv[1:] or [os.environ["PACINI_COMMAND"]]
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "cli/hid"))
from hid_test import clip, main_under_umockdev  # noqa: E402
from host_test import check, skip  # noqa: E402

from bindings import BINDINGS, HERE, LIBRARY, OUTSIDE, BindingTest  # noqa: E402
from test_node import MODULES  # noqa: E402

PROGRAMS = HERE / "controllers"
NEUTRAL = bytes.fromhex("0001404000014040")
SIMULATED = []  # the controller


class Controllers(BindingTest):
    def setUp(self):
        super().setUp()
        clip(self.folder, "short.json", 1.0)
        SIMULATED[0].clear()

    def played(self, said):
        """The program has said what it did, and the controller has vibrated and stopped."""
        lines = said.decode().splitlines()
        self.assertTrue(any("Pro Controller" in line for line in lines), lines)
        self.assertEqual([line.lower() for line in lines if "tached" in line], ["attached", "detached"])
        rumble = [(time, report[2:10]) for time, report in SIMULATED[0].writes if report[:1] == b"\x10"]
        loud = [time for time, sides in rumble if sides != NEUTRAL]
        self.assertGreater(len(loud), 40)
        self.assertTrue(0.9 < loud[-1] - loud[0] < 1.2, loud[-1] - loud[0])
        self.assertEqual(rumble[-1][1], NEUTRAL)

    def test_lua(self):
        self.needs("love")
        for source in (PROGRAMS / "main.lua", PROGRAMS / "conf.lua", BINDINGS / "lua/pacini.lua"):
            shutil.copy(source, self.folder)
        self.played(self.run_program("love", self.folder))

    def test_csharp(self):
        self.needs("mcs", "mono")
        self.run_program("mcs", "-out:controllers.exe", HERE / "csharp/UnityStubs.cs", PROGRAMS / "Controllers.cs",
                         *sorted((BINDINGS / "csharp/Runtime").rglob("*.cs")))
        self.played(self.run_program("mono", "controllers.exe"))

    def test_node(self):
        self.needs("node")
        if not (MODULES / "koffi").is_dir():
            self.skipTest(f"koffi is not in {MODULES} - cmake/bootstrap.sh installs it for the slow tests")
        modules = self.folder / "node_modules"
        modules.mkdir()
        (modules / "koffi").symlink_to(MODULES / "koffi")
        shutil.copytree(BINDINGS / "node", modules / "pacini")
        shutil.copy(PROGRAMS / "controllers.mjs", self.folder)
        self.played(self.run_program("node", "controllers.mjs"))

    def test_godot(self):
        self.needs("godot3-server")
        shutil.copytree(BINDINGS / "godot/godot3/addons", self.folder / "addons")
        for source in (*(BINDINGS / "godot/godot3").glob("*.[ch]"), PROGRAMS / "controllers.gd"):
            shutil.copy(source, self.folder)
        shutil.copy(LIBRARY, self.folder / "addons/pacini/libpacini.so.1")
        (self.folder / "project.godot").write_text("config_version=4\n")
        self.run_lines_of_page("godot.md")
        self.played(self.run_program("godot3-server", "--path", self.folder, "-s", "controllers.gd"))

    def test_rust(self):
        self.needs("cargo", "rustc")
        shutil.copytree(BINDINGS / "rust", self.folder / "crate")
        shutil.copy(PROGRAMS / "controllers.rs", self.folder / "crate/examples")
        # The compiler needs no devices.
        self.run_program("cargo", "build", "--quiet", "--offline", "--manifest-path", "crate/Cargo.toml", "--example",
                         "controllers", HOME=os.environ["HOME"], PACINI_LIB_DIR=str(LIBRARY.parent), LD_PRELOAD="")
        self.played(self.run_program("crate/target/debug/examples/controllers", "short.json"))


def claims(devices):
    controller = devices.FakeController()
    controller.connect()
    SIMULATED.append(controller)
    OUTSIDE["UMOCKDEV_DIR"] = controller.bed.get_root_dir()  # Python does not see what umockdev sets
    result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromTestCase(Controllers))
    check("every binding plays on a controller", result.wasSuccessful() and result.testsRun == 5)
    if result.wasSuccessful() and result.skipped:
        skip("; ".join(why for _, why in result.skipped))


if __name__ == "__main__":
    main_under_umockdev(claims)
