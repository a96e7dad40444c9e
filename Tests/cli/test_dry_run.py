"""End to end: --dry-run says what would be done with each file, and does nothing."""
import json
import unittest

from command import CommandTest, noise, sine, wav


class DryRun(CommandTest):
    def setUp(self):
        super().setUp()
        for name in ("a", "b", "sub/c"):
            self.put(f"in/{name}.wav", wav(sine(100, 0.2, 8000), 8000))

    def planned(self, *arguments):
        """{input: action}; nothing may change below the folder."""
        before = {name: (self.folder / name).stat().st_mtime_ns for name in self.names()}
        folders = sorted(path for path in self.folder.rglob("*") if path.is_dir())
        report = self.report(*arguments, "--dry-run")
        self.assertTrue(report["dryRun"])
        self.assertEqual(report["written"], [])
        text = self.succeeds(*arguments, "--dry-run")
        for file in report["files"]:
            self.assertIn(f"would {file['action']} {file['output']}, ", text)
        self.assertEqual(before, {name: (self.folder / name).stat().st_mtime_ns for name in self.names()})
        self.assertEqual(folders, sorted(path for path in self.folder.rglob("*") if path.is_dir()))
        return {file["input"]: file["action"] for file in report["files"]}

    def test_a_batch_is_planned_as_it_is_done_then(self):
        encode = ["encode", "in", "-o", "clips"]
        self.assertEqual(self.planned(*encode), {"in/a.wav": "write", "in/b.wav": "write", "in/sub/c.wav": "write"})
        self.succeeds(*encode)
        self.assertEqual(set(self.planned(*encode).values()), {"skip"})
        self.assertEqual(set(self.planned(*encode, "--bands", "4").values()), {"overwrite"})
        self.put("in/a.wav", wav(noise(1600), 8000))
        self.assertEqual(self.planned(*encode), {"in/a.wav": "overwrite", "in/b.wav": "skip", "in/sub/c.wav": "skip"})
        self.assertEqual(set(self.planned(*encode, "--force").values()), {"overwrite"})

        convert = ["convert", "clips", "ios", "--format", "ahap"]
        self.assertEqual(set(self.planned(*convert).values()), {"write"})
        self.succeeds(*convert)
        self.assertEqual(set(self.planned(*convert).values()), {"skip"})
        self.assertEqual(set(self.planned(*convert, "--points", "5").values()), {"overwrite"})
        self.assertEqual(set(self.planned(*convert, "-n", "--force").values()), {"skip"})

        render = ["render", "clips", "-o", "drives"]
        self.assertEqual(set(self.planned(*render).values()), {"write"})
        self.assertEqual(self.planned("render", "clips/a.json", "-o", "in/a.wav"), {"clips/a.json": "overwrite"})

    def test_bad_inputs_are_told_already(self):
        self.put("in/bad.wav", "no sound")
        self.put("in/bad.json", "{}")
        self.fails(1, ["encode", "in", "-o", "out", "--dry-run"], "in/bad.wav: ")
        self.fails(1, ["render", "in/bad.json", "-o", "out.wav", "--dry-run"], "in/bad.json: ")
        self.fails(1, ["convert", "in/bad.json", "x.pacb", "--dry-run"], "in/bad.json: ")
        self.fails(1, ["encode", "none.wav", "--dry-run"], "none.wav: does not exist")
        done = self.run_command("encode", "in", "-o", "out", "--dry-run", "--json")
        report = json.loads(done.stdout)
        self.assertFalse(report["ok"])
        self.assertEqual(len(report["files"]), 3)
        self.assertFalse((self.folder / "out").exists())

    def test_a_profile_is_planned_too(self):
        self.assertEqual(self.succeeds("info", "erm-coin")[:4], "erm-")
        path = json.loads(self.succeeds("profiles", "--json"))["profiles"][0]["path"]
        self.assertEqual(self.planned("convert", path, "x.acf"), {path: "write"})


if __name__ == "__main__":
    unittest.main()
