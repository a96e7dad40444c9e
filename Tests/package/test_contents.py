"""Resources/package/contents.json: what is in the packages of a release and under which licences, and what is made of
it."""
import re
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "cmake"))
import spdx  # noqa: E402

[VERSION] = re.findall(r"project\(Pacini VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())
# Of the SPDX licence list.
LICENCES = {"MIT", "GPL-3.0-or-later", "GPL-3.0-only", "CC0-1.0", "LicenseRef-public-domain", "ISC", "BSD-3-Clause",
            "BSD-2-Clause", "MPL-2.0", "BSL-1.0", "Apache-2.0", "LGPL-2.1-or-later", "LGPL-2.1-only",
            "LGPL-2.0-or-later",
            "Zlib", "bzip2-1.0.6", "libpng-2.0", "IJG", "dtoa", "SunPro", "ZPL-2.1", "CPL-1.0", "Apache-2.0 WITH LLVM-exception",
            "GPL-3.0-or-later WITH GCC-exception-3.1"}


def licences_of(expression):
    return set(expression.split(" AND "))


class Contents(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.known = spdx.contents()
        self.told = spdx.stanzas((SOURCE / "Resources/package/copyright").read_text(encoding="utf-8"))

    def test_the_debian_package_holds_what_its_copyright_file_says(self):
        own = [self.known["components"][name] for name in self.known["packages"]["deb"]]
        self.assertEqual(sorted(one["stanza"] for one in own), sorted(self.told))
        text = (SOURCE / "Resources/package/copyright").read_text(encoding="utf-8")
        self.assertEqual(text.count("\nFiles:"), len(self.told))

    def test_every_licence_is_one_of_spdx_and_every_component_is_somewhere(self):
        known = self.known
        for name, one in known["components"].items():
            licence = self.told[one["stanza"]][1] if "stanza" in one else one["licence"]
            self.assertLessEqual(licences_of(licence), LICENCES, name)
        used = {name for names in known["packages"].values() for name in names} | set(known["files"].values())
        self.assertEqual(used, set(known["components"]))

    def zipped(self, *names):
        path = self.folder / "a.whl"
        with zipfile.ZipFile(path, "w") as archive:
            for name in names:
                archive.writestr(name, "a")
        return path

    def test_libraries_that_lie_in_a_package_are_found(self):
        wheel = self.zipped("pacini/__init__.py", "pacini.libs/libsndfile-01.so.1", "pacini.libs/libvorbisenc-02.so.2")
        found = spdx.components_of("wheel", wheel, self.known)
        self.assertEqual(found[-2:], ["sndfile", "vorbisenc"])

    def test_a_library_that_nobody_listed_is_an_error(self):
        wheel = self.zipped("pacini.libs/libsurprise-01.so.1")
        with self.assertRaisesRegex(spdx.Unknown, "libsurprise-01.so.1 is not in Resources/package/contents.json"):
            spdx.components_of("wheel", wheel, self.known)

    def test_what_makes_a_release_states_no_version(self):
        for path in ("cmake/make_release.py", "cmake/spdx.py"):
            self.assertNotIn(VERSION, (SOURCE / path).read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
