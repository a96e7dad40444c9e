"""A clip has the same bytes on every machine: the demo sounds encoded, packed, unpacked and rendered on this one, on
64-bit ARM (by qemu) and on 32-bit x86, by another compiler and with other versions of mathematical functions. Clips must
be those of the command byte for byte, and drives the same to -120 dB; by how much they differ at all is said.

check_bytes.py SOURCE PACINI EIGEN
"""
import ctypes
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from array import array
from pathlib import Path

from compiling import compile_program

SOURCE, PACINI, EIGEN = Path(sys.argv[1]), sys.argv[2], sys.argv[3]
DEMO = SOURCE / "Resources/demo"
LARGEST = 1e-6  # difference of a drive's samples: -120 dB, a thirtieth of a step of 16 bits
# machine -> compiler, its flags, what runs its programs, what it sets for them
MACHINES = {
    "this one": ("g++", [], [], {}),
    # glibc has versions of its functions with and without fused multiply-add, whose last bits differ.
    "no fused multiply-add in the library": ("g++", [], [], {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}),
    # Its library sorts and searches in other ways.
    "Clang with libc++": ("clang++", ["-stdlib=libc++"], [], {}),
    "64-bit ARM": ("aarch64-linux-gnu-g++", [], ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"], {}),
    "32-bit x86": ("i686-linux-gnu-g++", ["-msse2", "-mfpmath=sse", "-static"],
                   [] if platform.machine() == "x86_64" else ["qemu-i386"], {}),
}


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}: {done.returncode}\n{done.stderr.decode(errors='replace')}")


def samples(path):
    """The interleaved samples of a sound, its rate and its number of channels."""
    class Info(ctypes.Structure):
        _fields_ = [("frames", ctypes.c_int64)] + [(name, ctypes.c_int) for name in
                                                   ("rate", "channels", "format", "sections", "seekable")]
    library = ctypes.CDLL("libsndfile.so.1")
    library.sf_open.restype = ctypes.c_void_p
    library.sf_readf_float.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64]
    library.sf_readf_float.restype = ctypes.c_int64
    library.sf_close.argtypes = [ctypes.c_void_p]
    info = Info()
    sound = library.sf_open(os.fsencode(path), 0x10, ctypes.byref(info))
    content = (ctypes.c_float * (info.frames * info.channels))()
    if library.sf_readf_float(sound, content, info.frames) != info.frames:
        sys.exit(f"failed: cannot read {path}")
    library.sf_close(sound)
    return bytes(content), info.rate, info.channels


def floats(path):
    values = array("f")
    values.frombytes(path.read_bytes())
    return values


def same(what, found, expected):
    if found.read_bytes() != expected.read_bytes():
        sys.exit(f"failed: {what} has other bytes")


def difference(what, found, expected):
    """How many samples of a drive differ, and by how much at most."""
    found, expected = floats(found), floats(expected)
    largest = max(abs(x - y) for x, y in zip(found, expected))
    if len(found) != len(expected) or largest > LARGEST:
        sys.exit(f"failed: {what} has {len(found)} samples for {len(expected)}, or differs by {largest:.2g}")
    return sum(x != y for x, y in zip(found, expected)), largest


missing = sorted({tool for compiler, _, runner, _ in MACHINES.values() for tool in [compiler, *runner[:1]]
                  if shutil.which(tool) is None})
if missing:
    print(f"SKIPPED: {', '.join(missing)} not found")
    sys.exit(77)

# The x87 keeps more digits than a double has, and writer and reader of clips would not agree.
refused = subprocess.run(["i686-linux-gnu-g++", "-std=c++20", "-fsyntax-only", f"-I{SOURCE}/Core", "-include",
                          "pacini/clip/PackedClip.h", "-x", "c++", "-"], input=b"", capture_output=True, check=False)
if refused.returncode == 0 or b"-msse2 -mfpmath=sse" not in refused.stderr:
    sys.exit("failed: the x87 is not refused, or not in words that help")

with tempfile.TemporaryDirectory() as folder:
    folder = Path(folder)
    sounds = [(path, *samples(path)) for path in sorted(DEMO.glob("*.flac"))]
    if len(sounds) < 8:
        sys.exit("failed: where are the demo sounds?")
    for path, *_ in sounds:
        run(PACINI, "encode", path, "-o", folder / f"{path.stem}.pacb", "--format", "packed")
    programs, reference = {}, folder / "this one"
    for machine, (compiler, flags, runner, environment) in MACHINES.items():
        if compiler not in programs:
            programs[compiler] = folder / compiler
            compile_program(SOURCE, EIGEN, compiler, flags, "Tests/portability/bytes.cpp", programs[compiler])
        program = [*runner, programs[compiler]]
        environment = {**os.environ, **environment}
        own = folder / machine
        own.mkdir()
        run(*program, "grids", own / "grids", env=environment)
        same(f"{machine}: the grid of clips", own / "grids", reference / "grids")
        differing, most = 0, 0.0
        for path, content, rate, channels in sounds:
            of_command = folder / f"{path.stem}.pacb"
            clip, drive, again, unsealed = (own / f"{path.stem}.{kind}" for kind in ("pacb", "drive", "again", "unsealed"))
            run(*program, rate, channels, path.name, clip, drive, input=content, env=environment)
            run(*program, "again", of_command, again, unsealed, env=environment)
            same(f"{machine}: the clip of {path.stem}, read and written,", again, of_command)
            same(f"{machine}: the clip of {path.stem}", clip, unsealed)
            count, largest = difference(f"{machine}: the drive of {path.stem}", drive, reference / drive.name)
            differing, most = differing + count, max(most, largest)
        print(f"{machine}: the same {len(sounds)} clips; {differing} samples of their drives differ, by at most {most:.2g}")
