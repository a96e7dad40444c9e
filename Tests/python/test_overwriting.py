"""What Python writes by a name that a caller gave never destroys a recording that nobody spoke of."""

from __future__ import annotations

import os
import unittest
from pathlib import Path
from typing import Any

import numpy as np
import pacini
from sounds import RATE, FolderTest, knocks, run


class Overwriting(FolderTest):
    def recording(self, name: str = "door.wav", seed: int = 1) -> Path:
        path = self.folder / name
        pacini.write_audio(path, knocks(0.5, seed=seed), RATE)
        return path

    def keeps(self, path: Path, says: str, call: Any, *arguments: Any, **options: Any) -> None:
        """Raises with that reason; the file stays to the byte and nothing is left beside it."""
        before, names = path.read_bytes(), sorted(os.listdir(self.folder))
        with self.assertRaisesRegex(pacini.Error, says) as caught:
            call(*arguments, **options)
        self.assertEqual(caught.exception.code, "io")
        self.assertEqual(path.read_bytes(), before)
        self.assertEqual(sorted(os.listdir(self.folder)), names)

    def test_a_recording_is_replaced_by_nothing_that_does_not_say_so(self) -> None:
        path = self.recording()
        clip, scene = pacini.Clip(1.0), pacini.Scene([pacini.Clip(1.0)])
        profile, sweep = pacini.Profile("lra-175"), pacini.measure.sweep(duration=1)
        drive = np.zeros(480, np.float32)
        says = "is a sound that Pacini did not make; overwrite=True"
        self.keeps(path, says, pacini.write_audio, path, drive, RATE)
        self.keeps(path, says, clip.save, path, format="json")
        self.keeps(path, says, clip.save, path, format="wav16", profile="lra-175")
        self.keeps(path, says, scene.save, path)
        self.keeps(path, says, profile.save, path)
        self.keeps(path, says, sweep.save, path)
        clip.save(self.folder / "clip.json")
        self.keeps(path, says, pacini.convert, self.folder / "clip.json", path, format="packed")
        for call, arguments in (
            (pacini.write_audio, (path, drive, RATE)),
            (clip.save, (self.folder / "clip.json",)),
            (scene.save, (path,)),
            (profile.save, (path,)),
        ):
            self.keeps(path, "exists", call, *arguments, overwrite=False)
        pacini.write_audio(path, drive, RATE, overwrite=True)
        self.assertEqual(len(pacini.read_audio(path)[0]), 480)

    def test_the_recording_of_a_clip_is_never_lost(self) -> None:
        path = self.recording()
        clip = pacini.encode(path)
        for overwrite in (None, True):
            self.keeps(
                path, "is the recording that this clip was made from", clip.save, path, format="wav16",
                profile="lra-175", overwrite=overwrite,
            )  # fmt: skip
        os.mkdir(self.folder / "drives")
        elsewhere = self.folder / "drives" / "door.wav"  # of the same name, but only a drive signal
        clip.save(elsewhere, format="wav16", profile="lra-175")
        drive = elsewhere.read_bytes()
        clip.save(elsewhere, format="wav16", profile="lra-175")  # nothing of it can be lost
        self.assertEqual(elsewhere.read_bytes(), drive)
        clip.save(elsewhere, format="wav8", profile="lra-175")
        with self.assertRaisesRegex(pacini.Error, "is a sound that Pacini did not make"):
            pacini.encode(knocks(seed=2), RATE).save(elsewhere, format="wav8", profile="lra-175")

    def test_what_is_converted_is_not_its_own_result(self) -> None:
        path = self.folder / "clip.json"
        pacini.encode(knocks(), RATE).save(path)
        os.symlink(path, self.folder / "link.json")
        for output in (path, self.folder / "link.json"):
            self.keeps(path, "is also the input", pacini.convert, path, output, format="packed", overwrite=True)

    def test_files_of_one_kind_are_replaced_and_those_of_another_are_not(self) -> None:
        clip, scene = pacini.encode(knocks(), RATE), pacini.Scene([pacini.Clip(1.0)])
        profile = pacini.Profile("lra-175")
        paths = {"clip": self.folder / "c.json", "scene": self.folder / "s.json", "profile": self.folder / "p.json"}
        things: dict[str, Any] = {"clip": clip, "scene": scene, "profile": profile}
        for _ in range(2):
            for name, thing in things.items():
                thing.save(paths[name])
        for name, thing in things.items():
            for other, path in paths.items():
                if other != name:
                    self.keeps(path, f"is (a|the) {other}", thing.save, path)
        notes = self.folder / "notes.json"
        notes.write_text('{"by": "hand"}')
        for thing in things.values():
            self.keeps(notes, "nothing in it says that Pacini made it", thing.save, notes)
        empty = self.folder / "empty.json"
        empty.touch()
        clip.save(empty)
        for extension in (".haptic", ".ahap", ".xml", ".kt", ".h", ".tact", ".csv"):
            for _ in range(2):
                clip.save(self.folder / f"clip{extension}")
                clip = clip.transposed(1)

    def test_a_companion_is_looked_at_too(self) -> None:
        mine = self.folder / "door-transients.ahap"
        mine.write_text("a person's")
        clip = pacini.encode(knocks(), RATE)
        self.keeps(mine, "nothing in it says that Pacini made it", clip.save, self.folder / "door.ahap", split=True)
        clip.save(self.folder / "door.ahap", split=True, overwrite=True)
        clip.save(self.folder / "door.ahap", split=True)

    def test_what_pacini_marked_is_replaced_until_somebody_changes_it(self) -> None:
        pacini.encode(knocks(), RATE).save(self.folder / "clip.json")
        run("render", "clip.json", folder=self.folder)
        path = self.folder / "clip.haptic.wav"
        data = bytearray(path.read_bytes())
        pacini.write_audio(path, knocks(0.1), RATE)
        data[-1] ^= 1
        path.write_bytes(bytes(data))
        self.keeps(path, "was changed since Pacini made it", pacini.write_audio, path, knocks(0.1), RATE)

    def test_a_sweep_replaces_neither_sound_nor_description(self) -> None:
        sweep = pacini.measure.sweep(duration=1)
        path, description = self.folder / "sweep.wav", self.folder / "sweep.json"
        description.write_text("a person's")
        self.keeps(description, "exists", sweep.save, path)
        sweep.save(path, overwrite=True)
        self.keeps(path, "exists", sweep.save, path)
        description.unlink()
        self.keeps(path, "is a sound", sweep.save, path)
        with self.assertRaisesRegex(pacini.Error, "name a sound"):
            sweep.save(description)


if __name__ == "__main__":
    unittest.main()
