"""pacini.dll as programs in C and C# get it: by its import library, and as what it needs and shows."""
import array
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import wine

SOURCE = Path(os.environ["PACINI_SOURCE_DIR"])
BINDING = SOURCE / "Source/library/bindings/csharp"
DOTNET = SOURCE / "build/windows-tests/dotnetcore2/bin/dotnet.exe"
FRAMEWORK = {"name": "Microsoft.NETCore.App", "version": "3.1.0"}
EXAMPLE = Path(os.environ["PACINI_COMMAND"]).parent / "pacini_first_vibration"
LIBRARY = SOURCE / "Tests/library"
LARGEST = 3_000_000  # bytes, stripped
wine.prepare()


class Library(unittest.TestCase):
    def test_the_first_vibration_is_that_of_this_machine(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "first_vibration.exe"
            subprocess.run(["x86_64-w64-mingw32-gcc-posix", "-std=c99", "-Wall", "-Wextra", "-Werror",
                            "-DPACINI_SHARED=1", f"-I{SOURCE / 'Source/library/include'}",
                            LIBRARY / "first_vibration.c", wine.BUILD / "lib/libpacini.dll.a", "-o", program], check=True)
            (Path(folder) / "pacini.dll").symlink_to(wine.BIN / "pacini.dll")
            played = wine.run(program, LIBRARY / "knock.json")
        self.as_here(played)

    def as_here(self, played):
        self.assertEqual((played.returncode, played.stderr), (0, b""))
        here = subprocess.run([EXAMPLE, LIBRARY / "knock.json"], check=True, capture_output=True)
        here, windows = (array.array("f", done.stdout) for done in (here, played))
        self.assertEqual(len(windows), len(here))
        self.assertLess(max(abs(a - b) for a, b in zip(windows, here)), 1e-9)

    def test_a_program_in_csharp_plays_it_too(self):
        """Its own library may not be Pacini.dll: to Windows that is the name of pacini.dll."""
        if not DOTNET.exists():
            self.skipTest(f"{DOTNET} is missing")
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "first.exe"
            subprocess.run(["mcs", "-warnaserror", "-langversion:7", f"-out:{program}", BINDING / "Samples~/FirstVibration.cs",
                            BINDING / "Runtime/Native.cs", BINDING / "Runtime/Pacini.cs"], check=True)
            (Path(folder) / "pacini.dll").symlink_to(wine.BIN / "pacini.dll")
            program.with_suffix(".runtimeconfig.json").write_text(json.dumps({"runtimeOptions": {
                "framework": FRAMEWORK, "configProperties": {"System.Globalization.Invariant": True}}}))
            self.as_here(wine.run(DOTNET, "exec", program, LIBRARY / "knock.json"))

    def test_it_needs_the_systems_libraries_alone_and_shows_the_header_alone(self):
        text = subprocess.run(["x86_64-w64-mingw32-objdump", "-p", wine.BIN / "pacini.dll"], check=True,
                              capture_output=True, text=True).stdout
        needed = {name.lower() for name in re.findall(r"DLL Name: (\S+)", text)}
        self.assertLessEqual(needed, {"kernel32.dll", "msvcrt.dll"})
        shown = set(re.findall(r"^\s*\[ *\d+\] (\w+)$", text, re.M))
        header = (SOURCE / "Source/library/include/pacini.h").read_text(encoding="utf-8")
        self.assertEqual(shown, set(re.findall(r"PACINI_API [\w *]*?\b(pacini_\w+)\(", header)))

    def test_it_is_small(self):
        with tempfile.TemporaryDirectory() as folder:
            stripped = Path(folder) / "pacini.dll"
            subprocess.run(["x86_64-w64-mingw32-strip", wine.BIN / "pacini.dll", "-o", stripped], check=True)
            self.assertLess(stripped.stat().st_size, LARGEST)


if __name__ == "__main__":
    unittest.main()
