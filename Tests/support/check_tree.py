#!/usr/bin/env python3
"""Checks what lies in the repository: names at its top, sizes, binary files, and the version in every package.

check_tree.py ROOT       exit 1 and a list of broken rules, 77 where Git has no list of files, or exit 0
check_tree.py --selftest proves that broken rules are found
"""
import fnmatch
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = {
    ".ci", ".clang-format", ".clang-tidy", ".editorconfig", ".gitattributes", ".github", ".gitignore", "ARCHITECTURE.md",
    "CHANGELOG.md", "CITATION.cff", "CMakeLists.txt", "CMakePresets.json", "CONTRIBUTING.md", "Core", "LICENSE", "LICENSES",
    "README.md", "Resources", "SECURITY.md", "Source", "Tests", "cmake", "profiles", "pyproject.toml",
}
LARGEST = 400_000  # bytes
# Binary files, each with its reason.
BINARY = {
    "Resources/demo/*.flac": "demo sounds, each with its source in Resources/demo/SOURCES.md",
    "Resources/library/*.flac": "sounds of the library, made by us",
    "Resources/docs/*.png": "pictures of the documentation",
    "Tests/golden/editor/*.png": "blessed pictures of the windows",
    "Tests/io/audio/*": "a sound in each container that is read",
    "Tests/io/films/*": "a sound in each container that ffmpeg reads, whose headers are damaged",
    "Tests/analysis/*.wav": "a sentence by a speech synthesiser, which tests of the voice gate need",
    "Tests/io/broken/*": "documents with bytes that no text has",
    "Tests/fuzz/corpus/chapters/*": "tags and comments of sound files",
    "Tests/fuzz/corpus/hid/*": "descriptors of devices",
    "Tests/fuzz/corpus/hmpg/*": "MPEG haptics that its reference program made of our HJIF samples",
    "Tests/fuzz/corpus/packed/*": "packed clips",
    "Tests/fuzz/corpus/pulsar/*": "archives",
    "Tests/fuzz/corpus/*/sound-*": "headers of sound files",
    "Tests/fuzz/regressions/*/*": "inputs that broke a reader once",
}
# Where a package states the version; CMakeLists.txt states it for all of them.
VERSION = re.compile(r"project\(Pacini VERSION ([0-9.]+)")
STATED = {
    "CITATION.cff": r"^version: (.+)$",
    "Source/web/package/package.json": r'^  "version": "([^"]+)"',
    "Source/library/bindings/node/package.json": r'^  "version": "([^"]+)"',
    "Source/library/bindings/csharp/package.json": r'^  "version": "([^"]+)"',
    "Source/library/bindings/rust/Cargo.toml": r'^version = "([^"]+)"',
}


def is_binary(data):
    """As Git judges: a NUL byte among the first 8000."""
    return b"\0" in data[:8000]


def violations(root, tracked):
    for name in sorted({path.split("/")[0] for path in tracked} - TOP):
        yield f"{name}: this name may not stand at the top of the repository"
    for name in tracked:
        path = root / name
        if path.is_symlink() or not path.is_file():
            continue
        if path.stat().st_size > LARGEST:
            yield f"{name}: {path.stat().st_size} bytes are more than the {LARGEST} that a tracked file may have"
        if is_binary(path.read_bytes()) and not any(fnmatch.fnmatch(name, pattern) for pattern in BINARY):
            yield f"{name}: this binary file has no reason in check_tree.py"
    [version] = VERSION.findall((root / "CMakeLists.txt").read_text(encoding="utf-8"))
    for name, pattern in STATED.items():
        stated = re.findall(pattern, (root / name).read_text(encoding="utf-8"), re.M)
        if stated != [version]:
            yield f"{name}: states version {' and '.join(stated) or '(none)'}, CMakeLists.txt {version}"
    manifests = [name for name in tracked if name.rsplit("/", 1)[-1] in ("package.json", "Cargo.toml") and name not in STATED
                 and re.search(r'^\s*"?version"?\s*[:=]', (root / name).read_text(encoding="utf-8"), re.M)]
    for name in manifests:
        yield f"{name}: states a version that check_tree.py does not compare"


def selftest():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        files = {"CMakeLists.txt": b"project(Pacini VERSION 1.2.3 LANGUAGES CXX)\n", "Core/a.h": b"\n",
                 "Resources/demo/a.flac": b"fLaC\0"}
        forms = {"json": b'  "version": "1.2.3",\n', "cff": b"version: 1.2.3\n"}
        files |= {name: forms.get(name.rsplit(".", 1)[1], b'version = "1.2.3"\n') for name in STATED}

        def found(changed):
            for name, data in (files | changed).items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_bytes(data)
            return sorted(line.split(":")[0] for line in violations(root, sorted(files | changed)))

        if found({}):
            sys.exit("check_tree: a clean tree is refused")
        cases = {"wheel.whl": b"PK\0", "Core/large.h": b" " * (LARGEST + 1), "Core/tool": b"\x7fELF\0",
                 "Source/web/package/package.json": b'  "version": "1.2.2",\n', "Source/new/package.json": b'"version": "1.2.3"'}
        for name, data in cases.items():
            if name not in found({name: data}):
                sys.exit(f"check_tree: {name} is not found")
            (root / name).unlink()


def main():
    if sys.argv[1:] == ["--selftest"]:
        return selftest()
    root = Path(sys.argv[1])
    done = subprocess.run(["git", "-c", f"safe.directory={root}", "ls-files", "-z"], cwd=root, capture_output=True, text=True)
    if done.returncode != 0 or not done.stdout:
        print("SKIPPED: Git has no list of the files here")
        return 77
    found = list(violations(root, [name for name in done.stdout.split("\0") if name and (root / name).exists()]))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
