"""End to end: help, the manual page, completions, and what is said of command lines that cannot be understood."""
import json
import re
import shutil
import subprocess
import unittest

from command import COMMAND, CommandTest, sine, wav

COMMANDS = ["encode", "render", "info", "convert", "lint", "profiles", "devices", "play", "live", "serve", "compare", "manifest", "study",
            "manifest merge", "manifest check", "manifest retry", "measure", "measure sweep", "measure analyse", "measure report",
            "measure fit", "measure verify", "measure simulate", "measure compensate", "texture", "texture analyse",
            "texture render", "plot", "bench", "help", "completions", "man"]


class Help(CommandTest):
    def options(self, command):
        """{"--low": "HZ", ...} as the help lists them; flags have no value."""
        found = {}
        for line in self.succeeds("help", *command.split()).splitlines():
            match = re.match(r" +(?:(-\w), )?(--[\w-]+)(?: (\S+))?(?:  |$)", line)
            if match:
                found[match[2]] = match[3]
        return found

    def test_every_way_to_ask_gives_the_same_help(self):
        for command in COMMANDS:
            with self.subTest(command):
                text = self.succeeds("help", *command.split())
                self.assertEqual(text, self.succeeds(*command.split(), "--help"))
                self.assertEqual(text, self.succeeds(*command.split(), "-h"))
                self.assertIn(f"Usage: pacini {command} ", text + " ")
                self.assertFalse(re.search(r"\bINT\b|\bUINT\b|\bFLOAT\b|\bTEXT\b|REQUIRED", text), text)
        self.assertEqual(self.succeeds("help"), self.succeeds("--help"))

    def test_examples_are_of_the_command_and_every_command_with_files_has_some(self):
        for command in COMMANDS:
            examples = re.findall(r"^  (pacini .*)$", self.succeeds("help", *command.split()), re.M)
            with self.subTest(command):
                for example in examples:
                    self.assertTrue(example.startswith(f"pacini {command}"), example)
                if command not in ("devices",):
                    self.assertTrue(examples)

    def test_lines_are_wrapped_and_entries_start_in_one_column(self):
        for command in COMMANDS:
            text = self.succeeds("help", *command.split())
            options = text[text.index("Options"):].split("\n\n")[0]
            for line in options.splitlines()[1:]:
                self.assertLessEqual(len(line), 80, line)
                self.assertRegex(line, r"^(  [^ ].{23}  [^ ]|  (-\w, |    )--[\w-]+( \S+)?$| {28}[^ ]|      .{20}  [^ ])")

    def test_ranges_defaults_and_choices_are_told_once(self):
        text = " ".join(self.succeeds("help", "encode").split())
        self.assertIn("Other formats: --points X Maximum number of amplitude points", text)
        self.assertIn("--bands N Number of frequency bands (1 to 32) [12]", text)
        self.assertIn("Spacing of the bands: log or linear [log]", text)
        self.assertIn("--low X Lower end of the bands (1 to 1700 Hz) [30]", text)
        text = " ".join(self.succeeds("help", "plot").split())
        self.assertIn("--from S Start of the part to show, s (0 to 86400 = 24 h) [0]", text)

    def test_pacini_alone_shows_its_commands_in_short(self):
        done = self.run_command()
        self.assertEqual((done.returncode, done.stderr.decode().count("\n")), (2, 1))
        self.assertIn("a command is missing", done.stderr.decode())
        self.assertIn("  encode  ", done.stdout.decode())
        self.assertIn("'pacini help COMMAND'", done.stdout.decode())
        self.assertLess(done.stdout.decode().count("\n"), 30)

    def test_help_of_what_is_no_command_says_so(self):
        self.fails(2, ["help", "encdoe"], "unknown command 'encdoe'; did you mean encode?")
        self.fails(2, ["help", "measure", "fti"], "unknown step 'fti'; did you mean fit?")
        self.fails(2, ["help", "encode", "fit"], "'encode' has no steps")
        self.fails(2, ["help", "xyzzy"], "there are encode, render")


class Meant(CommandTest):
    def test_what_was_probably_meant_is_said(self):
        self.put("a.wav", wav(sine(100, 0.1)))
        self.clip()
        for arguments, says in (
                (["encdoe", "a.wav"], "unknown command 'encdoe'; did you mean encode?"),
                (["Encode", "a.wav"], "did you mean encode?"),
                (["measure", "anaylse"], "unknown step 'anaylse'; did you mean analyse?"),
                (["encode", "a.wav", "--brekpoints", "3"], "unknown option --brekpoints of 'encode'; did you mean "
                                                           "--breakpoints?"),
                (["encode", "a.wav", "--band=3"], "unknown option --band of 'encode'; did you mean --bands?"),
                (["render", "--profle", "erm-coin"], "did you mean --profile?"),
                (["--qiuet", "info", "clip.json"], "unknown option --qiuet; did you mean --quiet?"),
                (["measure", "fit", "--secions", "3"], "did you mean --sections?"),
                (["encode", "a.wav", "--method", "tehsis"], ["--method: 'tehsis' is not one of a2vt", "mean thesis?"]),
                (["encode", "a.wav", "--format", "jsn"], "did you mean json?"),
                (["lint", "clip.json", "--target", "hapic"], "did you mean haptic?"),
                (["lint", "clip.json", "--target", "ahap", "--fail-on", "band"], "did you mean bands?"),
                (["bench", "simplfy"], "did you mean simplify?"),
                (["render", "clip.json", "--carriers", "pich"], "did you mean pitch?")):
            with self.subTest(" ".join(arguments)):
                self.fails(2, arguments, *([says] if isinstance(says, str) else says))
        # Half of the letters are no slip; dashes are no letters.
        self.assertNotIn("did you mean", self.fails(2, ["live", "--gain", "3"], "unknown option --gain").stderr.decode())
        self.fails(1, ["render", "clip.json", "--profile", "l5-wristbnd"], "did you mean l5-wristband?")
        self.fails(1, ["measure", "simulate", "a.wav", "-o", "b.wav", "--profile", "l5wristband"], "did you mean")

    def test_what_is_far_from_everything_gets_the_whole_list(self):
        self.fails(2, ["xyzzy"], "unknown command 'xyzzy'; there are encode, render, info,", "try 'pacini --help'")
        self.fails(2, ["encode", "--xyzzy"], "unknown option --xyzzy of 'encode'; try 'pacini encode --help'")
        self.clip()
        self.fails(1, ["render", "clip.json", "--profile", "xyzzy"], "there are bass-shaker, dualsense-voice-coil, eap, erm-coin")

    def test_wrong_values_are_told_with_the_right_ones(self):
        self.clip()
        self.put("a.wav", wav(sine(100, 0.1)))
        for option, value, says in (("--bands", "99", "'99' is not a whole number from 1 to 32"),
                                    ("--bands", "abc", "'abc' is not a whole number from 1 to 32"),
                                    ("--bands", "3.5", "'3.5' is not a whole number"), ("--bands", "-1", "'-1' is not"),
                                    ("--low", "nan", "'nan' is not a number from 1 to 1700"),
                                    ("--low", "inf", "'inf' is not a number"), ("--low", "", "'' is not a number"),
                                    ("--low", "1e400", "'1e400' is not a number"),
                                    ("-j", "0", "--jobs: '0' is not a whole number from 1 to 256"),
                                    ("-j", "-3", "'-3' is not"), ("-j", "99999999999999999999", "is not a whole")):
            self.fails(2, ["encode", "a.wav", option, value], says)
        self.fails(2, ["encode", "a.wav", "--bands"], "--bands: a value is missing")
        self.fails(2, ["encode", "a.wav", "--bands", "3", "--bands", "4"], "--bands is given more than once")
        self.fails(2, ["render", "clip.json", "--seed", "-1"], "from 0 to 2^64 - 1")
        self.fails(2, ["plot", "clip.json", "--from", "90000"], "'90000' is not a number from 0 to 86400 = 24 h")
        self.fails(2, ["render", "clip.json", "--felt"], "--felt needs --profile")
        self.fails(2, ["measure", "analyse", "a.wav"], "--sweep is missing")
        self.fails(2, ["compare", "a.wav", "a.wav", "a.wav"], "unexpected argument 'a.wav'")
        self.fails(2, ["measure", "sweep", "--rate", "99999999999"], "from 2000 to 384000")


class Manual(CommandTest):
    def test_the_page_names_every_command_and_every_option(self):
        page = self.succeeds("man").replace("\\-", "-")
        for command in COMMANDS:
            self.assertIn(f'.SS "pacini {command}"', page)
            for option in re.findall(r"^ +(?:-\w, )?(--[\w-]+)", self.succeeds("help", *command.split()), re.M):
                self.assertIn(f"\\fB{option}\\fR", page)

    def test_the_page_is_formatted_without_a_complaint(self):
        self.put("pacini.1", self.succeeds("man"))
        if not shutil.which("groff"):
            self.skipTest("groff is not installed")
        done = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-rLL=100n", "pacini.1"], cwd=self.folder,
                              capture_output=True)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        text = re.sub(r"\x1b\[\d*m|.\x08", "", done.stdout.decode())
        self.assertIn("pacini encode door.wav -o door.pacb", text)
        self.assertIn("--breakpoints", text)


class Completions(CommandTest):
    def completed(self, *words):
        """What bash offers for the last word, which may be empty."""
        script = ('source completion; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _pacini; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        done = subprocess.run(["bash", "-c", script, "bash", "pacini", *words], cwd=self.folder, capture_output=True,
                              timeout=60)
        self.assertEqual(done.stderr, b"")
        return [word for word in done.stdout.decode().split("\n") if word]

    def setUp(self):
        super().setUp()
        self.put("completion", self.succeeds("completions", "bash"))
        self.put("a sound.wav", "")
        (self.folder / "dir").mkdir()

    def test_the_script_is_good_bash_and_registers_the_command(self):
        self.assertEqual(subprocess.run(["bash", "-n", "completion"], cwd=self.folder).returncode, 0)
        done = subprocess.run(["bash", "-c", "source completion; complete -p pacini"], cwd=self.folder,
                              capture_output=True)
        self.assertIn(b"-F _pacini", done.stdout)

    def test_commands_steps_options_and_values_are_offered(self):
        self.assertEqual(self.completed("en"), ["encode"])
        self.assertEqual(sorted(self.completed("")), sorted(name for name in COMMANDS if " " not in name))
        self.assertEqual(self.completed("--ver"), ["--version"])
        self.assertEqual(self.completed("measure", "v"), ["verify"])
        self.assertEqual(self.completed("measure", "fit", "--sec"), ["--sections"])
        self.assertEqual(self.completed("encode", "--br"), ["--breakpoints"])
        self.assertEqual(self.completed("-q", "encode", "--br"), ["--breakpoints"])
        self.assertEqual(self.completed("encode", "--method", "th"), ["thesis"])
        self.assertEqual(self.completed("encode", "--method", "=", "th"), ["thesis"])
        self.assertEqual(self.completed("completions", ""), ["bash", "zsh", "fish"])
        self.assertEqual(self.completed("help", "enc"), ["encode"])
        self.assertIn("l5-wristband", self.completed("render", "a", "--profile", "l5"))
        self.assertEqual(self.completed("encode", "--bands", ""), [])

    def test_files_are_offered_where_files_are_taken(self):
        self.assertIn("a sound.wav", self.completed("encode", "a"))
        self.assertIn("a sound.wav", self.completed("encode", "-o", "a"))
        self.assertEqual(self.completed("render", "--clips", ""), ["dir"])
        self.assertEqual(self.completed("profiles", "a"), [])
        self.assertEqual(self.completed("info", "encode", "a"), ["a sound.wav"])

    def test_every_option_of_the_help_is_offered_by_every_shell(self):
        scripts = {shell: self.succeeds("completions", shell) for shell in ("bash", "zsh", "fish")}
        for command in COMMANDS:
            for option in re.findall(r"^ +(?:-\w, )?(--[\w-]+)", self.succeeds("help", *command.split()), re.M):
                self.assertIn(option, self.completed(*command.split(), option))
                self.assertIn(f"{option}[", scripts["zsh"])
                self.assertIn(f" -l {option[2:]} ", scripts["fish"])

    def test_zsh_understands_its_own(self):
        if shutil.which("zsh") is None:
            self.skipTest("zsh is not installed")
        self.put("_pacini", self.succeeds("completions", "zsh"))
        script = ("fpath=($PWD $fpath); autoload -Uz compinit; compinit -u -D; "
                  "whence -w _pacini; print $_comps[pacini]; source ./_pacini; whence -w _pacini-measure-fit")
        done = subprocess.run(["zsh", "-f", "-c", script], cwd=self.folder, capture_output=True, timeout=60)
        self.assertEqual(done.stdout.decode().split("\n"),
                         ["_pacini: function", "_pacini", "_pacini-measure-fit: function", ""], done.stderr)

    def test_fish_understands_its_own(self):
        if shutil.which("fish") is None:
            self.skipTest("fish is not installed")
        self.put("script", self.succeeds("completions", "fish"))
        for line, offered in (("pacini en", "encode"), ("pacini encode --method th", "thesis"),
                              ("pacini measure fit --sec", "--sections"), ("pacini encode a", "a sound.wav")):
            done = subprocess.run(["fish", "-c", f"source script; complete -C '{line}'"], cwd=self.folder,
                                  capture_output=True, timeout=60)
            self.assertEqual(done.stderr, b"")
            self.assertIn(offered, [entry.split("\t")[0] for entry in done.stdout.decode().splitlines()], line)

    def test_an_unknown_shell_is_told(self):
        self.fails(2, ["completions", "bsh"], "did you mean bash?")
        self.fails(2, ["completions"], "missing")


if __name__ == "__main__":
    unittest.main()
