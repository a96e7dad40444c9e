"""End to end: pacini profiles, pacini info and pacini convert with actuator profiles and ACF files."""
import json
import shutil
import subprocess
import unittest
from pathlib import Path

from command import COMMAND, SOURCE, CommandTest, sine, wav

# Made for this test.
ACF = """// a comment
{
  metadata: { version: '1.0.0', device: 'A controller', author: "Somebody", },
  continuous: { gain: .8, emphasis_ducking: 0.5, frequency_min: 55, frequency_max: 200, },
  emphasis: {
    gain: 1, fade_out_percent: 0,
    frequency_min: { output_frequency: 55, duration_ms: 36.4, shape: 'sine' },
    frequency_max: { output_frequency: 165, duration_ms: 12.1, shape: 'square' },
  },
}
"""


class Profiles(CommandTest):
    def test_the_shipped_profiles_are_listed(self):
        text = self.succeeds("profiles")
        report = self.report("profiles")
        files = sorted(path.stem for path in (SOURCE / "profiles").glob("*.json"))
        self.assertEqual([entry["name"] for entry in report["profiles"]], files)
        self.assertEqual(Path(report["folder"]), SOURCE / "profiles")
        self.assertIn(report["folder"], text)
        for entry in report["profiles"]:
            content = json.loads(Path(entry["path"]).read_text())
            self.assertEqual(entry["resonance"], content["resonance"]["frequency"])
            self.assertEqual(entry["technology"], content["technology"])
            self.assertRegex(text, rf"(?m)^{entry['name']} .* Hz")
        self.assertRegex(text, r"(?m)^erm-coin .* amplitude only$")

    def test_a_program_without_profiles_says_so(self):
        shutil.copy(COMMAND, self.folder / "alone")
        done = subprocess.run([self.folder / "alone", "profiles"], capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr.decode(), r"^pacini: .*profiles.*\n$")
        (self.folder / "a.wav").write_bytes(wav(sine(100, 0.2)))
        done = subprocess.run([self.folder / "alone", "bench", "decimate", "a.wav"], cwd=self.folder, capture_output=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (1, b""))
        self.assertRegex(done.stderr.decode(), r"^pacini: .*/pacini-bench: cannot be started: .*\n$")
        shutil.copy(Path(COMMAND).with_name("pacini-bench"), self.folder)
        for what in ("actuators", "all"):
            done = subprocess.run([self.folder / "alone", "bench", what, self.folder / "a.wav", "-o", self.folder / "out"],
                                  capture_output=True, timeout=60)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr.decode(), r"^pacini: .*profiles.*\n$")
            self.assertFalse((self.folder / "out").exists())

    def test_a_profile_is_shown_by_name_and_by_file(self):
        by_name = self.succeeds("info", "l5-wristband")
        by_file = self.succeeds("info", str(SOURCE / "profiles/l5-wristband.json"))
        self.assertEqual(by_name.split("\n", 1)[1], by_file.split("\n", 1)[1])
        for part in ("voice coil", "67 Hz, Q 3.97", "8.8 ohm", "1 V rms", "peak 68 Hz, -10 dB, Q 1.6", "device 40 g,",
                     "moving mass 12 g*", "* assumed"):
            self.assertIn(part, by_name)
        report = self.report("info", "l5-wristband")
        self.assertEqual((report["kind"], report["resonance"]["q"]), ("profile", 3.97))
        self.assertIn("body.movingMass", report["assumed"])
        self.assertNotIn("body.deviceMass", report["assumed"])
        self.assertNotIn("resonance.frequency", report["assumed"])

    def test_every_shipped_profile_is_shown_and_renders(self):
        self.clip()
        for entry in self.report("profiles")["profiles"]:
            self.assertIn(entry["title"], self.succeeds("info", entry["name"]))
            self.succeeds("render", "clip.json", "-o", "out.wav", "--profile", entry["name"])

    def test_a_file_comes_before_a_shipped_name(self):
        self.put("flat-pcm", wav(sine(100, 0.1)))
        self.assertIn("sound", self.succeeds("info", "flat-pcm"))

    def test_a_broken_profile_is_reported_as_a_profile(self):
        content = json.loads((SOURCE / "profiles/lra-175.json").read_text())
        content["technology"] = "motor"
        self.put("p.json", json.dumps(content))
        for arguments in (["info", "p.json"], ["convert", "p.json", "p.acf"]):
            self.fails(1, arguments, "pacini: p.json: technology: must be erm, lra, piezo, eap, vca or pcm, not 'motor'")
        self.assertEqual(self.names(), ["p.json"])

    def test_what_a_profile_says_cannot_reach_the_terminal(self):
        content = json.loads((SOURCE / "profiles/flat-pcm.json").read_text())
        self.put("p.json", json.dumps(content | {"name": "\x1b[2J"}))
        self.assertNotIn("\x1b", self.succeeds("info", "p.json"))


class Convert(CommandTest):
    def converts(self, *arguments):
        """Runs; exit 0. Returns the warnings, one for each line on stderr."""
        done = self.run_command("convert", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stderr.decode().splitlines()
        for line in lines:
            self.assertTrue(line.startswith(f"pacini: {arguments[0]}: warning: "), line)
        return lines

    def test_an_acf_becomes_a_profile_and_an_acf_again(self):
        self.put("quest.acf", ACF)
        warnings = "\n".join(self.converts("quest.acf", "quest.json"))
        for lost in ("metadata.author", "continuous.emphasis_ducking", "emphasis.frequency_min"):
            self.assertIn(lost, warnings)
        profile = json.loads((self.folder / "quest.json").read_text())
        self.assertEqual(profile["range"]["lowFrequency"], 55)
        self.assertEqual(profile["name"], "A controller")
        self.assertIn("55 Hz", self.succeeds("info", "quest.json"))
        self.assertEqual(self.succeeds("info", "quest.json").split("\n", 1)[1],
                         self.succeeds("info", "quest.acf").split("\n", 1)[1])
        self.converts("quest.json", "again.acf")
        again = json.loads((self.folder / "again.acf").read_text())
        self.assertEqual(again["continuous"], {"gain": 0.8, "emphasis_ducking": 0.5, "frequency_min": 55,
                                               "frequency_max": 200})
        self.assertEqual(again["metadata"]["device"], "A controller")

    def test_every_shipped_profile_becomes_an_acf(self):
        for path in sorted((SOURCE / "profiles").glob("*.json")):
            self.converts(str(path), f"{path.stem}.acf")
            back = self.run_command("convert", f"{path.stem}.acf", f"{path.stem}.json")
            self.assertEqual(back.returncode, 0, back.stderr)

    def test_a_profile_keeps_everything_in_json(self):
        path = SOURCE / "profiles/l5-wristband.json"
        self.assertEqual(self.converts(str(path), "copy.json"), [])
        self.assertEqual((self.folder / "copy.json").read_bytes(), path.read_bytes())

    def test_the_report_holds_the_warnings(self):
        self.put("quest.acf", ACF)
        done = self.run_command("convert", "quest.acf", "quest.json", "--json")
        report = json.loads(done.stdout)
        self.assertEqual(len(report["warnings"]), done.stderr.decode().count("\n"))
        self.assertEqual(report["bytes"], (self.folder / "quest.json").stat().st_size)

    def test_broken_acf_files_and_wrong_uses_are_refused(self):
        self.put("quest.acf", ACF)
        self.put("bad.acf", ACF.replace("gain: .8", "gain: NaN"))
        self.fails(1, ["convert", "bad.acf", "x.json"], "pacini: bad.acf: line 4, column 23: NaN")
        self.fails(1, ["info", "bad.acf"], "pacini: bad.acf: line 4, column 23: NaN")
        self.put("bad.acf", ACF.replace("'sine'", "'round'"))
        self.fails(1, ["convert", "bad.acf", "x.json"], "bad.acf: emphasis.frequency_min.shape: must be saw, sine")
        self.put("bad.acf", "")
        self.fails(1, ["convert", "bad.acf", "x.json"], "bad.acf: ")
        self.fails(1, ["convert", "missing.acf", "x.json"], "pacini: missing.acf: does not exist")
        self.fails(2, ["convert", "quest.acf", "x.pacb"], "x.pacb: must have the extension .json or .acf")
        self.fails(2, ["convert", "quest.acf", "x.json", "--format", "json"], "quest.acf: is a profile")
        self.fails(1, ["convert", "quest.acf", "quest.acf"], "is also the input")
        clip = self.clip()
        self.fails(2, ["convert", "clip.json", "x.acf"], "x.acf: ")
        self.fails(1, ["render", "clip.json", "--profile", "quest.acf"], "quest.acf: is an ACF file", "convert")
        self.assertEqual(self.names(), ["bad.acf", "clip.json", "quest.acf"])
        self.assertEqual((self.folder / "quest.acf").read_text(), ACF)
        self.assertEqual(json.loads((self.folder / "clip.json").read_text()), clip)


if __name__ == "__main__":
    unittest.main()
