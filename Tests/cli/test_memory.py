"""End to end: memory must not grow with the length of a sound, but only, slowly, with what the clip keeps of it."""
import math
import os
import struct
import subprocess
import sys
import unittest

from command import COMMAND, CommandTest, wav_header


def peak_of(arguments, folder):
    """The largest resident size of the command in bytes."""
    process = subprocess.Popen([COMMAND, *arguments], cwd=folder, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0, arguments
    return usage.ru_maxrss * (1 if sys.platform == "darwin" else 1024)


class Memory(CommandTest):
    def peak(self, *arguments):
        return peak_of(arguments, self.folder)

    def test_a_sound_five_times_as_long_needs_hardly_more(self):
        peaks = {}
        for minutes in (1, 5):
            name = f"{minutes}.wav"
            second = os.urandom(48000 * 4)  # noise in stereo: all bands have much to keep
            with open(self.folder / name, "wb") as file:
                file.write(wav_header(minutes * 60 * len(second), channels=2))
                for _ in range(minutes * 60):
                    file.write(second)
            peaks[minutes] = [self.peak("encode", name, "-o", f"{minutes}.pacb"),
                              self.peak("info", f"{minutes}.wav"),
                              self.peak("info", f"{minutes}.pacb"),
                              self.peak("render", f"{minutes}.pacb", "-o", "out.wav")]
        for work, short, long in zip(("encode", "info sound", "info clip", "render"), peaks[1], peaks[5]):
            # An hour must stay below 300 MB: at most 4 MB for each of its minutes.
            self.assertLess(long - short, 4 * 4_000_000, work)
            self.assertLess(long, 100_000_000, work)

    def test_encoding_keeps_nothing_of_what_it_has_found_but_the_clip(self):
        # An hour of noise, which spends every breakpoint, is a clip of 14 MB. With all that was found of the bands it was
        # 39 to 45 MB, with what is heard too 60 MB.
        for audible in ("0", "1"):
            with self.subTest(audible=audible):
                self.check_an_hour(24_000_000, "--audible", audible)

    def test_where_there_is_no_more_to_say_memory_does_not_grow(self):
        # A clip of a tone is a few points, however long it is: what is left is what encoding itself needs.
        wave = struct.pack("<8000h", *(round(3000 * math.sin(2 * math.pi * 2500 * i / 8000)) for i in range(8000)))
        peaks = []
        for minutes in (30, 150):
            with open(self.folder / "tone.wav", "wb") as file:
                file.write(wav_header(minutes * 60 * len(wave), rate=8000))
                for _ in range(minutes * 60):
                    file.write(wave)
            peaks.append(self.peak("encode", "tone.wav", "-o", f"{minutes}.pacb"))
        self.assertLess(peaks[1] - peaks[0], 3_000_000)

    def check_an_hour(self, most, *options):
        peaks = {"json": [], "packed": []}
        for minutes in (30, 90):
            second = os.urandom(8000 * 2)
            with open(self.folder / "noise.wav", "wb") as file:
                file.write(wav_header(minutes * 60 * len(second), rate=8000))
                for _ in range(minutes * 60):
                    file.write(second)
            for form, found in peaks.items():
                found.append(self.peak("encode", "noise.wav", "--format", form, "-o", f"{minutes}.{form}", *options))
        for form, (short, long) in peaks.items():
            self.assertLess(long - short, most, form)


if __name__ == "__main__":
    unittest.main()
