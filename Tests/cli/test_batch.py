"""End to end: shards, manifests and retries of runs over many files."""
import hashlib
import json
import os
import random
import unittest

from command import CommandTest, noise, sine, wav


class Batch(CommandTest):
    def sounds(self, count=12, seconds=0.2):
        for i in range(count):
            self.put(f"in/{'sub/' if i % 3 == 0 else ''}{i:03}.wav", wav(sine(60 + 10 * i, seconds * (1 + i % 4))))

    def contents(self, folder):
        root = self.folder / folder
        return {str(path.relative_to(root)): path.read_bytes() for path in root.rglob("*")
                if path.is_file() and ".manifest." not in path.name}

    def entries(self, manifest):
        return {entry["input"]: entry for entry in json.loads((self.folder / manifest).read_bytes())["files"]}

    def test_shards_together_give_what_one_run_gives(self):
        self.sounds()
        self.succeeds("encode", "in", "-o", "whole", "--format", "packed", "--manifest", "whole/run.manifest.json")
        orders = list(range(1, 5))
        random.Random(3).shuffle(orders)
        seen = []
        for shard in orders:
            report = self.report("encode", "in", "-o", "parts", "--format", "packed", "--shard", f"{shard}/4",
                                 "--manifest", "parts/run.manifest.json")
            seen += [file["input"] for file in report["files"]]
            self.assertGreater(len(report["files"]), 0)
        self.assertEqual(len(seen), 12)
        self.assertEqual(len(set(seen)), 12)
        self.assertEqual(self.contents("parts"), self.contents("whole"))

        parts = [f"parts/run.manifest.{i}-of-4.json" for i in range(1, 5)]
        self.succeeds("manifest", "merge", *parts, "-o", "parts/run.manifest.json")
        merged, whole = self.entries("parts/run.manifest.json"), self.entries("whole/run.manifest.json")
        self.assertEqual(sorted(merged), sorted(whole))
        self.assertIn("sub/000.wav", merged)
        for name, entry in merged.items():
            self.assertEqual(entry["outputs"], whole[name]["outputs"])
            output = entry["outputs"][0]
            content = (self.folder / "parts" / output["file"]).read_bytes()
            self.assertEqual((len(content), hashlib.sha256(content).hexdigest()), (output["bytes"], output["sha256"]))
            self.assertGreater(entry["report"]["seconds"], 0)
        report = self.report("manifest", "check", "parts/run.manifest.json")
        self.assertEqual((report["files"], report["failed"], report["missingOrChanged"]), (12, 0, 0))

    def test_what_no_shard_made_is_counted(self):
        self.sounds()
        line = ["encode", "in", "-o", "out", "--format", "packed", "--manifest", "run.manifest.json"]
        sizes = {}
        for shard in (1, 3):
            sizes[shard] = len(self.report(*line, "--shard", f"{shard}/3")["files"])
        parts = ["run.manifest.1-of-3.json", "run.manifest.3-of-3.json"]
        missing = 12 - sizes[1] - sizes[3]
        says = f"shard 2/3 is in none of the manifests: nobody made {missing} files"
        self.fails(1, ["manifest", "merge", *parts, "-o", "run.manifest.json"], says)
        self.assertEqual(len(self.entries("run.manifest.json")), 12 - missing)  # what there is is merged all the same
        for manifests in (["run.manifest.json"], parts, parts[:1] + ["run.manifest.json"]):
            done = self.fails(1, ["manifest", "check", *manifests, "--json"], says)
            self.assertEqual(json.loads(done.stdout)["notMade"], missing)
        self.fails(1, ["manifest", "check", parts[1]], "shards 1/3, 2/3 are in none of the manifests")
        # The merged one knows what is missing: the last shard completes it.
        self.succeeds(*line, "--shard", "2/3")
        self.succeeds("manifest", "merge", "run.manifest.json", "run.manifest.2-of-3.json", "-o", "run.manifest.json")
        report = self.report("manifest", "check", "run.manifest.json")
        self.assertEqual((report["files"], report["notMade"]), (12, 0))
        # So does another division, and a run over everything.
        for shard in (1, 2):
            self.succeeds(*line, "--shard", f"{shard}/2")
        self.succeeds("manifest", "merge", parts[0], "run.manifest.1-of-2.json", "run.manifest.2-of-2.json", "-o",
                      "two.manifest.json")
        self.succeeds("manifest", "check", "two.manifest.json")
        self.fails(1, ["manifest", "merge", *parts, "-o", "run.manifest.json"], says)
        self.succeeds(*line)
        self.succeeds("manifest", "check", "run.manifest.json")
        self.succeeds("manifest", "check", "run.manifest.json", parts[0])

    def test_conversions_renders_and_comparisons_count_what_nobody_made_too(self):
        self.sounds(6)
        self.succeeds("encode", "in", "-o", "clips", "--format", "packed")
        self.succeeds("render", "clips", "-o", "drives")
        for line, manifest in ((["convert", "clips", "haptic", "--format", "haptic"], "haptic/pacini.manifest"),
                               (["render", "clips", "-o", "more", "--manifest", "r.manifest.json"], "r.manifest"),
                               (["compare", "in", "drives", "--manifest", "c.manifest.json"], "c.manifest")):
            self.succeeds(*line, "--shard", "2/2")
            self.fails(1, ["manifest", "merge", f"{manifest}.2-of-2.json", "-o", f"{line[0]}.manifest.json"],
                       "shard 1/2 is in none of the manifests")
            self.fails(1, ["manifest", "check", f"{line[0]}.manifest.json"], "shard 1/2")
        os.remove(self.folder / "drives/001.wav")
        self.fails(1, ["compare", "in", "drives", "--manifest", "all.manifest.json"], "in/001.wav")
        self.fails(1, ["manifest", "check", "all.manifest.json"], "001.wav: has no counterpart")

    def test_what_is_known_of_a_file_stays_when_it_fails(self):
        self.sounds(2)
        line = ["encode", "in", "-o", "out", "--format", "packed", "--manifest", "run.manifest.json"]
        self.succeeds(*line)
        before = self.entries("run.manifest.json")["001.wav"]
        sound = (self.folder / "in/001.wav").read_bytes()
        self.put("in/001.wav", sound[:60])
        self.fails(1, line, "in/001.wav")
        failed = self.entries("run.manifest.json")["001.wav"]
        self.assertTrue(failed.pop("error"))
        self.assertEqual(failed, before)
        self.fails(1, ["manifest", "check", "run.manifest.json"], "001.wav")
        self.put("in/001.wav", sound)
        self.succeeds("manifest", "retry", "run.manifest.json")
        self.succeeds("manifest", "check", "run.manifest.json")

    def test_what_was_left_as_it_was_is_nobodys_fault(self):
        self.sounds(3)
        self.succeeds("encode", "in", "-o", "out", "--format", "packed")
        self.succeeds("encode", "in", "-o", "out", "--format", "packed", "-n", "--manifest", "run.manifest.json")
        self.succeeds("manifest", "check", "run.manifest.json")

    def test_a_manifest_that_moves_when_merged_still_finds_its_files(self):
        self.sounds(2)
        self.succeeds("encode", "in", "-o", "clips/", "--manifest", "records/run.manifest.json")
        self.succeeds("manifest", "merge", "records/run.manifest.json", "-o", "all.manifest.json")
        self.assertEqual(self.report("manifest", "check", "all.manifest.json")["missingOrChanged"], 0)
        self.assertEqual(self.entries("records/run.manifest.json")["001.wav"]["outputs"][0]["file"],
                         "../clips/001.json")
        self.assertEqual(self.entries("all.manifest.json")["001.wav"]["outputs"][0]["file"], "clips/001.json")

    def test_what_failed_is_retried_and_nothing_else(self):
        self.sounds(4)
        self.put("in/bad.wav", b"RIFF")
        line = ["encode", "in", "-o", "out", "--format", "packed", "--bands", "8", "--manifest", "run.manifest.json"]
        self.fails(1, line, "in/bad.wav")
        self.assertIn("error", self.entries("run.manifest.json")["bad.wav"])
        self.fails(1, ["manifest", "check", "run.manifest.json"], "bad.wav")
        self.put("in/bad.wav", wav(sine(90, 0.5)))
        os.remove(self.folder / "out/001.pacb")
        report = self.report("manifest", "retry", "run.manifest.json", "-j", "1")
        self.assertEqual([file["input"] for file in report["files"]], ["in/bad.wav"])
        self.assertEqual(self.report("info", "out/bad.pacb")["bands"], 8)
        self.assertNotIn("error", self.entries("run.manifest.json")["bad.wav"])
        # What was removed meanwhile is found, and made again by the run itself.
        self.fails(1, ["manifest", "check", "run.manifest.json"], "001.wav: out/001.pacb is missing")
        self.succeeds(*line)
        self.succeeds("manifest", "check", "run.manifest.json")
        (self.folder / "out/002.pacb").write_bytes(b"other")
        self.fails(1, ["manifest", "check", "run.manifest.json"], "002.wav: out/002.pacb was changed")

    def test_a_run_that_was_killed_goes_on_with_another_number_of_shards(self):
        for i in range(60):
            self.put(f"in/{i:03}.wav", wav(noise(48000 * 2, seed=i)))
        line = ["encode", "in", "-o", "out", "--format", "packed", "--manifest", "run.manifest.json", "-j", "1"]
        manifest = self.folder / "run.manifest.json"
        process = self.started(
            *line, until=lambda: manifest.exists() and manifest.read_bytes().count(b'"sha256"') >= 10)
        process.kill()
        process.communicate()
        # What it did not come to is known by name.
        done = self.run_command("manifest", "check", "run.manifest.json", "--json")
        self.assertEqual((done.returncode, json.loads(done.stdout)["files"]), (1, 60))
        self.assertIn(b"was not reached before the run ended", done.stderr)
        fresh = 0
        for shard in (2, 1, 3):
            fresh += sum(f["upToDate"] for f in self.report(*line, "--shard", f"{shard}/3")["files"])
        self.assertGreater(fresh, 7)
        self.assertLess(fresh, 60)
        self.succeeds("encode", "in", "-o", "whole", "--format", "packed")
        self.assertEqual(self.contents("out"), self.contents("whole"))
        # How long a file took stays known although it was up to date the next time.
        self.succeeds(*line)
        self.assertTrue(all(f["report"]["seconds"] > 0 for name, f in self.entries("run.manifest.json").items()
                            if not f["report"]["upToDate"]))

    def test_a_manifest_that_is_cut_off_has_no_end(self):
        self.sounds(4)
        self.succeeds("encode", "in", "-o", "out", "--manifest", "run.manifest.json")
        whole = (self.folder / "run.manifest.json").read_bytes()
        lines = whole.splitlines(keepends=True)
        for cut in (len(whole) // 2, len(b"".join(lines[:3])), len(whole) - 3):
            self.put("cut.manifest.json", whole[:cut])
            self.fails(1, ["manifest", "check", "cut.manifest.json", "-q"], "cut.manifest.json: has no end")
            self.fails(1, ["manifest", "merge", "cut.manifest.json", "-o", "all.manifest.json", "-q", "-y"],
                       "has no end")
        self.succeeds("manifest", "check", "run.manifest.json")

    def test_render_convert_and_compare_have_shards_too(self):
        self.sounds(5)
        self.succeeds("encode", "in", "-o", "clips", "--format", "packed")
        for shard in (1, 2):
            self.succeeds("render", "clips", "-o", "drives", "--shard", f"{shard}/2", "--manifest",
                          "render.manifest.json")
            self.succeeds("convert", "clips", "haptic", "--format", "haptic", "--shard", f"{shard}/2")
        self.assertEqual(len(self.contents("drives")), 5)
        self.assertEqual(len(self.contents("haptic")), 5)
        self.succeeds("manifest", "check", "haptic/pacini.manifest.1-of-2.json", "haptic/pacini.manifest.2-of-2.json",
                      "render.manifest.1-of-2.json", "render.manifest.2-of-2.json")
        whole = {file["reference"]: file["hts"] for file in self.report("compare", "in", "drives")["files"]}
        parts = {}
        for shard in (1, 2):
            self.succeeds("compare", "in", "drives", "--shard", f"{shard}/2", "--manifest", "c.manifest.json")
            for entry in self.entries(f"c.manifest.{shard}-of-2.json").values():
                parts[entry["report"]["reference"]] = entry["report"]["hts"]
        self.assertEqual(parts, whole)
        # Manifests are no clips of a folder.
        self.assertEqual(len(self.report("render", "haptic", "-o", "again")["files"]), 5)

    def test_more_shards_than_files_leave_some_without_work(self):
        self.sounds(1)
        counts = [len(self.report("encode", "in", "-o", "out", "--shard", f"{i}/3")["files"]) for i in (1, 2, 3)]
        self.assertEqual(sorted(counts), [0, 0, 1])
        # A dry run says what this shard would do and starts no manifest.
        report = self.report("encode", "in", "-o", "dry", "--dry-run", "--shard", "1/3", "--manifest", "m.json")
        self.assertEqual(len(report["files"]), 1)
        self.assertNotIn("m.1-of-3.json", self.names())

    def test_wrong_usage_is_said(self):
        self.sounds(1)
        for shard in ("0/2", "3/2", "1", "a/b", "1/0"):
            self.fails(2, ["encode", "in", "--shard", shard], f"'{shard}' is not a shard")
        self.fails(2, ["encode", "in", "--retry"], "--manifest")
        self.put("notes.json", "{}")
        self.fails(1, ["encode", "in", "--manifest", "notes.json"], "notes.json: exists and is not a manifest")
        self.assertEqual((self.folder / "notes.json").read_text(), "{}")
        self.fails(1, ["manifest", "check", "notes.json"], "notes.json: is not a manifest")
        self.fails(1, ["manifest", "retry", "missing.json"], "missing.json: does not exist")
        self.fails(1, ["manifest", "retry", "missing.json", "-j", "2"], "missing.json: does not exist")
        self.succeeds("encode", "in", "-o", "out", "--manifest", "run.manifest.json")
        self.fails(1, ["render", "out", "--manifest", "run.manifest.json"], "is a manifest of pacini encode")
        self.fails(1, ["manifest", "merge", "run.manifest.json", "-o", "notes.json"], "notes.json",
                   "exists and is not a manifest")
        self.succeeds("convert", "out", "packed", "--format", "packed")
        self.fails(1, ["manifest", "merge", "run.manifest.json", "packed/pacini.manifest.json", "-o", "m.json"],
                   "is of pacini convert")
        self.fails(1, ["manifest", "retry", "packed/pacini.manifest.json"], "is of a conversion")
        # Others may have written a manifest: it cannot name any command.
        text = (self.folder / "run.manifest.json").read_text()
        self.put("other.json", text.replace('"command": "encode"', '"command": "bench"'))
        self.fails(1, ["manifest", "retry", "other.json"], "only encode, render and compare can be retried")
        # Nor can a manifest of others send the run to a cluster of theirs.
        manifest = json.loads(text)
        manifest["arguments"] += ["--ray=ray://elsewhere:10001"]
        self.put("sent.manifest.json", json.dumps(manifest))
        self.fails(2, ["manifest", "retry", "sent.manifest.json"], "cannot be combined with --ray")


if __name__ == "__main__":
    unittest.main()
