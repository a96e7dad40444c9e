"""pacini.lua in LÖVE, without a window."""
import math
import re
import shutil
import subprocess
import time
import unittest

from bindings import BINDINGS, HERE, KNOCK, LIBRARY, OUTSIDE, BindingTest, declarations, floats, one_line

LUA = BINDINGS / "lua"
RATE = 48000


class Lua(BindingTest):
    def game(self, main, conf=LUA / "example/conf.lua"):
        game = self.folder / "game"
        game.mkdir()
        for source in (main, conf, LUA / "pacini.lua", KNOCK):
            shutil.copy(source, game)
        return game

    def test_plays_what_the_c_program_plays_and_reports_errors(self):
        self.needs("love")
        self.run_program("love", self.game(HERE / "lua/main.lua"))
        self.assert_same_samples((self.folder / "played.raw").read_bytes(), self.expected())

    def test_the_library_is_found_beside_the_game(self):
        self.needs("love")
        game = self.game(HERE / "lua/main.lua")
        shutil.copy(LIBRARY, game / "libpacini.so")
        self.run_program("love", game, LD_LIBRARY_PATH="")

    def heard(self, seconds):
        """What the example plays, as OpenAL Soft writes it into a file in the place of a sound device."""
        file = self.folder / "heard.wav"
        settings = self.folder / "alsoft.conf"
        settings.write_text("[general]\ndrivers = wave\nfrequency = 48000\nchannels = mono\nsample-type = float32\n"
                            f"output-limiter = false\ndither = false\n[wave]\nfile = {file}\n")
        with subprocess.Popen(["love", self.folder / "game"], stderr=subprocess.PIPE, env={
                **OUTSIDE, "HOME": str(self.folder), "ALSOFT_CONF": str(settings),
                "LD_LIBRARY_PATH": str(LIBRARY.parent)}) as game:
            end = time.monotonic() + 30
            while time.monotonic() < end and game.poll() is None and not (
                    file.exists() and file.stat().st_size > seconds * 4 * RATE):
                time.sleep(0.05)
            game.terminate()
            says = game.communicate(timeout=10)[1]
        self.assertTrue(file.exists(), says)
        data = file.read_bytes()
        return floats(data[data.index(b"data") + 8:])

    def test_the_first_vibration_reaches_the_sound_device(self):
        self.needs("love")
        self.game(LUA / "example/main.lua")
        expected = floats(self.expected())
        loudest = max(range(len(expected)), key=lambda i: abs(expected[i]))
        likeness = []
        for _ in range(5):  # it plays in real time, which a busy machine may not keep
            played = self.heard(1.0)
            # It may begin late, and is as loud as OpenAL wants.
            at = max(range(len(played)), key=lambda i: abs(played[i])) - loudest
            a, b = played[max(0, at):][:24000], expected[:24000]
            energies = math.fsum(x * x for x in a) * math.fsum(y * y for y in b)
            likeness.append(math.fsum(x * y for x, y in zip(a, b)) / math.sqrt(energies or 1.0))
            if len(a) == len(b) and likeness[-1] > 0.9999:
                return
        self.fail(f"what is heard is like what the C program plays by {likeness}")

    def test_declarations_are_those_of_the_header(self):
        text = (LUA / "pacini.lua").read_text()
        [bound] = re.findall(r"ffi\.cdef \[\[(.*?)\]\]", text, re.S)
        header = declarations()
        found = 0
        for one in re.findall(r"(?:typedef struct|typedef enum|enum) .*?} ?\w* ;|[^;]+;", one_line(bound)):
            # Newer headers have more constants.
            constants = re.findall(r"PACINI_\w+ = \d+", one) if " enum " in f" {one}" else []
            for declared in constants or [one.strip()]:
                self.assertRegex(header, re.escape(declared) + r"(?!\w)")
            found += 1
        self.assertGreater(found, 35)


if __name__ == "__main__":
    unittest.main()
