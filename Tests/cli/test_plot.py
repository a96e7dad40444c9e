"""End to end: what pacini plot --analysis draws of a sound whose events, level and bands are known."""
import json
import math
import unittest
import xml.etree.ElementTree as ElementTree

from command import CommandTest, float_wav, noise, wav

SVG = "{http://www.w3.org/2000/svg}"
EVENTS = (0.3, 0.75, 1.2, 1.6)


def knocks(rate=16000, seconds=2.0):
    """Bursts of 200 Hz that set in at once and decay."""
    sound = [0.0] * round(rate * seconds)
    for start in EVENTS:
        for i in range(round(0.15 * rate)):
            t = i / rate
            sound[round(start * rate) + i] += 0.8 * math.exp(-t / 0.03) * math.cos(2 * math.pi * 200 * t)
    return sound


class Analysis(CommandTest):
    def series(self, *arguments):
        """Vertices of the paths of each series of the picture, and all texts."""
        self.succeeds("plot", *arguments, "-o", "out.svg", "-y")
        root = ElementTree.parse(self.folder / "out.svg").getroot()
        found = {}
        for group in root.iter(SVG + "g"):
            title = group.find(SVG + "title")
            if title is not None:
                for path in group.findall(SVG + "path"):
                    points = [tuple(map(float, pair.split())) for piece in path.get("d").replace("Z", "").split("M")
                              for pair in piece.strip("L ").split("L") if pair.strip()]
                    found.setdefault(title.text, []).append((path.get("d").count("M"), points))
        return found, ["".join(text.itertext()) for text in root.iter(SVG + "text")]

    def settings(self, **encode):
        self.put("mine.json", json.dumps({"format": "pacini.settings", "version": 1, "encode": encode}))
        return ["--settings", "mine.json"]

    def test_an_analysis_shows_score_threshold_and_bands(self):
        self.put("knocks.wav", wav(knocks(), 16000))
        for how, score, events in (([], "onset score of a2vt", "events"),
                                   (self.settings(method="thesis"), "onset score |fast \u2212 slow|", "transients")):
            with self.subTest(score):
                found, texts = self.series("knocks.wav", "--analysis", *how)
                for text in ("Magnitude and envelope (1 = largest)", "Onset score (1 = threshold)", "Spectral centroid",
                             "Time (s)", "Frequency (Hz)"):
                    self.assertIn(text, texts)
                (left, level), (right, _) = found["threshold"][0][1]
                pieces, marks = found[events][0]
                self.assertEqual(pieces, len(EVENTS), texts)
                self.assertTrue(any(f"{len(EVENTS)} events" in text for text in texts), texts)
                # Above the threshold (upwards is less) at each event, below it between them.
                line = found[score][0][1]
                for at in EVENTS:
                    x = left + (right - left) * at / 2.0
                    width = 0.012 * (right - left)
                    self.assertTrue(any(abs(px - x) < width and py < level for px, py in line), at)
                    self.assertTrue(any(abs(px - x) < width for px, _ in marks), at)
                    between = x + 0.1 * (right - left) / 1.0
                    self.assertFalse(any(abs(px - between) < width and py < level for px, py in line), at)

    def test_the_sum_of_the_bands_is_flat_and_settings_count(self):
        self.put("knocks.wav", wav(knocks(), 16000))
        for method, tolerance in (("a2vt", 0.05), ("thesis", 0.05)):
            for bands in (3, 6, 12):
                with self.subTest((method, bands)):
                    found, texts = self.series("knocks.wav", "--analysis", *self.settings(method=method, bands=bands))
                    self.assertIn(f"Response of {bands} bands", texts)
                    self.assertEqual(len(found["bands"]), bands)
                    line = found["their sum"][0][1]
                    middle = line[len(line) // 4:-(len(line) // 4)]
                    # A decibel is a 66th of the panel's height; the lines of the bands reach its lower end.
                    lowest = max(y for _, points in found["bands"] for _, y in points)
                    highest = min(y for _, y in middle)
                    decibel = (lowest - highest) / 60.0
                    self.assertLess((max(y for _, y in middle) - highest) / decibel, tolerance + 0.1)
        loud, _ = self.series("knocks.wav", "--analysis", *self.settings(method="thesis", transientThreshold=9))
        self.assertEqual(loud.get("transients", [(0, [])])[0][0], 0)

    def test_only_sounds_and_methods_with_a_score_have_an_analysis(self):
        self.put("knocks.wav", wav(knocks(), 16000))
        self.clip("clip.json", 0.1)
        usage = "is for one sound, without --sound and --profile"
        self.fails(2, ["plot", "clip.json", "--analysis"], f"clip.json: --analysis: {usage}")
        self.fails(2, ["plot", "knocks.wav", "--analysis", "--profile", "lra-175"], usage)
        self.fails(2, ["plot", "lra-175", "--analysis", "-o", "p.png"], "lra-175: is a profile; leave out")
        self.fails(2, ["plot", "knocks.wav", "--settings", "mine.json"], "--settings", "--analysis")
        for method in ("vocoder16", "lowpass"):
            self.fails(1, ["plot", "knocks.wav", "--analysis", *self.settings(method=method)],
                       f"mine.json: method: must be a2vt or thesis to draw the analysis, not {method}")
        self.fails(1, ["plot", "knocks.wav", "--analysis", "--settings", "none.json"], "none.json: ")
        self.assertEqual(self.names(), ["clip.json", "knocks.wav", "mine.json"])

    def test_extreme_sounds_have_an_analysis(self):
        for name, samples, rate in (("silence", [0.0] * 4000, 8000), ("one", [0.5], 8000), ("empty", [], 8000),
                                    ("noise", noise(60000), 384000), ("constant", [0.9] * 8000, 48000),
                                    ("tiny", [1e-30 * (-1) ** i for i in range(4000)], 8000)):
            self.put(f"{name}.wav", float_wav(samples, rate))
            for how in ([], self.settings(method="thesis")):
                with self.subTest((name, how)):
                    found, _ = self.series(f"{name}.wav", "--analysis", *how)
                    self.assertIn("threshold", found)

    def test_a_part_is_shown(self):
        self.put("knocks.wav", wav(knocks(), 16000))
        found, _ = self.series("knocks.wav", "--analysis", "--from", "0.7", "--to", "1.3")
        self.assertEqual(found["events"][0][0], 2)


if __name__ == "__main__":
    unittest.main()
