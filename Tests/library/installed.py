"""libpacini as it is installed below a prefix: found by pkg-config and by CMake, shared and static."""
import os
import subprocess
from pathlib import Path

EXAMPLE = Path(__file__).with_name("first_vibration.c")
CLIP = Path(__file__).with_name("knock.json")
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(Vibrating LANGUAGES C)
find_package(pacini REQUIRED COMPONENTS library)
foreach(kind library library_static)
    add_executable(${kind} "%s")
    target_link_libraries(${kind} PRIVATE Pacini::${kind})
endforeach()
"""


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, check=False, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}\n{done.stdout.decode(errors='replace')[-3000:]}"
                           f"{done.stderr.decode(errors='replace')[-3000:]}")
    return done.stdout


def library_folder(prefix):
    [library] = prefix.glob("lib/**/libpacini.so.1")
    return library.parent


def built(prefix, folder):
    """The example, built in each way in `folder`: programs by the name of the way."""
    libraries = library_folder(prefix)
    folder.mkdir()
    environment = dict(os.environ, PKG_CONFIG_PATH=str(libraries / "pkgconfig"))
    alone = folder / "static"  # where both are, linkers take the shared one
    alone.mkdir()
    (alone / "libpacini.a").symlink_to(libraries / "libpacini.a")
    programs = {}
    for way, more in (("pkg-config", []), ("pkg-config --static", ["--static"])):
        flags = run("pkg-config", "--cflags", "--libs", *more, "pacini", env=environment).decode().split()
        programs[way] = folder / way.replace(" ", "")
        # As C: the C++ library comes with libpacini, or is named by Libs.private.
        run("cc", "-std=c99", EXAMPLE, "-o", programs[way], *([f"-L{alone}"] if more else []), *flags)
    (folder / "CMakeLists.txt").write_text(PROJECT % EXAMPLE, encoding="utf-8")
    run("cmake", "-S", folder, "-B", folder / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", folder / "build")
    for target in ("library", "library_static"):
        programs[f"CMake, {target}"] = folder / "build" / target
    return programs


def played(prefix, programs):
    """What each program plays of the clip; the shared library is that of the prefix."""
    environment = dict(os.environ, LD_LIBRARY_PATH=str(library_folder(prefix)))
    return {way: run(program, CLIP, env=environment) for way, program in programs.items()}


def needs_shared_library(program):
    return b"libpacini.so.1" in run("readelf", "--dynamic", program)
