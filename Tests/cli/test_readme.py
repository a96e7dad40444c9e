"""End to end: every command that the README and the documents print, read from there and run in a fresh folder on
sounds that do not come with Pacini; every option and default that they name; every file and heading that they link.

A command that is neither run here nor on one of the short lists below fails, and so does an entry of a list that no
document prints any more.
"""
import json
import math
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import unittest

from command import COMMAND, LARGEST, SANITIZED, SOURCE, CommandTest, wav
from documents import PAGES, Document, documents
from test_profiles import ACF

sys.path.append(str(SOURCE / "Tests/support"))
import check_includes

RATE = 44100

# Commands that are not run here: the file that runs them, and the words in it that do.
ELSEWHERE = {
    "bash cmake/bootstrap.sh demo": ("cmake/bootstrap.sh", "demo)"),
    "bash cmake/bootstrap.sh test": (".ci/run", "cmake/bootstrap.sh test"),
    "bash cmake/bootstrap.sh windows": ("cmake/bootstrap.sh", "windows)"),
    "bash cmake/bootstrap.sh release": (".github/workflows/release.yml", "cmake/bootstrap.sh release"),
    "bash cmake/bootstrap.sh wheels": ("cmake/bootstrap.sh", "wheels)"),
    "bash cmake/bootstrap.sh build": ("cmake/bootstrap.sh", "build)"),
    "bash cmake/bootstrap.sh package": ("cmake/bootstrap.sh", "package)"),
    "cmake --workflow --preset release": ("CMakePresets.json", '"name": "release"'),
    "bash cmake/bootstrap.sh plugin": ("cmake/bootstrap.sh", "plugin)"),
    "cmake --workflow --preset test": ("CMakePresets.json", '"name": "test"'),
    "bash cmake/bootstrap.sh deps": ("cmake/bootstrap.sh", "deps)"),
    "parec --device=@DEFAULT_MONITOR@ --latency-msec=5 | pacini live - --raw s16 --rate 44100": ("Tests/cli/test_live.py",
                                                                                             '"--raw", "s16", "--rate"'),
    "pacini live --sound-input pulse:@DEFAULT_MONITOR@": ("Tests/hosts/check_live.py", "--sound-input"),
    "pacini live --sound-input jack --sound-output jack --follow-input 2 --profile l5-wristband": ("Tests/cli/test_live_follow.py",
                                                                                                   '"--follow-input"'),
    "pacini serve door.json": ("Tests/web/check_phone.mjs", "['serve', "),
    # Needs ffmpeg.
    "pacini encode film.mp4": ("Tests/cli/test_films.py", 'self.succeeds("encode", "film.mp4")'),
    "pacini encode film.mp4 -o film.ahap": ("Tests/cli/test_films.py", '"film.mp4", "-o", "film.ahap"'),
    "pacini encode film.mp4 -o clips/ --scenes 10": ("Tests/cli/test_films.py", '"-o", "clips/", "--scenes", "10"'),
    "pacini encode film.mp4 -o film.json --without-centre": ("Tests/cli/test_films.py", '"--without-centre"'),
    "pacini render clips/film.scene.json": ("Tests/cli/test_films.py", '"render", "clips/film.scene.json"'),
    "pacini serve film.json --film film.mp4": ("Tests/cli/test_films.py", '"serve", "film.json", "--film", "film.mp4"'),
    "bash cmake/bootstrap.sh web": ("Tests/web/check_web.py", "build/web"),
    "cmake --preset debug": ("CMakePresets.json", '"name": "debug"'),
    "cmake --preset asan-assertions": ("cmake/bootstrap.sh", "build asan-assertions"),
    "python3 Resources/docs/make_parameters.py": ("Tests/cli/test_settings.py", "make_parameters.py"),
    "cmake --preset debug -DPACINI_TEST_ROOMS=io": ("Tests/CMakeLists.txt", "set(PACINI_TEST_ROOMS"),
    "cmake --preset release -DPACINI_JUCE_DIR=/path/to/JUCE": ("cmake/PaciniJuce.cmake", "PACINI_JUCE_DIR"),
    "cmake --install build/release --component core": ("Tests/examples/check_package.py", '"--install"'),
    "cmake --install build/release --component library": ("Tests/library/check_installed.py", '"--install"'),
    "ctest --preset release -L hosts": ("Tests/hosts/CMakeLists.txt", "LABELS \"hosts;slow\""),
    "python3 Tests/portability/check_bytes.py": ("Tests/CMakeLists.txt", "portability/check_bytes.py"),
    "python3 Tests/fuzz/run.py": ("Tests/fuzz/run.py", "__main__"),
    "python3 Tests/mutate.py": (".ci/run", "Tests/mutate.py"),
    "python3 Resources/docs/make_measurements.py": ("Resources/docs/make_measurements.py", "__main__"),
    "python3 Resources/docs/make_editor_pictures.py": ("Resources/docs/make_editor_pictures.py", "__main__"),
    "pacini encode sounds/ -o clips/ --format packed --ray auto": ("Tests/python/test_ray.py", "--ray"),
    "build/python-venv/bin/python Resources/docs/make_site.py": ("Tests/python/test_site.py", "make_site"),
    "Tests/hosts/check_standalone.py PROGRAM PICTURE": ("Tests/hosts/CMakeLists.txt", "check_standalone.py"),
    "build/release-packages": ("cmake/bootstrap.sh", "make_release.py build/release-packages"),
    "build/release/plugins": ("cmake/bootstrap.sh", "build/release/plugins"),
    "build/release/bin/pacini": ("cmake/bootstrap.sh", "build/release/bin/pacini"),
    "build/release/plugins/Standalone/PaciniEditor [FILE...]": ("Tests/hosts/CMakeLists.txt", "Standalone/PaciniEditor"),
    'build/release/bin/pacini_plugin_tests "[.bench]"': ("Tests/plugin/engine/LoadTest.cpp", "[.bench]"),
}

# Code within the text that needs words to be run, or other words here.
COMPLETED = {
    "pacini help": "pacini help -q",
    "pacini help COMMAND": "pacini help compare -q",
    "pacini completions bash": "pacini completions bash -q",
    "pacini devices": "pacini devices --help",
    "pacini live": "pacini live --help",
    "pacini live - -o -": "pacini live rain.wav -o live.wav",
    "pacini play door.json": "pacini play door.json --dry-run --like switch",
    "pacini man": "pacini man -q",
    "pacini serve CLIP --film FILE": "pacini serve --help",
    "pacini plot PROFILE": "pacini plot lra-175 -o lra.png",
    "pacini lint CLIP --target NAME": "pacini lint door.json --target hjif",
    "pacini encode --method NAME": "pacini encode rain.wav -o rain.json --method thesis",
    "pacini encode --format NAME": "pacini encode rain.wav -o rain.ahap --format ahap",
    "pacini encode --settings": "pacini encode --print-settings >own.json && pacini encode rain.wav -o r.json --settings own.json",
    "pacini measure simulate sweep.wav -o rec.wav --wearers 14": "",  # between the steps of the measurement, see WORLD
    "pacini bench methods FOLDER --sweep --markdown corpus.md": "pacini bench methods sounds --markdown corpus.md",
}

# What happens in the world between two commands: the command after which, and a command of the documents that stands
# for it, with other names.
WORLD = {
    "pacini measure sweep -o sweep.wav":
        ("pacini measure simulate sweep.wav -o rec.wav --wearers 14", {}),
    "pacini measure sweep -o flat.wav --profile mine.json":
        ("pacini measure simulate sweep.wav -o rec.wav --wearers 14", {"sweep.wav": "flat.wav", "rec.wav": "flat.wav"}),
}

# A machine of the tests has no controller, and must not set one in motion that it has.
WITHOUT_HARDWARE = {
    "pacini devices": "pacini play door.json --dry-run --like dualsense",
    "pacini play door.json --device 1": "pacini play door.json --dry-run --like switch",
    "pacini play door.json --profile quest-controller":
        "pacini play door.json --profile quest-controller --dry-run --like switch",
}

# Exit codes other than 0, with the words of the comment that say so.
FAILING = {"pacini lint clips/ --target haptic --max-error 0.1": (1, "exits with 1 if a clip loses more"),
           "pacini manifest merge clips/run.manifest.*-of-8.json -o clips/run.manifest.json":
               (1, "exits with 1 while parts are missing")}

# What a reader of the document has made before, by commands of the others.
BEFORE = {PAGES + "devices.md": ["pacini encode door.wav"],
          PAGES + "formats.md": ["pacini encode door.wav", "pacini convert door.json door.pacb",
                                        "pacini encode sounds/ -o clips/ --format packed -j 8"],
          PAGES + "datasets.md": ["pacini encode sounds/ -o clips/ --format packed --manifest clips/run.manifest.json"]}


def hits(*times, seconds, frequency=180.0, seed=1):
    """Blows on something hollow: each a burst of noise and a tone that die away."""
    source = random.Random(seed)
    samples = [0.0] * round(seconds * RATE)
    for k, time in enumerate(times):
        level, pitch = 0.8 / (1 + k % 3), frequency * (1 + 0.1 * k)
        for i in range(min(round(0.4 * RATE), len(samples) - round(time * RATE))):
            t = i / RATE
            samples[round(time * RATE) + i] += level * (math.exp(-t / 0.004) * source.uniform(-1, 1)
                                                        + math.exp(-t / 0.06) * math.sin(2 * math.pi * pitch * t))
    return [max(-1.0, min(1.0, 0.7 * x)) for x in samples]


def rain(seconds, seed=2):
    source = random.Random(seed)
    level, samples = 0.0, []
    for _ in range(round(seconds * RATE)):
        level += 0.002 * (abs(source.gauss(0, 0.3)) - level)
        samples.append(max(-1.0, min(1.0, level * source.gauss(0, 0.6))))
    return samples


def bursts(seconds):
    """As `pacini study latency --probe` writes them: five periods of 160 Hz in the middle of each second."""
    length = round(5 / 160 * RATE)
    start = (RATE - length) // 2
    second = [0.0] * RATE
    for i in range(length):
        second[start + i] = 0.25 * math.sin(math.pi * i / length) ** 2 * math.sin(2 * math.pi * 160 * i / RATE)
    return second * round(seconds)


class Documents(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.documents = documents()
        cls.readme = cls.documents[0]

    def material(self):
        """The folder of somebody who has recordings, and starts anew."""
        for path in self.folder.iterdir():
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        bench = (0.1, 0.5, 0.8)
        self.put("door.wav", wav(hits(0.2, 0.9, 1.1, seconds=2.0), RATE))
        self.put("rain.wav", wav(rain(2.0), RATE))
        self.put("sounds/bench.wav", wav(hits(*bench, seconds=1.2, frequency=90.0, seed=3), RATE))
        self.put("sounds/outside/rain.wav", wav(rain(1.0, seed=4), RATE))
        self.put("onsets.json", json.dumps({"bench.wav": bench, "outside/rain.wav": []}))
        self.put("labels.txt", "0.2\t0.2\tknock\n0.9\t1.1\tanother\n")
        self.put("quest.acf", ACF)
        self.put("stroke.wav", wav(rain(3.0, seed=6), RATE))
        self.put("engine.wav", wav(rain(3.0, seed=7), RATE))
        self.put("rpm.csv", "time,rpm\n0,900\n3,6000\n")
        self.put("hand.csv", "time,speed\n0,40\n1,250\n2,90\n3,180\n")
        self.put("ratings.csv", "group,stimulus,participant,rating\n" + "".join(
            f"{group},{stimulus},{person},{(person * stimulus + ord(group)) % 9}\n"
            for group in "ABC" for stimulus in (1, 2) for person in range(4)))
        self.put("recorded.wav", wav([x for x in bursts(4.0) for _ in range(2)], RATE, channels=2))
        shutil.copytree(SOURCE / "Resources/demo", self.folder / "Resources/demo")
        self.put("corpus/gate.wav", wav(hits(0.1, 0.4, seconds=0.8, seed=5), RATE))
        for block in [block for document in self.documents for block in document.blocks]:
            text = "\n".join(line.text for line in block)
            if '"pacini.scene"' in text and '"texture"' not in text:
                self.put("hall.scene.json", text)
        self.shell("pacini encode rain.wav -o rain.pacb")
        self.shell("pacini study new lab --template jnd")

    def shell(self, line, file_limit=LARGEST):
        """Runs a line as a person types it; `pacini` is the command under test."""
        programs = self.folder / ".programs"
        programs.mkdir(exist_ok=True)
        if not (programs / "pacini").exists():
            (programs / "pacini").write_text(f'#!/bin/sh\nexec "{COMMAND}" "$@"\n')
            (programs / "pacini").chmod(0o755)
        return subprocess.run(
            ["bash", "-c", line], cwd=self.folder, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=900,
            env={**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"},
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (file_limit, file_limit)))

    @staticmethod
    def shorter(line):
        """Benchmarks do here what they do, on the sounds that are there, once."""
        if not line.startswith("pacini bench"):
            return line
        line = re.sub(r" --repeat \d+|(?<=bench)$", lambda found: "" if found[0] else " all", line)
        line = line.replace("Resources/demo", "sounds") + " --repeat 1"
        if SANITIZED:
            line = line.replace(" --sweep", "")
        if not re.search(r"bench \w+ (sounds|corpus)", line):
            line = re.sub(r"(bench \w+)", r"\1 sounds", line)
        return line

    def works(self, printed, line):
        done = self.shell(self.shorter(line))
        expected, _ = FAILING.get(printed.command, (0, ""))
        self.assertEqual(done.returncode, expected, f"{printed}\nran as: {line}\n{done.stdout}{done.stderr}")
        self.assertNotIn("does not exist", done.stderr)
        # Where standard output takes the result, what was done is told beside it.
        notes = re.compile(r"^\d+ (encoded|rendered): " if "-o -" in line else r"^$")
        for message in filter(lambda text: not notes.search(text), done.stderr.splitlines()):
            self.assertRegex(message, r": warning: " if expected == 0 else r"^pacini: ", f"{printed}")
        written = re.findall(r"(?:-o|--output|--plot|--markdown) (\S+)", line)
        named = [re.sub(r"[,;:)]$", "", word) for word in printed.comment.split()]
        for name in [name for name in written if name != "-"] + [word for word in named if re.fullmatch(r"[\w-]+\.(json|pacb|wav|haptic|svg|png)", word)]:
            if "--wearers" in line and name.endswith(".wav"):
                name = name.replace(".wav", "-01.wav")
            path = self.folder / name
            self.assertTrue(path.exists() and (path.is_dir() or path.stat().st_size > 0), f"{printed}: no {name}")
        return done

    def runs(self, block):
        """Runs the commands of a block one after the other, in a folder that holds only the material."""
        self.material()
        for line in BEFORE.get(block[0].document, []):
            self.assertEqual(self.shell(line).returncode, 0, line)
        for printed in block:
            if printed.command in ELSEWHERE:
                continue
            with self.subTest(str(printed)):
                self.works(printed, WITHOUT_HARDWARE.get(printed.command, printed.command))
            if printed.command in WORLD and any("measure verify" in later.command for later in block):
                line, names = WORLD[printed.command]
                for before, after in names.items():
                    line = line.replace(before, after)
                done = self.works(printed, line)
                self.assertNotIn("clips", done.stderr)

    def test_every_command_of_a_block_runs_after_those_before_it(self):
        ran = 0
        for document in self.documents:
            for block in document.commands():
                self.runs(block)
                ran += len(block)
        self.assertGreater(ran, 30)

    def test_every_command_within_the_text_runs(self):
        self.material()
        self.shell("pacini encode door.wav")
        seen = set()
        for document in self.documents:
            for printed in document.inline_commands():
                if printed.command in seen or printed.command in ELSEWHERE:
                    continue
                seen.add(printed.command)
                line = COMPLETED.get(printed.command, printed.command)
                words = line.split()
                if not line:
                    continue
                if words[:2] != ["pacini", "bench"] and all(re.fullmatch(r"[a-z]+", word) for word in words):
                    line += " --help"  # the name of a command alone
                with self.subTest(str(printed)):
                    done = self.works(printed, line)
                    if line.endswith("--help"):
                        usage = " ".join(words[:-1] if words[-1] == "--help" else words)
                        self.assertRegex(done.stdout, rf"(?m)^Usage: {usage}\b", "there is no such command")
        self.assertGreater(len(seen), 10)

    def test_no_command_is_forgotten_and_no_entry_of_a_list_either(self):
        printed = [p for document in self.documents for block in document.commands() for p in block]
        printed += [p for document in self.documents for p in document.inline_commands()]
        for one in printed:
            self.assertTrue(one.command in ELSEWHERE or re.search(r"(^| )pacini ", one.command),
                            f"{one}: is neither run here nor said to be run elsewhere (ELSEWHERE)")
        commands = {one.command for one in printed}
        for listed in (ELSEWHERE, COMPLETED, WORLD, WITHOUT_HARDWARE, FAILING):
            for command in listed:
                self.assertIn(command, commands, "no document prints this any more")
        for command, (file, words) in ELSEWHERE.items():
            self.assertIn(words, (SOURCE / file).read_text(), command)
        for command, (_, words) in FAILING.items():
            self.assertTrue(any(one.command == command and words in one.comment for one in printed), command)
        for line in [line for line, _ in WORLD.values()] + [line for lines in BEFORE.values() for line in lines]:
            self.assertIn(line, commands)

    def test_presets_and_wishes_to_the_script_that_are_named_exist(self):
        presets = json.loads((SOURCE / "CMakePresets.json").read_text())
        names = {kind: {one["name"] for one in presets[f"{kind}Presets"]} for kind in ("configure", "test", "workflow")}
        script = subprocess.run(["bash", SOURCE / "cmake/bootstrap.sh", "--help"], capture_output=True, text=True).stdout
        found = 0
        for document in self.documents:
            for text in re.findall(r"(?:cmake|ctest) [^`\n]*--preset \w+|bootstrap\.sh \w+", document.text):
                kind = "workflow" if "--workflow" in text else "test" if text.startswith("ctest") else "configure"
                name = text.split()[-1]
                if text.startswith("bootstrap"):
                    self.assertIn(f"bash cmake/bootstrap.sh {name} ", script, document.name)
                else:
                    self.assertIn(name, names[kind], text)
                found += 1
        self.assertGreater(found, 4)
        text = "\n".join(document.text for document in self.documents)
        for name in re.search(r"`cmake --preset debug`((?:, `\w+`)+)", text).group(1).split(", ")[1:]:
            self.assertIn(name.strip("`"), names["configure"])

    def test_every_file_that_is_named_exists(self):
        found = 0
        for document in self.documents:
            paths = re.findall(r"\]\(([^)#:]+)\)", document.text)
            for span in document.spans:
                paths += re.findall(r"(?<![\w/~.-])(?:Core|Source|Tests|Resources|profiles|cmake)/[\w./-]*\w", span.text)
            for path in paths:
                places = (SOURCE / path, (SOURCE / document.name).parent / path)
                self.assertTrue(any(place.exists() for place in places), f"{document.name}: {path}")
                found += 1
        self.assertGreater(found, 40)

    def test_links_lead_somewhere(self):
        """From the place of the document that has them, to a heading too."""
        documents = {document.name: document for document in [*self.documents, Document("CHANGELOG.md")]}
        found = 0
        for document in documents.values():
            for link in document.links():
                path, _, heading = link.partition("#")
                target = (SOURCE / document.name).parent / path if path else SOURCE / document.name
                self.assertTrue(target.exists(), f"{document.name}: {link}")
                if heading:
                    name = os.path.relpath(target, SOURCE)
                    self.assertIn(heading, documents[name].anchors(), f"{document.name}: {link}")
                found += 1
        self.assertGreater(found, 40)

    def test_the_modules_of_the_architecture_are_those_of_the_include_check(self):
        [page] = [document for document in self.documents if document.name == "ARCHITECTURE.md"]
        rows = {cells[0].strip("`"): cells[-1] for heading, cells in page.rows if heading.startswith("Modules")}
        every = set(check_includes.CORE)
        says = {check_includes.NO_JUCE: None, check_includes.NO_WINDOWS: "JUCE without windows", (): "JUCE"}
        rooms = {name: (others, None) for name, others in check_includes.CORE.items()}
        rooms.update((name, (every | others, says[without])) for name, (others, without) in check_includes.SOURCE.items())
        self.assertEqual(set(rows) - {"module"}, set(rooms))
        for name, (others, juce) in rooms.items():
            words = rows[name].split(", ")
            said = set(every) if "all of Core" in words else set()
            said.update(word.strip("`") for word in words if word.startswith("`"))
            self.assertEqual(said - {name}, others - {name}, name)
            self.assertEqual([word for word in words if word.startswith("JUCE")], [juce] if juce else [], name)

    def test_the_readme_is_short_and_links_every_page(self):
        self.assertLessEqual(len(self.readme.text.splitlines()), 150)
        linked = set(self.readme.links())
        for document in self.documents[1:]:
            if not document.name.startswith("Resources/help/"):
                self.assertIn(document.name, linked)


class Options(CommandTest):
    """Options and their defaults, as the help of the command has them."""

    # Of the programs with a window, which are not built everywhere: the page, and the file that declares its options.
    OTHER_PROGRAMS = {PAGES + "plugin.md": "Source/app/Settings.cpp"}
    # The commands whose options a page describes without naming the command, with their defaults.
    COMMANDS = {PAGES + "getting-started.md": ["encode"], PAGES + "settings.md": ["encode"],
                PAGES + "scenes.md": ["render"], PAGES + "profiles.md": ["render"],
                PAGES + "devices.md": ["play"],
                PAGES + "measuring.md": ["measure sweep", "measure analyse", "measure report", "measure fit",
                                         "measure verify", "measure simulate", "measure compensate"]}
    OF_OTHER_TOOLS = {"--install", "--component", "--preset", "--workflow", "--make", "--at", "--rooms", "--install-links",
                      "--latency-msec"}

    def help_of(self, command):
        """Option to default; empty without one."""
        texts, names = {}, []
        for line in self.succeeds(*command.split(), "--help").splitlines():
            if option := re.match(r"  (?:(-\w), |    )(--[\w-]+)", line):
                names = [name for name in option.groups() if name]
                texts.update({name: line for name in names})
            elif not line.startswith(" " * 20):
                names = []
            texts.update({name: texts[name] + " " + line.strip() for name in names if not option})
        return {name: "".join(re.findall(r"\[([^\[\]]+)\]\s*$", text)) for name, text in texts.items()}

    def setUp(self):
        super().setUp()
        self.documents = documents()
        top = self.succeeds("--help")
        commands = re.findall(r"(?m)^  ([a-z]+) {2,}", top[top.index("Commands:"):top.index("Options")])
        self.assertGreater(len(commands), 10)
        self.helps = {command: self.help_of(command) for command in commands}
        for command in ("measure", "study", "texture"):
            top = self.succeeds(command, "--help")
            steps = re.findall(r"(?m)^  ([a-z]+) {3,}", top[top.index("Steps:"):top.index("Options")])
            self.helps.update({f"{command} {step}": self.help_of(f"{command} {step}") for step in steps})
        editor = (SOURCE / "Source/app/editor/EditorApplication.cpp").read_text()
        self.all = {name for options in self.helps.values() for name in options} | {"--version"}
        self.all |= set(re.findall(r'"(--[a-z-]+)"', editor))

    def test_every_option_that_is_named_exists(self):
        found = 0
        for document in self.documents:
            printed = [*document.spans, *(line for block in document.blocks for line in block)]
            for one in printed:
                for option in re.findall(r"(?<![\w-])--[a-z][\w-]*", one.command):
                    if option in self.OF_OTHER_TOOLS:
                        continue
                    found += 1
                    command = re.match(r"pacini ((?:measure |study |texture )?[a-z]+)", one.command)
                    if document.name in self.OTHER_PROGRAMS and not command:
                        if option != "--help":
                            self.assertIn(f'"{option}"', (SOURCE / self.OTHER_PROGRAMS[document.name]).read_text(), one)
                    elif command and command.group(1) in self.helps:
                        self.assertIn(option, self.helps[command.group(1)], one)
                    else:
                        self.assertIn(option, self.all, one)
        self.assertGreater(found, 50)

    def default_is(self, page, option, stated):
        texts = [self.helps[command][option] for command in self.COMMANDS[page] if option in self.helps[command]]
        self.assertTrue(texts, f"{page}: {option}")
        if stated == "off":
            self.assertIn(texts[0], ("", "off"), option)
        elif re.fullmatch(r"-?[\d.]+", stated):
            self.assertEqual(float(texts[0]), float(stated), option)
        else:
            self.assertEqual(texts[0], stated.strip("`"), option)

    def test_defaults_of_the_tables_are_those_of_the_help(self):
        rows = [(document.name, cells) for document in self.documents for _, cells in document.rows
                if cells[0].startswith("`--")]
        self.assertGreater(len(rows), 5)
        for page, cells in rows:
            names = re.findall(r"`(--[\w-]+)`", cells[0])
            defaults = cells[-1].split(", ")
            self.assertEqual(len(names), len(defaults), cells)
            for name, stated in zip(names, defaults):
                self.default_is(page, name, stated)

    def test_numbers_behind_an_option_are_its_default(self):
        """`--max-boost` (6 dB), `--quantise` bits (6: ...)"""
        found = 0
        for document in [document for document in self.documents if document.name in self.COMMANDS]:
            for match in re.finditer(r"`(--[\w-]+)`(?:\s\w+)?\s\((-?[\d.]+)\b", document.text):
                self.default_is(document.name, match.group(1), match.group(2))
                found += 1
        self.assertGreaterEqual(found, 4)


class Claims(CommandTest):
    """Numbers that the README and the pages state, each with the sentence that it stands in. Sizes, speed and strength
    are compared by Tests/benchmarks/check_claims.py."""

    NUMBERS = {"five": 5, "seven": 7, "eleven": 11, "twelve": 12, "thirteen": 13, "twenty": 20}

    def setUp(self):
        super().setUp()
        self.documents = documents()
        self.text = " ".join(" ".join(document.text.split()) for document in self.documents)

    def stated(self, *patterns):
        """The number in sentences that must be there, the same in all of them; as a number if it is a word."""
        numbers = set()
        for pattern in patterns:
            found = re.findall(pattern, self.text)
            self.assertTrue(found, f"no document says /{pattern}/ any more: change this test with it")
            numbers.update(self.NUMBERS.get(number.lower()) or float(number) for number in found)
        self.assertEqual(len(numbers), 1, f"{patterns}: {numbers}")
        return numbers.pop()

    def test_profiles_and_methods_are_as_many_as_it_says(self):
        profiles = self.stated(r"`profiles/` has (\w+):", r"(\w+) profiles come with Pacini")
        self.assertEqual(len(list((SOURCE / "profiles").glob("*.json"))), profiles)
        for path in (SOURCE / "profiles").glob("*.json"):
            self.assertIn(path.stem, self.succeeds("profiles"))
            self.assertTrue(json.loads(path.read_text())["sources"], path.name)
        methods = self.stated(r"(\w+) other translation methods")
        listed = [line for line in self.succeeds("encode", "--list-methods").splitlines() if not line.startswith(" ")]
        self.assertEqual(len(listed), methods + 1)

    def test_a_measurement_takes_as_many_commands_as_it_says(self):
        steps = self.stated(r"an interface that records it, and (\w+) commands", r"\[(\w+) commands\]")
        block = [block for document in self.documents for block in document.commands()
                 if "measure verify" in block[-1].command]
        self.assertEqual([len(commands) for commands in block], [steps])

    def test_a_scene_has_as_many_actuators_as_it_says(self):
        most = int(self.stated(r"pan over up to (\d+) actuators", r"on up to (\d+) actuators"))
        self.clip("a.json", 0.1)
        for count in (most, most + 1):
            scene = {"format": "pacini.scene", "version": 1, "duration": 0.1, "actuators": count,
                     "plays": [{"clip": "a.json"}]}
            self.put("a.scene.json", json.dumps(scene))
            done = self.run_command("render", "a.scene.json", "-o", "a.wav")
            self.assertEqual(done.returncode, 0 if count == most else 1, done.stderr)

    def test_wearers_and_full_scale_of_what_is_felt(self):
        wearers = int(self.stated(r"`--wearer 1` to `(\d+)` are simulated people"))
        scale = self.stated(r"1 in the file is (\d+) m/s\^2 \(`--felt-full-scale`\)")
        self.clip("a.json", 0.1)
        felt = ["render", "a.json", "-o", "a.wav", "--profile", "l5-wristband", "--felt"]
        for wearer in (wearers, wearers + 1):
            done = self.run_command(*felt, "--wearer", str(wearer))
            self.assertEqual(done.returncode, 0 if wearer == wearers else 2, done.stderr)
        self.succeeds(*felt)
        by_default = (self.folder / "a.wav").read_bytes()
        self.succeeds(*felt, "--felt-full-scale", str(scale))
        self.assertEqual((self.folder / "a.wav").read_bytes(), by_default)

    def test_goal_and_limit_of_the_equaliser(self):
        rms = self.stated(r"as few sections as leave ([\d.]+) dB RMS")
        largest = self.stated(r"dB RMS and ([\d.]+) dB at most, raises")
        boost = self.stated(r"nothing by more than (\d+) dB, and nothing outside of the range")
        dips = {60: -14, 200: 9, 700: -6}
        text = "".join(f"{f:.3f},{sum(d / (1 + (6 * math.log2(f / at)) ** 2) for at, d in dips.items()):.4f}\n"
                       for f in (20 * 2 ** (i / 24) for i in range(150)))
        self.put("r.csv", "frequency,dB\n" + text)
        report = self.report("measure", "fit", "r.csv")
        self.assertTrue(report["reachedGoal"])
        self.assertLessEqual(report["rms"], rms)
        self.assertLessEqual(report["max"], largest)
        self.assertLessEqual(report["boost"], boost + 0.1)
        self.assertGreater(report["boost"], 3)

    def test_steps_of_six_bits(self):
        """A slow fade and a slow glide in a packed clip of `--quantise` bits come back in steps of the stated size."""
        bits = int(self.stated(r"rounded to `--quantise` bits \((\d+):"))
        level = self.stated(r"level steps of ([\d.]+) dB")
        pitch = self.stated(r"pitch steps of ([\d.]+) %")
        points = [{"time": i / 10, "amplitude": 10 ** (-i / 100)} for i in range(100)]
        pitches = [{"time": i / 10, "frequency": 80 * 1.005 ** i} for i in range(90)]
        clip = self.clip("a.json", 10.0, envelope=points, transients=[])
        clip["bands"][0].update(amplitude=points, pitch=pitches)
        self.put("a.json", json.dumps(clip))
        self.succeeds("convert", "a.json", "a.pacb", "--quantise", str(bits))
        self.succeeds("convert", "a.pacb", "b.json")
        back = json.loads((self.folder / "b.json").read_text())["bands"][0]

        def steps(values, scale):
            values = sorted(set(values))
            return [scale(b / a) for a, b in zip(values, values[1:]) if a > 0]

        self.assertAlmostEqual(min(steps([p["amplitude"] for p in back["amplitude"]], lambda r: 20 * math.log10(r))),
                               level, delta=0.1)
        self.assertAlmostEqual(min(steps([p["frequency"] for p in back["pitch"]], lambda r: 100 * (r - 1))), pitch,
                               delta=0.15)

    def test_a_million_broken_files_are_what_the_fuzzers_feed(self):
        self.assertIn("a million broken ones", self.text)
        self.assertIn("default=1_000_000", (SOURCE / "Tests/fuzz/run.py").read_text())


if __name__ == "__main__":
    unittest.main()
