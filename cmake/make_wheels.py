#!/usr/bin/env python3
"""Makes wheels of the newest commit for CPython 3.9 to 3.14, and tries each where no compiler is.

make_wheels.py FOLDER [--changed] [--try]    `bash cmake/bootstrap.sh wheels` installs what is needed and calls it

Wheels for 3.9, 3.10 and 3.11 are for one version each, as they are compiled against its headers; one wheel of the
stable interface (abi3) is for 3.12 and all later ones. Those are made whose Python is at hand: by the name python3.N,
or below ~/.pyenv/versions. What cannot be made or tried for want of a Python is told. With --try the wheels of FOLDER are
tried, and none is made.

Tried means: a virtual environment of its own with numpy alone, `pip install --no-index` of the folder, which chooses
the wheel, PATH without a compiler, and a first sound that becomes the same clip in each.
"""

import argparse
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import make_release

VERSIONS = range(9, 15)
STABLE = 12  # the first whose stable interface nanobind has (wheel.py-api in pyproject.toml)
TOOLS = ("nanobind>=2.4,<4", "scikit-build-core<2")
SOUND = make_release.ROOT / "Resources/demo/knock_wood_bridge.flac"
FIRST_SOUND = "import pacini, sys; sys.stdout.buffer.write(pacini.encode(sys.argv[1]).to_bytes())"


def run_version(python):
    """The version that a CPython with pip and venv says of itself; nothing for anything else."""
    asked = "import sys, ensurepip, venv; print(*sys.version_info[:2], sys.implementation.name)"
    done = subprocess.run([python, "-c", asked], capture_output=True, check=False, text=True)
    words = done.stdout.split() if done.returncode == 0 else []
    return (int(words[0]), int(words[1])) if words[2:] == ["cpython"] else None


def interpreters():
    """Those at hand by their minor versions."""
    found = {}
    for minor in VERSIONS:
        named = [
            shutil.which(f"python3.{minor}"),
            *sorted((Path.home() / ".pyenv/versions").glob(f"3.{minor}.*/bin/python3.{minor}")),
        ]
        for path in filter(None, named):
            if run_version(path) == (3, minor):
                found[minor] = Path(path)
                break
    return found


def has_headers(python):
    asked = "import os, sysconfig; print(os.path.exists(os.path.join(sysconfig.get_path('include'), 'Python.h')))"
    return subprocess.run([python, "-c", asked], capture_output=True, check=False, text=True).stdout.strip() == "True"


def environment(python, folder, *modules):
    """The interpreter of a virtual environment with these modules."""
    make_release.run(python, "-m", "venv", "--clear", folder)
    inside = folder / "bin/python"
    make_release.run(
        inside, "-m", "pip", "install", "-q", "--disable-pip-version-check", "--only-binary=:all:", *modules
    )
    return inside


def tag(minor):
    return f"cp3{STABLE}-abi3" if minor >= STABLE else f"cp3{minor}-cp3{minor}"


def builders(at_hand):
    """Which Python makes which wheel: a list of (tag, Python), and tags of those that none makes."""
    made = [
        (tag(minor), at_hand[minor])
        for minor in VERSIONS
        if minor < STABLE and minor in at_hand and has_headers(at_hand[minor])
    ]
    stable = next(
        (at_hand[minor] for minor in VERSIONS if minor >= STABLE and minor in at_hand and has_headers(at_hand[minor])),
        None,
    )
    made += [(tag(STABLE), stable)] if stable else []
    return made, [name for name in dict.fromkeys(map(tag, VERSIONS)) if name not in dict(made)]


def make(folder, changed):
    with tempfile.TemporaryDirectory() as work:
        release = make_release.Release(Path(work), changed)
        made, missing = builders(interpreters())
        for name, python in made:
            print(f"{name}: compiling, which takes minutes ...", flush=True)
            release.wheel(environment(python, Path(work) / name, *TOOLS))
        folder.mkdir(parents=True, exist_ok=True)
        for path in folder.glob("pacini-*.whl"):
            path.unlink()
        for _, path in release.packages:
            shutil.move(path, folder / path.name)
            print(f"{(folder / path.name).stat().st_size:>11,}  {path.name}")
    for name in missing:
        print(f"NOT MADE: {name}: no Python of it is at hand with its headers")


def attempt(folder):
    """Tries the wheels; how many failed."""
    at_hand, clips, failed = interpreters(), {}, 0
    for minor in VERSIONS:
        if minor not in at_hand or not list(folder.glob(f"pacini-*-{tag(minor)}-*.whl")):
            print(f"NOT TRIED: Python 3.{minor}: " + ("it has no wheel" if minor in at_hand else "it is not at hand"))
            continue
        with tempfile.TemporaryDirectory() as name:
            python = environment(at_hand[minor], Path(name) / "env", "numpy")
            bare = {"PATH": str(python.parent), "HOME": name, "LC_ALL": "C.UTF-8"}
            steps = (
                [
                    python,
                    "-m",
                    "pip",
                    "install",
                    "-q",
                    "--disable-pip-version-check",
                    "--no-index",
                    "--find-links",
                    folder,
                    "pacini",
                ],
                [python, "-c", FIRST_SOUND, SOUND],
            )
            for step in steps:
                done = subprocess.run(
                    [str(word) for word in step], capture_output=True, check=False, env=bare, cwd=name
                )
                if done.returncode != 0:
                    break
        if done.returncode != 0 or len(done.stdout) < 100:
            failed += 1
            print(f"FAILED: Python 3.{minor}: {done.stderr.decode(errors='replace')[-1500:]}")
            continue
        clips[minor] = done.stdout
        print(
            f"ok: Python 3.{minor} encodes its first sound: {len(done.stdout)} bytes,",
            hashlib.sha256(done.stdout).hexdigest()[:12],
        )
    if len(set(clips.values())) > 1:
        failed += 1
        print("FAILED: the clips differ")
    return failed if clips else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument(
        "--changed", action="store_true", help="although files differ from the commit, whose wheels are made"
    )
    parser.add_argument("--try", dest="only_try", action="store_true", help="make none, only try those of the folder")
    options = parser.parse_args()
    os.environ.setdefault("PIP_NO_INPUT", "1")
    if not options.only_try:
        if make_release.git("status", "--porcelain", "--untracked-files=no").strip() and not options.changed:
            make_release.fail("there are changes that are not committed: commit them first, or say --changed")
        make(options.folder.resolve(), options.changed)
    sys.exit(1 if attempt(options.folder.resolve()) else 0)


if __name__ == "__main__":
    main()
