"""End to end: every command with --json prints one object of one shape, when it goes well, fails or is called wrongly."""
import json
import os
import subprocess
import sys
import unittest

from command import COMMAND, SOURCE, CommandTest, noise, sine, wav

sys.path.insert(0, str(SOURCE / "Tests/io/schema"))
from check_schema import Draft202012Validator, strict_json  # noqa: E402  finds a Python that has the validator

SCHEMA = strict_json((SOURCE / "Resources/schema/pacini.report.schema.json").read_bytes())
COMMANDS = ["encode", "render", "info", "convert", "lint", "profiles", "devices", "play", "live", "serve", "compare", "measure sweep",
            "measure analyse", "measure fit", "measure verify", "measure simulate", "texture analyse", "texture render", "plot",
            "bench", "help", "completions",
            "man"]
HAPTIC = json.dumps({"version": {"major": 1, "minor": 0, "patch": 0}, "metadata": {}, "signals": {"continuous": {
    "envelopes": {"amplitude": [{"time": 0, "amplitude": 0}, {"time": 1, "amplitude": 1}]}}}})


class Json(CommandTest):
    def setUp(self):
        super().setUp()
        self.clip()
        self.put("door.wav", wav(sine(100, 0.3, 8000), 8000))
        self.put("bad.wav", "no sound")
        self.put("bad.json", '{"format": "pacini.clip", "version": 1}')
        self.put("bad.csv", "10,0\n")
        self.put("r.csv", "frequency,dB\n" + "".join(f"{f},{f % 7}\n" for f in range(30, 300, 5)))

    def reported(self, code, *arguments, **options):
        """Runs; that exit code, and on stdout nothing but a report that keeps to the schema, which is returned."""
        done = self.run_command(*arguments, "--json", **options)
        text = done.stderr.decode()
        self.assertEqual(done.returncode, code, text)
        report = strict_json(done.stdout)
        self.assertEqual([error.message for error in Draft202012Validator(SCHEMA).iter_errors(report)], [], report)
        self.assertEqual(report["ok"], code == 0)
        said = [line for line in text.splitlines() if ": warning: " not in line]
        self.assertEqual(len(said), len(report["failures"]), text)
        for failure in report["failures"]:
            self.assertTrue(any(failure["message"] in line and failure["input"] in line for line in said), failure)
        self.assertEqual(len(text.splitlines()) - len(said), len(report["warnings"]), text)
        return report

    def measured(self):
        """A sweep, its recording, a profile with an equaliser and the recording through it."""
        sweep = ["measure", "sweep", "--duration", "2", "--rate", "8000"]
        self.succeeds(*sweep, "-o", "sweep.wav")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav", "--drift", "0")
        self.assertEqual(self.run_command("measure", "analyse", "rec.wav", "--sweep", "sweep.json", "-o",
                                          "mine.json").returncode, 0)
        self.succeeds("measure", "fit", "mine.json", "-o", "mine.json", "--rate", "8000")
        self.succeeds(*sweep, "-o", "flat.wav", "--profile", "mine.json", "--levels", "-20")
        self.succeeds("measure", "simulate", "flat.wav", "-o", "after.wav", "--drift", "0")

    def test_the_schema_is_one_and_refuses_other_shapes(self):
        Draft202012Validator.check_schema(SCHEMA)
        validator = Draft202012Validator(SCHEMA)
        good = self.reported(0, "info", "clip.json")
        self.assertTrue(validator.is_valid(good))
        for key in ("pacini", "version", "command", "ok", "written", "failures", "warnings", "files"):
            self.assertFalse(validator.is_valid({k: v for k, v in good.items() if k != key}), key)
        for wrong in ({"version": 2}, {"ok": False}, {"command": "sing"}, {"failures": ["x"]}, {"files": [{}]},
                      {"failures": [{"input": "", "where": "", "message": "broke"}]}):
            self.assertFalse(validator.is_valid({**good, **wrong}), wrong)

    def test_every_command_reports_its_success(self):
        self.measured()
        self.put("door.haptic", HAPTIC)
        cases = (["encode", "door.wav"], ["encode", "door.wav"], ["encode", "--list-methods"], ["render", "clip.json"],
                 ["info", "clip.json"], ["info", "clip.json", "door.wav", "l5-wristband"],
                 ["convert", "clip.json", "clip.pacb"], ["convert", "clip.json", "door.json", "-o", "out", "--format",
                                                         "ahap"],
                 ["convert", "mine.json", "mine.acf"], ["lint", "clip.json", "--target", "ahap"], ["lint", "--targets"],
                 ["profiles"], ["play", "clip.json", "--dry-run", "--like", "xbox"], ["compare", "door.wav", "door.wav"],
                 ["measure", "sweep", "--duration", "2", "-o", "s.wav"],
                 ["measure", "simulate", "sweep.wav", "-o", "r.wav", "--wearers", "2"],
                 ["measure", "analyse", "rec.wav", "--sweep", "sweep.json", "-o", "m.csv", "--plot", "m.svg"],
                 ["measure", "fit", "r.csv"],
                 ["measure", "verify", "after.wav", "--sweep", "flat.json", "--profile", "mine.json", "--tolerance",
                  "20"],
                 ["texture", "analyse", "rec.wav", "-o", "t.json"],
                 ["texture", "render", "t.json", "--speed", "0:0 1:1", "-o", "t.wav"],
                 ["encode", "door.wav", "--dry-run"], ["render", "clip.json", "--dry-run"],
                 ["convert", "clip.json", "x.ahap", "--dry-run"], ["help"], ["help", "encode"],
                 ["completions", "zsh"], ["man"], ["live", "door.wav", "-o", "live.wav"], ["plot", "clip.json"], ["bench", "decimate", "door.wav", "--repeat", "1"])
        done = set()
        for arguments in cases:
            with self.subTest(" ".join(arguments)):
                report = self.reported(0, *arguments)
                done.add(report["command"])
                self.assertTrue(" ".join(arguments).startswith(report["command"]))
                for path in report["written"]:
                    self.assertTrue((self.folder / path).is_file(), path)
        # What serves goes on until it is ended (Tests/web/check_phone.mjs).
        self.assertEqual(sorted(done), sorted(name for name in COMMANDS if name not in ("devices", "serve")))
        devices = self.run_command("devices", "--json")  # there may be none to ask for
        self.assertIn("controllers", self.reported(devices.returncode, "devices") | {"controllers": 0})

    def test_every_command_reports_what_failed(self):
        self.measured()
        self.clip("lossy.json", envelope=[{"time": i / 1000, "amplitude": i % 2} for i in range(1001)])
        for arguments, failed in (
                (["encode", "door.wav", "bad.wav", "none.wav"], ["bad.wav", "none.wav"]),
                (["render", "bad.json", "clip.json", "-o", "out"], ["bad.json"]),
                (["info", "bad.json"], ["bad.json"]), (["info", "bad.json", "clip.json"], ["bad.json"]),
                (["convert", "bad.json", "x.pacb"], ["bad.json"]),
                (["convert", "bad.json", "clip.json", "-o", "out", "--format", "packed"], ["bad.json"]),
                (["lint", "bad.json", "--target", "ahap"], ["bad.json"]),
                (["lint", "lossy.json", "--target", "haptic", "--max-error", "0.1"], [""]),
                (["play", "bad.json", "--dry-run", "--like", "xbox"], ["bad.json"]),
                (["compare", "door.wav", "bad.wav"], ["bad.wav"]), (["compare", "bad.wav", "door.wav"], ["bad.wav"]),
                (["measure", "sweep", "-o", "no/where.wav", "--duration", "2"], ["no/where.wav"]),
                (["measure", "simulate", "bad.wav", "-o", "x.wav"], ["bad.wav"]),
                (["measure", "analyse", "bad.wav", "--sweep", "sweep.json"], ["bad.wav"]),
                (["measure", "fit", "bad.csv"], ["bad.csv"]),
                (["measure", "verify", "after.wav", "--sweep", "flat.json", "--profile", "mine.json", "--tolerance",
                  "0"], ["mine.json"]),
                (["texture", "analyse", "bad.wav", "-o", "t.json"], ["bad.wav"]),
                (["texture", "render", "bad.json", "--speed", "0:0 1:1", "-o", "t.wav"], ["bad.json"]),
                (["plot", "bad.json"], ["bad.json"]), (["bench", "decimate", "bad.wav"], ["bad.wav"])):
            with self.subTest(" ".join(arguments)):
                report = self.reported(1, *arguments)
                self.assertEqual([failure["input"] for failure in report["failures"]], failed)
                self.assertTrue(" ".join(arguments).startswith(report["command"]) and report["command"])

    def test_every_command_reports_wrong_usage(self):
        for command in COMMANDS:
            with self.subTest(command):
                report = self.reported(2, *command.split(), "--no-such-option")
                self.assertEqual(report["command"], command)
                self.assertIn("unknown option --no-such-option", report["failures"][0]["message"])
        for arguments, command in ((["encode"], "encode"), ([], ""), (["sing"], ""), (["measure"], "measure"),
                                   (["encode", "door.wav", "--bands", "99"], "encode"),
                                   (["play", "clip.json", "--like", "xbox"], "play"),
                                   (["convert", "clip.json"], "convert"), (["lint", "clip.json"], "lint"),
                                   (["plot", "clip.json", "-o", "x.txt"], "plot"),
                                   (["compare", "door.wav", "."], "compare")):
            with self.subTest(" ".join(arguments)):
                self.assertEqual(self.reported(2, *arguments)["command"], command)

    def test_the_flag_may_stand_anywhere_but_behind_the_end_of_options(self):
        for arguments in (["--json", "info", "clip.json"], ["info", "--json", "clip.json"],
                          ["measure", "--json", "fit", "r.csv"], ["--json", "sing"], ["--json", "--version"]):
            done = self.run_command(*arguments)
            self.assertEqual(strict_json(done.stdout)["pacini"], self.succeeds("--version").split()[1])
        self.assertEqual(self.run_command("sing", "--", "--json").stdout, b"")
        self.assertEqual(self.reported(0, "encode", "--help")["text"], self.succeeds("encode", "--help").rstrip("\n"))

    def test_results_stand_in_order_whichever_was_done_first(self):
        for i in range(12):
            self.put(f"in/{i:02}.wav", wav(noise(8000 if i % 3 else 80000, i), 8000) if i % 2 else "no sound")
        report = self.reported(1, "encode", "in", "-o", "out", "-j", "4")
        self.assertEqual([file["input"] for file in report["files"]], [f"in/{i:02}.wav" for i in range(1, 12, 2)])
        self.assertEqual([entry["input"] for entry in report["failures"]], [f"in/{i:02}.wav" for i in range(0, 12, 2)])
        self.assertEqual(sorted(report["written"]), sorted(file["output"] for file in report["files"]))
        again = self.reported(1, "encode", "in", "-o", "out")
        self.assertEqual(again["written"], [])

    def test_a_report_that_cannot_be_printed_is_told(self):
        for arguments, code in ((["info", "clip.json"], 1), (["info", "bad.json"], 1), (["encode", "--bands"], 2)):
            with open("/dev/full", "w") as full:
                done = self.run_command(*arguments, "--json", stdout=full)
            self.assertEqual(done.returncode, code)
            self.assertIn(b"pacini: standard output: the disk is full", done.stderr)
            closed = subprocess.run(["bash", "-c", f'"$0" {" ".join(arguments)} --json >&-', COMMAND],
                                    cwd=self.folder, timeout=60, stderr=subprocess.PIPE)
            self.assertEqual(closed.returncode, code)
            self.assertIn(b"pacini: standard output: is closed", closed.stderr)

    def test_names_that_are_no_text_are_reported_too(self):
        path = os.path.join(os.fsencode(self.folder), b"lat\xe9in\n.wav")
        with open(path, "wb") as file:
            file.write(b"no sound")
        self.assertEqual(self.run_command("encode", path, "--json").returncode, 1)
        report = strict_json(self.run_command("encode", b"lat\xe9in\n.wav", "--json").stdout)
        self.assertEqual(report["failures"][0]["input"], "lat\ufffdin\n.wav")


if __name__ == "__main__":
    unittest.main()
