"""The examples in C with SDL2: a sound device that is a file, and a controller that does not exist."""
import array
import math
import shutil
import struct
import subprocess
import unittest
import wave

from bindings import BINDINGS, HEADER, HERE, KNOCK, LIBRARY, BindingTest, floats

EXAMPLES = BINDINGS / "c-sdl2"
RATE = 48000


class Sdl(BindingTest):
    def setUp(self):
        super().setUp()
        if not shutil.which("sdl2-config"):
            self.skipTest("libsdl2-dev is missing - cmake/bootstrap.sh installs it for the tests")
        self.flags = subprocess.run(["sdl2-config", "--cflags", "--libs"], check=True, capture_output=True,
                                    text=True).stdout.split()

    @staticmethod
    def silence(count):
        return array.array("f", bytes(4 * count))

    def compile(self, out, *sources):
        """Without any warning."""
        self.run_program("cc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wshadow", "-Wconversion",
                         "-Wdouble-promotion", "-Werror", "-O1", "-I", HEADER.parent, "-I", EXAMPLES, *sources,
                         "-o", out, *self.flags, f"-L{LIBRARY.parent}", "-lpacini", "-lm")

    def test_sound_and_touch_are_on_channels_of_one_device(self):
        self.compile("sound_and_touch", EXAMPLES / "sound_and_touch.c")
        sound = [round(8000 * math.sin(0.01 * i)) for i in range(2 * 24000)]
        with wave.open(str(self.folder / "sound.wav"), "wb") as file:
            file.setnchannels(2)
            file.setsampwidth(2)
            file.setframerate(RATE)
            file.writeframes(struct.pack(f"<{len(sound)}h", *sound))
        self.run_program("./sound_and_touch", KNOCK, "sound.wav", SDL_AUDIODRIVER="disk",
                         SDL_DISKAUDIOFILE=str(self.folder / "heard.raw"))
        heard = floats((self.folder / "heard.raw").read_bytes())
        while heard[:4 * 512] == self.silence(4 * 512):  # before it was told to begin
            del heard[:4 * 512]
        frames = len(heard) // 4
        self.assertGreater(frames, 24000)
        touch = self.rendered(KNOCK, frames, 2, RATE)
        self.assertGreater(max(map(abs, touch)), 0.1)
        self.assert_same_samples(heard[2::4].tobytes(), touch[0::2].tobytes())
        self.assert_same_samples(heard[3::4].tobytes(), touch[1::2].tobytes())
        for channel in (0, 1):
            played = heard[channel::4]
            self.assertLess(max(abs(a - b / 32768) for a, b in zip(played, sound[channel::2])), 1e-4)
            self.assertEqual(max(map(abs, played[24000:])), 0.0)

    def test_the_lines_of_the_page_compile_them_and_what_is_wrong_is_told(self):
        for source in EXAMPLES.iterdir():
            shutil.copy(source, self.folder)
        self.run_lines_of_page("sdl.md")
        self.run_program("./sound_and_touch", code=1)  # usage
        self.run_program("./sound_and_touch", "none.pacb", code=1, SDL_AUDIODRIVER="dummy")
        self.run_program("./sound_and_touch", KNOCK, "none.wav", code=1, SDL_AUDIODRIVER="dummy")
        self.run_program("./rumble_controller", KNOCK, code=1)  # no controller

    def test_a_controller_gets_the_levels_of_the_drive_signal(self):
        self.compile("virtual_pad", HERE / "sdl/virtual_pad.c", EXAMPLES / "rumble.c")
        self.compile("rumble_controller.o", "-c", EXAMPLES / "rumble_controller.c")
        lines = [line.split() for line in self.run_program("./virtual_pad", KNOCK).decode().splitlines()]
        asked = [(int(heavy), int(light)) for kind, heavy, light in lines if kind == "update"]
        self.assertEqual(len(asked), 100)
        # The levels of 10 ms each, below and above 100 Hz.
        drive, low = self.rendered(KNOCK, 4000, 1, 4000.0), 0.0
        step = 1 - math.exp(-2 * math.pi * 100 / 4000)
        heavy, light = [0.0] * 100, [0.0] * 100
        for i, x in enumerate(drive):
            low += step * (x - low)
            heavy[i // 40] = max(heavy[i // 40], abs(low))
            light[i // 40] = max(light[i // 40], abs(x - low))
        self.assertGreater(max(heavy + light), 0.2)
        off = [max(abs(a - 65535 * min(1, h)), abs(b - 65535 * min(1, l)))
               for (a, b), h, l in zip(asked, heavy, light)]
        self.assertLess(max(off), 2)
        self.assertEqual(asked[-1], (0, 0))
        self.assertGreater(max(map(int, lines[-2][1:])), 3000)  # it plays again, and stops when it is closed
        self.assertEqual(lines[-1], ["closed", "0", "0"])


if __name__ == "__main__":
    unittest.main()
