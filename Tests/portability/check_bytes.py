"""A clip has the same bytes on every machine: the demo sounds encoded, packed, unpacked and rendered on this one, on
64-bit ARM and 32-bit x86 (by qemu), on Windows (in wine) and as WebAssembly (in Node.js), by several compilers and with
other versions of mathematical functions. Prints a table. Clips must be those of the command byte for byte, and drives
those of the first row sample for sample.

check_bytes.py [SOURCE PACINI EIGEN]    of this checkout, its release build and Debian's Eigen where they are not given

Exit 0, 1 if a clip or a drive is not the same, 77 if a machine cannot be tried here; in CI that is a failure.
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

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "windows"))
import wine  # noqa: E402

if len(sys.argv) not in (1, 4):
    sys.exit(__doc__)
ROOT = HERE.parents[1]
SOURCE, PACINI, EIGEN = map(Path, sys.argv[1:] or (ROOT, ROOT / "build/release/bin/pacini", "/usr/include/eigen3"))
DEMO = SOURCE / "Resources/demo"
SSE = ["-msse2", "-mfpmath=sse"]
WASM = ["--target=wasm32-wasi", "-Wno-deprecated", "-fno-exceptions", "-fno-rtti", "-msimd128",
        "-Wl,-z,stack-size=1048576"]
FUNCTIONS = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}
OTHER = {"LD_PRELOAD": "other_functions.so"}  # compiled where it is wanted
# What it runs on, compiler, its flags, what runs its programs, what is set for them. The first is the reference.
MACHINES = [
    (f"Linux, {platform.machine()}", "g++", [], [], {}),
    # glibc has versions of its functions with and without fused multiply-add, whose last bits differ.
    (f"Linux, {platform.machine()}, functions without fused multiply-add", "g++", [], [], FUNCTIONS),
    # Much worse ones, so that eight sounds are enough to see whether any of them matters.
    (f"Linux, {platform.machine()}, functions 1e-12 off", "g++", [], [], OTHER),
    # Its library sorts and searches in other ways.
    (f"Linux, {platform.machine()}, libc++", "clang++", ["-stdlib=libc++"], [], {}),
    ("Linux, 64-bit ARM", "aarch64-linux-gnu-g++", [], ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"], {}),
    ("Linux, 32-bit x86", "i686-linux-gnu-g++", [*SSE, "-static"],
     [] if platform.machine() == "x86_64" else ["qemu-i386"], {}),
    ("Windows, x86_64, in wine", "x86_64-w64-mingw32-g++-posix", ["-static"], [wine.WINE or "wine64"], {}),
    ("WebAssembly, in Node.js", "clang++-22", WASM, ["node", "--no-warnings", HERE / "run_wasm.mjs"], {}),
]


class Failed(Exception):
    pass


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, check=False, timeout=900, **options)
    if done.returncode != 0:
        raise Failed(f"{' '.join(map(str, command))} ended with {done.returncode}: "
                     f"{(done.stdout + done.stderr).decode(errors='replace')[-2000:]}")
    return done.stdout.decode(errors="replace")


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


def difference(found, expected):
    """The largest difference of two drives; infinite where they have not the same length."""
    found, expected = floats(found), floats(expected)
    return max(abs(x - y) for x, y in zip(found, expected)) if len(found) == len(expected) else float("inf")


def missing(compiler, runner):
    """Why a machine cannot be tried here, or nothing."""
    lacking = [tool for tool in [compiler, *map(str, runner[:1])] if shutil.which(tool) is None]
    return f"{' and '.join(lacking)} not found" if lacking else ""


def version(compiler):
    return run(compiler, "-dumpversion" if compiler.startswith("clang") else "-dumpfullversion").strip()


def check_x87():
    """The x87 keeps more digits than a double has, and writer and reader of clips would not agree."""
    command = ["i686-linux-gnu-g++", "-std=c++20", "-fsyntax-only", f"-I{SOURCE}/Core", "-include",
               "pacini/clip/PackedClip.h", "-x", "c++", "-"]
    refused = subprocess.run(command, input=b"", capture_output=True, check=False)
    if refused.returncode == 0 or b"-msse2 -mfpmath=sse" not in refused.stderr:
        raise Failed("the x87 is not refused, or not in words that help")


class Comparison:
    def __init__(self, folder):
        self.folder = folder
        self.sounds = [(path, *samples(path)) for path in sorted(DEMO.glob("*.flac"))]
        if len(self.sounds) < 8:
            raise Failed("where are the demo sounds?")
        for path, *_ in self.sounds:
            run(PACINI, "encode", path, "-o", folder / f"{path.stem}.pacb", "--format", "packed")
        self.reference = None

    def on(self, number, compiler, flags, runner, environment):
        """How many clips and drives are the same on a machine, and the largest difference of a drive."""
        program = self.folder / f"{compiler}.exe"  # the one name that all systems take
        if not program.exists():
            compile_program(SOURCE, EIGEN, compiler, flags, "Tests/portability/bytes.cpp", program)
        command, set_for_it = [*runner, program], environment
        if environment is OTHER:
            library = self.folder / OTHER["LD_PRELOAD"]
            run("gcc", "-O1", "-fno-builtin", "-shared", "-fPIC", HERE / "other_functions.c", "-o", library, "-ldl", "-lm")
            set_for_it = {"LD_PRELOAD": str(library)}
        environment = {**os.environ, **set_for_it}
        if "wine" in str(runner[:1]):
            wine.make_drive()
        own = self.folder / str(number)
        own.mkdir()
        self.reference = self.reference or own
        # Paths as they are on drive Z, which is the root of this machine.
        run(*command, "functions", own / "functions", env=environment, cwd=self.folder)
        if (own / "functions").read_bytes() != (self.reference / "functions").read_bytes():
            raise Failed("the portable functions have other bytes")
        if "LD_PRELOAD" not in set_for_it:  # of 600 000 values, a few are as near as 1e-12 to where they are rounded
            run(*command, "grids", own / "grids", env=environment, cwd=self.folder)
            if (own / "grids").read_bytes() != (self.reference / "grids").read_bytes():
                raise Failed("the grid of clips has other bytes")
        clips, drives, largest = 0, 0, 0.0
        for path, content, rate, channels in self.sounds:
            of_command = self.folder / f"{path.stem}.pacb"
            kinds = ("pacb", "drive", "again", "unsealed")
            clip, drive, again, unsealed = (own / f"{path.stem}.{kind}" for kind in kinds)
            run(*command, rate, channels, path.name, clip, drive, input=content, env=environment, cwd=self.folder)
            run(*command, "again", of_command, again, unsealed, env=environment, cwd=self.folder)
            clips += again.read_bytes() == of_command.read_bytes() and clip.read_bytes() == unsealed.read_bytes()
            most = difference(drive, self.reference / drive.name)
            drives, largest = drives + (most == 0), max(largest, most)
        return clips, drives, largest


def main():
    failed, untried = [], []
    print("| machine | compiler | clips with the same bytes | drives with the same samples | "
          "largest difference of a sample |")
    print("|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        comparison = Comparison(Path(folder))
        n = len(comparison.sounds)
        for number, (machine, compiler, flags, runner, environment) in enumerate(MACHINES):
            why = missing(compiler, runner)
            if why:
                untried.append(f"{machine}: {why}")
                print(f"| {machine} | {compiler} | not tried: {why} | | |", flush=True)
                continue
            try:
                clips, drives, largest = comparison.on(number, compiler, flags, runner, environment)
            except (Failed, SystemExit) as error:  # the latter where it does not compile
                failed.append(f"{machine}: {error}")
                print(f"| {machine} | {compiler} | failed | | |", flush=True)
                continue
            print(f"| {machine} | {compiler} {version(compiler)} | {clips} of {n} | {drives} of {n} | "
                  f"{f'{largest:.1g}' if largest else '0'} |", flush=True)
            if clips < n or drives < n:
                failed.append(f"{machine}: {n - clips} clips have other bytes, drives differ by up to {largest:.2g}")
    if not missing("i686-linux-gnu-g++", []):
        try:
            check_x87()
        except Failed as error:
            failed.append(str(error))
    for line in failed:
        print(f"failed: {line}", file=sys.stderr)
    for line in untried:
        print(f"SKIPPED: {line}")
    if failed or (untried and os.environ.get("CI") == "true"):
        return 1
    return 77 if untried else 0


if __name__ == "__main__":
    sys.exit(main())
