"""`bash cmake/bootstrap.sh release`: names, versions, checksums and the list of licences of what it packs, and the same
bytes when it packs again. What takes minutes to build is packed of what is there already."""
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
PYTHON = SOURCE / "build/python-venv/bin/python"
sys.path.insert(0, str(SOURCE / "cmake"))
import spdx  # noqa: E402

[VERSION] = re.findall(r"project\(Pacini VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())
LARGEST = {f"pacini-{VERSION}-source.tar.gz": 20_000_000, f"pacini-{VERSION}.tar.gz": 10_000_000,
           f"pacini-{VERSION}.crate": 100_000, f"pacini-{VERSION}.tgz": 2_000_000}
SOURCES = {f"pacini-{VERSION}-source.tar.gz", f"pacini-{VERSION}.tar.gz", f"pacini-{VERSION}.crate"}
BESIDE = {f"pacini-{VERSION}.spdx.json", "SHA256SUMS"}
# Debian's packages whose headers are compiled in, and the components that they are.
COMPILED_IN = {"libeigen3-dev": "eigen", "nlohmann-json3-dev": "json", "libcli11-dev": "cli11", "libfmt-dev": "fmt",
               "libboost-dev": "boost", "juce-modules-source-data": "juce"}
# Headers of shared libraries, and of what is opened at run time: these are not in the package.
SHARED = set("""libc6-dev linux-libc-dev libstdc++-dev libasound2-dev libcairo2-dev libexpat1-dev libfreetype-dev
    libebur128-dev libhidapi-dev
    libjack-jackd2-dev libjpeg62-turbo-dev libpng-dev libpulse-dev libqrcodegencpp-dev librtaudio-dev libsndfile1-dev
    libx11-dev libxcursor-dev libxext-dev libxinerama-dev libxrandr-dev libxrender-dev libzip-dev x11proto-dev
    zlib1g-dev""".split())


def said(*command, **options):
    """What a command prints that must succeed."""
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


def release(root, folder, *options, python=sys.executable, **environment):
    command = [python, "-B", root / "cmake/make_release.py", folder, *options]
    return subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **environment})


def sums(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir()}


def licences_of(expression):
    return set(expression.split(" AND "))


class FolderTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def made(self, *words, **options):
        done = release(*words, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def check(self, folder, expected, commit):
        """What holds for every release."""
        names = {path.name for path in folder.iterdir()}
        self.assertEqual(names, expected | BESIDE)
        subprocess.run(["sha256sum", "--check", "--quiet", "--strict", "SHA256SUMS"], cwd=folder, check=True)
        self.assertEqual(len((folder / "SHA256SUMS").read_text().splitlines()), len(names) - 1)
        for name in expected:
            self.assertLess((folder / name).stat().st_size, LARGEST.get(name, 40_000_000), name)
        document = json.loads((folder / f"pacini-{VERSION}.spdx.json").read_text())
        self.assertIn(f"pacini-{VERSION}-{commit}", document["documentNamespace"])
        packed = {one["packageFileName"]: one for one in document["packages"] if "packageFileName" in one}
        self.assertEqual(set(packed), expected)
        parts = {one["SPDXID"]: one for one in document["packages"]}
        for name, one in packed.items():
            self.assertEqual(one["versionInfo"], VERSION)
            [told] = one["checksums"]
            self.assertEqual(told["checksumValue"], hashlib.sha256((folder / name).read_bytes()).hexdigest())
            inside = [parts[line["relatedSpdxElement"]] for line in document["relationships"]
                      if line["spdxElementId"] == one["SPDXID"] and line["relationshipType"] == "CONTAINS"]
            self.assertEqual(licences_of(one["licenseDeclared"]),
                             set.union(*(licences_of(part["licenseDeclared"]) for part in inside)), name)
        return document


class CheckoutTest(FolderTest):
    """A checkout of its own, of one commit."""

    def setUp(self):
        super().setUp()
        self.root = self.folder / "pacini"
        listed = subprocess.run(["git", "-c", f"safe.directory={SOURCE}", "ls-files", "-z", "--cached", "--others",
                                 "--exclude-standard"], cwd=SOURCE, check=True, capture_output=True).stdout
        for name in listed.decode().split("\0"):
            if name and (SOURCE / name).is_file():
                (self.root / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(SOURCE / name, self.root / name)
        self.git("init", "-q")
        self.git("add", ".")
        self.git("commit", "-qm", "all")
        self.commit = self.git("rev-parse", "HEAD").strip()

    def git(self, *words):
        return said("git", "-c", "user.name=a", "-c", "user.email=a@example.com", *words, cwd=self.root)


@unittest.skipUnless(PYTHON.exists(), "build/python-venv is missing: bash cmake/bootstrap.sh test installs it")
class Sources(CheckoutTest):
    """What is packed of the commit alone."""

    def test_the_sources_have_the_same_bytes_wherever_and_whenever_they_are_packed(self):
        parts = ("--parts", "source,sdist,crate")
        self.made(self.root, self.folder / "one", *parts, python=PYTHON)
        self.check(self.folder / "one", SOURCES, self.commit)
        moved = self.folder / "elsewhere/with another name"
        moved.parent.mkdir()
        self.root.rename(moved)
        shutil.copytree(self.folder / "one", self.folder / "two")  # replaced by the next one
        os.utime(moved / "README.md", (1, 1))
        old = os.umask(0o077)
        self.addCleanup(os.umask, old)
        self.made(moved, self.folder / "two", *parts, python=PYTHON, TZ="Asia/Tokyo", LC_ALL="C", SOURCE_DATE_EPOCH="5")
        self.assertEqual(sums(self.folder / "one"), sums(self.folder / "two"))

        with tarfile.open(self.folder / f"one/pacini-{VERSION}-source.tar.gz") as archive:
            members = {member.name: member for member in archive.getmembers()}
            commit = archive.extractfile(f"pacini-{VERSION}/cmake/commit.txt").read().decode().strip()
        self.assertEqual(commit, self.commit)
        self.assertIn(f"pacini-{VERSION}/Tests/package/test_release.py", members)
        self.assertFalse([name for name in members if "/.git/" in name or "/build/" in name])
        with tarfile.open(self.folder / f"one/pacini-{VERSION}.tar.gz") as archive:
            information = archive.extractfile(f"pacini-{VERSION}/PKG-INFO").read().decode()
        self.assertIn(f"\nVersion: {VERSION}\n", information)
        with tarfile.open(self.folder / f"one/pacini-{VERSION}.crate") as archive:
            names = archive.getnames()
            manifest = archive.extractfile(f"pacini-{VERSION}/Cargo.toml").read().decode()
        self.assertIn(f'version = "{VERSION}"', manifest)
        for name in ("LICENSE", "build.rs", "src/lib.rs"):
            self.assertIn(f"pacini-{VERSION}/{name}", names)

    def fails(self, words, *wanted):
        done = release(self.root, *words)
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stderr.startswith("release: "), done.stderr)
        for text in wanted:
            self.assertIn(text, done.stderr)

    def test_what_is_in_the_way_is_told_and_nothing_is_made(self):
        target = self.folder / "made"
        self.fails([target, "--parts", "source,rpm"], "'rpm' is no part of a release; there are source, sdist, wheel")
        self.fails([target, "--parts", "npm"], "build/web is not built")
        self.fails([target, "--parts", "deb"], "build/release is not built")
        self.fails([target, "--parts", "source,windows"], "build/windows is not built")
        self.assertFalse(target.exists())
        header = self.root / "build/release/Source/commit/Commit.h"
        header.parent.mkdir(parents=True)
        header.write_text('#define PACINI_COMMIT "0123456789ab"\n')
        self.fails([target, "--parts", "deb"], "build/release was built of another commit")
        target.mkdir()
        (target / "letter.txt").write_text("mine")
        self.fails([target, "--parts", "source"], "made: holds letter.txt, which is of no release; name another folder")
        self.fails([target, "--check"], "letter.txt")
        self.fails([target / "letter.txt", "--parts", "source"], "letter.txt: is not a folder")
        self.assertEqual([path.name for path in target.iterdir()], ["letter.txt"])
        (self.root / "README.md").write_text("changed")
        self.fails([self.folder / "other", "--check"], "README.md: differs from the commit; commit it first")
        shutil.rmtree(self.root / ".git")
        self.fails([self.folder / "other", "--check"], "is no checkout of Git")


class Compiled(CheckoutTest):
    """What is compiled. ccache compiles most of it once for all checkouts, unless a path of one is among the options;
    what is linked, archived and written by the build is made anew."""

    PROGRAMS = ["pacini", "pacini_library", "pacini_library_static"]

    def build(self, root, **environment):
        """Name to bytes of what is built."""
        environment = {**os.environ, **environment}
        said("cmake", "--preset", "release", cwd=root, env=environment)
        said("ninja", "-C", "build/release", "-j2", *self.PROGRAMS, cwd=root, env=environment)
        build = root / "build/release"
        return {path.name: path.read_bytes() for path in [build / "bin/pacini", *sorted((build / "lib").iterdir())]}

    def test_the_command_and_the_library_have_the_same_bytes_wherever_and_whenever_they_are_built(self):
        one = self.build(self.root)
        self.assertLessEqual({"pacini", "libpacini.so", "libpacini.a"}, set(one))
        other = self.folder / "elsewhere/with another name"
        said("git", "clone", "-q", self.root, other)
        mask = os.umask(0o077)
        self.addCleanup(os.umask, mask)
        # Not in another language, for which ccache would compile all of it again.
        two = self.build(other, TZ="Asia/Tokyo", USER="somebody", SOURCE_DATE_EPOCH="5")
        self.assertEqual(set(one), set(two))
        # The path of a source and the time are what ccache would hide.
        hidden = "__(FILE|DATE|TIME|TIMESTAMP)__|source_location"
        found = subprocess.run(["git", "grep", "-nE", hidden, "--", "Core", "Source"], cwd=other, capture_output=True)
        self.assertEqual((found.returncode, found.stdout), (1, b""))
        self.assertEqual([name for name in one if one[name] != two[name]], [])
        for name, data in one.items():
            self.assertNotIn(os.fsencode(self.root), data, name)


class BuiltTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.commit = said("git", "-c", f"safe.directory={SOURCE}", "rev-parse", "HEAD", cwd=SOURCE).strip()

    def twice(self, parts):
        """What is packed of what is built, in the same bytes when it is packed again."""
        for name, zone in (("one", "UTC"), ("two", "Asia/Tokyo")):
            self.made(SOURCE, self.folder / name, "--changed", "--parts", parts, python=PYTHON, TZ=zone, LC_ALL="C")
        self.assertEqual(sums(self.folder / "one"), sums(self.folder / "two"))
        return self.folder / "one"

    def packages_of_headers(self, build):
        """Debian's packages, without their numbers, that have the headers of our sources and of JUCE."""
        headers = set()
        for entry in said("ninja", "-C", build, "-t", "deps").split("\n\n"):
            if entry.startswith(("Source/", "juce/")):
                headers |= set(re.findall(r"^    (/usr/(?:include|share)/\S+)", entry, re.M))
        owners = said("dpkg-query", "--search", *sorted(headers)).splitlines()
        names = {word.partition(":")[0] for line in owners if not line.startswith("diversion ")
                 for word in line.rpartition(": ")[0].split(", ")}
        return {re.sub(r"^(libboost|libstdc\+\+)[\d.-]+-dev", r"\1-dev", name) for name in names}


@unittest.skipUnless(PYTHON.exists() and (SOURCE / "build/release/CPackConfig.cmake").exists()
                     and (SOURCE / "build/web/package/encode.wasm").exists(),
                     "build/release, build/web or build/python-venv is missing: bootstrap.sh slow-tests makes them")
class Built(BuiltTest):
    def test_the_packages_are_named_alike_complete_and_the_same_when_packed_again(self):
        folder = self.twice("wheel,npm,deb")
        architecture = said("dpkg", "--print-architecture").strip()
        names = {path.name for path in folder.iterdir()} - BESIDE
        [wheel] = [name for name in names if name.endswith(".whl")]
        self.assertRegex(wheel, rf"^pacini-{re.escape(VERSION)}-cp3\d+-cp3\d+-manylinux_[\w.]+\.whl$")
        npm, deb = f"pacini-{VERSION}.tgz", f"pacini_{VERSION}_{architecture}.deb"
        self.assertEqual(names, {wheel, npm, deb})
        document = self.check(folder, names, self.commit)

        tree = self.folder / "tree"
        subprocess.run(["dpkg-deb", "--extract", folder / deb, tree], check=True)
        version = said(tree / "usr/bin/pacini", "--version")
        self.assertRegex(version, rf"^pacini {re.escape(VERSION)} \(commit {self.commit[:12]}(, changed)?\)\n$")
        with tarfile.open(folder / npm) as archive:
            self.assertEqual(json.load(archive.extractfile("package/package.json"))["version"], VERSION)
            self.assertIn("package/LICENSE", archive.getnames())
        self.check_wheel(folder / wheel)
        sizes = {part["name"]: part.get("versionInfo") for part in document["packages"]}
        for name in ("JUCE", "Eigen", "libsndfile", "libc++, libc++abi and compiler-rt for WebAssembly"):
            self.assertRegex(sizes[name], r"\d+\.\d+", name)
        self.check_validator(folder / f"pacini-{VERSION}.spdx.json")

    def check_wheel(self, path):
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            metadata = archive.read(f"pacini-{VERSION}.dist-info/METADATA").decode()
            self.assertIsNone(archive.testzip())
        self.assertIn(f"\nVersion: {VERSION}\n", metadata)
        self.assertIn(f"pacini-{VERSION}.dist-info/licenses/libraries/libsndfile1.txt", names)
        libraries = [name for name in names if name.startswith("pacini.libs/")]
        texts = [name for name in names if "/licenses/libraries/" in name]
        self.assertEqual(len(libraries), len(texts))
        site = self.folder / "site"
        # This compares each file with the wheel's record.
        said(PYTHON, "-m", "pip", "install", "-q", "--disable-pip-version-check", "--no-deps", "--target", site, path)
        script = f"import pacini; assert pacini.__version__ == {VERSION!r}; print(pacini.__file__)"
        self.assertIn(str(site), said(PYTHON, "-c", script, env={**os.environ, "PYTHONPATH": str(site)}))

    def check_validator(self, path):
        program = PYTHON.parent / "pyspdxtools"
        if not program.exists():
            self.skipTest("spdx-tools is missing: bash cmake/bootstrap.sh slow-tests installs it")
        command = [program, "--infile", path, "--version", "SPDX-2.3"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""))

    def test_whose_headers_are_compiled_in_is_listed(self):
        names = self.packages_of_headers(SOURCE / "build/release")
        self.assertEqual(names - set(COMPILED_IN) - SHARED, set())
        self.assertLess(set(COMPILED_IN), names)
        self.assertLessEqual(set(COMPILED_IN.values()), set(spdx.contents()["packages"]["deb"]))


if __name__ == "__main__":
    unittest.main()
