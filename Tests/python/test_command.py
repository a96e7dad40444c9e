"""What the package makes is what the command makes: the same bytes, samples and figures for every sound of the demo."""

import json
import unittest
import warnings

import numpy as np
import pacini
from sounds import DEMO, SOURCE, FolderTest, run


class SameAsCommand(FolderTest):
    def test_clips_of_all_demo_sounds_have_the_same_bytes(self):
        run("encode", *DEMO, "-o", f"{self.folder}/packed/", "--format", "packed", "-q")
        run("encode", *DEMO, "-o", f"{self.folder}/json/", "--format", "json", "-q")
        self.assertGreaterEqual(len(DEMO), 8)
        for sound in DEMO:
            clip = pacini.encode(sound)
            with self.subTest(sound=sound.name):
                self.assertEqual(clip.to_bytes(), (self.folder / "packed" / f"{sound.stem}.pacb").read_bytes())
                self.assertEqual(clip.to_bytes("json"), (self.folder / "json" / f"{sound.stem}.json").read_bytes())
                samples, rate = pacini.read_audio(sound)
                named = {"name": sound.stem, "source": sound.name}
                self.assertEqual(pacini.encode(samples, rate, **named), clip)
                if samples.ndim == 2:
                    planes = np.ascontiguousarray(samples)
                    self.assertEqual(pacini.encode(planes, rate, **named), clip)
                    self.assertEqual(pacini.encode(planes.T.astype(np.float64), rate, axis=0, **named), clip)

    def test_options_are_those_of_the_command(self):
        sound = DEMO[0]
        for options, words in (
            ({"bands": 5, "breakpoints": 8, "quantise": 8}, ["--bands", 5, "--breakpoints", 8, "--quantise", 8]),
            ({"low": 40, "high": 800, "spacing": "linear"}, ["--low", 40, "--high", 800, "--spacing", "linear"]),
            (
                {"audible": 0, "sensitivity": 2, "keep_level": True},
                ["--audible", 0, "--sensitivity", 2, "--keep-level"],
            ),
            ({"method": "thesis", "bands": 8}, ["--method", "thesis", "--bands", 8]),
            ({"minimum_gap": 0.1, "silence": -40}, ["--minimum-gap", 0.1, "--silence", -40]),
            (
                {"method": "envelope-sine", "attack": 0.05, "crest_adaptive": True},
                ["--method", "envelope-sine", "--attack", 0.05, "--crest-adaptive"],
            ),
        ):
            with self.subTest(options=options):
                run("encode", sound, "-o", self.folder / "clip.pacb", "--overwrite", "--force", "-q", *words)
                self.assertEqual(pacini.encode(sound, **options).to_bytes(), (self.folder / "clip.pacb").read_bytes())

    def test_parameters_are_described_as_by_the_command(self):
        from pacini import _parameters

        described = json.loads(run("encode", "--print-settings", "--json"))["parameters"]
        self.assertEqual(list(_parameters.ENCODE.values()), described["encode"])
        self.assertEqual(list(_parameters.EXPORT.values()), described["export"])

    def test_presets_are_the_same(self):
        presets = json.loads(run("encode", "--print-settings", "--json"))["presets"]
        told = [(one["name"], one["purpose"]) for one in presets]
        self.assertEqual([(one.name, one.purpose) for one in pacini.presets()], told)
        sound, output = DEMO[0], self.folder / "clip.pacb"
        for preset in pacini.presets():
            run("encode", sound, "-o", output, "--preset", preset.name, "--bands", 5, "-q", "-y")
            settings = {"format": "pacini.settings", "version": 1, "encode": {"preset": preset.name}}
            for options in ({"preset": preset.name}, {"settings": settings}):
                self.assertEqual(pacini.encode(sound, bands=5, **options).to_bytes(), output.read_bytes())
        with self.assertRaises(pacini.Error) as caught:
            pacini.encode(sound, preset="musik")
        self.assertEqual(caught.exception.where, "preset")
        self.assertIn("did you mean music?", str(caught.exception))

    def test_methods_that_make_clips_or_signals_make_the_same(self):
        sound = DEMO[0]
        samples, rate = pacini.read_audio(sound)
        for method in pacini.methods():
            with self.subTest(method=method.name):
                output = self.folder / f"{method.name}.{'pacb' if method.output == 'clip' else 'wav'}"
                run("encode", sound, "-o", output, "--method", method.name, "-q")
                if method.output == "clip":
                    self.assertEqual(pacini.encode(sound, method=method.name).to_bytes(), output.read_bytes())
                    continue
                signal, own = pacini.translate(sound, method=method.name)
                self.assertEqual(own, rate)
                np.testing.assert_array_equal(signal, pacini.read_audio(output)[0])
                np.testing.assert_array_equal(signal, pacini.translate(samples, rate, method=method.name)[0])

    def test_signals_and_what_is_felt_have_the_same_samples(self):
        clip = pacini.encode(DEMO[4])
        clip.save(self.folder / "clip.pacb")
        for options, words in (
            ({}, []),
            ({"profile": "l5-wristband"}, ["--profile", "l5-wristband"]),
            ({"profile": "quest-controller", "strength": 1.0}, ["--profile", "quest-controller", "--strength", 1]),
            (
                {"transpose": 3, "stretch": 1.5, "gain": -6, "delay": 0.1, "variation": 0.3, "seed": 3},
                ["--transpose", 3, "--stretch", 1.5, "--gain", -6, "--delay", 0.1, "--variation", 0.3, "--seed", 3],
            ),
            ({"start": 0.1, "end": 0.3, "sample_rate": 44100}, ["--from", 0.1, "--to", 0.3, "--rate", 44100]),
            (
                {"carriers": "fixed", "pulse": "square", "pulse_cycles": 2, "protect": False},
                ["--carriers", "fixed", "--pulse", "square", "--pulse-cycles", 2, "--no-protection"],
            ),
        ):
            with self.subTest(options=options):
                run("render", self.folder / "clip.pacb", "-o", self.folder / "drive.wav", "--overwrite", "-q", *words)
                np.testing.assert_array_equal(
                    pacini.render(clip, **options), pacini.read_audio(self.folder / "drive.wav")[0]
                )
        run(
            "render",
            self.folder / "clip.pacb",
            "-o",
            self.folder / "felt.wav",
            "--profile",
            "l5-wristband",
            "--felt",
            "--wearer",
            2,
            "-q",
        )
        np.testing.assert_array_equal(
            pacini.felt(clip, profile="l5-wristband", wearer=2, full_scale=100),
            pacini.read_audio(self.folder / "felt.wav")[0],
        )

    def test_what_was_designed_on_another_actuator_has_the_same_samples(self):
        clip = pacini.encode(DEMO[4])
        clip.save(self.folder / "clip.pacb")
        actuators = {"profile": "l5-wristband", "designed_for": "quest-controller"}
        words = ["--profile", "l5-wristband", "--designed-for", "quest-controller", "--overwrite", "-q"]
        for function, further in ((pacini.render, []), (pacini.felt, ["--felt"])):
            with self.subTest(further), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                run("render", self.folder / "clip.pacb", "-o", self.folder / "drive.wav", *words, *further)
                made = function(clip, **actuators)
                np.testing.assert_array_equal(made, pacini.read_audio(self.folder / "drive.wav")[0])
                self.assertFalse(np.array_equal(made, function(clip, profile="l5-wristband")))
        scene = pacini.Scene.load(SOURCE / "Resources/demo/workshop.scene.json", clips=self.demo_clips())
        with self.assertWarnsRegex(UserWarning, r"^clips\[\d\]: .* weaker than where it was designed"):
            report = pacini.explain(scene, profile="phone-taptic", designed_for="l5-wristband")
        self.assertIn(
            ("clips[0]", "levels are those that are felt on L5 voice coil in a wristband"), report.adaptations
        )
        for wrong, where in (
            ({"designed_for": "lra-175"}, "designed_for"),
            ({"profile": "lra-175", "designed_for": "erm-coin"}, "designed_for: technology"),
            ({"profile": "flat-pcm", "designed_for": "lra-175"}, "profile: body"),
            ({"profile": "piezo", "designed_for": "lra-175", "adapt": False}, "designed_for"),
        ):
            with self.subTest(wrong), self.assertRaises(pacini.Error) as raised:
                pacini.render(clip, **wrong)
            self.assertEqual(raised.exception.where, where)

    def demo_clips(self):
        """A folder with the clips of the demo."""
        run("encode", *DEMO, "-o", f"{self.folder}/clips/", "--format", "packed", "-q")
        return self.folder / "clips"

    def test_a_scene_has_the_same_samples_on_all_actuators(self):
        path, clips = SOURCE / "Resources/demo/workshop.scene.json", self.demo_clips()
        run("render", path, "--clips", clips, "-o", self.folder / "scene.wav", "--to", 2, "-q")
        scene = pacini.Scene.load(path, clips=clips)
        drive = pacini.render(scene, end=2)
        self.assertEqual(drive.shape[0], scene.actuators)
        np.testing.assert_array_equal(drive, pacini.read_audio(self.folder / "scene.wav")[0])

    def test_comparisons_have_the_same_figures(self):
        for sound in DEMO[:2]:
            clip = pacini.encode(sound)
            clip.save(self.folder / "clip.pacb")
            run("render", self.folder / "clip.pacb", "-o", self.folder / "drive.wav", "--overwrite", "-q")
            (self.folder / "onsets.txt").write_text("0.1\n0.5\n")
            said = json.loads(
                run("compare", sound, self.folder / "drive.wav", "--onsets", self.folder / "onsets.txt", "--json")
            )["files"][0]
            samples, rate = pacini.read_audio(sound)
            for found in (
                pacini.compare(sound, self.folder / "drive.wav", onsets=[0.1, 0.5]),
                pacini.compare(samples, clip, rate, onsets=[0.1, 0.5]),
                pacini.compare(sound, self.folder / "clip.pacb", onsets=[0.1, 0.5]),
            ):
                self.assertGreater(len(found.values), 25)
                for key, value in found.values.items():
                    self.assertEqual(value, said[key], key)
                self.assertEqual(found.match, said["match"])

    def test_exports_and_what_they_lose_are_the_same(self):
        clip = pacini.encode(DEMO[0])
        clip.save(self.folder / "clip.json")
        for format in pacini.formats():
            if not format.is_written or format.name == "hjif":
                continue
            with self.subTest(format=format.name):
                for folder in ("a", "b"):
                    (self.folder / folder).mkdir(exist_ok=True)
                name = "clip" + format.extension
                run(
                    "convert",
                    self.folder / "clip.json",
                    "-o",
                    self.folder / "a" / name,
                    "--format",
                    format.name,
                    "-q",
                    "--overwrite",
                )
                losses = clip.save(self.folder / "b" / name, format=format.name)
                self.assertEqual((self.folder / "a" / name).read_bytes(), (self.folder / "b" / name).read_bytes())
                self.assertEqual(losses, clip.lint(format.name))
                if not any(own == format.name for own in ("json", "packed")):
                    said = json.loads(run("lint", self.folder / "clip.json", "--target", format.name, "--json"))
                    self.assertEqual(
                        [loss.message for loss in losses], [loss["message"] for loss in said["files"][0]["losses"]]
                    )

    def test_a_measurement_is_the_same(self):
        sweep = pacini.measure.sweep(duration=2, levels=[-20, -10])
        run("measure", "sweep", "-o", self.folder / "sweep.wav", "--duration", 2, "--levels", "-20,-10", "-q")
        self.assertEqual((self.folder / "sweep.json").read_text(), sweep.description)
        run("measure", "simulate", self.folder / "sweep.wav", "-o", self.folder / "recording.wav", "-q")
        run(
            "measure",
            "analyse",
            self.folder / "recording.wav",
            "--sweep",
            self.folder / "sweep.json",
            "--full-scale",
            "5g",
            "-o",
            self.folder / "mine.json",
            "-q",
        )
        measured = pacini.measure.analyse(
            self.folder / "recording.wav", sweep, full_scale=5 * pacini.measure.GRAVITY, name="mine"
        )
        self.assertEqual(measured.profile, pacini.Profile(self.folder / "mine.json"))
        run("measure", "fit", self.folder / "mine.json", "-o", self.folder / "flat.json", "-q")
        self.assertEqual(pacini.measure.fit(measured).profile, pacini.Profile(self.folder / "flat.json"))


if __name__ == "__main__":
    unittest.main()
