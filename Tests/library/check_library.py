#!/usr/bin/env python3
"""Checks libpacini as those who link it get it.

check_library.py LIBRARY HEADER FIRST_VIBRATION PACINI CLIP CONFIGURATION COMPILER
What it shows, what it needs, how large it is, that its header is C99 and C++, and that the example of the header's first
lines gives what the command renders.
"""
import array
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LIBRARY, HEADER, EXAMPLE, PACINI, CLIP = (Path(path) for path in sys.argv[1:6])
CONFIGURATION, COMPILER = sys.argv[6:8]
LARGEST = 975_000  # bytes, stripped; the aim is 900 000
SOURCE = Path(__file__).resolve().parent / "first_vibration.c"
HANDLES = ["pacini_clip", "pacini_engine", "pacini_texture", "pacini_play", "pacini_controller"]


def run(*command, **options):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, **options).stdout


def functions():
    """(name, types of the arguments) of each function of the header."""
    text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(), flags=re.S)
    found = re.findall(r"PACINI_API [\w *]*?\b(pacini_\w+)\(([^)]*)\);", text)
    return [(name, [re.sub(r"\w+$", "", one.strip()).strip() for one in arguments.split(",")])
            for name, arguments in found if arguments != "void"]


def calls():
    """Calls that are right, and those with a handle of another kind or a number in its place: one a line."""
    right, wrong = [], []
    for name, types in functions():
        if set(types).isdisjoint(HANDLES):
            continue
        given = [f"a_{kind}" if kind in HANDLES else "0" for kind in types]
        right.append(f"{name}({', '.join(given)});")
        for at in (i for i, kind in enumerate(types) if kind in HANDLES):
            for other in [f"a_{kind}" for kind in HANDLES if kind != types[at]] + ["7", f"a_{types[at]}.id"]:
                wrong.append(f"{name}({', '.join([*given[:at], other, *given[at + 1:]])});")
    for kind in HANDLES:
        right.append(f"{{ {kind} none = PACINI_NONE; {kind} same = a_{kind}; (void)none; (void)same; }}")
        wrong.append(f"{{ {kind} none = 0; (void)none; }}")
        wrong += [f"{{ {kind} other = a_{another}; (void)other; }}" for another in HANDLES if another != kind]
    return right, wrong


def lines_with_errors(language, lines, folder):
    """Numbers of those of `lines` that do not compile."""
    arguments = ", ".join(f"{kind} a_{kind}" for kind in HANDLES)
    first = ["#include <pacini.h>", f"void test({arguments})", "{"]
    source = Path(folder) / "calls"
    source.write_text("\n".join([*first, *lines, "}"]) + "\n")
    done = subprocess.run(["cc", "-x", language, "-fsyntax-only", "-fmax-errors=0", "-I", HEADER.parent, source],
                          capture_output=True, text=True)
    errors = {int(line) - len(first) - 1 for line in re.findall(r"calls:(\d+):\d+: error: ", done.stderr)}
    return errors, done.stderr


class Library(unittest.TestCase):
    def test_only_functions_of_the_header_are_visible(self):
        visible = set()
        for line in run("nm", "-D", "--defined-only", LIBRARY).decode().splitlines():
            *_, kind, name = line.split()
            if kind == "T":
                visible.add(name)
        declared = {name.split("(")[0] for name in HEADER.read_text().replace("\n", " ").split()
                    if name.startswith("pacini_") and "(" in name}
        functions = {name for name in visible if name.startswith("pacini_")}
        self.assertEqual(visible - functions, set())
        self.assertTrue(functions <= declared, functions - declared)
        self.assertGreater(len(functions), 25)

    def test_it_needs_the_libraries_of_every_system_only(self):
        needed = re.findall(r"\(NEEDED\).*\[(\w+)", run("readelf", "--dynamic", LIBRARY).decode())
        self.assertEqual(set(needed) - {"libstdc", "libc", "libm", "libgcc_s", "ld"}, set())

    @unittest.skipUnless(CONFIGURATION == "Release" and COMPILER == "GNU", "other builds are larger")
    def test_it_is_small(self):
        with tempfile.TemporaryDirectory() as folder:
            stripped = Path(folder) / "libpacini.so"
            run("strip", "--strip-unneeded", LIBRARY, "-o", stripped)
            self.assertLess(stripped.stat().st_size, LARGEST)

    def test_the_header_is_c99_and_cpp(self):
        with tempfile.TemporaryDirectory() as folder:
            for language, standard in (("c", "c99"), ("c", "c17"), ("c++", "c++98"), ("c++", "c++20")):
                source = Path(folder) / "t"
                source.write_text('#include "pacini.h"\nint main(void) { return PACINI_OK; }\n')
                more = ["-Wno-long-long"] if standard == "c++98" else []
                run("cc", "-x", language, f"-std={standard}", "-pedantic-errors", "-Wall", "-Wextra", "-Werror", *more,
                    "-fsyntax-only", "-I", HEADER.parent, source)

    def test_a_handle_of_another_kind_or_a_number_does_not_compile(self):
        right, wrong = calls()
        self.assertGreater(len(right), 25)
        self.assertGreater(len(wrong), 150)
        with tempfile.TemporaryDirectory() as folder:
            for language in ("c", "c++"):
                errors, said = lines_with_errors(language, right, folder)
                self.assertEqual(errors, set(), said)
                errors, said = lines_with_errors(language, wrong, folder)
                self.assertEqual([line for i, line in enumerate(wrong) if i not in errors], [])
                self.assertNotRegex(said, r"error: (?!incompatible type|invalid initializer|conversion from|"
                                          r"could not convert|cannot convert)")

    def test_programs_of_the_time_when_handles_were_numbers_play_the_same(self):
        """They are told by their header, which is as that of 1.4 was."""
        with tempfile.TemporaryDirectory() as folder:
            header, count = re.subn(r"typedef struct (\w+)( /\*[^\n]*)?\s*\{\s*uint64_t id;\s*\} \1;",
                                    r"typedef uint64_t \1;", HEADER.read_text())
            self.assertEqual(count, len(HANDLES))
            (Path(folder) / "pacini.h").write_text(header.replace("#define PACINI_NONE {0}", "#define PACINI_NONE 0"))
            program = Path(folder) / "numbers"
            run("cc", "-std=c99", "-I", folder, SOURCE, "-o", program, f"-L{LIBRARY.parent}", "-lpacini",
                f"-Wl,-rpath,{LIBRARY.parent}")
            self.assertEqual(run(program, CLIP), run(EXAMPLE, CLIP))

    def test_handles_are_passed_as_numbers_are(self):
        """The same instructions call and are called, on each machine for which a compiler is here."""
        body = """
            typedef struct { unsigned long long id; } handle;
            typedef unsigned long long number;
            void taken(int, KIND, double, KIND, void*, KIND, KIND, float, KIND, KIND);
            void test(KIND a, int b, KIND c, float d, KIND e, KIND f, KIND g, double h, KIND i, void* j)
            { taken(b, g, h, c, j, a, e, d, f, i); taken(b, a, h, i, j, c, f, d, g, e); }"""
        # GCC copies structs with other instructions than numbers on i386, to the same places: Clang has the same ones.
        compilers = [["cc"], ["cc", "-mabi=ms"], ["aarch64-linux-gnu-gcc"], ["x86_64-w64-mingw32-gcc-posix"]]
        clang = next(filter(shutil.which, ("clang", "clang-22", "clang-14")), None)
        compilers += [[clang, f"--target={machine}"] for machine in (
            "x86_64-linux-gnu", "i386-linux-gnu", "x86_64-windows-gnu", "i386-windows-gnu", "aarch64-linux-gnu",
            "arm64-apple-darwin", "armv7-linux-gnueabihf", "wasm32-wasi") if clang]
        tried = 0
        for compiler in compilers:
            if not shutil.which(compiler[0]):
                continue
            made = [subprocess.run([*compiler, "-O2", "-S", "-x", "c", "-", "-o", "-", f"-DKIND={kind}"], input=body,
                                   capture_output=True, text=True) for kind in ("number", "handle")]
            if any(done.returncode for done in made):
                continue  # a compiler without that machine
            with self.subTest(compiler=compiler):
                self.assertEqual(made[0].stdout, made[1].stdout)
            tried += 1
        self.assertGreaterEqual(tried, 1)

    def test_the_first_vibration_is_what_the_command_renders(self):
        played = array.array("f", run(EXAMPLE, CLIP))
        with tempfile.TemporaryDirectory() as folder:
            wave = Path(folder) / "r.wav"
            run(PACINI, "render", CLIP, "-o", wave, "--profile", "lra-175")
            import wave as reader  # of no use for floats: only its header is read
            data = wave.read_bytes()
            self.assertEqual(data[:4], b"RIFF")
            start = data.index(b"data") + 8
            rendered = array.array("f", data[start:start + 4 * ((len(data) - start) // 4)])
        n = min(len(played), len(rendered))
        self.assertGreater(n, 20000)
        self.assertGreater(max(map(abs, played)), 0.05)
        # The command leaves out what nobody feels and filters behind the decoder at its own rate.
        self.assertLess(max(abs(a - b) for a, b in zip(played[:n], rendered[:n])), 2e-3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
