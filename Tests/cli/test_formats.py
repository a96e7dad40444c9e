"""Files of other formats as programs that are not ours read them: Python's json and xml.etree, the C compiler; Kotlin
and Java, which need not be here, by their tokens.
"""
import json
import re
import shutil
import subprocess
import unittest
import wave
import xml.etree.ElementTree as ElementTree

from command import CommandTest

NAME = 'tür "1" \\ */ $x <&> end'  # quotes, escapes, ends of comments, templates and tags


def no_constants(text):
    raise ValueError(f"{text} is not JSON")


def strict_json(path):
    """The tree of a file that is UTF-8 without doubled keys, NaN and the like."""
    def pairs(entries):
        names = [name for name, _ in entries]
        if len(set(names)) != len(names):
            raise ValueError(f"doubled keys: {names}")
        return dict(entries)

    return json.loads(path.read_bytes().decode("utf-8"), object_pairs_hook=pairs, parse_constant=no_constants)


def code_tokens(text):
    """Words, numbers and signs of Kotlin or Java; fails at what is neither."""
    pattern = re.compile(r'\s+|//[^\n]*|"(?:[^"\\\n]|\\.)*"|[A-Za-z_]\w*|-?\d+(?:\.\d+)?f?\b|[-{}()\[\].,;:=<>+&|!@*]')
    tokens, at = [], 0
    while at < len(text):
        found = pattern.match(text, at)
        if not found:
            raise ValueError(f"no token: {text[at:at + 40]!r}")
        at = found.end()
        if not found.group().isspace():
            tokens.append(found.group())
    return tokens


def check_brackets(tokens):
    closing = {"(": ")", "[": "]", "{": "}"}
    stack = []
    for token in tokens:
        if token in closing:
            stack.append(closing[token])
        elif token in closing.values() and (not stack or stack.pop() != token):
            raise ValueError(f"{token} closes nothing")
    if stack:
        raise ValueError(f"{stack} are missing")


class Formats(CommandTest):
    def setUp(self):
        super().setUp()
        levels = [{"time": i / 40, "amplitude": 0.1 + 0.8 * (i * 7 % 10) / 10} for i in range(41)]
        self.clip(envelope=levels, name=NAME)

    def converted(self, target, *options):
        """The file names that a conversion of the clip to a format writes."""
        report = self.report("convert", "clip.json", "-o", "out", "--format", target, *options)
        return [self.folder / output["file"] for output in report.get("outputs") or report["files"][0]["outputs"]]

    def test_json_formats_are_strict_json(self):
        names = {"haptic": lambda t: t["metadata"]["project"], "ahap": None,
                 "hjif": lambda t: t["description"], "haps": lambda t: t["m_description"],
                 "android": lambda t: t["name"], "openxr-json": lambda t: t["name"],
                 "tact": lambda t: t["project"]["name"]}
        for target, name_of in names.items():
            with self.subTest(target):
                [path] = self.converted(target)
                tree = strict_json(path)
                if name_of:
                    self.assertEqual(name_of(tree), NAME)

    def test_vibration_xml_is_what_the_android_json_says(self):
        [path] = self.converted("android")
        effects = strict_json(path)
        files = self.converted("android-xml", "--split")
        self.assertEqual(len(files), 3)
        roots = [ElementTree.fromstring(path.read_bytes()) for path in files]
        self.assertEqual({root.tag for root in roots}, {"vibration-effect"})
        by_tag = {root[0].tag: root[0] for root in roots}
        steps = [(int(e.get("durationMs")), int(e.get("amplitude"))) for e in by_tag["waveform-effect"]]
        self.assertEqual(steps, list(zip(effects["waveform"]["timings"], effects["waveform"]["amplitudes"])))
        for tag, key, level, frequency in (("waveform-envelope-effect", "waveformEnvelope", "amplitude", "frequencyHz"),
                                           ("basic-envelope-effect", "basicEnvelope", "intensity", "sharpness")):
            points = [{name: float(e.get(name)) for name in (level, frequency, "durationMs")} for e in by_tag[tag]]
            self.assertEqual(points, effects[key]["controlPoints"], tag)
            self.assertTrue(all(e.tag == "control-point" for e in by_tag[tag]))

    def envelope_of(self, path, tag):
        """The attributes of an envelope's start and of its control points, checked as Android's parser does."""
        level, frequency, initial = {"waveform-envelope-effect": ("amplitude", "frequencyHz", "initialFrequencyHz"),
                                     "basic-envelope-effect": ("intensity", "sharpness", "initialSharpness")}[tag]
        root = ElementTree.fromstring(path.read_bytes())
        self.assertEqual((root.tag, root.attrib, [child.tag for child in root]), ("vibration-effect", {}, [tag]))
        effect = root[0]
        self.assertEqual(set(effect.attrib), {initial})
        points = []
        for element in effect:
            self.assertEqual((element.tag, set(element.attrib), len(element)),
                             ("control-point", {level, frequency, "durationMs"}, 0))
            self.assertRegex(element.get("durationMs"), r"^[1-9]\d*$")
            point = {name: float(value) for name, value in element.attrib.items()}
            self.assertTrue(0.0 <= point[level] <= 1.0)
            self.assertTrue(0.0 <= point[frequency] <= 1.0 if tag[0] == "b" else 0.0 < point[frequency] <= 1000.0)
            points.append(point)
        self.assertGreater(len(points), 0)
        self.assertEqual(points[-1][level], 0.0)
        return {initial: float(effect.get(initial)), "controlPoints": points}

    def test_envelopes_in_xml_are_those_of_the_json_within_the_same_limits(self):
        limits = ["--max-points", "16", "--min-segment", "20", "--max-segment", "400"]
        [path] = self.converted("android", *limits)
        effects = strict_json(path)
        for target, tag, key in (("android-envelope", "waveform-envelope-effect", "waveformEnvelope"),
                                 ("android-basic", "basic-envelope-effect", "basicEnvelope")):
            for options in ([], limits, ["--points", "8"], ["--profile", "lra-175"]):
                with self.subTest(target, options=options):
                    [path] = self.converted(target, *options)
                    envelope = self.envelope_of(path, tag)
                    points = envelope["controlPoints"]
                    self.assertIn(sum(point["durationMs"] for point in points), (1000, 1001))  # to 0 takes one
                    if options == limits:
                        self.assertEqual(envelope, effects[key])
                        self.assertLessEqual(len(points), 16)
                        self.assertTrue(all(20 <= point["durationMs"] <= 400 for point in points))
                    elif not options:
                        self.assertGreater(len(points), 16)

    def test_lint_says_what_limits_cost(self):
        def largest(*options):
            losses = self.report("lint", "clip.json", "--target", "android-basic", *options)["files"][0]["losses"]
            return max([loss["error"] for loss in losses if loss["kind"] == "points"], default=0.0)
        free, sixteen, four = largest(), largest("--max-points", "16"), largest("--max-points", "4")
        self.assertLess(free, 0.01)
        self.assertLess(free, sixteen)
        self.assertLessEqual(sixteen, four)
        limits = ["--max-points", "2", "--max-segment", "400"]
        self.fails(1, ["convert", "clip.json", "x.xml", "--format", "android-basic", *limits], "envelope.points")
        for options, option in ((["--min-segment", "600"], "--min-segment"), (["--max-segment", "3", "--min-segment", "2"],
                                                                              "--max-segment")):
            self.fails(2, ["convert", "clip.json", "x.xml", "--format", "android-basic", *options],
                       f"{option}: makes segments of", "raise --max-segment or lower --min-segment")
        self.fails(2, ["convert", "clip.json", "x.haptic", "--max-points", "16"], "has no effect in haptic")

    def test_kotlin_and_java_have_the_steps_of_the_json_in_closed_brackets(self):
        [path] = self.converted("android")
        effects = strict_json(path)
        for target in ("android-kotlin", "android-java"):
            with self.subTest(target):
                [path] = self.converted(target)
                tokens = code_tokens(path.read_text(encoding="utf-8"))
                check_brackets(tokens)
                joined = " ".join(tokens)
                kinds = ("longArrayOf", "intArrayOf") if target == "android-kotlin" else ("long", "int")
                for kind, key in zip(kinds, ("timings", "amplitudes")):
                    opening = f"{kind} (" if target == "android-kotlin" else f"new {kind} [ ] {{"
                    numbers = joined.split(opening, 1)[1]
                    numbers = numbers[:numbers.index(")" if target == "android-kotlin" else "}")]
                    self.assertEqual([int(n) for n in numbers.replace(",", " ").split()], effects["waveform"][key])
                self.assertEqual(joined.count("addControlPoint"), len(effects["waveformEnvelope"]["controlPoints"]))

    def compiled(self, header, program):
        """What a C program prints that includes a header, compiled with all warnings as errors."""
        compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
        if compiler is None:
            self.skipTest("there is no C compiler")
        source = self.put("main.c", f'#include "{header}"\n#include "{header}"\n#include <stdio.h>\n'
                                    f"int main(void) {{ {program} return 0; }}\n")
        done = subprocess.run([compiler, "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-o",
                               self.folder / "main", source], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return subprocess.run([self.folder / "main"], capture_output=True, text=True, check=True).stdout.split()

    def test_the_c_array_compiles_and_has_the_raw_samples(self):
        [raw] = self.converted("raw8")
        wanted = [byte - 256 if byte > 127 else byte for byte in raw.read_bytes()]
        [header] = self.converted("c")
        text = header.read_text(encoding="utf-8")
        array, length = re.search(r"int8_t (\w+)\[(\w+)\]", text).groups()
        printed = self.compiled(header, f'for (int i = 0; i < {length}; ++i) printf("%d\\n", {array}[i]);')
        self.assertEqual([int(n) for n in printed], wanted)
        self.assertGreater(max(wanted), 10)

    def test_the_openxr_header_compiles_and_has_the_values_of_its_json(self):
        [path] = self.converted("openxr-json")
        tree = strict_json(path)
        wanted = [x for buffer in tree["pcmVibration"]["buffers"] for x in buffer["buffer"]]
        self.assertTrue(all(len(b["buffer"]) == b["bufferSize"] <= 4000 for b in tree["pcmVibration"]["buffers"]))
        [header] = self.converted("openxr")
        text = header.read_text(encoding="utf-8")
        names = re.findall(r"static const (?:float|int64_t|uint32_t) (\w+)", text)
        arrays = re.findall(r"static const float (\w+)\[(\d+)\]", text)
        self.assertEqual([int(count) for _, count in arrays], [len(wanted),
                                                               tree["amplitudeEnvelopeVibration"]["amplitudeCount"]])
        scalars = [name for name in names if name not in dict(arrays)]
        uses = "".join(f"(void){name};" for name in scalars)
        loops = "".join(f'for (int i = 0; i < {count}; ++i) printf("%.9g\\n", (double){name}[i]);'
                        for name, count in arrays)
        printed = [float(n) for n in self.compiled(header, uses + loops)]
        wanted += tree["amplitudeEnvelopeVibration"]["amplitudes"]
        self.assertEqual(len(printed), len(wanted))
        self.assertLess(max(abs(a - b) for a, b in zip(printed, wanted)), 1e-6)

    def test_wav_files_are_read_by_another_reader(self):
        for target, width in (("wav8", 1), ("wav16", 2)):
            with self.subTest(target):
                [path] = self.converted(target)
                with wave.open(str(path)) as file:
                    self.assertEqual((file.getnchannels(), file.getsampwidth()), (1, width))
                    self.assertAlmostEqual(file.getnframes() / file.getframerate(), 1.0, places=2)


if __name__ == "__main__":
    unittest.main()
