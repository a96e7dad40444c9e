"""Windows on this machine: wine, with a folder of its own for its drive C, and the command as a program of Linux.

Without wine or build/windows a test is skipped, which CI refuses; `bash cmake/bootstrap.sh windows` brings both.
"""
import atexit
import fcntl
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
BUILD = ROOT / "build/windows"
BIN = BUILD / "bin"
PREFIX = BUILD / "wine"
WINE = next((path for path in (shutil.which("wine64"), "/usr/lib/wine/wine64", shutil.which("wine"))
             if path and os.path.exists(path)), None)
# Neither its menus in those of this machine, nor its browser, nor its library of Visual C++, which not every Windows has.
os.environ.update(WINEPREFIX=str(PREFIX), WINEDEBUG="-all", LC_ALL="C.UTF-8",
                  WINEDLLOVERRIDES="winemenubuilder.exe=d;mscoree,mshtml=;vcruntime140=n")
os.environ.pop("DISPLAY", None)


def skip(why):
    print(f"SKIPPED: {why}")
    sys.exit(77)


def prepare():
    """Skips the test where Windows is not built or not there, and starts it."""
    if WINE is None:
        skip("wine64 is not installed")
    if not (BIN / "pacini.exe").exists():
        skip("build/windows is not built")
    make_drive()
    stay()


def make_drive():
    """Drive C of this checkout, made by the first that needs it."""
    PREFIX.mkdir(parents=True, exist_ok=True)
    with open(BUILD / "wine.lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (PREFIX / "ready").exists():
            subprocess.run([WINE, "wineboot", "-i"], capture_output=True, check=True, timeout=300)
            (PREFIX / "ready").touch()


def compile_c(name, folder, *options):
    """Compiles a source of this folder for Windows."""
    program = Path(folder) / f"{name}.exe"
    subprocess.run(["x86_64-w64-mingw32-gcc-posix", "-O1", "-Wall", "-Werror", *options, HERE / f"{name}.c", "-o", program],
                   check=True)
    return program


def stay():
    """Keeps Windows running until this program ends: it would start anew, for a second, with each command. Without a
    console: with one, Ctrl+C does not reach those of other programs."""
    folder = tempfile.TemporaryDirectory()
    program = subprocess.Popen([WINE, compile_c("stay", folder.name, "-mwindows")], stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    program.stdout.readline()
    atexit.register(lambda: (program.communicate(), folder.cleanup()))


def run(program, *words, **options):
    """Runs a program of Windows to its end."""
    options = {"stdin": subprocess.DEVNULL, "capture_output": True, "timeout": 300, "check": False, **options}
    return subprocess.run([WINE, str(program), *map(str, words)], **options)


def command(folder, program="pacini"):
    """A script that stands for the command in tests that start it as a program of Linux."""
    script = Path(folder) / program
    script.write_text(f'#!/bin/sh\nexec "{WINE}" "{BIN / program}.exe" "$@"\n', encoding="utf-8")
    script.chmod(0o755)
    return script


def as_windows(path):
    """The path of a file as programs of Windows see it: drive Z is the root of this machine."""
    return "Z:" + str(path).replace("/", "\\")
