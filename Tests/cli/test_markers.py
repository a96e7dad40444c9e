"""End to end: markers from a sound or a file of labels into a clip, and from there into a sound again."""
import json
import struct
import unittest

from command import CommandTest, sine, wav


def chunk(name, content):
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


def with_cues(sound, cues):
    """The WAV with (frame, name) of `cues` behind its sound."""
    points, labels = struct.pack("<I", len(cues)), b"adtl"
    for number, (frame, name) in enumerate(cues, 1):
        points += struct.pack("<II4sIII", number, frame, b"data", 0, 0, frame)
        labels += chunk(b"labl", struct.pack("<I", number) + name.encode() + b"\0")
    sound += chunk(b"cue ", points) + chunk(b"LIST", labels)
    return sound[:4] + struct.pack("<I", len(sound) - 8) + sound[8:]


class Markers(CommandTest):
    def markers(self, name):
        clip = json.loads((self.folder / name).read_text())
        return [(marker["time"], marker["name"]) for marker in clip["markers"]]

    def markers_of_sound(self, sound):
        self.succeeds("encode", sound, "-o", "back.json", "--overwrite")
        return self.markers("back.json")

    def marked(self):
        names = ["hit", "L\u00e4rm", "end"]
        self.clip(seconds=2.0, markers=[{"time": t, "name": n} for t, n in zip((0.5, 1.0, 2.0), names)])
        return names

    def test_labels_beside_a_sound_become_markers_besides_its_own(self):
        self.put("door.wav", with_cues(wav(sine(100, 1.0)), [(12000, "cue")]))
        self.put("labels.txt", "0.500000\t0.500000\thit\n\\\t100\t200\n0.75\t0.75\tring, loud\n")
        self.succeeds("encode", "door.wav", "--markers", "labels.txt")
        self.assertEqual(self.markers("door.json"), [(0.25, "cue"), (0.5, "hit"), (0.75, "ring, loud")])
        self.put("labels.txt", "0.5\thit\n")
        self.succeeds("encode", "door.wav", "--markers", "labels.txt")  # again: other labels make another clip
        self.assertEqual(self.markers("door.json"), [(0.25, "cue"), (0.5, "hit")])

    def test_a_clip_with_markers_is_as_it_was_encoded_until_they_are_edited(self):
        self.put("door.wav", with_cues(wav(sine(100, 1.0)), [(12000, "cue")]))
        self.succeeds("encode", "door.wav")
        self.assertIn("up to date", self.succeeds("encode", "door.wav"))
        edited = (self.folder / "door.json").read_text().replace("cue", "mine")
        self.put("door.json", edited)
        self.fails(1, ["encode", "door.wav"], "was edited since it was encoded", lines=1)

    def test_a_cue_sheet_beside_a_sound_is_markers(self):
        self.put("long.wav", wav(sine(100, 1.0)))
        self.put("long.cue", 'FILE "long.wav" WAVE\n  TRACK 01 AUDIO\n    TITLE "hit"\n    INDEX 01 00:00:15\n'
                             '  TRACK 02 AUDIO\n    INDEX 01 00:00:45\n')
        self.succeeds("encode", "long.wav", "--markers", "long.cue")
        self.assertEqual(self.markers("long.json"), [(0.2, "hit"), (0.6, "02")])
        self.put("wrong.cue", 'FILE "long.wav" WAVE\n  TRACK 01 AUDIO\n    INDEX 01 0.2\n')
        self.fails(1, ["encode", "long.wav", "--markers", "wrong.cue"], "wrong.cue: line 3", "minutes:seconds:frames")

    def test_what_of_labels_is_lost_is_told(self):
        self.put("door.wav", wav(sine(100, 1.0)))
        self.put("labels.txt", "0.5\t0.7\tpart\n1.5\t1.5\tbehind\n")
        self.fails(0, ["encode", "door.wav", "--markers", "labels.txt"], "labels.txt: warning:", "regions (1)",
                   "door.wav: warning: has a marker behind the end of its sound", lines=2)
        self.put("soon.txt", "soon\thit\n")
        self.fails(1, ["encode", "door.wav", "--markers", "soon.txt"], "soon.txt: line 1", "is not a time")
        self.fails(1, ["encode", "door.wav", "--markers", "none.txt"], "none.txt")
        self.put("b.wav", wav(sine(100, 1.0)))
        labelled = ["--markers", "labels.txt"]
        self.fails(2, ["encode", "door.wav", "b.wav", "-o", "out/", *labelled], "--markers", "one sound")
        self.fails(2, ["encode", "door.wav", "--method", "lowpass", *labelled], "--markers", "for clips")

    def test_a_rendering_has_the_markers_at_the_times_that_they_have_there(self):
        names = self.marked()
        self.succeeds("render", "clip.json", "-o", "out.wav")
        self.assertEqual(self.markers_of_sound("out.wav"), list(zip((0.5, 1.0, 2.0), names)))
        self.succeeds("render", "clip.json", "-o", "out.wav", "--stretch", "2", "--delay", "0.25")
        self.assertEqual(self.markers_of_sound("out.wav"), list(zip((1.25, 2.25, 4.25), names)))
        self.succeeds("render", "clip.json", "-o", "out.wav", "--from", "0.75", "--to", "1.5")
        self.assertEqual(self.markers_of_sound("out.wav"), [(0.25, names[1])])
        self.succeeds("render", "clip.json")
        self.assertIn("up to date", self.succeeds("render", "clip.json"))
        self.warns("render", "clip.json", "-o", "out.flac", "--encoding", "pcm16",
                   says="has markers, which FLAC does not get")

    def test_samples_of_a_wav_have_them_too(self):
        names = self.marked()
        for form in ("wav8", "wav16"):
            self.succeeds("convert", "clip.json", "out.wav", "--format", form, "--sample-rate", "8000", "--overwrite")
            self.assertEqual(self.markers_of_sound("out.wav"), list(zip((0.5, 1.0, 2.0), names)))
        self.assertNotIn("markers", self.succeeds("lint", "clip.json", "--target", "wav16"))
        self.assertIn("markers are left out", self.succeeds("lint", "clip.json", "--target", "raw16"))


if __name__ == "__main__":
    unittest.main()
