"""The site of all documentation: it is made, has everything that can be called, and no link that leads nowhere."""

import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["PACINI_SOURCE_DIR"])
MAKER = SOURCE / "Resources/docs/make_site.py"


@unittest.skipUnless(
    importlib.util.find_spec("mkdocs") and importlib.util.find_spec("mkdocstrings"),
    "MkDocs and mkdocstrings are missing",
)
class Site(unittest.TestCase):
    def make(self, maker=MAKER):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        site = Path(folder.name) / "site"
        done = subprocess.run([sys.executable, "-B", str(maker), str(site)], capture_output=True, text=True)
        return done, site

    def test_every_page_and_everything_that_can_be_called_is_in_it(self):
        done, site = self.make()
        self.assertEqual(done.returncode, 0, done.stderr[-4000:])
        for page in (SOURCE / "Resources/docs").glob("*.md"):
            self.assertTrue((site / page.with_suffix(".html").name).exists(), page.name)
        index = (site / "index.html").read_text()
        self.assertTrue("Sound to touch" in index)
        c = re.sub(r"<[^>]*>", "", (site / "api-c.html").read_text())
        for function in re.findall(
            r"PACINI_API \w+[ *]+(pacini_\w+)\(", (SOURCE / "Source/library/include/pacini.h").read_text()
        ):
            self.assertTrue(function + "(" in c, function)
        import pacini

        python = (site / "api-python.html").read_text()
        for name in pacini.__all__:
            self.assertTrue(f'id="pacini.{name}"' in python, name)
        cpp = (site / "api-cpp.html").read_text()
        for header in (SOURCE / "Core/pacini").rglob("*.h"):
            name = f"pacini/{header.relative_to(SOURCE / 'Core/pacini')}"
            self.assertTrue(name in cpp, name)
        for declared in ("struct Scene", "class Decoder", "compilePlan"):
            self.assertTrue(declared in re.sub(r"<[^>]*>", "", cpp), declared)

    def test_a_link_that_leads_nowhere_is_an_error(self):
        text = MAKER.read_text()
        with tempfile.TemporaryDirectory() as folder:
            for broken in ("[gone](nowhere.md)", "[gone](scenes.md#nowhere)"):
                changed = text.replace(
                    '"# The package for Python\\n\\n', f'"# The package for Python\\n\\n{broken}\\n\\n'
                )
                self.assertNotEqual(changed, text)
                maker = Path(folder) / "Resources" / "docs" / "make_site.py"
                maker.parent.mkdir(parents=True, exist_ok=True)
                maker.write_text(
                    changed.replace("ROOT = Path(__file__).resolve().parents[2]", f"ROOT = Path({str(SOURCE)!r})")
                )
                done, _ = self.make(maker)
                self.assertNotEqual(done.returncode, 0, broken)
                self.assertIn("nowhere", done.stderr)


if __name__ == "__main__":
    unittest.main()
