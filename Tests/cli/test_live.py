"""End to end: sounds that pacini live takes from pipes and files, and the drive that it writes. What controllers get is
tried in hid/check_live.py."""
import json
import os
import pty
import signal
import struct
import subprocess
import time
import unittest

from command import COMMAND, SANITIZED, CommandTest, float_wav, noise, read_float_wav, rms, sine, wav, wav_header

ENDLESS = 0xFFFFFFFF


def endless(content):
    """A WAV as programs write it that do not know its length."""
    at = content.index(b"data") + 4
    return content[:4] + struct.pack("<I", ENDLESS) + content[8:at] + struct.pack("<I", ENDLESS) + content[at + 4:]


def drive_of(stream):
    """The samples of a float WAV on standard output."""
    return stream[stream.index(b"data") + 8:]


class Live(CommandTest):
    def setUp(self):
        super().setUp()
        self.samples = [x + y for x, y in zip(sine(70, 1.0, level=0.4), noise(48000, level=0.1))]
        self.sound = float_wav(self.samples)
        self.put("a.wav", self.sound)

    def piped(self, content, *arguments):
        done = self.run_command("live", "-", *arguments, "-o", "-", input=content, stdin=None)
        self.assertEqual((done.returncode, done.stderr), (0, b""), arguments)
        return drive_of(done.stdout)

    def test_a_file_a_pipe_and_raw_samples_give_the_same_drive(self):
        self.succeeds("live", "a.wav", "-o", "a.haptic.wav")
        rate, drive = read_float_wav(self.folder / "a.haptic.wav")
        self.assertEqual((rate, len(drive)), (48000, 48000))
        expected = struct.pack(f"<{len(drive)}f", *drive)
        self.assertGreater(rms(drive), 0.05)
        self.assertEqual(self.piped(self.sound), expected)
        self.assertEqual(self.piped(endless(self.sound)), expected)
        self.assertEqual(self.piped(self.sound[44:], "--raw", "f32", "--channels", "1"), expected)

    def test_chunks_around_the_samples_are_no_sound(self):
        content = wav(sine(70, 0.5))
        listed = b"LIST" + struct.pack("<I", 6) + b"INFOab"
        around = content[:36] + listed + content[36:] + listed
        self.assertEqual(self.piped(around), self.piped(content))

    def test_every_width_of_samples_is_read(self):
        values = [round(2 ** 23 * x) for x in sine(70, 0.3)]
        wide = b"".join(struct.pack("<i", 256 * v) for v in values)
        narrow = b"".join(struct.pack("<i", v)[:3] for v in values)
        floats = struct.pack(f"<{len(values)}f", *(v / 2 ** 23 for v in values))
        expected = self.piped(floats, "--raw", "f32", "--channels", "1")
        self.assertEqual(self.piped(wide, "--raw", "s32", "--channels", "1"), expected)
        self.assertEqual(self.piped(narrow, "--raw", "s24", "--channels", "1"), expected)
        self.assertEqual(self.piped(wav_header(len(narrow), bits=24) + narrow), expected)

    def test_channels_are_mixed(self):
        one = self.piped(float_wav(self.samples))
        two = self.piped(float_wav([x for sample in self.samples for x in (sample, sample)], channels=2))
        self.assertEqual(one, two)

    def warned(self, content, *arguments):
        done = self.run_command("live", "-", *arguments, "-o", "-", input=content, stdin=None)
        self.assertEqual(done.returncode, 0, done.stderr)
        return len(drive_of(done.stdout)) // 4, done.stderr.decode()

    def test_a_pipe_says_what_is_missing_or_no_number(self):
        frames, told = self.warned(self.sound[:-4 * 24000])
        self.assertEqual(frames, 24000)
        self.assertEqual(told, "pacini: -: warning: ends after 0.50 s of the 1.00 s that its header states\n")
        odd = [float("nan"), float("inf"), 1e30]
        samples = [odd[i // 7 % 3] if i % 7 == 0 else x for i, x in enumerate(self.samples)]
        raw = struct.pack(f"<{len(samples)}f", *samples)
        frames, told = self.warned(raw + b"abc", "--raw", "f32", "--channels", "1")
        self.assertEqual(frames, 48000)
        self.assertEqual(told, "pacini: -: warning: 6858 samples were not a number, infinite or beyond 1e+12 and played as 0\n"
                         "pacini: -: warning: ends within a frame, 3 bytes after the last whole one; check its format\n")
        zeros = struct.pack(f"<{len(samples)}f", *(x if i % 7 else 0.0 for i, x in enumerate(self.samples)))
        self.assertEqual(self.piped(zeros, "--raw", "f32", "--channels", "1"),
                         drive_of(self.run_command("live", "-", "--raw", "f32", "--channels", "1", "-o", "-", input=raw,
                                                   stdin=None).stdout))

    def test_a_recording_that_may_be_long_is_a_wav_in_the_end(self):
        self.succeeds("live", "a.wav", "-o", "a.haptic.wav")
        self.assertEqual((self.folder / "a.haptic.wav").read_bytes()[:4], b"RIFF")

    def test_the_drive_comes_while_the_sound_does(self):
        process = subprocess.Popen([COMMAND, "live", "-", "-o", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        process.stdin.write(endless(self.sound))
        process.stdin.flush()
        got = b""
        while len(got) < 44 + 4 * 47000:
            got += os.read(process.stdout.fileno(), 65536)
        self.assertIsNone(process.poll())
        process.stdin.close()
        process.stdout.read()
        process.stdout.close()
        self.assertEqual(process.wait(10), 0)

    def test_a_terminal_shows_levels_and_is_left_clean(self):
        try:
            master, slave = pty.openpty()
        except OSError as error:
            self.skipTest(f"no terminal can be made here: {error}")
        process = subprocess.Popen([COMMAND, "live", "-", "-o", "b.wav"], stdin=subprocess.PIPE, stderr=slave,
                                   stdout=subprocess.DEVNULL, cwd=self.folder, env={**os.environ, "TERM": "xterm"})
        os.close(slave)
        process.stdin.write(endless(self.sound))
        process.stdin.flush()
        time.sleep(0.3)
        shown = os.read(master, 65536).decode()
        process.stdin.close()
        try:
            while part := os.read(master, 65536):
                shown += part.decode()
        except OSError:
            pass  # the other end is closed
        os.close(master)
        self.assertEqual(process.wait(10), 0)
        self.assertRegex(shown, r"sound \[#+-+\] +-\d+ dB  touch \[#+-+\] +-\d+ dB  1\.00 s")
        self.assertTrue(shown.endswith("\r\x1b[K"), shown)

    def test_ctrl_c_ends_it_and_keeps_what_was_written(self):
        process = subprocess.Popen([COMMAND, "live", "-", "-o", "b.wav"], stdin=subprocess.PIPE, cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        process.stdin.write(endless(self.sound))
        process.stdin.flush()
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(10), -signal.SIGINT)
        self.assertEqual(process.stderr.read(), b"")
        process.stderr.close()
        process.stdin.close()
        self.assertEqual(len(read_float_wav(self.folder / "b.wav")[1]), 48000)

    def test_presets_and_parameters_are_those_of_the_translator(self):
        plain = self.piped(self.sound)
        self.assertEqual(self.piped(self.sound, "--preset", "neutral"), plain)
        self.assertNotEqual(self.piped(self.sound, "--preset", "music"), plain)
        self.assertEqual(self.piped(self.sound, "--audible", "1"), plain)
        whole = struct.unpack(f"<{len(plain) // 4}f", plain)
        muted = self.piped(self.sound, "--rumble-muted", "--texture-muted", "--transients-muted", "--audible", "0",
                           "--brightness", "-60")
        self.assertLess(rms(struct.unpack(f"<{len(muted) // 4}f", muted)), 0.01 * rms(whole))
        self.assertNotEqual(self.piped(self.sound, "--profile", "l5-wristband"), plain)

    def test_the_live_part_of_a_settings_file_is_what_it_begins_with(self):
        mine = self.folder / "mine.json"
        mine.write_text(json.dumps({"format": "pacini.settings", "version": 1,
                                    "live": {"rumble": -6, "audible": 0.25, "textureMuted": True}}))
        options = ("--rumble", "-6", "--audible", "0.25", "--texture-muted")
        self.assertEqual(self.piped(self.sound, "--settings", str(mine)), self.piped(self.sound, *options))
        self.assertEqual(self.piped(self.sound, "--settings", str(mine), "--audible", "1"),
                         self.piped(self.sound, *options[:2], "--audible", "1", options[-1]))
        mine.write_text(json.dumps({"format": "pacini.settings", "version": 1, "encode": {}}))
        self.fails(1, ["live", "a.wav", "-o", "b.wav", "--settings", "mine.json"], "mine.json: live: is missing")
        mine.write_text(json.dumps({"format": "pacini.settings", "version": 1, "live": {"audible": 7}}))
        self.fails(1, ["live", "a.wav", "-o", "b.wav", "--settings", "mine.json"], "mine.json: live.audible")
        self.fails(2, ["live", "a.wav", "-o", "b.wav", "--settings", "mine.json", "--preset", "music"], "--preset")

    def test_settings_that_are_printed_are_read_again(self):
        options = ("--preset", "music", "--rumble", "-6", "--texture-muted")
        done = self.run_command("live", *options, "--print-settings")
        self.assertEqual(done.returncode, 0, done.stderr)
        mine = self.folder / "mine.json"
        mine.write_bytes(done.stdout)
        self.assertEqual(self.piped(self.sound, "--settings", str(mine)), self.piped(self.sound, *options))
        again = self.run_command("live", "--settings", str(mine), "--attack", "20", "--print-settings")
        self.assertEqual(json.loads(again.stdout), json.loads(done.stdout) | {"live": json.loads(done.stdout)["live"]
                                                                               | {"attack": 20}})
        self.assertEqual(self.report("live", "--settings", str(mine), "--print-settings")["settings"],
                         json.loads(done.stdout))
        self.fails(1, ["live", "--settings", "none.json", "--print-settings"], "none.json")

    def test_a_duration_ends_it(self):
        report = self.report("live", "a.wav", "-o", "b.wav", "--duration", "0.25")
        self.assertEqual((report["seconds"], report["outputs"]), (0.25, [{"output": "b.wav", "frames": 12000}]))

    def test_its_delay_is_that_of_the_translator(self):
        report = self.report("live", "a.wav", "-o", "b.wav")
        self.assertLess(report["translatorMilliseconds"], 1.4)

    def test_an_hour_takes_no_more_memory_than_a_minute(self):
        # A sanitizer keeps what was freed, up to a limit.
        kept = {"ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":quarantine_size_mb=1:thread_local_quarantine_size_kb=64"}

        def peak(seconds):
            process = subprocess.Popen([COMMAND, "live", "-", "--raw", "s16", "--rate", "8000", "--channels", "1",
                                        "-o", "-"], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                       env={**os.environ, **kept})
            for _ in range(seconds):
                process.stdin.write(bytes(16000))
            process.stdin.close()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = status
            self.assertEqual(status, 0)
            return usage.ru_maxrss  # kB

        self.assertLess(peak(3600), peak(60) + (4000 if SANITIZED else 500))

    def test_the_input_is_not_written_over(self):
        self.fails(2, ["live", "a.wav", "-o", "a.wav"], "a.wav: is the sound itself")
        self.assertEqual((self.folder / "a.wav").read_bytes(), self.sound)

    def test_wrong_usage_is_told(self):
        self.fails(2, ["live"], "the sound is missing")
        self.fails(2, ["live", "a.wav", "-o", "b.wav", "--preset", "musik"], "did you mean music")
        self.fails(2, ["live", "a.wav", "-o", "b.wav", "--rate", "8000"], "--raw")
        self.fails(2, ["live", "a.wav", "-o", "b.wav", "--measure-latency"], "--device")
        self.fails(1, ["live", "none.wav", "-o", "b.wav"], "none.wav")
        self.fails(1, ["live", "a.wav", "--device", "no such thing"], "controller is connected")

    def test_what_is_no_sound_is_told(self):
        for content, what in ((b"", "is empty"), (b"hello, this is text", "is not a WAV"), (self.sound[:30], "ends within"),
                              (wav_header(4, channels=0) + bytes(4), "0 channels"),
                              (wav_header(4, rate=10) + bytes(4), "10 Hz"),
                              (wav_header(4, bits=8) + bytes(4), "8 bits"),
                              (self.sound[:12] + b"data" + bytes(4), "fmt")):
            self.fails(1, ["live", "-", "-o", "b.wav"], "pacini: -: ", what, input=content, stdin=None)


if __name__ == "__main__":
    unittest.main()
