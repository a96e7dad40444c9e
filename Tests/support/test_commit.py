"""cmake/WriteCommit.cmake: the commit that `pacini --version` names, in a checkout, in an archive, and where nobody
knows."""
import re
import subprocess
import unittest
from pathlib import Path

from folder_test import FolderTest

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "cmake/WriteCommit.cmake"


class Commit(FolderTest):
    def setUp(self):
        super().setUp()
        self.source = self.folder / "pacini"
        (self.source / "cmake").mkdir(parents=True)
        for name in (".gitattributes", "cmake/commit.txt"):
            (self.source / name).write_bytes((ROOT / name).read_bytes())
        (self.source / "code.h").write_text("int a;\n")

    def git(self, *words, folder=None):
        return subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.com", *words], check=True,
                              cwd=folder or self.source, capture_output=True).stdout

    def committed(self, folder=None):
        self.git("init", "-q", folder=folder)
        self.git("add", ".", folder=folder)
        self.git("commit", "-qm", "a", folder=folder)
        return self.git("rev-parse", "HEAD", folder=folder).decode()[:12]

    def told(self, source=None):
        header = self.folder / "Commit.h"
        subprocess.run(["cmake", f"-DSOURCE={source or self.source}", f"-DHEADER={header}", "-P", SCRIPT], check=True)
        [commit] = re.findall(r'#define PACINI_COMMIT "(.*)"\n', header.read_text())
        return commit

    def test_a_checkout_tells_its_commit_and_whether_files_differ(self):
        commit = self.committed()
        self.assertRegex(commit, "^[0-9a-f]{12}$")
        self.assertEqual(self.told(), commit)
        (self.source / "new.h").write_text("int b;\n")
        self.assertEqual(self.told(), commit)
        (self.source / "code.h").write_text("int b;\n")
        self.assertEqual(self.told(), f"{commit}, changed")

    def test_an_archive_tells_the_commit_that_it_was_made_of(self):
        commit = self.committed()
        unpacked = self.folder / "other/pacini"
        unpacked.mkdir(parents=True)
        subprocess.run(["tar", "-x", "-C", unpacked], input=self.git("archive", "HEAD"), check=True)
        self.assertEqual(self.told(unpacked), commit)
        self.assertNotEqual(self.committed(self.folder / "other"), commit)  # within another checkout, too
        self.assertEqual(self.told(unpacked), commit)

    def test_elsewhere_there_is_none(self):
        self.assertEqual(self.told(), "")
        self.committed(self.folder)  # of another project
        self.assertEqual(self.told(), "")

    def test_the_header_stays_as_it_is_while_the_commit_does(self):
        self.committed()
        self.told()
        header = self.folder / "Commit.h"
        before = header.stat().st_mtime_ns
        self.told()
        self.assertEqual(header.stat().st_mtime_ns, before)


if __name__ == "__main__":
    unittest.main()
