"""End to end: what a score is to be read against."""
import json
import unittest

from command import CommandTest, sine, wav


def clicks(frequency, level=0.8):
    """A short tone every 0.2 s for 2 s, at 8 kHz."""
    tone = [x * (1 - i / 160) for i, x in enumerate(sine(frequency, 0.02, 8000, level))]
    return (tone + [0.0] * 1440) * 10


class Ceiling(CommandTest):
    def test_the_score_of_the_sound_itself_stands_beside_every_score(self):
        for name, sound in (("low", clicks(80)), ("high", clicks(1200)), ("tone", sine(100, 2, 8000))):
            self.put(f"{name}.wav", wav(sound, 8000))
        for name in ("low", "high", "tone"):
            itself = self.report("compare", f"{name}.wav", f"{name}.wav")["files"][0]
            self.assertAlmostEqual(itself["ceiling"], itself["hts"], places=9)
            other = self.report("compare", f"{name}.wav", "tone.wav")["files"][0]
            self.assertAlmostEqual(other["ceiling"], itself["hts"], places=9)
        self.assertGreater(self.report("compare", "tone.wav", "tone.wav")["files"][0]["hts"], 99)

    def test_a_sound_that_is_little_felt_does_not_reach_100_and_a_translation_passes_it(self):
        self.put("high.wav", wav(clicks(1200), 8000))
        self.put("moved.wav", wav(clicks(150), 8000))
        report = self.report("compare", "high.wav", "moved.wav")["files"][0]
        self.assertLess(report["ceiling"], 97)
        self.assertGreater(report["hts"], report["ceiling"])

    def test_tables_and_means_show_it(self):
        self.put("a.wav", wav(clicks(80), 8000))
        text = self.succeeds("compare", "a.wav", "a.wav")
        heading = text.splitlines()[0].split()
        self.assertEqual(heading[:6], ["file", "match", "HTS", "of", "REF", "HTS-F"])
        report = self.report("compare", "a.wav", "a.wav")
        self.assertEqual(report["mean"]["ceiling"], report["files"][0]["ceiling"])
        self.assertIn("of REF", self.succeeds("compare", "--help"))


class Clips(CommandTest):
    def test_a_clip_is_compared_as_it_is_rendered(self):
        self.put("a.wav", wav(clicks(80), 8000))
        self.succeeds("encode", "a.wav", "-o", "a.json")
        self.succeeds("render", "a.json", "-o", "rendered.wav")
        rendered, clip = (self.report("compare", "a.wav", name)["files"][0] for name in ("rendered.wav", "a.json"))
        for scores in (rendered, clip):
            for differs in ("candidate", "seconds", "timesRealTime"):
                del scores[differs]
        self.assertEqual(clip, rendered)

    def test_of_a_folder_a_rendered_sound_comes_before_the_clip_of_its_name(self):
        for name in ("a", "b"):
            self.put(f"sounds/{name}.wav", wav(clicks(80), 8000))
        self.succeeds("encode", "sounds", "-o", "clips")
        self.put("clips/a.wav", wav(sine(150, 2, 8000), 8000))
        files = self.report("compare", "sounds", "clips")["files"]
        self.assertEqual([file["candidate"].rsplit("/", 1)[1] for file in files], ["a.wav", "b.json"])

    def test_a_clip_is_no_reference(self):
        self.put("a.wav", wav(clicks(80), 8000))
        self.succeeds("encode", "a.wav", "-o", "a.json")
        self.fails(1, ["compare", "a.json", "a.wav"], "a.json: is a clip; name its sound first")

    def test_the_table_states_the_sound_itself_and_silence(self):
        self.put("a.wav", wav(clicks(1200), 8000))
        self.put("silent.wav", wav([0.0] * 16000, 8000))
        rows = {line.split("  ")[0]: line.split() for line in self.succeeds("compare", "a.wav", "silent.wav").split("\n")}
        scores = self.report("compare", "a.wav", "silent.wav")["files"][0]
        self.assertEqual(rows["sound itself"][2:4], [f"{scores[key]:.1f}" for key in ("matchOfSound", "ceiling")])
        self.assertEqual(rows["silence"][1], f"{scores['match']:.1f}")
        self.assertGreater(float(rows["sound itself"][2]), float(rows["silence"][1]))


class Match(CommandTest):
    def test_a_vibration_that_comes_with_the_sound_is_predicted_to_match_better_than_a_hum(self):
        self.put("click.wav", wav(clicks(2000), 8000))
        self.put("moved.wav", wav(clicks(150), 8000))
        self.put("hum.wav", wav(sine(150, 2, 8000), 8000))
        moved, hum = (self.report("compare", "click.wav", f"{name}.wav")["files"][0] for name in ("moved", "hum"))
        self.assertGreater(moved["match"], hum["match"] + 15)
        self.assertGreater(moved["matchParts"]["attacks"], 0.8)
        self.assertEqual(
            list(moved["matchParts"]), ["attacks", "envelope", "roughness", "brightness", "movement", "silence"]
        )
        itself = self.report("compare", "moved.wav", "moved.wav")["files"][0]
        self.assertAlmostEqual(itself["match"], itself["matchOfSound"], places=9)

    def test_a_recording_of_another_length_is_aligned_and_the_lag_is_told(self):
        hits = [0.0] * 16000
        for start in (800, 3300, 4700, 9100, 12700):
            for i, x in enumerate(sine(1500, 0.02, 8000)):
                hits[start + i] = x
        self.put("hits.wav", wav(hits, 8000))
        self.put("late.wav", wav([0.0] * 400 + hits, 8000))
        self.put("cut.wav", wav(([0.0] * 400 + hits)[:16000], 8000))
        itself, late, cut = (
            json.loads(self.warns("compare", "hits.wav", f"{name}.wav", "--json", says=says) if says
                       else self.succeeds("compare", "hits.wav", f"{name}.wav", "--json"))["files"][0]
            for name, says in (("hits", ""), ("late", "computed without the lag"), ("cut", "lowers the match"))
        )
        self.assertEqual(itself["matchLag"], 0)
        self.assertAlmostEqual(late["matchLag"], 50, delta=6)
        self.assertAlmostEqual(cut["matchLag"], 50, delta=6)
        self.assertEqual([f["matchAligned"] for f in (itself, late, cut)], [False, True, False])
        self.assertGreater(late["match"], itself["match"] - 1)
        self.assertLess(cut["match"], itself["match"] - 10)

    def test_what_is_silent_has_none(self):
        self.put("click.wav", wav(clicks(2000), 8000))
        self.put("silence.wav", wav([0.0] * 16000, 8000))
        says = "only match and HTS are meaningful"
        report = json.loads(self.warns("compare", "silence.wav", "click.wav", "--json", says=says))["files"][0]
        self.assertIsNone(report["match"])
        self.assertIsNone(report["matchParts"])
        still = self.report("compare", "click.wav", "silence.wav")["files"][0]
        self.assertEqual(set(still["matchParts"].values()), {0})
        self.assertLess(still["match"], 36)

    def test_folders_have_a_mean_of_it(self):
        for name, pitch in (("a", 80), ("b", 2000)):
            self.put(f"in/{name}.wav", wav(clicks(pitch), 8000))
            self.put(f"out/{name}.wav", wav(clicks(120), 8000))
        report = self.report("compare", "in", "out")
        matches = [file["match"] for file in report["files"]]
        self.assertEqual(len(matches), 2)
        self.assertAlmostEqual(report["mean"]["match"], sum(matches) / 2, places=9)


if __name__ == "__main__":
    unittest.main()
