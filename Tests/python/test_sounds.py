"""Sounds in arrays of every kind, good and bad; threads, processes and Ctrl+C."""

import dataclasses
import inspect
import json
import multiprocessing
import os
import pickle
import random
import signal
import struct
import subprocess
import sys
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pacini
from sounds import COMMAND, DEMO, SOURCE, FolderTest, knocks

RATE = 48000


def encoded_bytes(seed):
    return pacini.encode(knocks(seed=seed), RATE).to_bytes()


def write_floats(path, samples):
    """A WAV file of float32 samples, whatever they are."""
    data = samples.astype("<f4").tobytes()
    form = struct.pack("<HHIIHH", 3, 1, RATE, 4 * RATE, 4, 32)
    chunks = b"fmt " + struct.pack("<I", len(form)) + form + b"data" + struct.pack("<I", len(data)) + data
    path.write_bytes(b"RIFF" + struct.pack("<I", 4 + len(chunks)) + b"WAVE" + chunks)


def processor_seconds(pid):
    """Time that a process has worked, whatever else the machine does; 0 where no system tells it."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return 0.0
    return sum(int(ticks) for ticks in text.rsplit(")", 1)[1].split()[11:13]) / os.sysconf("SC_CLK_TCK")


class Arrays(FolderTest):
    def test_what_a_mask_hides_is_not_encoded(self):
        sound = np.ma.masked_array(knocks(), mask=False)
        whole = pacini.encode(sound, RATE)
        self.assertEqual(whole.to_bytes(), pacini.encode(knocks(), RATE).to_bytes())
        sound[1000:1100] = np.ma.masked
        points = np.ma.masked_array([[0.0, 1.0], [1.0, 0.5]], mask=[[False, False], [False, True]])
        for call, hidden in (
            (lambda: pacini.encode(sound, RATE), 100),
            (lambda: pacini.compare(sound, knocks(), RATE), 100),
            (lambda: pacini.Band(40, 60, 80, amplitude=points), 1),
            (lambda: pacini.simplify([0.0, 1.0], points[:, 1], count=2), 1),
        ):
            with self.assertRaisesRegex(pacini.ArgumentError, rf"\w: has {hidden} masked values; .*\.filled\(0\)$"):
                call()

    def test_every_layout_of_one_sound_makes_one_clip(self):
        mono = knocks()
        stereo = np.stack([mono, 0.5 * mono])
        wanted = pacini.encode(stereo, RATE)
        frames = np.ascontiguousarray(stereo.T)
        wide = np.zeros((4, 2 * len(mono)), np.float32)
        wide[::2, ::2] = stereo
        fields = np.zeros(len(mono), [("flag", "i1"), ("left", "f4")])
        fields["left"] = mono
        read_only = stereo.copy()
        read_only.flags.writeable = False
        for name, sound, axis in (
            ("channels in C order", stereo, -1),
            ("channels in Fortran order", np.asfortranarray(stereo), 1),
            ("frames first", frames, 0),
            ("float64", stereo.astype(np.float64), -1),
            ("every second sample", wide[::2, ::2], -1),
            ("backwards twice", stereo[:, ::-1].copy()[:, ::-1], -1),
            ("read-only", read_only, -1),
            ("a memory map", self._mapped(stereo), -1),
        ):
            with self.subTest(name):
                self.assertEqual(pacini.encode(sound, RATE, axis=axis), wanted)
                self.assertEqual(
                    pacini.compare(sound, mono, RATE, axis=axis).values, pacini.compare(stereo, mono, RATE).values
                ) if axis == -1 else None
        self.assertEqual(pacini.encode(fields["left"], RATE), pacini.encode(mono, RATE))
        self.assertEqual(pacini.encode(mono.tolist(), RATE), pacini.encode(mono, RATE))
        self.assertEqual(pacini.encode(mono[np.newaxis], RATE), pacini.encode(mono, RATE))

    def _mapped(self, sound):
        np.save(self.folder / "sound.npy", sound)
        return np.load(self.folder / "sound.npy", mmap_mode="r")

    @unittest.skipIf(os.name == "nt", "no resource usage")
    def test_samples_that_are_interleaved_are_not_copied(self):
        script = (
            "import numpy as np, pacini, resource\n"
            "frames = np.full((48000 * 60, 8), 0.1, np.float32)\n"
            "pacini.encode(frames[:48000], 48000, axis=0)\n"
            "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
            "pacini.encode(frames, 48000, axis=0)\n"
            "pacini.encode(frames.T, 48000)\n"
            "grown = 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)\n"
            "print(grown / frames.nbytes)\n"
        )
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        self.assertLess(float(done.stdout), 0.25, done.stderr)
        made = pacini.render(pacini.Clip(1.0))
        self.assertTrue(made.flags.c_contiguous and made.flags.writeable)

    def test_bad_sounds_are_refused_with_their_place(self):
        mono = knocks(0.2)
        broken = np.stack([mono, mono])
        broken[1, 300] = np.nan
        self.refuses("sound[1, 300]", "notFinite", pacini.encode, broken, RATE)
        self.refuses("sound[300]", "notFinite", pacini.encode, broken[1], RATE)
        broken[1, 300] = np.inf
        self.refuses("sound[1, 300]", "notFinite", pacini.encode, broken.astype(np.float64), RATE)
        repaired = broken.copy()
        repaired[1, 300] = 0
        self.assertEqual(pacini.encode(broken, RATE, allow_nan=True), pacini.encode(repaired, RATE))
        for wrong in (
            mono.astype(np.int16),
            mono.astype(np.float16),
            mono.astype(complex),
            mono.astype(object),
            mono.astype(">f4"),
            np.zeros((2, 2, 2), np.float32),
            np.float32(1),
            bytearray(b"x"),
            None,
            np.zeros((65, 10), np.float32),
            np.zeros((0, 10), np.float32),
        ):
            self.refuses("sound", "invalidArgument", pacini.encode, wrong, RATE)
        for wrong, told in ((mono.astype(np.int16), "sound / 32768"), (np.zeros((100, 2), np.float32), "give axis=0")):
            with self.assertRaisesRegex(pacini.Error, told):
                pacini.encode(wrong, RATE)
        self.refuses("sample_rate", "invalidArgument", pacini.encode, b"x", RATE)  # a path
        self.refuses("axis", "invalidArgument", pacini.encode, mono, RATE, axis=1)
        self.refuses("sample_rate", "invalidArgument", pacini.encode, mono)
        for rate in (0, -1, 100, 1e9, 44100.5, float("nan"), "fast"):
            self.refuses("sample_rate", "invalidArgument", pacini.encode, mono, rate)
        self.assertEqual(pacini.encode(np.zeros(0, np.float32), RATE).duration, 0.0)
        self.assertEqual(pacini.encode(np.zeros(1, np.float32), RATE).breakpoints, 0)
        self.refuses("bands", "invalidArgument", pacini.encode, mono, RATE, bands=99)
        self.refuses("method", "invalidArgument", pacini.encode, mono, RATE, method="magic")
        self.refuses("method", "invalidArgument", pacini.encode, mono, RATE, method="lowpass")
        self.refuses("spacing", "invalidArgument", pacini.encode, mono, RATE, method="thesis", spacing="log")

    def test_options_are_those_that_are_described_and_the_nearest_is_named(self):
        mono = knocks(0.5)
        self.refuses("minimum_gap", "invalidArgument", pacini.encode, mono, RATE, minimum_gap=2)
        with self.assertRaisesRegex(pacini.Error, "must be log or linear, not 'linaer'; did you mean linear"):
            pacini.encode(mono, RATE, spacing="linaer")
        with self.assertRaisesRegex(pacini.Error, "did you mean thesis"):
            pacini.encode(mono, RATE, method="tehsis")
        with self.assertRaisesRegex(TypeError, "minimal_gap: is no argument of encode.*did you mean minimum_gap"):
            pacini.encode(mono, RATE, minimal_gap=0.1)
        with self.assertRaisesRegex(TypeError, "pionts: is no argument of to_bytes.*did you mean points"):
            pacini.encode(mono, RATE).to_bytes("haptic", pionts=4)
        self.refuses("sample_rate", "invalidArgument", pacini.encode(mono, RATE).to_bytes, "openxr", sample_rate=100)
        self.assertEqual(pacini.encode(mono, RATE, bands=np.int16(5)), pacini.encode(mono, RATE, bands=5.0))

    def test_a_parameter_that_is_described_is_a_keyword(self):
        from pacini import _parameters

        shown = inspect.signature(pacini.encode).parameters
        self.assertTrue(set(_parameters.ENCODE) < set(shown))
        self.assertNotIn("options", shown)
        for name, one in _parameters.ENCODE.items():
            self.assertIn(f"{name}: {one['text']}", pacini.encode.__doc__)

        depth = {"kind": "number", "text": "How much", "lowest": 0, "highest": 6, "unit": "dB", "default": 1}
        made_up = {"shimmer_depth": depth}

        @_parameters.with_keywords(made_up)
        def shimmer(sound, **options):
            """Shimmers."""
            _parameters.check_names("shimmer", options, made_up)

        self.assertEqual(list(inspect.signature(shimmer).parameters), ["sound", "shimmer_depth"])
        self.assertIn("shimmer_depth: How much (0 to 6 dB) [1]", shimmer.__doc__)
        self.assertRaises(TypeError, shimmer, None, shimmer_dept=1)

    def test_settings_are_a_file_or_its_object(self):
        settings = {"format": "pacini.settings", "version": 1, "encode": {"bands": 5, "minimumGap": 0.05}}
        mono = knocks(0.5)
        wanted = pacini.encode(mono, RATE, bands=5, minimum_gap=0.05)
        self.assertEqual(pacini.encode(mono, RATE, settings=settings), wanted)
        (self.folder / "mine.json").write_text(json.dumps(settings))
        self.assertEqual(pacini.encode(mono, RATE, settings=self.folder / "mine.json"), wanted)
        self.assertEqual(len(pacini.encode(mono, RATE, settings=settings, bands=4).bands), 4)
        settings["encode"]["bnads"] = 3
        with self.assertWarnsRegex(UserWarning, "bnads: is unknown; did you mean"):
            pacini.encode(mono, RATE, settings=settings)
        settings["encode"] = {"bands": 99}
        self.refuses("encode.bands", "invalidArgument", pacini.encode, mono, RATE, settings=settings)
        missing = self.folder / "none.json"
        self.refuses(str(missing), "io", pacini.encode, mono, RATE, settings=missing)

    def test_bad_files_are_refused_with_their_name(self):
        missing = self.folder / "missing.wav"
        self.refuses(str(missing), "io", pacini.encode, missing)
        text = self.folder / "text.wav"
        text.write_text("no sound")
        self.refuses(str(text), "invalidData", pacini.encode, str(text))
        self.refuses("sample_rate", "invalidArgument", pacini.encode, DEMO[0], 48000)
        pacini.write_audio(self.folder / "a.wav", knocks(0.1), RATE)
        self.assertEqual(pacini.read_audio(self.folder / "a.wav")[0].tobytes(), knocks(0.1).tobytes())
        with open(self.folder / "a.wav", "rb") as closed:
            pass
        self.refuses("sound", "invalidArgument", pacini.encode, closed, RATE)
        loud = np.array([0.0, 2.0], np.float32)
        self.assertEqual(pacini.write_audio(self.folder / "b.wav", loud, RATE, encoding="pcm16"), 1)
        self.refuses("encoding", "invalidArgument", pacini.write_audio, self.folder / "c.wav", loud, RATE, encoding="8")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["a.wav", "b.wav", "text.wav"])

    def test_nothing_is_printed_of_damaged_mp3_files(self):
        whole = (SOURCE / "Tests/io/audio/tone.mp3").read_bytes()
        source = random.Random(5)
        for number in range(40):
            content = bytearray(whole)
            for _ in range(source.choice((1, 3, 10, 60))):
                content[source.randrange(len(content))] = source.randrange(256)
            (self.folder / f"{number}.mp3").write_bytes(bytes(content[source.choice((0, source.randrange(900))):]))
        program = ("import pacini, pathlib, sys\nprint('before', file=sys.stderr)\n"
                   "for path in sorted(pathlib.Path(sys.argv[1]).glob('*.mp3')):\n"
                   "    try:\n        pacini.encode(path)\n    except pacini.Error:\n        pass\n")
        done = subprocess.run([sys.executable, "-W", "ignore", "-c", program, self.folder], capture_output=True,
                              text=True)
        self.assertEqual((done.returncode, done.stderr), (0, "before\n"))

    def test_samples_that_are_no_sound_are_no_silence_for_comparisons(self):
        sound = knocks(0.5)
        whole = pacini.compare(sound, sound, RATE)
        self.assertEqual(whole.not_finite, 0)
        for value, says in (
            (np.nan, "is NaN"),
            (np.inf, "is infinite"),
            (-np.inf, "is infinite"),
            (1e30, "far beyond"),
        ):
            broken = sound.copy()
            broken[100] = value
            path = self.folder / f"{value}.wav"
            write_floats(path, broken)
            for arguments, where in (
                ((sound, broken, RATE), "candidate[100]"),
                ((broken, sound, RATE), "reference[100]"),
                ((sound, broken.astype(np.float64), RATE), "candidate[100]"),
                ((np.stack([sound, sound]), np.stack([sound, broken]), RATE), "candidate[100]"),
                ((path, path), "reference[100]"),
            ):
                with self.subTest(f"{value} in {where}"), self.assertRaisesRegex(pacini.Error, says) as caught:
                    pacini.compare(*arguments)
                self.assertEqual((caught.exception.where, caught.exception.code), (where, "notFinite"))
            taken = pacini.compare(sound, broken, RATE, allow_nan=True)
            self.assertEqual(taken.not_finite, 1)
            self.assertTrue(all(np.isfinite(x) for x in taken.values.values() if isinstance(x, float)))
        self.refuses(
            "candidate[7]", "notFinite", pacini.compare, sound, np.where(np.arange(24000) == 7, 1e300, 0.0), RATE
        )
        self.assertEqual(pacini.compare(sound, sound, RATE).values, whole.values)

    def test_recordings_that_are_no_sound_are_not_measured(self):
        sweep = pacini.measure.sweep(duration=1)
        recording = pacini.measure.simulate(sweep)
        broken = recording.samples.copy()
        broken[1, 1000] = np.nan
        self.refuses(
            "channels[1][1000]",
            "notFinite",
            pacini.measure.analyse,
            pacini.measure.Recording(broken, recording.sample_rate),
            sweep,
        )
        played = sweep.signal.copy()
        played[7] = np.inf
        self.refuses("sound[7]", "notFinite", pacini.measure.simulate, dataclasses.replace(sweep, signal=played))

    def test_many_files_go_on_after_one_whatever_it_is_called(self):
        for name in ("a", "c"):
            pacini.write_audio(self.folder / f"{name}.wav", knocks(0.2), RATE)
        folder = os.fsencode(self.folder)
        for name in (b"b\xff.wav", b"d\xff.wav"):
            with open(folder + b"/" + name, "wb") as file:
                file.write(b"junk" if name[0:1] == b"b" else (self.folder / "a.wav").read_bytes())
        paths = [os.fsdecode(folder + b"/" + name) for name in sorted(os.listdir(folder))]
        found = {path: clip for path, clip in pacini.encode_files(paths, threads=1)}
        self.assertEqual([type(found[path]) for path in paths], [pacini.Clip, pacini.Error, pacini.Clip, pacini.Clip])
        self.assertEqual(found[paths[1]].where, paths[1])

    def test_a_path_is_text_bytes_or_an_object_and_may_be_the_only_one(self):
        name = os.fsencode(self.folder) + b"/b\xff"
        forms = (os.fsdecode(name + b".wav"), name + b".wav", Path(os.fsdecode(name + b".wav")))
        pacini.write_audio(forms[1], knocks(0.2), RATE)
        wanted = pacini.encode(knocks(0.2), RATE).bands
        for path in forms:
            self.assertEqual(pacini.encode(path).bands, wanted)
            self.assertEqual([(given, clip.bands) for given, clip in pacini.encode_files(path)], [(path, wanted)])
            self.assertEqual([given for given, _ in pacini.encode_files([path])], [path])
            np.testing.assert_array_equal(pacini.read_audio(path)[0], knocks(0.2))
            self.assertEqual(pacini.compare(path, path).lsd, 0.0)
        clip = pacini.encode(forms[1])
        clip.save(name + b".pacb")
        pacini.convert(name + b".pacb", name + b".json")
        self.assertEqual(pacini.read(name + b".json"), pacini.Clip.load(name + b".pacb"))
        self.assertEqual(pacini.lint(name + b".json", "ahap"), clip.lint("ahap"))
        with open(name + b".settings.json", "w") as file:
            file.write(json.dumps({"format": "pacini.settings", "version": 1, "encode": {"bands": 2}}))
        self.assertEqual(len(pacini.encode(forms[1], settings=name + b".settings.json").bands), 2)
        profile = pacini.Profile("l5-wristband")
        profile.save(name + b".profile.json")
        np.testing.assert_array_equal(
            pacini.render(clip, profile=name + b".profile.json"), pacini.render(clip, profile=profile)
        )

    def test_many_sounds_may_be_arrays_with_their_rates(self):
        sound, other = knocks(0.3), np.stack([knocks(0.2), knocks(0.2)], axis=1)
        path = self.folder / "a.wav"
        pacini.write_audio(path, sound, RATE)
        wanted = pacini.encode(sound, RATE).bands
        given = [path, (sound, RATE), sound, (other, 44100), (sound.astype(np.int16), RATE)]
        found = {id(item): clip for item, clip in pacini.encode_files(given, sample_rate=RATE, axis=0, threads=2)}
        for item in given[:3]:
            self.assertEqual(found[id(item)].bands, wanted)
        self.assertEqual(found[id(given[3])].bands, pacini.encode(other, 44100, axis=0).bands)
        self.assertIn("int16", str(found[id(given[4])]))
        ((item, clip),) = pacini.encode_files(sound, sample_rate=RATE)
        self.assertIs(item, sound)
        self.assertEqual(clip.bands, wanted)
        ((_, error),) = pacini.encode_files([sound])
        self.assertEqual((type(error), error.where), (pacini.Error, "sample_rate"))

    def test_folders_are_compared_by_the_names_in_them(self):
        sounds, felt = self.folder / "sounds", self.folder / "felt"
        for folder in (sounds / "deep", felt / "deep"):
            folder.mkdir(parents=True)
        for name in ("a", "b", "deep/c", "d"):
            pacini.write_audio(sounds / f"{name}.wav", knocks(0.4), RATE)
        (sounds / "notes.txt").write_text("no sound")
        clip = pacini.encode(knocks(0.4), RATE)
        clip.save(felt / "a.pacb")
        pacini.write_audio(felt / "a.wav", knocks(0.4), RATE)  # what was rendered counts, not its clip
        clip.save(felt / "deep/c.pacb")
        pacini.write_audio(felt / "d.wav", knocks(0.4), RATE)
        pacini.write_audio(felt / "d.flac", knocks(0.4), RATE, encoding="pcm16")
        clip.save(felt / "alone.pacb")
        with self.assertWarnsRegex(UserWarning, "alone.pacb: has no reference"):
            found = dict(pacini.compare_files(sounds, felt, threads=2))
        self.assertEqual(sorted(found), ["a.wav", "b.wav", "d.wav", "deep/c.wav"])
        self.assertEqual(found["a.wav"].lsd, 0.0)
        self.assertEqual(found["deep/c.wav"].hts, pacini.compare(sounds / "deep/c.wav", clip).hts)
        self.assertRegex(str(found["b.wav"]), "no counterpart b")
        self.assertRegex(str(found["d.wav"]), "two counterparts")
        with self.assertRaisesRegex(pacini.Error, "is no folder"):
            pacini.compare_files(sounds / "a.wav", felt)

    def test_options_that_are_none_are_told_before_the_first_file(self):
        self.refuses("bandz", "invalidArgument", pacini.encode_files, ["none.wav"], bandz=3)
        self.refuses("bands", "invalidArgument", pacini.encode_files, ["none.wav"], bands=1000)
        with self.assertRaisesRegex(pacini.Error, "did you mean bands"):
            pacini.encode_files([], bandz=3)

    def test_rendered_signals_have_the_type_that_is_asked_for(self):
        clip = pacini.encode(knocks(0.3), RATE)
        single, double = pacini.render(clip), pacini.render(clip, dtype=np.float64)
        self.assertEqual((single.dtype, double.dtype, single.shape), (np.float32, np.float64, (14400,)))
        np.testing.assert_array_equal(single, double.astype(np.float32))
        self.refuses("dtype", "invalidArgument", pacini.render, clip, dtype=int)
        self.refuses("sample_rate", "invalidArgument", pacini.render, clip, 10)
        self.refuses("stretch", "invalidArgument", pacini.render, clip, stretch=0)
        numbers = ("gain", "transpose", "stretch", "delay", "start", "variation", "tolerance", "max_boost", "strength",
                   "pulse_frequency", "pulse_cycles")  # fmt: skip
        for option in numbers:
            for value in (np.nan, np.inf, 1e300, -1e300):
                self.refuses(option, "invalidArgument", pacini.render, clip, **{option: value})
        self.refuses("end", "invalidArgument", pacini.render, clip, start=0.2, end=0.1)
        # What has no effect is refused, as by the command.
        for option, value in (("strength", 0.5), ("max_boost", 3), ("mapping", "clamp")):
            self.refuses(option, "invalidArgument", pacini.render, clip, **{option: value})
            self.refuses(
                option, "invalidArgument", pacini.render, clip, profile="lra-175", adapt=False, **{option: value}
            )
            pacini.render(clip, profile="lra-175", **{option: value})
        for option in ("pulse_frequency", "pulse_cycles"):
            for pulse in (None, "adaptive"):
                self.refuses(option, "invalidArgument", pacini.render, clip, pulse=pulse, **{option: 40})
            pacini.render(clip, pulse="sine", **{option: 40})
        self.refuses("strength", "invalidArgument", pacini.explain, clip, strength=0.5)
        self.refuses("strength", "invalidArgument", clip.lint, "wav16", strength=0.5)
        self.refuses("strength", "invalidArgument", clip.to_bytes, "wav16", strength=0.5)
        self.refuses("strength", "invalidArgument", clip.save, self.folder / "x.haptic", strength=0.5)
        nothing_left = {"method": "thesis", "low_limit": 500, "high_limit": 100}
        self.refuses("low_limit", "invalidArgument", pacini.encode, knocks(0.3), RATE, **nothing_left)
        self.refuses("content", "invalidArgument", pacini.render, "clip.json")
        report = pacini.explain(clip, profile="lra-175")
        self.assertTrue(report.adaptations)

    def test_the_translator_does_not_care_for_blocks(self):
        sound = knocks()
        translator = pacini.Translator(RATE, profile="l5-wristband", preset="Music")
        whole = translator(sound)
        translator.reset()
        parts = [translator(block) for block in np.split(sound, [1, 100, 5000])]
        np.testing.assert_array_equal(np.concatenate(parts), whole)
        self.assertGreater(np.abs(whole).max(), 0.05)
        self.assertTrue(0.001 < translator.latency / RATE < 0.0015)
        self.assertEqual(len(translator.meters["bands"]), 6)
        translator.set(bypass=True, rumble_muted=True)
        self.assertTrue(translator.params["bypass"] and translator.params["rumble_muted"])
        self.refuses("colour", "invalidArgument", translator.set, colour=1)
        self.refuses("rumble", "invalidArgument", translator.set, rumble=100)
        self.refuses("block", "invalidArgument", translator, np.stack([sound, sound]))

    def test_the_translator_reads_the_settings_of_the_plugin(self):
        path = self.folder / "mine.json"
        live = {"intensity": -6, "rumbleMuted": True}
        content = {"format": "pacini.settings", "version": 1, "encode": {"bands": 8}, "live": live}
        path.write_text(json.dumps(content))
        usual = pacini.Translator().params
        wanted = {**usual, "intensity": -6.0, "rumble_muted": True}
        for settings in (path, str(path), content):
            translator = pacini.Translator(settings=settings)
            self.assertEqual(translator.params, wanted)
            # What was heard before there were any settings is nothing: the first block has them.
            by_hand = pacini.Translator(intensity=-6, rumble_muted=True)
            np.testing.assert_array_equal(translator(knocks()), by_hand(knocks()))
        self.refuses("preset", "invalidArgument", pacini.Translator, preset="Music", settings=content)
        self.assertEqual(pacini.Translator(settings=content, intensity=3).params, {**wanted, "intensity": 3.0})
        self.assertEqual(pickle.loads(pickle.dumps(pacini.Translator(settings=content))).params, wanted)
        with self.assertWarnsRegex(UserWarning, "settings: .*intensty.*intensity"):
            pacini.Translator(settings={**content, "live": {"intensty": 1}})
        self.refuses("live", "invalidData", pacini.Translator, settings={**content, "live": None})
        for wrong in ({"format": "pacini.settings", "version": 1}, {**content, "live": {"intensity": 1000}},
                      {**content, "live": {"intensity": "loud"}}, {**content, "live": []}, {**content, "version": 99},
                      {**content, "encode": {"bands": 1000}}):
            path.write_text(json.dumps(wrong))
            told = subprocess.run([COMMAND, "live", DEMO[0], "--settings", path, "-o", "-"],
                                  capture_output=True, text=True).stderr
            for settings in (path, wrong):
                with self.assertRaises(pacini.Error) as caught:
                    pacini.Translator(settings=settings)
                self.assertIn(str(caught.exception), told)

    def test_progress_is_told_and_may_stop_the_work(self):
        shares = []
        sound = knocks(120.0)
        pacini.encode(sound, RATE, progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(shares and 0.0 < shares[0] and shares[-1] <= 1.0)

        def stop(share):
            raise KeyError("enough")

        with self.assertRaises(KeyError):
            pacini.encode(sound, RATE, progress=stop)
        self.assertEqual(pacini.encode(knocks(), RATE).to_bytes(), encoded_bytes(1))


class Concurrency(FolderTest):
    def test_threads_get_what_one_gets(self):
        wanted = [encoded_bytes(seed) for seed in range(8)]
        with ThreadPoolExecutor(4) as pool:
            self.assertEqual(list(pool.map(encoded_bytes, range(8))), wanted)
        found = dict(pacini.encode_files([*DEMO, self.folder / "missing.wav"], threads=2))
        self.assertIsInstance(found.pop(self.folder / "missing.wav"), pacini.Error)
        self.assertEqual(found, {path: pacini.encode(path) for path in DEMO})

    def test_the_lock_is_free_while_work_goes_on(self):
        sound = knocks(60.0)
        counted = 0
        done = threading.Event()

        def work():
            pacini.encode(sound, RATE)
            done.set()

        thread = threading.Thread(target=work)
        thread.start()
        longest = 0.0
        last = time.perf_counter()
        while not done.is_set():
            time.sleep(0.001)
            now = time.perf_counter()
            longest, last, counted = max(longest, now - last), now, counted + 1
        thread.join()
        self.assertGreater(counted, 20)
        self.assertLess(longest, 0.5)

    def test_children_by_fork_and_by_spawn_get_the_same(self):
        wanted = [encoded_bytes(seed) for seed in range(3)]
        for method in ("fork", "spawn"):
            with multiprocessing.get_context(method).Pool(2) as pool:
                self.assertEqual(pool.map(encoded_bytes, range(3)), wanted, method)

    @unittest.skipIf(os.name == "nt", "no signals")
    def test_ctrl_c_stops_long_work_within_a_second_of_work_and_leaves_nothing(self):
        for work in (
            "pacini.encode(sound, 48000)",
            "pacini.translate(sound[:5760000], 48000, method='percept')",
            "pacini.compare(sound[:5760000], sound[:5760000], 48000)",
            "pacini.render(pacini.Clip(3000.0, [pacini.Band(50, 100, 200, amplitude=[(0, 0.5)])]), leave_out=False)",
            "[pacini.encode(sound[:48000], 48000) for _ in range(10000)]",
            "pacini.write_audio('0.wav', sound, 48000); list(pacini.encode_files(['0.wav'] * 9))",
        ):
            script = (
                "import numpy as np, pacini, signal, sys, time\n"
                # Jobs in the background of a script ignore it.
                "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
                "sound = np.random.default_rng(1).standard_normal(48000 * 600, dtype=np.float32)\n"
                "print('ready', flush=True)\n"
                "try:\n"
                f"    {work}\n"
                "    print('finished', flush=True)\n"
                "except KeyboardInterrupt:\n"
                "    print('stopped', flush=True)\n"
            )
            with (
                self.subTest(work),
                subprocess.Popen(
                    [sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, cwd=self.folder
                ) as process,
            ):
                self.assertEqual(process.stdout.readline(), "ready\n")
                time.sleep(0.1)  # inside of the work, however fast the machine is
                before = processor_seconds(process.pid)
                process.send_signal(signal.SIGINT)
                self.assertEqual(process.stdout.readline(), "stopped\n")
                self.assertLess(processor_seconds(process.pid) - before, 1.0)
                self.assertEqual(process.wait(120), 0)
        self.assertTrue({path.name for path in self.folder.iterdir()} <= {"0.wav"})


class Interpreters(unittest.TestCase):
    def test_another_interpreter_is_refused_and_the_main_one_goes_on(self):
        script = """
import sys
import pacini
try:
    import _interpreters as interpreters
except ImportError:
    import _xxsubinterpreters as interpreters
before = pacini.Clip(1.0)
other = interpreters.create()
code = "try:\\n import pacini\\nexcept ImportError as error:\\n print(error, flush=True)"
run = getattr(interpreters, "exec", None) or interpreters.run_string
run(other, code)
assert pacini.Clip(2.0).duration == 2.0 and before.duration == 1.0
print("goes on")
"""
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, "(?s)main interpreter only.*goes on")


if __name__ == "__main__":
    unittest.main()
