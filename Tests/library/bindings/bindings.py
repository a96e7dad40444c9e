"""What the tests of the bindings share: where things are, what must be there, and what the C program plays."""
import array
import ctypes
import json
import os
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
BINDINGS = ROOT / "Source/library/bindings"
HERE = Path(__file__).resolve().parent
HEADER = ROOT / "Source/library/include/pacini.h"
KNOCK = HERE.parent / "knock.json"
PACINI = Path(os.environ["PACINI_COMMAND"])
LIBRARY = Path(os.environ["PACINI_LIBRARY"])
FIRST_VIBRATION = Path(os.environ["PACINI_FIRST_VIBRATION"])
# The environment that people have.
OUTSIDE = {name: value for name, value in os.environ.items() if not name.startswith("PACINI_")}


def floats(data):
    return array.array("f", data[:len(data) // 4 * 4])


def declarations():
    """What pacini.h declares, without comments, on one line."""
    text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(), flags=re.S)
    text = re.sub(r"(?m)^\s*(#|//).*$", "", text)
    return one_line(text.replace("PACINI_API ", ""))


def one_line(text):
    """C on one line, laid out in one way."""
    return " ".join(re.sub(r"([(){},;*])", r" \1 ", text).split())


def structs():
    """Name to [(type, field, length)] of each struct of pacini.h."""
    found = {}
    for name, body in re.findall(r"typedef struct (\w+) { (.*?) } \1 ;", declarations()):
        fields = []
        for field in filter(None, (part.strip() for part in body.split(";"))):
            kind, names = re.match(r"((?:const )?\w+(?: \*)?) (.*)", field).groups()
            for one in names.split(","):
                one, _, length = one.strip().partition("[")
                fields.append((kind, one, length.rstrip("]")))
        found[name] = fields
    return found


def layout():
    """Lines 'struct size' and 'struct.field offset', as the C compiler has them."""
    lines = []
    for name, fields in structs().items():
        lines.append(f'printf("{name} %d\\n", (int)sizeof({name}));')
        lines += [f'printf("{name}.{field} %d\\n", (int)offsetof({name}, {field}));' for _, field, _ in fields]
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "layout.c"
        source.write_text("#include <pacini.h>\n#include <stdio.h>\nint main(void)\n{\n" + "\n".join(lines) +
                          "\nreturn 0;\n}\n")
        subprocess.run(["cc", "-I", HEADER.parent, source, "-o", Path(folder) / "layout"], check=True)
        return subprocess.run([Path(folder) / "layout"], check=True, capture_output=True, text=True).stdout.splitlines()


class BindingTest(unittest.TestCase):
    """Each test has a folder of its own, in which the library is."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def needs(self, *programs):
        for program in programs:
            if not shutil.which(program):
                self.skipTest(f"{program} is missing - cmake/bootstrap.sh installs it for the tests")

    def run_program(self, *command, code=0, timeout=120, **environment):
        """Standard output of a program that finds the library."""
        try:
            done = subprocess.run([str(word) for word in command], cwd=self.folder, stdin=subprocess.DEVNULL,
                                  capture_output=True, timeout=timeout,
                                  env={**OUTSIDE, "HOME": str(self.folder), "LD_LIBRARY_PATH": str(LIBRARY.parent),
                                       **environment})
        except subprocess.TimeoutExpired as late:
            self.fail(f"{late}: {(late.stdout or b'')[-2000:]} {(late.stderr or b'')[-2000:]}")
        self.assertEqual(done.returncode, code, (done.stdout[-2000:] + done.stderr[-4000:]).decode(errors="replace"))
        return done.stdout

    def run_lines_of_page(self, page):
        """The lines of a page that call the C compiler, where pacini.h and libpacini are installed."""
        lines = re.findall(r"(?m)^ +(cc .*)$", (ROOT / "Resources/docs" / page).read_text())
        self.assertTrue(lines, page)
        for line in lines:
            self.run_program("sh", "-c", line, C_INCLUDE_PATH=str(HEADER.parent), LIBRARY_PATH=str(LIBRARY.parent))

    def expected(self):
        """A second of knock.json on an lra-175, as the C program plays it."""
        played = self.run_program(FIRST_VIBRATION, KNOCK)
        self.assertGreater(max(map(abs, floats(played))), 0.05)
        return played

    def scene(self):
        """A scene of two knocks for two actuators, 1.5 s, and what the command renders of it."""
        shutil.copy(KNOCK, self.folder)
        (self.folder / "two.scene.json").write_text(json.dumps(
            {"format": "pacini.scene", "version": 1, "duration": 1.5, "actuators": 2, "clips": [KNOCK.name], "plays": [
                {"clip": KNOCK.name, "start": 0.1, "pan": 0.25}, {"clip": KNOCK.name, "start": 0.4, "pan": 1}]}))
        self.run_program(PACINI, "render", "two.scene.json", "-o", "two.wav")
        data = (self.folder / "two.wav").read_bytes()
        return "two.scene.json", data[data.index(b"data") + 8:][:8 * 72000]

    def assert_same_layout(self, lines):
        """Lines of layout(): each struct that a binding declares is the C compiler's. It may leave structs out."""
        names = {re.match(r"\w+", line)[0] for line in lines}
        self.assertGreaterEqual(len(names), 6)
        self.assertEqual(sorted(lines), sorted(line for line in layout() if re.match(r"\w+", line)[0] in names))

    def assert_same_samples(self, played, expected):
        """Bit for bit; the first difference tells where it is."""
        if played != expected:
            first = next((i for i, (a, b) in enumerate(zip(floats(played), floats(expected))) if a != b), None)
            self.fail(f"{len(played)} bytes instead of {len(expected)}, first difference at sample {first}")

    def check(self, library, result):
        text = ctypes.create_string_buffer(256)
        library.pacini_last_error(text, ctypes.c_size_t(256))
        self.assertEqual(result, 0, text.value)

    def rendered(self, clip, frames, actuators, rate):
        """What pacini_render_interleaved() gives of a clip on plain actuators, as floats."""
        library = ctypes.CDLL(str(LIBRARY))
        config = ctypes.create_string_buffer(4096)
        library.pacini_engine_config_init(config)
        struct.pack_into("=Id", config, 4, actuators, rate)
        engine, handle = ctypes.c_uint64(), ctypes.c_uint64()
        self.check(library, library.pacini_engine_create(config, ctypes.byref(engine)))
        self.check(library, library.pacini_clip_load_file(str(clip).encode(), ctypes.byref(handle)))
        self.check(library, library.pacini_play_start(engine, handle, None, None))
        samples = (ctypes.c_float * (frames * actuators))()
        self.check(library, library.pacini_render_interleaved(engine, samples, actuators, frames))
        library.pacini_engine_destroy(engine)
        library.pacini_clip_release(handle)
        return array.array("f", bytes(samples))
