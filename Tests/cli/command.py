"""What the end-to-end tests of the command share: running it, checking how it fails, and making sounds.

The build tells through the environment where the command is (PACINI_COMMAND), where the sources are
(PACINI_SOURCE_DIR) and which sanitizers are on (PACINI_SANITIZE, may be empty).
"""
import json
import math
import os
import random
import resource
import shutil
import struct
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

COMMAND = os.environ["PACINI_COMMAND"]
SOURCE = Path(os.environ["PACINI_SOURCE_DIR"])
SANITIZED = bool(os.environ.get("PACINI_SANITIZE"))
if SANITIZED:
    # As in support/LeakSuppressions.cpp: what libsndfile forgets when a file is damaged is not ours.
    os.environ.setdefault("LSAN_OPTIONS", f"suppressions={Path(__file__).parent / 'leaks.supp'}:print_suppressions=0")
LONGEST = 300  # s; a hang fails the test
LARGEST = 400_000_000  # bytes of a file that the command writes; a runaway must not fill the disk


def sine(frequency, seconds, rate=48000, level=0.5):
    return [level * math.sin(2 * math.pi * frequency * i / rate) for i in range(round(seconds * rate))]


def noise(count, seed=1, level=0.5):
    source = random.Random(seed)
    return [source.uniform(-level, level) for _ in range(count)]


def wav_header(data_bytes, rate=48000, channels=1, bits=16, floats=False):
    frame = channels * bits // 8
    return (b"RIFF" + struct.pack("<I", min(36 + data_bytes, 0xFFFFFFFF)) + b"WAVEfmt "
            + struct.pack("<IHHIIHH", 16, 3 if floats else 1, channels & 0xFFFF, rate & 0xFFFFFFFF,
                          rate * frame & 0xFFFFFFFF, frame & 0xFFFF, bits)
            + b"data" + struct.pack("<I", data_bytes & 0xFFFFFFFF))


def wav(samples, rate=48000, channels=1):
    """A 16-bit WAV of interleaved samples within +-1, as bytes."""
    data = struct.pack(f"<{len(samples)}h", *(max(-32768, min(32767, round(32768 * x))) for x in samples))
    return wav_header(len(data), rate, channels) + data


def float_wav(samples, rate=48000, channels=1):
    """A 32-bit float WAV of interleaved samples, as bytes."""
    data = struct.pack(f"<{len(samples)}f", *samples)
    return wav_header(len(data), rate, channels, 32, True) + data


def read_float_wav(path):
    """(rate, samples) of a mono float WAV; finds its chunks by itself."""
    content = Path(path).read_bytes()
    assert content[:4] == b"RIFF" and content[8:12] == b"WAVE", content[:12]
    offset, rate = 12, None
    while offset + 8 <= len(content):
        size = struct.unpack_from("<I", content, offset + 4)[0]
        if content[offset:offset + 4] == b"fmt ":
            kind, channels, rate, _, _, bits = struct.unpack_from("<HHIIHH", content, offset + 8)
            if kind == 0xFFFE:  # the extended form, whose kind comes later
                kind = struct.unpack_from("<H", content, offset + 32)[0]
            assert (kind, channels, bits) == (3, 1, 32), (kind, channels, bits)
        if content[offset:offset + 4] == b"data":
            return rate, struct.unpack_from(f"<{size // 4}f", content, offset + 8)
        offset += 8 + size + size % 2
    raise AssertionError("no data chunk")


def rms(samples):
    return math.sqrt(sum(x * x for x in samples) / len(samples)) if samples else 0.0


class CommandTest(unittest.TestCase):
    """A test with a folder of its own, in which the command runs."""

    maxDiff = None

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="pacini-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def put(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    def run_command(self, *arguments, file_limit=LARGEST, **options):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (file_limit, file_limit))

        options = {"preexec_fn": limit, **options}
        options = {"cwd": self.folder, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE,
                   "stdin": subprocess.DEVNULL, "timeout": LONGEST, **options}
        return subprocess.run([COMMAND, *arguments], **options)

    def started(self, *arguments, until, **options):
        """Runs the command in the background; returns the process once `until` holds, before which it may not end."""
        process = subprocess.Popen([COMMAND, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, **options)
        end = time.monotonic() + 60
        while not until():
            self.assertLess(time.monotonic(), end, "nothing is being written")
            self.assertIsNone(process.poll(), "ended too early")
            time.sleep(0.002)
        return process

    def writes(self, beginning=""):
        """Whether a temporary with this beginning is in the folder."""
        return any(name.startswith(beginning) and ".pacini-" in name for name in os.listdir(self.folder))

    def names(self):
        """All files below the folder, as text; none may be a temporary."""
        found = sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*") if not path.is_dir())
        self.assertEqual([name for name in found if ".pacini-" in name], [], "temporaries were left behind")
        return found

    def succeeds(self, *arguments, **options):
        """Runs; exit 0 and nothing on stderr. Returns stdout."""
        done = self.run_command(*arguments, **options)
        self.assertEqual((done.returncode, done.stderr.decode(errors="replace")), (0, ""), arguments)
        return (done.stdout or b"").decode(errors="replace")

    def report(self, *arguments, **options):
        """Runs with --json; exit 0 and one object on stdout, which is returned."""
        return json.loads(self.succeeds(*arguments, "--json", **options))

    def fails(self, code, arguments, *says, lines=1, **options):
        """Runs; that exit code, so many messages, each on one line after 'pacini: ', which together say all of
        `says`; no temporaries. Returns the process."""
        done = self.run_command(*arguments, **options)
        text = done.stderr.decode(errors="replace")
        self.assertEqual(done.returncode, code, text)
        self.assertEqual(text.count("\n"), lines, text)
        for line in text.splitlines():
            self.assertTrue(line.startswith("pacini: "), text)
        for part in says:
            self.assertIn(part, text)
        self.names()
        return done

    def warns(self, *arguments, says, **options):
        """Runs; exit 0 and one line on stderr that says so. Returns stdout."""
        return (self.fails(0, arguments, "warning: ", says, **options).stdout or b"").decode(errors="replace")

    def clip(self, file="clip.json", seconds=1.0, **changes):
        """Writes a small valid clip: one band at 100 Hz that fades in and out, one event. Returns its content."""
        content = {
            "format": "pacini.clip", "version": 1, "name": "made", "duration": seconds,
            "envelope": [{"time": 0, "amplitude": 0}, {"time": seconds / 2, "amplitude": 0.5},
                         {"time": seconds, "amplitude": 0}],
            "centroid": [],
            "bands": [{"lowFrequency": 80, "centreFrequency": 100, "highFrequency": 125, "priority": 0,
                       "amplitude": [{"time": 0, "amplitude": 0}, {"time": seconds / 2, "amplitude": 0.5},
                                     {"time": seconds, "amplitude": 0}],
                       "pitch": []}],
            "transients": [{"time": seconds / 4, "amplitude": 0.8, "sharpness": 0.5}],
        }
        content.update(changes)
        self.put(file, json.dumps(content))
        return content
