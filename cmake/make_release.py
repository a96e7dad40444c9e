#!/usr/bin/env python3
"""Makes the packages of a release from the newest commit and what is built of it, with checksums and a list of
licences.

make_release.py FOLDER [--parts LIST] [--changed] [--check]    `bash cmake/bootstrap.sh release` builds and calls it

FOLDER then holds the packages, SHA256SUMS and an SPDX list, all with the version of CMakeLists.txt. They have the same
bytes whenever the same commit is packed with the same tools. With --parts some only, separated by commas:
  source   all sources, as Git archives them          deb      what build/release has, by cpack
  sdist    the sources that the wheel is built of     npm      build/web/package
  wheel    built of that, with the libraries inside   windows  build/windows/package: an installer and a zip
  crate    the binding for Rust
Changes that are not committed are refused, or with --changed left out of the sources and packed with the rest. --check
makes nothing, and only says whether something is in the way.
"""
import argparse
import base64
import gzip
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
import zipfile
from pathlib import Path

import spdx

ROOT = spdx.ROOT
PARTS = ("source", "sdist", "wheel", "npm", "crate", "deb", "windows")
EARLIEST = 315532800  # 1980, before which a zip has no dates


def fail(why):
    sys.exit(f"release: {why}")


def run(*command, **options):
    """What a command prints; its failure ends this program with what it said."""
    words = [str(word) for word in command]
    try:
        done = subprocess.run(words, capture_output=True, check=False, **options)
    except FileNotFoundError:
        fail(f"{words[0]} is missing: `bash cmake/bootstrap.sh release` installs what is needed")
    if done.returncode != 0:
        said = (done.stdout + done.stderr).decode(errors="replace")[-4000:]
        fail(f"{' '.join(words)} ended with {done.returncode}\n{said}")
    return done.stdout


def git(*words):
    return run("git", "-c", f"safe.directory={ROOT}", "-C", ROOT, *words)


def only(folder, pattern, what):
    """The one file of a folder that a pattern finds."""
    found = sorted(folder.glob(pattern))
    if len(found) != 1:
        fail(f"{folder}: has {len(found)} files {pattern} for one: {what}")
    return found[0]


class Release:
    def __init__(self, work, changed):
        self.work = work
        self.changed = changed
        self.made = work / "made"
        self.made.mkdir()
        self.commit = git("rev-parse", "HEAD").decode().strip()
        self.epoch = max(int(git("log", "-1", "--format=%ct")), EARLIEST)
        os.environ.update(SOURCE_DATE_EPOCH=str(self.epoch), TZ="UTC", LC_ALL="C.UTF-8")
        os.umask(0o022)
        listed = git("show", "HEAD:CMakeLists.txt").decode()
        self.version = re.search(r"project\(Pacini VERSION ([0-9.]+)", listed)[1]
        self.packages = []
        self.name = f"pacini-{self.version}"
        archive = git("archive", "--format=tar", f"--prefix={self.name}/", "HEAD")
        self.archive = gzip.compress(archive, 9, mtime=0)
        tar = work / "source.tar"
        tar.write_bytes(archive)
        run("tar", "-xf", tar, "-C", work)
        self.sources = work / self.name

    def built(self, preset):
        """The folder of a preset, if it was built of this commit."""
        folder = ROOT / "build" / preset
        header = folder / "Source/commit/Commit.h"
        if not header.exists():
            fail(f"{folder} is not built")
        if not self.changed and f'"{self.commit[:12]}"' not in header.read_text(encoding="utf-8"):
            fail(f"{folder} was built of another commit")
        return folder

    def keep(self, kind, path, name=None):
        target = self.made / (name or path.name)
        if path != target:
            shutil.copyfile(path, target)
        self.packages.append((kind, target))

    def source(self):
        path = self.made / f"{self.name}-source.tar.gz"
        path.write_bytes(self.archive)
        self.keep("source", path)

    def make_sdist(self):
        folder = self.work / "sdist"
        if not folder.exists():
            folder.mkdir()
            script = f"from scikit_build_core.build import build_sdist; build_sdist({str(folder)!r})"
            run(sys.executable, "-c", script, cwd=self.sources)
        return only(folder, f"{self.name}.tar.gz", "the sdist")

    def sdist(self):
        self.keep("sdist", self.make_sdist())

    def wheel(self, python=sys.executable):
        """Of the sdist, as for those who have no wheel for their Python; at a place where ccache knows its objects.
        `python` is the interpreter that it is for, with what builds it."""
        place = ROOT / "build/wheel-of-release"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        with tarfile.open(self.make_sdist()) as archive:
            archive.extractall(place)
        folder = Path(tempfile.mkdtemp(dir=self.work))
        run(python, "-m", "pip", "wheel", place / self.name, "--no-deps", "--no-build-isolation", "-q",
            "--disable-pip-version-check", "-w", folder)
        tools = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
        run(sys.executable, "-m", "auditwheel", "repair", only(folder, "*.whl", "the wheel"), "-w", folder / "repaired",
            env={**os.environ, "PATH": tools})
        shutil.rmtree(place)
        wheel = only(folder / "repaired", "*.whl", "the wheel with its libraries")
        path = self.made / wheel.name
        self.with_licences(wheel, path)
        self.keep("wheel", path)

    def with_licences(self, wheel, path):
        """A wheel with what Debian says of each library in it, in order and with one date."""
        known = spdx.contents()
        owners = spdx.owners_of_libraries(wheel, known)  # also of what else is compiled in, such as {fmt}
        with zipfile.ZipFile(wheel) as archive:
            files = {info.filename: (archive.read(info), info.external_attr) for info in archive.infolist()
                     if not info.is_dir()}
        information = f"{self.name}.dist-info"
        for owner in owners:
            package = known["components"][owner]["debian"]
            text = Path("/usr/share/doc") / package / "copyright"
            if not text.is_file():
                fail(f"{text}: the licence of a library in the wheel is missing")
            files[f"{information}/licenses/libraries/{package}.txt"] = (text.read_bytes(), 0o644 << 16)
        record = f"{information}/RECORD"
        del files[record]
        lines = []
        for name in sorted(files):
            data = files[name][0]
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            lines.append(f"{name},sha256={digest},{len(data)}\n")
        files[record] = ("".join([*lines, f"{record},,\n"]).encode(), 0o644 << 16)
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
            for name in sorted(files, key=lambda name: (name == record, name)):
                info = zipfile.ZipInfo(name, time.gmtime(self.epoch)[:6])
                info.compress_type, info.external_attr = zipfile.ZIP_DEFLATED, files[name][1]
                archive.writestr(info, files[name][0])

    def npm(self):
        package = ROOT / "build/web/package"
        if not (package / "encode.wasm").exists():
            fail(f"{ROOT / 'build/web'} is not built")
        run("npm", "pack", package, "--silent", "--offline", "--pack-destination", self.work)
        self.keep("npm", only(self.work, f"{self.name}.tgz", "the package for npm"))

    def crate(self):
        folder = self.work / "crate"
        shutil.copytree(self.sources / "Source/library/bindings/rust", folder)
        shutil.copy(self.sources / "LICENSE", folder)
        run("cargo", "package", "--quiet", "--offline", "--allow-dirty", "--manifest-path", folder / "Cargo.toml",
            "--target-dir", self.work / "cargo")  # which compiles what it has packed
        self.keep("crate", only(self.work / "cargo/package", f"{self.name}.crate", "the crate"))

    def deb(self):
        configuration = self.built("release") / "CPackConfig.cmake"
        run("cpack", "-G", "DEB", "--config", configuration, "-B", self.work / "deb")
        self.keep("deb", only(self.work / "deb", f"pacini_{self.version}_*.deb", "the Debian package"))

    def windows(self):
        folder = self.built("windows") / "package"
        self.keep("zip", only(folder, f"{self.name}-windows.zip", "the zip for Windows"))
        self.keep("setup", only(folder, f"{self.name}-windows-setup.exe", "the installer for Windows"))

    def finish(self, folder):
        """The list and the checksums, and all of it in `folder` in the place of an earlier release."""
        text = spdx.document(self.packages, self.version, self.commit, self.epoch)
        (self.made / f"{self.name}.spdx.json").write_text(text, encoding="utf-8")
        files = sorted(path.name for path in self.made.iterdir())
        sums = [f"{hashlib.sha256((self.made / name).read_bytes()).hexdigest()}  {name}\n" for name in files]
        for name in earlier(folder):
            (folder / name).unlink()
        folder.mkdir(parents=True, exist_ok=True)
        for name in files:
            shutil.move(self.made / name, folder / name)
        (folder / "SHA256SUMS").write_text("".join(sums), encoding="utf-8")
        for name in files:
            print(f"{(folder / name).stat().st_size:>11,}  {name}")


def earlier(folder):
    """The files of an earlier release in `folder`; anything else there ends this program."""
    if not folder.exists():
        return []
    if not folder.is_dir():
        fail(f"{folder}: is not a folder")
    sums = folder / "SHA256SUMS"
    lines = sums.read_text(encoding="utf-8").splitlines() if sums.exists() else []
    listed = {line.partition("  ")[2] for line in lines}
    found = {path.name for path in folder.iterdir()}
    foreign = sorted(found - listed - {"SHA256SUMS"})
    if foreign:
        fail(f"{folder}: holds {foreign[0]}, which is of no release; name another folder")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--parts", default=",".join(PARTS), help="some of them, separated by commas")
    parser.add_argument("--check", action="store_true", help="make nothing, only say whether something is in the way")
    parser.add_argument("--changed", action="store_true", help="although files differ from the commit")
    options = parser.parse_args()
    parts = options.parts.split(",")
    for part in parts:
        if part not in PARTS:
            fail(f"'{part}' is no part of a release; there are {', '.join(PARTS)}")
    if not (ROOT / ".git").exists():
        fail(f"{ROOT}: is no checkout of Git, of which a release is made")
    changed = git("status", "--porcelain", "--untracked-files=no").decode().splitlines()
    if changed and not options.changed:
        fail(f"{changed[0][3:]}: differs from the commit; commit it first")
    folder = options.folder.resolve()
    earlier(folder)
    if options.check:
        return
    with tempfile.TemporaryDirectory() as work:
        release = Release(Path(work), options.changed)
        try:
            for part in PARTS:
                if part in parts:
                    getattr(release, part)()
            release.finish(folder)
        except spdx.Unknown as error:
            fail(error)


if __name__ == "__main__":
    main()
