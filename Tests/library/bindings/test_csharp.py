"""The package for Unity: without Unity under Mono, and its components with stubs in the place of Unity's classes."""
import json
import subprocess
import unittest

from bindings import BINDINGS, HERE, KNOCK, PACINI, ROOT, BindingTest, floats

PACKAGE = BINDINGS / "csharp"
PROGRAMS = HERE / "csharp"
CORE = [PACKAGE / "Runtime/Native.cs", PACKAGE / "Runtime/Pacini.cs"]


class CSharp(BindingTest):
    def setUp(self):
        super().setUp()
        self.needs("mcs", "mono")

    def compile(self, out, *sources, references=()):
        """A library or a program, without any warning."""
        kind = "exe" if out.endswith("exe") else "library"
        self.run_program("mcs", "-warnaserror", "-langversion:7", f"-target:{kind}", f"-out:{out}",
                         *(f"-r:{reference}" for reference in references), *sources)

    def run_mono(self, program, *arguments):
        return self.run_program("mono", program, *arguments)

    def test_plays_what_the_c_program_plays(self):
        self.compile("Pacini.dll", *CORE)
        self.compile("first.exe", PACKAGE / "Samples~/FirstVibration.cs", references=["Pacini.dll"])
        self.assert_same_samples(self.run_mono("first.exe", KNOCK), self.expected())

    def test_every_function_works_and_errors_are_exceptions(self):
        self.compile("Pacini.dll", *CORE)
        self.compile("every.exe", PROGRAMS / "EveryFunction.cs", references=["Pacini.dll"])
        self.run_mono("every.exe")
        path, rendered = self.scene()
        self.assert_same_samples(self.run_mono("every.exe", "scene", path), rendered)
        self.assert_same_layout(self.run_mono("every.exe", "layout").decode().splitlines())

    def test_components_work_in_the_place_of_unity(self):
        """Each assembly is compiled from its folder alone, as its definition says."""
        self.compile("Unity.dll", PROGRAMS / "UnityStubs.cs")
        self.compile("Pacini.Runtime.dll", *sorted((PACKAGE / "Runtime").rglob("*.cs")), references=["Unity.dll"])
        self.compile("Pacini.Editor.dll", *sorted((PACKAGE / "Editor").rglob("*.cs")),
                     references=["Unity.dll", "Pacini.Runtime.dll"])
        self.compile("components.exe", PROGRAMS / "Components.cs",
                     references=["Unity.dll", "Pacini.Runtime.dll", "Pacini.Editor.dll"])
        subprocess.run([PACINI, "convert", KNOCK, self.folder / "knock.pacb"], check=True, capture_output=True)
        (self.folder / "broken.pacb").write_bytes((self.folder / "knock.pacb").read_bytes()[:40])
        played = floats(self.run_mono("components.exe", "knock.pacb", "broken.pacb"))
        # Added to 0.25, the sound that is there, in single precision; .pacb rounds what it keeps.
        expected = floats(self.expected())
        self.assertEqual(len(played), len(expected))
        self.assertLess(max(abs(a - 0.25 - b) for a, b in zip(played, expected)), 0.01)

    def test_definitions_name_what_is_there(self):
        package = json.loads((PACKAGE / "package.json").read_text())
        self.assertIn(f"VERSION {package['version']} ", (ROOT / "CMakeLists.txt").read_text())
        names = {path: json.loads(path.read_text())["name"] for path in PACKAGE.rglob("*.asmdef")}
        self.assertEqual(sorted(names.values()), ["Pacini.Editor", "Pacini.Runtime"])
        for path in names:
            self.assertEqual(path.stem, names[path])
            self.assertLessEqual(set(json.loads(path.read_text())["references"]), set(names.values()))


if __name__ == "__main__":
    unittest.main()
