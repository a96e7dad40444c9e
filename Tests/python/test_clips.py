"""Clips as objects: curves in and out, edits, files, pickles."""

import copy
import dataclasses
import errno
import pickle
import unittest
import warnings
from pathlib import Path

import numpy as np
import pacini
from sounds import FolderTest, knocks


class Clips(FolderTest):
    @classmethod
    def setUpClass(cls):
        cls.clip = pacini.encode(knocks(), 48000, name="knocks", source="knocks.wav")

    def test_curves_are_structured_arrays_that_look_into_the_clip(self):
        envelope = self.clip.envelope
        self.assertEqual(envelope.dtype.names, ("time", "amplitude"))
        self.assertGreater(len(envelope), 2)
        self.assertFalse(envelope.flags.writeable or envelope.flags.owndata)
        with self.assertRaises(ValueError):
            envelope["amplitude"] *= 0.5
        self.assertEqual(self.clip.bands[0].pitch.dtype.names, ("time", "frequency"))
        self.assertEqual(self.clip.transients.dtype.names, ("time", "amplitude", "sharpness"))
        self.assertGreaterEqual(len(self.clip.transients), 3)
        kept = pacini.Clip(1.0, envelope=[(0, 0.25), (1, 0.75)]).envelope  # outlives its clip
        self.assertEqual(kept.tolist(), [(0.0, 0.25), (1.0, 0.75)])

    def test_what_is_written_back_is_what_comes_out(self):
        clip = self.clip.copy()
        envelope = clip.envelope.copy()
        envelope["amplitude"] *= 0.5
        clip.envelope = envelope
        np.testing.assert_array_equal(clip.envelope, envelope)
        self.assertNotEqual(clip, self.clip)
        clip.transients = [(0.1, 0.5, 1.0), (0.2, 0.25, 0.0)]
        self.assertEqual(clip.transients.tolist(), [(0.1, 0.5, 1.0), (0.2, 0.25, 0.0)])
        clip.bands = [dataclasses.replace(band, priority=7) for band in clip.bands[:3]]
        self.assertEqual([band.priority for band in clip.bands], [7, 7, 7])
        self.assertEqual(clip.bands[1].low, self.clip.bands[1].low)
        clip.bands = [dataclasses.replace(clip.bands[0], phase=0.25), *clip.bands[1:]]
        self.assertEqual([band.phase for band in clip.bands], [0.25, 0, 0])
        self.assertNotEqual(clip.bands[0], dataclasses.replace(clip.bands[0], phase=0.5))
        clip.centroid = np.array([(0.0, 100.0)])
        clip.markers = [(0.5, "half")]
        clip.noise = [pacini.NoiseBand(100, 200, [(0, 0.1)])]
        clip.name, clip.source = "other", pacini.Source("other.wav", 44100, 2)
        self.assertEqual((clip.markers, clip.name, clip.source.channels), ([(0.5, "half")], "other", 2))
        self.assertEqual(clip.noise[0].amplitude.tolist(), [(0.0, 0.1)])
        self.assertEqual(pacini.Clip.from_bytes(clip.to_bytes("json")), clip)

    def test_what_breaks_a_rule_is_refused_with_its_place_and_changes_nothing(self):
        clip = self.clip.copy()

        def put(name, value):
            setattr(clip, name, value)

        self.refuses("envelope[1].time", "invalidData", put, "envelope", [(0.5, 0), (0.1, 0)])
        self.refuses("envelope[0].amplitude", "notFinite", put, "envelope", [(0.5, np.nan)])
        self.refuses("envelope", "invalidArgument", put, "envelope", [1, 2, 3])
        self.refuses("envelope", "invalidArgument", put, "envelope", "nothing")
        self.refuses("envelope", "invalidArgument", put, "envelope", self.clip.centroid)
        self.refuses("centroid[0].time", "invalidData", put, "centroid", [(5.0, 100)])
        self.refuses("transients[0].sharpness", "invalidData", put, "transients", [(0.1, 0.5, 2.0)])
        self.refuses("bands[0]", "invalidData", put, "bands", [pacini.Band(100, 50, 200)])
        self.refuses(
            "bands[0].pitch[0].frequency", "invalidData", put, "bands", [pacini.Band(50, 100, 200, pitch=[(0, -1)])]
        )
        for phase, code in ((1.5, "invalidData"), (-0.1, "invalidData"), (np.nan, "notFinite")):
            self.refuses("bands[0].phase", code, put, "bands", [pacini.Band(50, 100, 200, phase=phase)])
        self.refuses("bands[0]", "invalidArgument", put, "bands", [1])
        self.refuses("markers[0]", "invalidArgument", put, "markers", [1])
        self.refuses("markers[1].time", "invalidArgument", put, "markers", [(0.1, "a"), ("b", 0.2)])
        self.refuses("duration", "invalidData", put, "duration", -1)
        self.refuses("duration", "invalidArgument", put, "duration", "long")
        self.assertEqual(clip, self.clip)

    def test_edits_are_new_clips(self):
        clip = self.clip
        part = clip[0.25:0.75]
        self.assertAlmostEqual(part.duration, 0.5)
        self.assertEqual(len(clip[:0.5].transients) + len(clip[0.5:].transients), len(clip.transients))
        self.assertAlmostEqual(clip[-0.25:].duration, 0.25)
        self.assertAlmostEqual((part + part).duration, 1.0)
        self.assertAlmostEqual((part * 3).duration, 1.5)
        self.assertEqual(3 * part, part * 3)
        with self.assertRaises(TypeError):
            iter(clip)
        self.assertAlmostEqual(clip.stretched(2).duration, 2.0)
        self.assertAlmostEqual(clip.transposed(12).bands[0].centre, 2 * clip.bands[0].centre)
        self.assertAlmostEqual(clip.without(0.2, 0.5).duration, 0.7)
        self.assertAlmostEqual(clip.inserted(0.5, part).duration, 1.5)
        np.testing.assert_allclose(clip.reversed().transients["time"], 1.0 - clip.transients["time"][::-1])
        np.testing.assert_array_equal(clip.trimmed().transients, clip.transients)
        with self.assertRaises(TypeError):
            clip[0.1:0.5:2]
        self.refuses("ratio", "invalidArgument", clip.stretched, 0)
        self.refuses("semitones", "invalidArgument", clip.transposed, np.nan)
        self.refuses("passes", "invalidArgument", clip.__mul__, 0)

    def test_curves_are_simplified_to_a_count_or_an_error(self):
        self.assertTrue(all(len(band.amplitude) <= 5 for band in self.clip.simplified(5).bands))
        simpler, lanes = self.clip.simplified_report(error=0.05, method="optimal")
        self.assertLess(simpler.breakpoints, self.clip.breakpoints)
        self.assertTrue(all(lane.max_error <= 0.05 + 1e-9 for lane in lanes if lane.kind == "amplitude"))
        self.assertEqual(sum(lane.after for lane in lanes), simpler.breakpoints)
        self.refuses("method", "invalidArgument", self.clip.simplified, 5, method="magic")
        self.refuses("count", "invalidArgument", self.clip.simplified)
        self.refuses("error", "invalidArgument", self.clip.simplified, error=-1)
        self.refuses("count", "invalidArgument", pacini.simplify, [0, 1, 2], [0, 1, 0])
        self.refuses("error", "invalidArgument", pacini.simplify, [0, 1, 2], [0, 1, 0], error=float("nan"))
        time = np.linspace(0, 1, 1000)
        for method in pacini.SIMPLIFIERS:
            x, y = pacini.simplify(time, np.sin(6 * time), error=0.01, method=method)
            self.assertLess(np.max(np.abs(np.interp(time, x, y) - np.sin(6 * time))), 0.0101, method)
            self.assertLess(len(x), 60, method)
        self.refuses("times", "invalidArgument", pacini.simplify, [1, 2], [1])
        self.refuses("curve[1]", "notFinite", pacini.simplify, [0, 1, 2], [0, np.nan, 0], 2)

    def test_every_format_that_is_written_and_read_comes_back(self):
        for format in pacini.formats():
            if not (format.is_written and format.is_read):
                continue
            with self.subTest(format=format.name):
                path = self.folder / ("clip" + format.extension)
                options = {"quick": True} if format.name == "hjif" else {}
                self.clip.save(path, format=format.name, **options)
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    back = pacini.Clip.load(path)
                if format.name in ("json", "packed"):
                    self.assertEqual(back, self.clip)
                else:
                    self.assertLess(abs(back.duration - self.clip.duration), 0.1)
                path.unlink()
        pacini.convert(self._saved(), self.folder / "other.haptic")
        self.assertEqual(pacini.read(self._saved()), self.clip)
        self.assertTrue(any(loss.kind == "bands" for loss in pacini.lint(self._saved(), "ahap")))

    def _saved(self):
        path = self.folder / "clip.pacb"
        self.clip.save(path)
        return path

    def test_files_that_are_no_clips_say_so(self):
        bad = self.folder / "bad.json"
        bad.write_text("{")
        self.refuses(f"{bad}: line 1, column 2", "invalidData", pacini.Clip.load, bad)
        self.refuses(str(self.folder / "missing.pacb"), "io", pacini.Clip.load, self.folder / "missing.pacb")
        self.refuses("format", "invalidArgument", self.clip.save, self.folder / "clip.xyz")
        self.refuses("format", "invalidArgument", self.clip.save, self.folder / "clip.json", format="xyz")
        self.refuses("points", "invalidArgument", self.clip.save, self.folder / "clip.json", points=5)
        self.refuses("", "invalidData", pacini.Clip.from_bytes, b"nothing")
        self.refuses("duration", "invalidData", pacini.Clip.from_dict, {**self.clip.to_dict(), "duration": -1})
        self.refuses("quantise", "invalidArgument", self.clip.to_bytes, quantise=99)
        self.refuses(str(bad), "io", self.clip.save, bad)
        self.clip.save(bad, overwrite=True)
        self.refuses(str(bad), "io", self.clip.save, bad, overwrite=False)
        with self.assertRaises(TypeError):
            self.clip.save(self.folder / "clip.json", colour="red")

    def test_all_objects_can_be_pickled(self):
        profile = pacini.Profile("l5-wristband")
        scene = pacini.Scene([self.clip], [{"clip": 0, "gain": -6}, {"clip": 0, "start": 0.5}], actuators=2)
        comparison = pacini.compare(knocks(), self.clip, 48000)
        for thing in (
            self.clip,
            profile,
            scene,
            comparison,
            *self.clip.bands,
            pacini.Source(),
            pacini.formats()[0],
            pacini.methods()[0],
            pacini.measure.sweep(duration=0.5),
        ):
            for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
                back = pickle.loads(pickle.dumps(thing, protocol))
                if not isinstance(thing, pacini.measure.Sweep):
                    self.assertEqual(back, thing)
        self.assertEqual(copy.deepcopy(self.clip), self.clip)
        self.assertEqual(hash(profile), hash(pacini.Profile("l5-wristband")))
        error = pickle.loads(pickle.dumps(pacini.Error("is wrong", "place", "io")))
        self.assertEqual((str(error), error.where, error.code), ("place: is wrong", "place", "io"))
        self.assertIs(type(error), pacini.FileError)
        translator = pacini.Translator(profile=profile, preset="Music", rumble=3)
        back = pickle.loads(pickle.dumps(translator))
        self.assertEqual(back.params, translator.params)
        np.testing.assert_array_equal(back.process(knocks()), translator.process(knocks()))

    def test_a_file_that_is_not_there_is_one_kind_of_error_everywhere(self):
        doors = (
            pacini.read,
            pacini.Clip.load,
            pacini.Scene.load,
            pacini.encode,
            pacini.read_audio,
            lambda path: pacini.encode(np.zeros(8000, np.float32), 8000, settings=path),
            lambda path: pacini.compare(path, path),
            lambda path: pacini.lint(path, "ahap"),
        )
        for door in doors:
            for path in ("nowhere/clip.json", Path("nowhere/clip.json")):
                with self.assertRaises(FileNotFoundError) as caught:
                    door(path)
                self.assertIsInstance(caught.exception, pacini.Error)
                self.assertEqual((caught.exception.errno, caught.exception.code), (errno.ENOENT, "io"))
                self.assertIn("nowhere/clip.json", str(caught.exception))
                self.assertIn("does not exist", str(caught.exception))
        (self.folder / "latin.json").write_bytes(b'{"name": "\xe9"}')
        self.refuses(str(self.folder / "latin.json"), "invalidData", pacini.encode, np.zeros(8000, np.float32), 8000,
                     settings=self.folder / "latin.json")  # fmt: skip
        with self.assertRaises(pacini.FileError) as caught:
            self.clip.save("nowhere/clip.json")
        self.assertIsInstance(caught.exception, OSError)
        self.assertNotIsInstance(pacini.Error("is wrong", "bands"), OSError)

    def test_a_scene_is_built_and_refused(self):
        scene = pacini.Scene(
            [self.clip, self.clip.transposed(5)],
            [{"clip": 0}, {"clip": 1, "start": 0.5, "pan": 1, "loop": 0.5, "passes": 2}],
            [{"time": 0.2, "play": 0, "parameter": "gain", "value": -20}],
            actuators=2,
            name="two",
        )
        self.assertEqual((len(scene.clips), scene.plays[1]["pan"], scene.changes[0]["value"]), (2, 1, -20))
        drive = pacini.render(scene)
        self.assertEqual(drive.shape, (2, 72000))
        self.assertGreater(np.abs(drive[1]).max(), 0.01)
        scene.save(self.folder / "two.scene.json")
        self.assertEqual(pacini.Scene.load(self.folder / "two.scene.json"), scene)
        self.assertEqual(pacini.read(self.folder / "two.scene.json"), scene)
        self.assertEqual(scene.lint(), [])
        self.assertEqual([where for where, _ in pacini.Scene([self.clip], []).lint()], ["plays", "clips[0]"])
        self.refuses("plays[0].clip", "invalidData", pacini.Scene, [self.clip], [{"clip": 4}])
        self.refuses("plays[0].gian", "invalidData", pacini.Scene, [self.clip], [{"clip": 0, "gian": 4}])
        self.refuses("clips[0]", "invalidArgument", pacini.Scene, ["clip"])

    def test_a_profile_is_read_changed_and_refused(self):
        self.assertIn("lra-175", pacini.Profile.names())
        content = pacini.Profile("lra-175").to_dict()
        content["name"] = "mine"
        content["resonance"]["frequency"] = 160.0
        mine = pacini.Profile.from_dict(content)
        mine.save(self.folder / "mine.json")
        self.assertEqual(pacini.Profile(self.folder / "mine.json"), mine)
        self.assertEqual(len(mine.equalizer_response([50, 100], 48000)), 2)
        content["resonance"]["frequency"] = -1
        self.refuses("resonance.frequency", "invalidData", pacini.Profile.from_dict, content)
        self.refuses("profile", "io", pacini.Profile, "none-such")
        self.refuses("profile", "invalidArgument", pacini.render, self.clip, profile=5)
        content["resonance"]["frequency"] = 160.0
        content.pop("body", None)
        content["sources"] = {path: text for path, text in content["sources"].items() if not path.startswith("body")}
        self.refuses("body", "invalidData", pacini.felt, self.clip, profile=pacini.Profile.from_dict(content))

    def test_a_notebook_shows_lanes_and_a_player(self):
        svg = self.clip._repr_svg_()
        self.assertEqual(svg.count("<polygon"), len(self.clip.bands) + 1)
        self.assertEqual(svg.count("<circle"), len(self.clip.transients))
        self.assertIn("<audio controls", self.clip._repr_html_())
        self.assertNotIn("<script", pacini.Clip(1.0, name="<script>")._repr_html_())
        pacini.Clip(0.0)._repr_html_()
        import matplotlib

        matplotlib.use("Agg")
        ax = self.clip.plot()
        self.assertEqual(len(ax.collections), len(self.clip.bands) + 1)
        self.assertIs(self.clip.plot(ax=ax), ax)


if __name__ == "__main__":
    unittest.main()
