"""cmake/bootstrap.sh where its packages cannot be had, and what it and the presets build for users."""
import json
import os
import re
import subprocess
import unittest
from pathlib import Path

from folder_test import FolderTest

ROOT = Path(__file__).resolve().parents[2]
BOOTSTRAP = ROOT / "cmake" / "bootstrap.sh"
DOCUMENTS = "\n".join(path.read_text(encoding="utf-8") for path in
                      [*ROOT.glob("*.md"), *(ROOT / "Resources/docs").glob("*.md")])


class Bootstrap(FolderTest):
    """With programs of our own in the place of the system's: nothing is installed."""

    def setUp(self):
        super().setUp()
        self.log = self.folder / "log"
        self.program("dpkg-query", "exit 1")  # nothing is installed
        self.program("id", "echo 0")
        self.program("sleep", "exit 0")
        self.program("cmake", "exit 0")

    def program(self, name, script):
        path = self.folder / name
        path.write_text(f'#!/bin/sh\necho "{name} $*" >>{self.log}\n{script}\n')
        path.chmod(0o755)

    def run_bootstrap(self, *arguments, **environment):
        done = subprocess.run(["bash", BOOTSTRAP, *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=60, env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}", **environment})
        return done, self.log.read_text().splitlines() if self.log.exists() else []

    def test_what_apt_says_is_shown_when_it_fails(self):
        self.program("apt-get", 'case "$*" in *install*) echo "E: Sub-process dpkg returned an error"; '
                                'echo "no space left" >&2; exit 100;; esac')
        done, calls = self.run_bootstrap("build")
        self.assertEqual(done.returncode, 1)
        for words in ("E: Sub-process dpkg returned an error\n", "no space left\n", "bootstrap: apt-get cannot install"):
            self.assertIn(words, done.stderr)
        [install] = [call for call in calls if "apt-get" in call and " install " in call]
        self.assertRegex(install, r"-o DPkg::Lock::Timeout=\d{2,}")

    def test_apt_is_silent_when_all_is_well(self):
        self.program("apt-get", "echo chatter; echo chatter >&2")
        done, _ = self.run_bootstrap("build")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("chatter", done.stdout + done.stderr)

    def test_a_lock_on_the_lists_of_packages_is_waited_for(self):
        self.program("apt-get", f'case "$*" in *update*) [ -e {self.folder}/free ] || {{ touch {self.folder}/free; '
                                'echo "E: Could not get lock /var/lib/apt/lists/lock."; exit 100; } ;; *) exit 100;; esac')
        done, calls = self.run_bootstrap("build")
        self.assertEqual(len([call for call in calls if call.endswith(" update")]), 2)
        self.assertNotIn("Could not get lock", done.stderr)

    def test_lists_that_cannot_be_had_are_not_the_end(self):
        self.program("apt-get", 'case "$*" in *update*) echo "E: one source is gone"; exit 100;; *) echo later; exit 100;; esac')
        done, calls = self.run_bootstrap("build")
        self.assertIn("E: one source is gone", done.stderr)
        self.assertTrue(any(" install " in call for call in calls))

    def test_who_may_not_install_is_told_what_is_missing(self):
        self.program("id", "echo 1000")
        for name in ("bash", "sed", "dirname", "uname", "grep", "apt-get"):
            if not (self.folder / name).exists():
                (self.folder / name).symlink_to(f"/usr/bin/{name}")
        done, _ = self.run_bootstrap("build", PATH=str(self.folder))
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"missing and neither root nor sudo is at hand: .*nlohmann-json3-dev")

    def test_a_disk_without_room_is_told_before_anything_is_built(self):
        self.program("dpkg-query", "echo installed")
        self.program("df", 'echo "Filesystem blocks Used Available Capacity Mounted"; echo "disk 1 1 7 99% /"')
        self.program("du", 'printf "0\\tbuild\\n"')  # nothing is built yet
        done, calls = self.run_bootstrap("build")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"bootstrap: building needs about \d+ MB in .*, but only 7 MB are free")
        self.assertFalse([call for call in calls if call.startswith("cmake")])

    def test_one_command_builds_all_that_people_run(self):
        self.program("dpkg-query", "echo installed")
        done, calls = self.run_bootstrap("plugin")
        self.assertEqual(done.returncode, 0, done.stderr)
        [build] = [call for call in calls if "--build" in call]
        self.assertTrue(build.endswith("--target pacini pacini_plugin_All pacini_editor_app"), build)

    def test_one_command_makes_the_package_of_it(self):
        self.program("dpkg-query", "echo installed")
        self.program("cpack", "exit 1")
        done, calls = self.run_bootstrap("package")
        [build] = [call for call in calls if "--build" in call]
        self.assertTrue(build.endswith("pacini pacini_plugin_All pacini_editor_app pacini-bench pacini_library pacini_library_static pacini_texts"), build)
        self.assertRegex(calls[-1], r"^cpack -G DEB --config build/release/CPackConfig.cmake -B \S+/build/package$")
        self.assertEqual(done.returncode, 1)
        self.assertIn("bootstrap: cannot make the package", done.stderr)

    def test_a_release_is_packed_after_all_is_built_and_refused_before(self):
        self.program("dpkg-query", "echo installed")
        self.program("python3", 'case "$*" in *--check*) echo "release: in the way" >&2; exit 1;; esac')
        done, calls = self.run_bootstrap("release")
        self.assertEqual((done.returncode, done.stderr), (1, "release: in the way\n"))
        self.assertFalse([call for call in calls if call.startswith("cmake")], calls)
        script = re.search(r"(?ms)^release\)$.*?;;", BOOTSTRAP.read_text()).group(0)
        steps = [script.index(step) for step in ("--check", "build_programs", "build_web", "build_windows",
                                                 "build/python-venv/bin/python -B cmake/make_release.py")]
        self.assertEqual(steps, sorted(steps))

    def test_all_its_commands_are_those_of_its_help_and_the_documents(self):
        shown = subprocess.run(["bash", BOOTSTRAP, "help"], capture_output=True, text=True, check=True).stdout
        commands = set(re.findall(r"bootstrap\.sh (\w+)", shown))
        self.assertEqual(commands, {"demo", "test", "build", "plugin", "package", "web", "windows", "release", "wheels",
                                    "deps"})
        self.assertLessEqual(set(re.findall(r"bootstrap\.sh (\w+)", DOCUMENTS)), commands)
        for command in commands:
            self.assertRegex(BOOTSTRAP.read_text(), rf"(?m)^{command}\)$")


class Warnings(unittest.TestCase):
    def test_are_errors_in_no_build_but_that_of_ci(self):
        presets = json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]
        strict = [preset["name"] for preset in presets if "PACINI_WARNINGS_AS_ERRORS" in preset["cacheVariables"]]
        self.assertEqual(strict, ["ci"])
        self.assertFalse([preset["name"] for preset in presets if "ci" in preset.get("inherits", [])])
        for script in (BOOTSTRAP.read_text(), DOCUMENTS):
            self.assertNotRegex(script, r"Werror|WARNINGS_AS_ERRORS|preset ci\b")


class Sanitizers(unittest.TestCase):
    def test_every_room_of_tests_is_in_one_part(self):
        parts = re.findall(r"rooms_of_tests '(.*)'\)", BOOTSTRAP.read_text())
        self.assertEqual(len(parts), 3)
        rooms = {path.parent.relative_to(ROOT / "Tests").as_posix() for path in (ROOT / "Tests").rglob("*Test.cpp")}
        for room in sorted(rooms):
            if not re.match("(support|plugin|editor|library)(/|$)", room):  # have programs of their own
                with self.subTest(room):
                    self.assertEqual(sum(bool(re.search(part, room)) for part in parts), 1)


if __name__ == "__main__":
    unittest.main()
