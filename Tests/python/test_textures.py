"""Textures in Python: made of recordings, read and written, played by arrays, and within scenes."""

import copy
import os
import pickle
import unittest

import numpy as np
import pacini
from sounds import FolderTest

RATE = 8000


def engine(seconds=20.0, seed=1):
    """Orders 1 and 2 of 100 Hz at full speed over noise, and the speed of each frame."""
    t = np.arange(int(seconds * RATE)) / RATE
    speed = 0.6 - 0.4 * np.cos(2 * np.pi * t / 10)
    way = np.cumsum(speed) / RATE
    noise = np.random.default_rng(seed).normal(0, 0.01, len(t))
    sound = 0.2 * speed * np.sin(2 * np.pi * 100 * way) + 0.1 * speed * np.sin(2 * np.pi * 200 * way) + noise
    return sound, speed


def rms(x):
    return float(np.sqrt(np.mean(np.square(x, dtype=np.float64))))


class Textures(FolderTest):
    @classmethod
    def setUpClass(cls):
        cls.sound, cls.speed = engine()
        cls.texture = pacini.Texture.of_recording(cls.sound, RATE, speed=3000 * cls.speed, name="engine")

    def test_a_recording_with_its_speed_gives_tones_and_nodes(self):
        content = self.texture.to_dict()
        self.assertEqual(self.texture.name, "engine")
        self.assertAlmostEqual(self.texture.full_speed, 3000, delta=5)
        self.assertEqual(len(content["tones"]), 2)
        for tone, wanted in zip(content["tones"], (100, 200)):
            self.assertAlmostEqual(tone["frequency"], wanted, delta=0.2)
        self.assertIn("2 tones", repr(self.texture))

    def test_what_a_motor_cannot_do_is_told(self):
        scene = pacini.Scene([], [{"texture": 0, "duration": 1}], textures=[self.texture])
        with self.assertWarnsRegex(UserWarning, r"plays\[0\] is a texture, which a motor cannot follow"):
            report = pacini.explain(scene, profile="erm-coin")
        self.assertEqual(report.predicted_error, 0)

    def test_it_plays_by_arrays_of_each_frame_and_by_points(self):
        per_frame = self.texture.render(np.full(2 * RATE, 0.5), sample_rate=RATE)
        points = self.texture.render([0.5, 0.5], times=[0, 2], sample_rate=RATE)
        one = self.texture.render(0.5, duration=2, sample_rate=RATE)
        self.assertEqual(per_frame.shape, (2 * RATE,))
        self.assertEqual(per_frame.dtype, np.float32)
        np.testing.assert_array_equal(per_frame, points)
        np.testing.assert_array_equal(per_frame, one)
        self.assertEqual(rms(self.texture.render(0.0, duration=1)), 0.0)
        self.assertEqual(rms(self.texture.render(0.5, 0.0, duration=1)), 0.0)
        soft = self.texture.render(0.5, 0.25, duration=2, sample_rate=RATE)
        self.assertAlmostEqual(rms(soft) / rms(one), 0.5, delta=0.02)
        self.assertFalse(np.array_equal(one, self.texture.render(0.5, duration=2, sample_rate=RATE, seed=2)))
        felt = self.texture.render(0.5, duration=1, profile="l5-wristband")
        self.assertLessEqual(np.abs(felt).max(), 1.0)

    def test_numbers_that_are_none_are_speed_zero_and_beyond_one_is_one(self):
        speed = np.full(RATE, 0.5)
        speed[RATE // 2 :] = np.nan
        made = self.texture.render(speed, sample_rate=RATE)
        self.assertTrue(np.isfinite(made).all())
        self.assertLess(rms(made[-RATE // 4 :]), 1e-6)
        full = self.texture.render(1.0, duration=1, sample_rate=RATE)
        np.testing.assert_array_equal(self.texture.render(7.0, duration=1, sample_rate=RATE), full)

    def test_it_is_written_read_copied_and_pickled(self):
        path = os.path.join(self.folder, "engine.texture.json")
        self.texture.save(path)
        self.assertEqual(pacini.Texture.load(path), self.texture)
        self.texture.save(path)  # one of its kind
        self.assertEqual(pickle.loads(pickle.dumps(self.texture)), self.texture)
        self.assertEqual(copy.deepcopy(self.texture), self.texture)
        other = os.path.join(self.folder, "notes.json")
        with open(other, "w") as file:
            file.write("{}")
        with self.assertRaises(pacini.Error):
            self.texture.save(other)
        with self.assertRaises(pacini.Error):
            pacini.Texture.load(other)

    def test_a_scene_moves_it(self):
        scene = pacini.Scene(
            [],
            [{"texture": 0, "duration": 2, "speed": 0}],
            [{"time": 1, "play": 0, "parameter": "speed", "value": 0.5}],
            textures=[self.texture],
        )
        self.assertEqual(scene.textures, [self.texture])
        self.assertEqual(pickle.loads(pickle.dumps(scene)), scene)
        made = pacini.render(scene, RATE)
        self.assertEqual(len(made), 2 * RATE)
        self.assertEqual(rms(made[: RATE - 80]), 0.0)
        self.assertGreater(rms(made[RATE + 80 : -80]), 0.03)

    def test_tables_that_do_not_cover_the_recording_and_samples_that_are_none_are_told(self):
        sound = np.random.default_rng(1).standard_normal(16000) * 0.1
        with self.assertWarnsRegex(UserWarning, "speed: is stated from 0.00 to 0.10 s, but the recording lasts 2.00 s"):
            pacini.Texture.of_recording(sound, 8000, speed=[1, 0.5], times=[0, 0.1])
        with self.assertRaisesRegex(pacini.Error, "speed: must have numbers from 0 to 1e9"):
            pacini.Texture.of_recording(sound, 8000, speed=[1e300, 1], times=[0, 2])
        with self.assertRaisesRegex(pacini.Error, "has samples that are not finite"):
            pacini.Texture.of_recording(np.full(16000, np.nan), 8000)

    def test_what_is_wrong_is_told_with_its_place(self):
        for call, where in (
            (lambda: self.texture.render(0.5), "duration"),
            (lambda: self.texture.render([0.1, 0.2], times=[0]), "speed"),
            (lambda: self.texture.render([0.1, 0.2], times=[1, 0]), "times"),
            (lambda: self.texture.render("fast", duration=1), "speed"),
            (lambda: self.texture.render(0.5, duration=1, profile="erm-coin"), "technology"),
            (lambda: pacini.Texture.of_recording(np.zeros(RATE), RATE), ""),
            (lambda: pacini.Texture.of_recording(self.sound, RATE, speed=[1, -1]), "speed"),
            (lambda: pacini.Texture.of_recording(self.sound, RATE, speed=[1, 2], times=[0]), "times"),
            (lambda: pacini.Texture.of_recording(self.sound, RATE, order=0), "order"),
            (lambda: pacini.Scene([], [{"texture": 1, "duration": 1}], textures=[self.texture]), "plays[0].texture"),
            (lambda: pacini.Scene([], [], textures=["wood"]), "textures[0]"),
        ):
            with self.assertRaises(pacini.Error) as caught:
                call()
            self.assertEqual(caught.exception.where, where)
        with self.assertRaises(TypeError):
            pacini.Texture.of_recording(self.sound, RATE, colour=1)


if __name__ == "__main__":
    unittest.main()
