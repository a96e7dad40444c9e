"""The command for Windows, in wine: names, paths and files as Windows has them, Ctrl+C, and what people type there."""
import json
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import wine

os.environ.setdefault("PACINI_COMMAND", "")
sys.path.insert(0, str(wine.ROOT / "Tests/cli"))
from command import CommandTest, sine, wav

wine.prepare()


class Files(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.tools = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.tools.cleanup)
        for name in ("hold", "interrupt"):
            wine.compile_c(name, cls.tools.name)

    def run_command(self, *arguments, **options):
        return wine.run(wine.BIN / "pacini.exe", *arguments, cwd=self.folder, **options)

    def read(self, name):
        return json.loads((self.folder / name).read_text(encoding="utf-8"))

    def sound(self, name="a.wav"):
        return self.put(name, wav(sine(100, 0.2)))

    def test_paths_with_backslashes_and_drive_letters(self):
        self.sound("in/a.wav")
        self.sound("in/deep/b.wav")
        self.succeeds("encode", "in\\a.wav", "-o", "in\\one.json")
        self.succeeds("encode", "in", "-o", wine.as_windows(self.folder / "out"), "--format", "packed")
        self.assertEqual(self.names(), ["in/a.wav", "in/deep/b.wav", "in/one.json", "out/a.pacb", "out/deep/b.pacb"])
        report = self.report("info", wine.as_windows(self.folder / "out/deep/b.pacb"))
        self.assertTrue(report["ok"])
        self.succeeds("encode", "in\\", "-o", "again\\")
        self.assertIn("again/deep/b.json", self.names())
        self.fails(1, ["encode", "Q:\\no\\a.wav"], "does not exist")
        self.fails(1, ["encode", "in\\a.wav", "-o", "no\\where\\a.json"], "create the folder first")

    def test_names_of_any_alphabet_and_of_any_length(self):
        for name in ("häptik", "触覚", "two words", "Дверь", "🚪", "x" * 240, "a.b.c", "%TEMP%", "quote'$(x)`"):
            self.sound(f"{name}.wav")
            self.succeeds("encode", f"{name}.wav", "-o", f"{name}.pacb")
            self.assertIn(name, self.succeeds("info", f"{name}.pacb"))
            [entry] = self.report("convert", f"{name}.pacb", f"{name}.json")["files"]
            self.assertEqual(self.read(f"{name}.json")["format"], "pacini.clip")
            self.assertIn(name, json.dumps(entry, ensure_ascii=False))
        deep = self.folder / "/".join(["f" * 60] * 5)  # longer than 260 characters
        deep.mkdir(parents=True)
        (deep / "a.wav").write_bytes(wav(sine(100, 0.2)))
        one = "\\".join(["f" * 60] * 5)
        self.succeeds("encode", one + "\\a.wav", "-o", one + "\\a.pacb")
        self.assertIn("a.wav", self.succeeds("info", one + "\\a.pacb"))
        # Such a folder cannot be listed, which is told.
        (deep.parent.parent / "b.wav").write_bytes(wav(sine(100, 0.2)))
        self.fails(1, ["encode", "f" * 60, "-o", "out"], "longer than 259 characters; move it")
        self.assertEqual([name.rpartition("/")[2] for name in self.names() if name.startswith("out/")], ["b.json"])

    def test_texts_with_carriage_returns_are_read(self):
        self.clip()
        self.sound()
        text = (self.folder / "clip.json").read_text(encoding="utf-8")
        self.put("dos.json", json.dumps(json.loads(text), indent=1).replace("\n", "\r\n"))
        self.put("bom.json", "\ufeff" + text)
        for name in ("dos", "bom"):
            self.succeeds("convert", f"{name}.json", f"{name}.pacb")
        self.put("labels.txt", "0.05\t0.05\tknock\r\n0.1\t0.1\tanother\r\n")
        self.succeeds("encode", "a.wav", "--markers", "labels.txt", "-o", "marked.json")
        self.put("unix.txt", "0.05\t0.05\tknock\n0.1\t0.1\tanother\n")
        self.succeeds("encode", "a.wav", "--markers", "unix.txt", "-o", "unix.json")
        self.assertEqual(self.read("marked.json")["markers"], self.read("unix.json")["markers"])

    def test_what_the_command_prints_has_the_lines_of_all_systems(self):
        self.clip()
        self.assertNotIn("\r", self.succeeds("info", "clip.json"))
        done = self.run_command("convert", "clip.json", "-o", "-", "--format", "packed", "-q")
        self.succeeds("convert", "clip.json", "clip.pacb")
        self.assertEqual(done.stdout, (self.folder / "clip.pacb").read_bytes())
        piped = self.run_command("info", "-", "--json", stdin=open(self.folder / "clip.pacb", "rb"))
        self.assertTrue(json.loads(piped.stdout)["ok"], piped.stderr)

    def test_a_file_that_another_program_keeps_is_told_and_kept(self):
        self.sound()
        self.put("a.json", "{}")
        for held, words in (("a.wav", ["encode", "a.wav", "-o", "b.json"]), ("a.json", ["encode", "a.wav", "-y"])):
            holder = subprocess.Popen([wine.WINE, Path(self.tools.name) / "hold.exe", held], cwd=self.folder,
                                      stdin=subprocess.PIPE, stdout=subprocess.PIPE)
            try:
                self.assertEqual(holder.stdout.readline().strip(), b"held")
                self.fails(1, words, held, "close it in other programs")
            finally:
                holder.communicate(timeout=60)
        self.assertEqual((self.folder / "a.json").read_text(), "{}")
        self.succeeds("encode", "a.wav", "-y")
        self.assertIn("pacini.clip", (self.folder / "a.json").read_text())

    def test_a_file_that_is_there_is_replaced_on_request_only(self):
        self.sound()
        self.put("a.json", "mine")
        self.fails(1, ["encode", "a.wav"], "a.json")
        self.assertEqual((self.folder / "a.json").read_text(), "mine")
        self.succeeds("encode", "a.wav", "-y")
        self.assertIn("pacini.clip", (self.folder / "a.json").read_text())
        os.chmod(self.folder / "a.json", 0o444)
        self.put("b.wav", wav(sine(200, 0.2)))
        self.fails(1, ["encode", "b.wav", "-o", "a.json"], "a.json: is marked read-only")

    def test_two_programs_that_write_one_file_leave_one_of_both_whole(self):
        self.sound()
        done = []
        threads = [threading.Thread(target=lambda: done.append(self.run_command("encode", "a.wav", "-y", "--force")))
                   for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(any(one.returncode == 0 for one in done), [one.stderr for one in done])
        self.assertIn("pacini.clip", (self.folder / "a.json").read_text())
        self.assertEqual(self.names(), ["a.json", "a.wav"])

    def interrupted(self, how):
        """Renders for long in a console; how it ended."""
        line = f'"{wine.as_windows(wine.BIN / "pacini.exe")}" render clip.json -o out.wav'
        process = subprocess.Popen([wine.WINE, Path(self.tools.name) / "interrupt.exe", line], cwd=self.folder,
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        until = time.monotonic() + 60
        while not any(path.stat().st_size for path in self.folder.glob(".*.pacini-*")):
            self.assertLess(time.monotonic(), until, "nothing is being written")
            self.assertIsNone(process.poll(), "ended too early")
            time.sleep(0.005)
        process.communicate(how + b"\n", timeout=120)
        return process.returncode

    def test_neither_ctrl_c_nor_a_sudden_end_leaves_a_file_or_takes_the_old_one(self):
        self.clip(seconds=3600)
        self.put("out.wav", "old")
        for how in (b"ctrl+c", b"end"):
            self.assertNotIn(self.interrupted(how), (253, 254, 255), how)
            self.assertEqual(self.names(), ["clip.json", "out.wav"], how)
            self.assertEqual((self.folder / "out.wav").read_text(), "old")

    def test_nul_takes_what_nobody_wants(self):
        self.sound()
        self.clip()
        self.succeeds("convert", "clip.json", "-o", "NUL", "--format", "packed")
        self.fails(1, ["info", "NUL"], "NUL")
        self.assertEqual(self.names(), ["a.wav", "clip.json"])

    def test_benchmarks_are_started_with_their_words(self):
        self.sound("two words/a.wav")
        done = self.run_command("bench", "methods", "two words", "--repeat", "1", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["benches"][0]["sounds"], 1)

    def test_pictures_without_cairo_are_svg(self):
        self.clip()
        self.succeeds("plot", "clip.json", "-o", "clip.svg")
        self.assertIn(b"<svg", (self.folder / "clip.svg").read_bytes())
        self.fails(1, ["plot", "clip.json", "-o", "clip.png"], "draw an .svg")


if __name__ == "__main__":
    unittest.main()
