"""What cmake/make_macos_package.sh asks of Apple's programs, with stand-ins for them: nobody has run it on macOS."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[2]
PLACES = {"vst3": "/Library/Audio/Plug-Ins/VST3", "au": "/Library/Audio/Plug-Ins/Components",
          "clap": "/Library/Audio/Plug-Ins/CLAP", "lv2": "/Library/Audio/Plug-Ins/LV2", "standalone": "/Applications",
          "editor": "/Applications", "command": "/usr/local"}
# Each notes its arguments. What makes a file keeps what it got; two bundles can be moved in each part.
STAND_IN = """#!/usr/bin/env python3
import os, shutil, sys
from pathlib import Path
name, given = Path(sys.argv[0]).name, sys.argv[1:]
with open(os.environ["NOTES"], "a") as notes:
    notes.write("\\t".join([name, *given]) + "\\n")
if name == os.environ.get("BREAKS"):
    sys.exit(3)
if name == "plutil" and int(given[1].partition(".")[0]) > 1:
    sys.exit(1)
if name == "pkgbuild" and "--analyze" not in given:
    root = Path(given[given.index("--root") + 1])
    Path(given[-1]).write_text("\\n".join(sorted(str(p.relative_to(root)) for p in root.rglob("*") if p.is_file())))
if name == "pkgbuild":
    Path(given[-1]).touch()
if name == "productbuild":
    parts = Path(given[given.index("--package-path") + 1])
    kept = Path(os.environ["NOTES"]).parent / "kept"
    shutil.copytree(parts, kept)
    shutil.copy(given[given.index("--distribution") + 1], kept)
    Path(given[-1]).write_text("installer")
"""


class MacosPackage(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        (self.folder / "tools").mkdir()
        for tool in ("codesign", "pkgbuild", "productbuild", "plutil", "xcrun", "spctl"):
            (self.folder / "tools" / tool).write_text(STAND_IN)
            (self.folder / "tools" / tool).chmod(0o755)
        self.programs = self.folder / "with space"
        for path in ("bin/pacini", "bin/pacini-bench", "lib/libpacini.dylib", "lib/pkgconfig/pacini.pc",
                     "plugins/VST3/Pacini.vst3/Contents/MacOS/Pacini", "plugins/AU/Pacini.component/Contents/MacOS/Pacini",
                     "plugins/CLAP/Pacini.clap/Contents/MacOS/Pacini", "plugins/LV2/Pacini.lv2/libPacini.so",
                     "plugins/LV2/Pacini.lv2/manifest.ttl", "plugins/Standalone/Pacini.app/Contents/MacOS/Pacini",
                     "plugins/Standalone/PaciniEditor.app/Contents/MacOS/PaciniEditor"):
            file = self.programs / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(path)
            file.chmod(0o755 if path.startswith("bin") or "/MacOS/" in path else 0o644)

    def make(self, **environment):
        path = f"{self.folder / 'tools'}{os.pathsep}{os.environ['PATH']}"
        self.notes = self.folder / "notes"
        self.notes.write_text("")
        usual = {name: value for name, value in os.environ.items() if not name.startswith("PACINI_")}
        return subprocess.run(["bash", ROOT / "cmake/make_macos_package.sh", self.programs, self.folder / "out.pkg"],
                              env={**usual, "PATH": path, "NOTES": str(self.notes), **environment}, capture_output=True,
                              text=True, timeout=60)

    def calls(self):
        return [line.split("\t") for line in self.notes.read_text().splitlines()]

    def test_each_part_goes_where_macos_looks_for_it_and_nowhere_else(self):
        done = self.make()
        self.assertEqual((done.returncode, done.stdout), (0, f"{self.folder / 'out.pkg'}\n"), done.stderr)
        self.assertEqual((self.folder / "out.pkg").read_text(), "installer")
        built = {call[-1].rpartition("/")[2]: call for call in self.calls() if call[0] == "pkgbuild" and "--analyze" not in call}
        self.assertEqual({name.removesuffix(".pkg"): call[call.index("--install-location") + 1]
                          for name, call in built.items()}, PLACES)
        packed = [line for name in PLACES for line in (self.folder / "kept" / f"{name}.pkg").read_text().splitlines()]
        self.assertEqual(len(packed), 11)
        self.assertIn("bin/pacini", packed)
        self.assertIn("Pacini.lv2/manifest.ttl", packed)
        moved = [call for call in self.calls() if call[0] == "plutil" and call[3:5] == ["-bool", "NO"]]
        self.assertEqual(len(moved), 3 * len(PLACES))  # two of each, and the one that is not there
        self.assertNotIn("codesign", self.notes.read_text())
        self.assertNotIn("xcrun", self.notes.read_text())

    def test_the_installer_offers_each_part_and_says_which_systems_it_is_for(self):
        self.assertEqual(self.make().returncode, 0)
        page = ElementTree.parse(self.folder / "kept/distribution.xml").getroot()
        for found in (page.iterfind("choices-outline/line"), page.iterfind("choice")):
            self.assertEqual([item.get("choice") or item.get("id") for item in found], list(PLACES))
        self.assertEqual({item.get("id"): item.text for item in page.iterfind("pkg-ref")},
                         {f"org.pacini.{name}": f"{name}.pkg" for name in PLACES})
        self.assertEqual(page.find("options").get("hostArchitectures"), "arm64,x86_64")
        self.assertEqual(page.find("volume-check/allowed-os-versions/os-version").get("min"), "13.3")

    def test_what_is_inside_is_signed_first_and_what_is_notarised_last(self):
        done = self.make(PACINI_SIGN_WITH="Developer ID Application: N", PACINI_SIGN_PACKAGE_WITH="Developer ID Installer: N",
                         PACINI_NOTARY_PROFILE="notes")
        self.assertEqual(done.returncode, 0, done.stderr)
        calls = self.calls()
        signed = [call[-1].rpartition("/")[2] for call in calls if call[0] == "codesign"]
        self.assertEqual(signed, ["Pacini.vst3", "Pacini.component", "Pacini.clap", "libPacini.so", "Pacini.app",
                                  "PaciniEditor.app", "pacini", "pacini-bench", "libpacini.dylib"])
        for call in calls:
            if call[0] == "codesign":
                self.assertEqual(call[call.index("--options") + 1], "runtime")
                self.assertIn("--timestamp", call)
                self.assertEqual("--entitlements" in call, call[-1].endswith(".app"))
        order = [call[0] if call[0] != "xcrun" else call[1] for call in calls]
        self.assertEqual(order[-4:], ["productbuild", "notarytool", "stapler", "spctl"])
        for part in PLACES:
            at = [k for k, call in enumerate(calls) if call[0] == "pkgbuild" and call[-1].endswith(f"/{part}.pkg")]
            own = [k for k, call in enumerate(calls) if call[0] == "codesign" and f"/{part}/" in call[-1]]
            self.assertTrue(all(k < at[0] for k in own), part)

    def test_what_fails_leaves_no_package_and_none_is_replaced(self):
        signing = {"PACINI_SIGN_WITH": "A", "PACINI_SIGN_PACKAGE_WITH": "B", "PACINI_NOTARY_PROFILE": "C"}
        for tool in ("codesign", "pkgbuild", "productbuild", "xcrun", "spctl"):
            with self.subTest(tool):
                self.assertNotEqual(self.make(BREAKS=tool, **signing).returncode, 0)
                self.assertFalse((self.folder / "out.pkg").exists())
                subprocess.run(["rm", "-rf", self.folder / "kept"], check=True)
        done = self.make(PACINI_NOTARY_PROFILE="C")
        self.assertEqual((done.returncode, self.calls()), (1, []))
        self.assertIn("set PACINI_SIGN_WITH", done.stderr)
        (self.programs / "plugins/CLAP/Pacini.clap/Contents/MacOS/Pacini").unlink()
        for empty in ("Contents/MacOS", "Contents", ""):
            (self.programs / "plugins/CLAP/Pacini.clap" / empty).rmdir()
        done = self.make()
        self.assertEqual(done.returncode, 1)
        self.assertIn("Pacini.clap: is missing", done.stderr)
        (self.folder / "out.pkg").write_text("of before")
        done = self.make()
        self.assertEqual((done.returncode, self.calls(), (self.folder / "out.pkg").read_text()), (1, [], "of before"))


if __name__ == "__main__":
    unittest.main()
