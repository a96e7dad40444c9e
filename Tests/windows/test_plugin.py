"""The plugin, the standalone program and the editor for Windows, in wine: VST3 and CLAP put out the drive that they put
out on this machine, find their library for sounds where hosts load them from, and their windows open and draw."""
import array
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import wine

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "hosts"))
from host_test import picture, until  # noqa: E402
from screen import Screen  # noqa: E402

SOURCE = Path(os.environ["PACINI_SOURCE_DIR"])
PLUGINS = wine.BUILD / "plugins"
OURS = Path(os.environ["PACINI_COMMAND"]).parents[1] / "plugins"
SDK = Path("/usr/share/juce/modules/juce_audio_processors/format_types/VST3_SDK")
SOUND = SOURCE / "Resources/demo/knock_wood_bridge.flac"
FRAMES = 23122
CLAP, VST3 = "CLAP/Pacini.clap", "VST3/Pacini.vst3/Contents/x86_64-win/Pacini.vst3"
SYSTEM = {"advapi32", "comdlg32", "dxgi", "gdi32", "imm32", "kernel32", "msvcrt", "ole32", "oleaut32", "shell32",
          "shlwapi", "user32", "version", "wininet", "winmm", "ws2_32", "wsock32"}
if not (PLUGINS / CLAP).exists():
    wine.skip("the plugin for Windows is not built")
wine.prepare()


def compiled(sources, output, *options):
    """A program or library for Windows, with no library of the compiler's beside it."""
    compiler = "gcc" if all(str(source).endswith(".c") for source in sources) else "g++"
    standard = "-std=c11" if compiler == "gcc" else "-std=c++20"
    subprocess.run([f"x86_64-w64-mingw32-{compiler}-posix", standard, "-O1", "-static", *sources, "-o", output,
                    *options], check=True)
    return output


class InWine(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def raw_sound(self):
        sound = self.folder / "in.raw"
        subprocess.run(["ffmpeg", "-v", "error", "-i", SOUND, "-ac", "1", "-ar", "48000", "-f", "f32le", sound],
                       check=True)
        return sound


class Plugins(InWine):
    def drives(self, host, sources, options, here, there):
        """What the plugin puts out on this machine and in wine."""
        sound, made = self.raw_sound(), (self.folder / "here.raw", self.folder / "there.raw")
        own = self.folder / "host"
        compiler = ["gcc", "-std=c11"] if host == "clap_render" else ["g++", "-std=c++20"]
        subprocess.run([*compiler, "-O1", *options, *sources, "-o", own, "-ldl"], check=True)
        subprocess.run([own, here, sound, made[0]], check=True, timeout=120)
        windows = compiled(sources, self.folder / f"{host}.exe", *options, "-lole32")
        done = wine.run(windows, wine.as_windows(there), wine.as_windows(sound), wine.as_windows(made[1]))
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        first, second = (array.array("f", path.read_bytes()) for path in made)
        self.assertEqual(len(first), sound.stat().st_size // 4)
        self.assertEqual(len(second), len(first))
        self.assertGreater(max(map(abs, first)), 0.2)
        return first, second

    def test_a_clap_puts_out_the_drive_of_this_machine(self):
        here, there = self.drives("clap_render", [HERE / "clap_render.c"], [], OURS / CLAP, PLUGINS / CLAP)
        self.assertLess(max(abs(a - b) for a, b in zip(here, there)), 1e-6)

    def test_a_vst3_puts_out_the_drive_of_this_machine(self):
        base = SDK / "pluginterfaces/base"
        sources = [HERE / "vst3_render.cpp", base / "funknown.cpp", base / "coreiids.cpp"]
        [own] = (OURS / "VST3").rglob("*.so")
        here, there = self.drives("vst3_render", sources, ["-DRELEASE=1", "-isystem", SDK], own, PLUGINS / VST3)
        self.assertLess(max(abs(a - b) for a, b in zip(here, there)), 1e-6)

    def test_they_need_the_systems_libraries_alone(self):
        for plugin in (CLAP, VST3):
            text = subprocess.run(["x86_64-w64-mingw32-objdump", "-p", PLUGINS / plugin], check=True,
                                  capture_output=True, text=True).stdout
            self.assertLessEqual({name.lower() for name in re.findall(r"DLL Name: (\S+)\.dll", text)}, SYSTEM)

    def test_sounds_are_read_by_the_library_in_the_plugins_folder_and_refused_without_it(self):
        host = compiled([HERE / "reads_sound.c"], self.folder / "host.exe")
        plugin = self.folder / "of mine" / "reads.dll"
        plugin.parent.mkdir()
        reader = self.folder / "reads.o"
        subprocess.run(["x86_64-w64-mingw32-gcc-posix", "-DPLUGIN", "-c", f"-I{wine.BUILD / 'dependencies'}",
                        HERE / "reads_sound.c", "-o", reader], check=True)
        finder = SOURCE / "Source/plugin/mingw/SoundLibrary.cpp"
        compiled([reader, finder, wine.BUILD / "sndfile-later.a"], plugin, "-shared")
        done = wine.run(host, wine.as_windows(plugin), wine.as_windows(SOUND))
        self.assertEqual((done.returncode, done.stdout.strip()), (1, b"-1"))
        self.assertEqual(done.stderr.strip(),
                         b"sndfile.dll is missing in the folder of the plugin: install Pacini again")
        for library in ("sndfile.dll", "VCRUNTIME140.dll"):
            shutil.copy(wine.BIN / library, plugin.parent)
        done = wine.run(host, wine.as_windows(plugin), wine.as_windows(SOUND))
        self.assertEqual((done.returncode, int(done.stdout), done.stderr), (0, FRAMES, b""))


class Windows(InWine):
    """Programs on a screen that nobody sees. Wine's screen is never ready for a next picture: dxgi.c."""

    def setUp(self):
        super().setUp()
        self.app = self.folder / "app"
        self.app.mkdir()
        compiled([HERE / "dxgi.c"], self.app / "dxgi.dll", "-shared")
        for library in ("sndfile.dll", "VCRUNTIME140.dll"):
            shutil.copy(wine.BIN / library, self.app)
        self.screen = self.enterContext(Screen(self.folder))
        self.screen.environment["WINEDLLOVERRIDES"] = os.environ["WINEDLLOVERRIDES"] + ";dxgi=n,b"

    def start(self, program, *words):
        shutil.copy(program, self.app)
        return self.screen.start(wine.WINE, self.app / program.name, *words, env=self.screen.environment)

    def colours(self):
        path = self.folder / "screen.png"
        self.assertTrue(picture(self.screen.display, path))
        return int(subprocess.run(["identify", "-format", "%k", path], check=True, capture_output=True).stdout)

    def test_the_editor_opens_a_sound_and_exports_it(self):
        self.start(PLUGINS / "Standalone/PaciniEditor.exe", "--fresh", wine.as_windows(SOUND))
        self.assertTrue(until(lambda: self.screen.find_window(r"Untitled \* - Pacini Editor")))
        self.screen.focus()
        made = self.folder / "mine.haptic"
        for _ in range(3):  # keys that come before the window is ready for them are lost
            self.screen.keys("ctrl+e")
            time.sleep(2)
            self.screen.keys("ctrl+a")
            self.screen.type(wine.as_windows(made))
            self.screen.keys("Return")
            if until(made.exists, 15):
                break
            self.screen.keys("Escape")
        self.assertIn("signals", json.loads(made.read_text(encoding="utf-8")))

    def test_the_standalone_program_draws_its_window(self):
        before = self.colours()
        self.start(PLUGINS / "Standalone/Pacini.exe")
        self.assertTrue(until(lambda: self.screen.find_window("^Pacini$")))
        self.assertTrue(until(lambda: self.colours() > before + 100, 30))

    def test_the_plugin_draws_its_window_within_that_of_a_host(self):
        before = self.colours()
        host = compiled([HERE / "clap_render.c"], self.app / "host.exe", "-lgdi32")
        done = subprocess.Popen([wine.WINE, host, wine.as_windows(PLUGINS / CLAP), wine.as_windows(self.raw_sound()),
                                 wine.as_windows(self.folder / "out.raw"), "20"], env=self.screen.environment,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        with done:
            width, height = map(int, done.stdout.readline().split())
            self.assertGreater(min(width, height), 500)
            self.assertTrue(until(lambda: self.colours() > before + 100, 15))
            self.assertEqual((done.wait(60), done.stderr.read()), (0, ""))


if __name__ == "__main__":
    unittest.main()
