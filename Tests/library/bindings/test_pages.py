"""The pages show code of files that tests run: line by line, so that they cannot drift apart."""
import re
import unittest

from bindings import BINDINGS, ROOT

PAGES = ROOT / "Resources/docs"
ONE_EACH = ["csharp", "godot", "lua", "node", "rust", "sdl"]
# A paragraph that ends with the name of a file, and the block below it.
SHOWN = re.compile(r"`([\w./~-]+\.\w+)`:\n\n((?:(?:    .*)?\n)+)")


def blocks(page):
    """(file, lines) of each; '...' stands for lines that are left out."""
    for path, block in SHOWN.findall((PAGES / page).read_text(encoding="utf-8") + "\n"):
        file = next((place / path for place in (ROOT, BINDINGS) if (place / path).is_file()), None)
        yield path, file, [line.strip() for line in block.splitlines() if line.strip()]


def missing(source, lines):
    """The first line that is not where it is shown to be; None when all are."""
    at, gap = 0, True
    for line in lines:
        if line == "...":
            gap = True
            continue
        try:
            found = source.index(line, at)
        except ValueError:
            return line
        if found != at and not gap:
            # The line may be there again, after one that was found too early.
            return line
        at, gap = found + 1, False
    return None


class Pages(unittest.TestCase):
    def shows(self, page):
        found = list(blocks(page))
        for path, file, lines in found:
            with self.subTest(page=page, file=path):
                self.assertIsNotNone(file, "there is no such file")
                source = [line.strip() for line in file.read_text(encoding="utf-8").splitlines() if line.strip()]
                # From each place where the first line is, as it may be there more than once.
                starts = [i for i, line in enumerate(source) if line == lines[0]]
                self.assertTrue(starts, f"{lines[0]!r} is not there")
                answers = [missing(source[start:], lines) for start in starts]
                self.assertIn(None, answers, f"is not shown as it is: {answers}")
        return found

    def test_a_first_vibration_takes_ten_lines_of_c_csharp_and_lua(self):
        found = {file.suffix: lines for _, file, lines in self.shows("runtime.md")}
        self.assertEqual(set(found), {".c", ".cs", ".lua"})
        for suffix, lines in found.items():
            self.assertLessEqual(len([line for line in lines if line != "..."]), 10, suffix)

    def test_each_page_shows_what_tests_run(self):
        for name in ONE_EACH:
            self.assertGreaterEqual(len(self.shows(f"{name}.md")), 1, name)

    def test_the_runtime_names_every_page_and_every_binding_has_one(self):
        runtime = (PAGES / "runtime.md").read_text(encoding="utf-8")
        for name in [*ONE_EACH, "engines"]:
            self.assertIn(f"]({name}.md)", runtime)
        said = "".join((PAGES / f"{name}.md").read_text(encoding="utf-8") for name in ONE_EACH)
        for folder in BINDINGS.iterdir():
            self.assertIn(f"Source/library/bindings/{folder.name}", said)

    def test_what_is_not_tried_says_so_at_its_beginning(self):
        for path in (PAGES / "engines.md", BINDINGS / "godot/godot4/pacini_extension.cpp"):
            self.assertRegex(path.read_text(encoding="utf-8")[:400], r"(?i)\bnot tried\b")

    def test_a_line_that_drifted_is_found(self):
        source = ["a", "b", "c", "d"]
        self.assertIsNone(missing(source, ["a", "b", "...", "d"]))
        self.assertEqual(missing(source, ["a", "c"]), "c")
        self.assertEqual(missing(source, ["a", "...", "x"]), "x")
        self.assertEqual(missing(source, ["b", "a"]), "a")


if __name__ == "__main__":
    unittest.main()
