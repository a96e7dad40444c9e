"""The command for Windows, in wine, writes the bytes that the command of this machine writes: clips of the demo
sounds in all formats, and drives for the wristband."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import wine

COMMAND = os.environ["PACINI_COMMAND"]
wine.prepare()


class Bytes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        for name in ("here", "windows"):
            (self.folder / name).mkdir()
            (self.folder / name / "demo").symlink_to(wine.ROOT / "Resources/demo")

    def on_both(self, *words):
        here = subprocess.run([COMMAND, *words], cwd=self.folder / "here", capture_output=True, timeout=300,
                              check=False)
        there = wine.run(wine.BIN / "pacini.exe", *words, cwd=self.folder / "windows")
        self.assertEqual(here.returncode, 0, here.stderr)
        self.assertEqual((there.returncode, there.stderr), (0, here.stderr), there.stdout)
        return here.stdout, there.stdout

    def same(self, pattern, least):
        # A record of a run has measured losses, which differ in the eighth digit: clips and drives have to be the same.
        files = sorted(path.relative_to(self.folder / "here") for path in (self.folder / "here").glob(pattern)
                       if path.name != "pacini.manifest.json")
        self.assertGreaterEqual(len(files), least)
        for file in files:
            there, here = (self.folder / place / file for place in ("windows", "here"))
            self.assertEqual(there.read_bytes(), here.read_bytes(), file)

    def test_clips_of_all_formats_and_drives_are_the_same(self):
        self.on_both("encode", "demo", "-o", "clips", "--format", "packed", "-j", "1")
        self.same("clips/*.pacb", 8)
        self.on_both("render", "clips", "-o", "drives", "--profile", "l5-wristband", "-j", "1")
        self.same("drives/*.wav", 8)
        for form in ("json", "haptic", "ahap", "hjif", "pulsar", "android-xml", "wav16"):
            self.on_both("convert", "clips", "-o", form, "--format", form, "-j", "1", "-q")
            self.same(f"{form}/*", 8)

    def test_texts_are_the_same_line_by_line(self):
        self.on_both("encode", "demo/knock_wood_bridge.flac", "-o", "knock.pacb")
        for words in (["info", "knock.pacb"], ["info", "knock.pacb", "--json"], ["help", "encode"], ["profiles"],
                      ["man"]):
            here, there = self.on_both(*words)
            profiles = wine.ROOT / "profiles"
            self.assertEqual(there.replace(wine.as_windows(profiles).encode(), str(profiles).encode()), here)


if __name__ == "__main__":
    unittest.main()
