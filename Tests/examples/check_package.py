"""The core as others use it: installed, found by CMake and by pkg-config, built into the examples, which then run; and as
a part of another project's source."""
import math
import os
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE, BUILD, PACINI = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
EXAMPLES = SOURCE / "Tests/examples"
LONGEST = 60  # lines of an example


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout.decode(errors='replace')}\n{done.stderr.decode(errors='replace')}")
    return done


def floats(data):
    return struct.unpack(f"<{len(data) // 4}f", data)


def check(what, holds):
    if not holds:
        sys.exit(f"failed: {what}")


with tempfile.TemporaryDirectory() as folder:
    folder = Path(folder)
    prefix = folder / "prefix"
    run("cmake", "--install", BUILD, "--prefix", prefix, "--component", "core")
    check("nothing but the core is installed", not (prefix / "bin").exists())
    for example in EXAMPLES.glob("*.cpp"):
        check(f"{example.name} is short", len(example.read_text().splitlines()) < LONGEST)

    run("cmake", "-S", EXAMPLES, "-B", folder / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}",
        "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror")
    run("cmake", "--build", folder / "build", "--parallel", "2")
    program = {name: folder / "build" / name for name in ("encode", "render", "live", "measure")}

    # Two seconds that fade, with a click.
    rate = 48000
    sound = [0.5 * math.exp(-n / rate) * math.sin(2 * math.pi * 120 * n / rate) + (0.8 if n == 30000 else 0.0)
             for n in range(2 * rate)]
    data = struct.pack(f"<{len(sound)}f", *sound)
    wave = folder / "sound.wav"
    wave.write_bytes(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " +
                     struct.pack("<IHHIIHH", 16, 3, 1, rate, 4 * rate, 4, 32) + b"data" + struct.pack("<I", len(data)) + data)

    clip = run(program["encode"], rate, input=data).stdout
    (folder / "clip.pacb").write_bytes(clip)
    run(PACINI, "encode", wave, "-o", folder / "own.json")
    own, theirs = (run(PACINI, "render", folder / name, "-o", folder / f"{name}.wav")
                   and (folder / f"{name}.wav").read_bytes()[-4 * rate:] for name in ("own.json", "clip.pacb"))
    check("an example's clip is that of the command", own == theirs)
    drive = run(program["render"], input=clip).stdout
    check("an example renders what the command does", drive[-4 * rate:] == theirs)

    live = floats(run(program["live"], rate, input=data).stdout)
    check("a live block for each block", len(live) == len(sound))
    check("the drive is one", all(abs(x) <= 1 for x in live) and max(map(abs, live)) > 0.05)

    sections = run(program["measure"]).stdout.decode().splitlines()
    check("an actuator takes some sections", 1 <= len(sections) <= 8 and all(" Hz " in line for line in sections))

    # Without CMake.
    environment = dict(os.environ, PKG_CONFIG_PATH=str(prefix / "share/pkgconfig"))
    flags = run("pkg-config", "--cflags", "pacini-core", env=environment).stdout.decode().split()
    run("c++", "-std=c++20", "-O1", *flags, EXAMPLES / "encode.cpp", "-o", folder / "plain")
    check("built by hand it does the same", run(folder / "plain", rate, input=data).stdout == clip)

    # As a folder of another project: the core alone, and none of its own settings.
    other = folder / "other"
    other.mkdir()
    (other / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(Other LANGUAGES CXX)\n"
        f"add_subdirectory({SOURCE} pacini)\n"
        f"add_executable(live {EXAMPLES}/live.cpp)\ntarget_link_libraries(live PRIVATE Pacini::core)\n"
        "if(TARGET pacini OR TARGET pacini_io OR CMAKE_BUILD_TYPE)\n    message(FATAL_ERROR \"more than the core\")\nendif()\n")
    run("cmake", "-S", other, "-B", other / "build", "-G", "Ninja")
    run("cmake", "--build", other / "build")
print("the core installs, and the examples on it do what the command does")
