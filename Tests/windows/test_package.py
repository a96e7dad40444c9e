"""The installer and the zip for Windows: installed in wine without a question, what is installed runs, and nothing is
left when it is removed; packed again, both have the same bytes."""
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile
from pathlib import Path

import wine

SOURCE = Path(os.environ["PACINI_SOURCE_DIR"])
PACKAGE = wine.BUILD / "package"
DRIVE = wine.PREFIX / "drive_c"
wine.prepare()


def one(pattern):
    [path] = PACKAGE.glob(pattern)
    return path


def everything():
    """All files and folders of drive C but temporary ones, and where the registry of the user names Pacini."""
    files = {str(path.relative_to(DRIVE)) for path in DRIVE.rglob("*") if "windows/temp" not in str(path).lower()
             and "Temp" not in path.parts}
    registry = wine.run("reg", "query", "HKCU", "/s").stdout.decode(errors="replace").splitlines()
    assert len(registry) > 50, registry
    return files, [line for line in registry if "acini" in line]


class Package(unittest.TestCase):
    def test_it_installs_runs_and_leaves_nothing(self):
        before, mentioned = everything()
        self.assertEqual(mentioned, [])
        target = DRIVE / "Program Files/Pacini of mine"
        self.addCleanup(shutil.rmtree, target, ignore_errors=True)
        self.addCleanup(lambda: (target / "uninstall.exe").exists() and self.remove(target))
        # The folder stands last, without quotes.
        done = wine.run(one("*-setup.exe"), *"/S /D=C:\\Program Files\\Pacini of mine".split())
        self.assertEqual(done.returncode, 0, done.stderr)
        said = wine.run(target / "bin/pacini.exe", "--version")
        self.assertRegex(said.stdout.decode(), r"^pacini \d+\.\d+")
        sound = target / "share/pacini/demo/knock_wood_bridge.flac"
        theirs = target / "share/mine.txt"
        theirs.write_text("mine", encoding="utf-8")
        clip = DRIVE / "knock.pacb"
        done = wine.run(target / "bin/pacini.exe", "encode", sound, "-o", "C:\\knock.pacb")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertGreater(clip.stat().st_size, 50)
        clip.unlink()
        self.assertGreater(len(everything()[1]), 3)
        # Where hosts look for the plugins of one user.
        common = next(DRIVE.glob("users/*/AppData/Local/Programs/Common"))
        for plugin in ("VST3/Pacini.vst3/Contents/x86_64-win/Pacini.vst3", "CLAP/Pacini/Pacini.clap"):
            self.assertTrue((common / plugin).is_file(), plugin)
            self.assertTrue((common / plugin).with_name("sndfile.dll").is_file(), plugin)
        self.remove(target)
        self.assertEqual(theirs.read_text(encoding="utf-8"), "mine")
        theirs.unlink()
        (target / "share").rmdir()
        target.rmdir()
        after, mentioned = everything()
        self.assertEqual((after - before, mentioned), (set(), []))

    def remove(self, target):
        """It removes itself by a copy, which goes on after it ended."""
        self.assertEqual(wine.run(target / "uninstall.exe", "/S").returncode, 0)
        until = time.monotonic() + 60
        while (target / "bin").exists() or (target / "uninstall.exe").exists():
            self.assertLess(time.monotonic(), until, "is not removed")
            time.sleep(0.1)

    def test_the_zip_holds_what_people_need(self):
        with zipfile.ZipFile(one("*.zip")) as archive:
            names = [name.split("/", 1)[1] for name in archive.namelist()]
        for name in ("bin/pacini.exe", "bin/pacini-bench.exe", "bin/pacini.dll", "bin/sndfile.dll", "bin/VCRUNTIME140.dll",
                     "include/pacini.h", "lib/libpacini.dll.a", "licenses/libsndfile-COPYING", "LICENSE",
                     "share/pacini/profiles/l5-wristband.json", "bin/PaciniEditor.exe", "bin/PaciniStandalone.exe",
                     "plugins/VST3/Pacini.vst3/Contents/x86_64-win/Pacini.vst3", "plugins/CLAP/Pacini/Pacini.clap"):
            self.assertIn(name, names)

    def test_packed_twice_it_has_the_same_bytes(self):
        def sums():
            return {path.name: hashlib.sha256(path.read_bytes()).hexdigest()
                    for path in PACKAGE.glob("*.*") if path.is_file()}
        first = sums()
        self.assertEqual(len(first), 2)
        time.sleep(2)  # dates of a zip have steps of 2 s
        subprocess.run(["cmake", "--build", wine.BUILD, "--target", "pacini_windows_package"], check=True,
                       capture_output=True, env={**os.environ, "TZ": "Asia/Tokyo", "LC_ALL": "C"})
        self.assertEqual(sums(), first)

    def test_a_release_takes_both_and_lists_what_is_in_them(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            command = [sys.executable, "-B", SOURCE / "cmake/make_release.py", folder, "--changed",
                       "--parts", "windows"]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            packages = {one("*.zip").name, one("*-setup.exe").name}
            [listed] = folder.glob("*.spdx.json")
            self.assertEqual({path.name for path in folder.iterdir()}, packages | {listed.name, "SHA256SUMS"})
            for name in packages:
                self.assertEqual((folder / name).read_bytes(), (PACKAGE / name).read_bytes())
            document = json.loads(listed.read_text(encoding="utf-8"))
        names = {part["name"]: part.get("versionInfo") for part in document["packages"]}
        for start in ("libsndfile with libFLAC", "mingw-w64's runtime", "libzip", "zlib", "NSIS", "JUCE's modules",
                      "libpng", "libjpeg-turbo"):
            found = [bool(version) for name, version in names.items() if name.startswith(start)]
            self.assertEqual(found, [True], start)


if __name__ == "__main__":
    unittest.main()
