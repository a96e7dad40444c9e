"""The changes that mutate.py makes: which there are, that they can be switched, and that reasons are of lines that exist."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))
from changes import blamed, changes_of, in_place

TEXT = """\
#include <algorithm>
// a < b in a comment
constexpr double limit = 2.0;
template <int N>
int few(int a)
{
    return a < N;
}
constexpr int table[]{
    3,
    4,
};
double f(double a, double b, int n)
{
    double sum = std::max(a, 0.5);
    for (int i = 0; i < n && a != b; ++i)
        sum = sum + a * b;
    if (sum > limit)
        sum -= 1.0;
    sum = std::clamp(sum, 0.0, 10.0);
    return sum + table[1];
}
"""
PROGRAM = TEXT + """
#include <cstdio>
int main()
{
    std::printf("%g %g %g", f(1.0, 2.0, 2), f(9.0, 0.25, 3), f(0.25, 9.0, 0));
}
"""


class Changes(unittest.TestCase):
    def setUp(self):
        self.found = changes_of("f.h", TEXT)

    def test_every_kind_is_found_at_its_place(self):
        said = [f"{change.line} {change.what}" for change in self.found]
        for one in ["15 std::max -> std::min", "16 `<` -> `<=`", "16 nothing after `&&`", "16 `!=` -> `==`", "17 `+` -> `-`",
                    "17 `*` -> `/`", "17 without this statement", "18 `>` -> `>=`", "19 without this statement",
                    "20 no std::clamp", "20 without this statement"]:
            self.assertIn(one, said)
        self.assertTrue(any(one.startswith("3 `2.0` -> ") for one in said))
        self.assertTrue(any(one.startswith("11 `4` -> ") for one in said))
        self.assertTrue(any(one.startswith("18 if (") for one in said))

    def test_comments_and_what_the_compiler_needs_stay(self):
        self.assertFalse([change for change in self.found if change.line in (1, 2, 4)])

    def test_constants_of_functions_and_of_classes_stay_what_they_are(self):
        text = ("struct A\n{\n    static constexpr double a = 2.0;\n};\ninline const double& f() noexcept\n{\n"
                "    static constexpr double a = 3.0;\n    return a;\n}\n")
        changed = in_place(text, list(enumerate(changes_of("f.h", text))))
        self.assertIn("    static inline const double a = mutants::either<", changed)
        self.assertEqual(changed.count("    static const double a = mutants::either<"), 1)

    def test_lines_stay_where_they_are(self):
        changed = in_place(TEXT, list(enumerate(self.found)))
        self.assertEqual(changed.count("\n"), TEXT.count("\n"))
        self.assertIn("// a < b in a comment\nconst double limit = mutants::either<", changed)

    def test_each_change_is_off_until_it_is_chosen(self):
        found = [change for change in changes_of("f.cpp", PROGRAM) if change.line < 22]
        with tempfile.TemporaryDirectory() as folder:
            built = []
            for name, text in [("plain", PROGRAM), ("changed", in_place(PROGRAM, list(enumerate(found))))]:
                (Path(folder) / f"{name}.cpp").write_text(text)
                subprocess.run(["c++", "-std=c++20", "-w", "-include", HERE / "Mutants.h", f"{name}.cpp", "-o", name],
                               cwd=folder, check=True)
                built.append(Path(folder) / name)
            plain, changed = built

            def printed(program, number=-1):
                return subprocess.run([program], env={"PACINI_MUTANT": str(number)}, capture_output=True, timeout=60).stdout

            self.assertEqual(printed(plain), printed(changed))
            seen = {change.what for number, change in enumerate(found) if printed(changed, number) != printed(plain)}
            self.assertTrue(any(one.startswith("`4` -> ") for one in seen))
            for one in ["std::max -> std::min", "`<` -> `<=`", "`!=` -> `==`", "`+` -> `-`", "`*` -> `/`", "no std::clamp",
                        "without this statement"]:
                self.assertIn(one, seen)


class Blame(unittest.TestCase):
    TEXT = """\
#include <string>
std::string words(std::string name, int count)
{
    return "the name " + name +
           " is long";
}
int twice(int count)
{
    return count + count;
}
"""

    def test_changes_that_do_not_compile_are_found_and_no_others(self):
        found = changes_of("Core/words.h", self.TEXT)
        with tempfile.TemporaryDirectory() as folder:
            header = Path(folder) / "source/Core/words.h"
            header.parent.mkdir(parents=True)
            (Path(folder) / "program.cpp").write_text('#include "source/Core/words.h"\nint main() {}\n')
            compiled = False
            for _ in range(3):
                header.write_text(in_place(self.TEXT, [(n, change) for n, change in enumerate(found) if not change.dropped]))
                done = subprocess.run(["c++", "-std=c++20", "-w", "-include", HERE / "Mutants.h", "-fsyntax-only", "program.cpp"],
                                      cwd=folder, capture_output=True, text=True)
                if compiled := done.returncode == 0:
                    break
                for change in blamed(found, done.stderr):
                    change.dropped = True
        self.assertTrue(compiled, done.stderr)
        self.assertEqual({change.line for change in found if change.dropped}, {4})
        self.assertTrue([change for change in found if not change.dropped and change.line == 9])


class Reasons(unittest.TestCase):
    def test_reasons_are_of_lines_that_exist(self):
        for entry in json.loads((HERE / "reasons.json").read_text()):
            with self.subTest(entry=entry):
                self.assertEqual(entry.keys(), {"file", "line", "change", "why"})
                self.assertGreater(len(entry["why"]), 12)
                made = changes_of(entry["file"], (ROOT / entry["file"]).read_text())
                self.assertIn((entry["line"], entry["change"]), [(change.text, change.what) for change in made])


if __name__ == "__main__":
    unittest.main()
