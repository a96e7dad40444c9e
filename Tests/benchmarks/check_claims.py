#!/usr/bin/env python3
"""Compares the figures that the README and its pages state of sizes, speed and strength with what this build does.

check_claims.py PACINI [--plugin-tests PROGRAM] [--write-sizes]   exit 1 when a claim does not hold

Sizes are exact: those of the demo sounds stand in Tests/golden/demo_sizes.json and change only on purpose, by
--write-sizes. Times are processor times of the program itself, without what the system takes for writing its files, so
that other programs and the disk hardly matter, and may miss the figures of the pages by the factor SLACK: this is to
find a build that has become slow, not a slow computer. Needs an optimised build.
"""
import argparse
import json
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
DEMO = SOURCE / "Resources/demo"
SIZES = SOURCE / "Tests/golden/demo_sizes.json"
PAGES = [SOURCE / "README.md", *sorted(SOURCE.glob("Resources/docs/*.md"))]
TEXT = " ".join(" ".join(page.read_text().split()) for page in PAGES)
SLACK = 4.0
failures = []


def check(claim, holds, measured=""):
    print(f"{'ok    ' if holds else 'FAILED'} {claim}{': ' if measured else ''}{measured}", flush=True)
    if not holds:
        failures.append(claim)


def stated(pattern):
    """The numbers of a sentence of the README or a page, which must be there, and the same wherever it stands."""
    found = {match.groups() for match in re.finditer(pattern, TEXT)}
    if len(found) != 1:
        sys.exit(f"check_claims.py: the README and its pages say /{pattern}/ with {len(found)} numbers instead of one: "
                 "change this check with them")
    return [float(number) for number in found.pop()]


def pacini(*arguments):
    """(what it printed, the processor time of the program itself in seconds)"""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([options.pacini, *map(str, arguments)], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"check_claims.py: {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout, after.ru_utime - before.ru_utime


def sizes(folder):
    text, _ = pacini("encode", DEMO, "-o", folder / "clips", "--format", "packed", "-j", "1", "--json")
    files = rows(json.loads(text), "input", "bytes")
    made = {Path(file["input"]).name: file["bytes"] for file in files}
    if options.write_sizes:
        SIZES.write_text(json.dumps(made, indent=2, sort_keys=True) + "\n")
        print(f"written to {SIZES}")
    golden = json.loads(SIZES.read_text())
    differing = {name: (golden.get(name), made.get(name)) for name in {*golden, *made}
                 if golden.get(name) != made.get(name)}
    check("the clips of the demo sounds have the sizes of Tests/golden/demo_sizes.json", not differing,
          str(differing) if differing else f"{sum(made.values())} bytes")
    about, = stated(r"about (\d+) bytes per second")
    rate = sum(made.values()) / sum(file["duration"] for file in files)
    check(f"about {about:.0f} bytes per second", abs(rate / about - 1) < 0.1, f"{rate:.1f}")


def likeness(folder):
    stated(r"score the same HTS, [\w ]+, as the sound itself below 1 kHz, which takes (4500) bytes per second")
    text, _ = pacini("bench", "methods", DEMO, "-o", folder / "bench", "--repeat", "1", "--json")
    means = [row for row in rows(json.loads(text), "method", "hts") if "clip" not in row]
    hts = {method: [row["hts"] for row in means if row["method"] == method and row["variant"].endswith(variant)][0]
           for method, variant in (("a2vt", "audible 0"), ("lowpass", ""))}
    check("a clip of the bands alone is as close to the sound as the sound below 1 kHz", hts["a2vt"] > hts["lowpass"] - 2, str(hts))


def rows(report, *keys):
    """All objects in a report that have these keys."""
    if isinstance(report, list):
        return [row for part in report for row in rows(part, *keys)]
    if not isinstance(report, dict):
        return []
    return [*([report] if all(key in report for key in keys) else []), *rows(list(report.values()), *keys)]


def speed(folder):
    encoding, rendering = stated(r"more than (\d+) times real time on one core, rendering at more than (\d+) times")
    stated(r"[Ww]ith an actuator profile and protection, rendering runs at a third to two thirds of that speed")
    copies = 24  # ten minutes: starting the program hardly counts then
    (folder / "sounds").mkdir()
    for file in DEMO.glob("*.flac"):
        for copy in range(copies):
            shutil.copy(file, folder / f"sounds/{file.stem}-{copy}.flac")
    text, _ = pacini("encode", folder / "sounds", "-o", folder / "clips", "--format", "packed", "--json")
    seconds = sum(file["duration"] for file in rows(json.loads(text), "input", "duration"))

    def fastest(*arguments):
        def once():
            shutil.rmtree(folder / "out", ignore_errors=True)
            return pacini(*arguments, "-j", "1")[1]
        return seconds / min(once() for _ in range(3))

    encoded = fastest("encode", folder / "sounds", "-o", folder / "out", "--format", "packed")
    check(f"encoding runs at more than {encoding:.0f} times real time", encoded > encoding / SLACK, f"{encoded:.0f}")
    rendered = fastest("render", folder / "clips", "-o", folder / "out")
    check(f"rendering at more than {rendering:.0f} times", rendered > rendering / SLACK, f"{rendered:.0f}")
    fitted = fastest("render", folder / "clips", "-o", folder / "out", "--profile", "lra-175")
    check("with a profile and its protection at a third of that or faster", fitted > rendered / 3, f"{fitted:.0f}")


def strength(folder):
    """What flattening the resonance costs: level of what is felt, as flat as can be and by default, against not flattened."""
    wide = stated(r"(\d+) to (\d+) dB of what is felt on wide actuators")
    narrow = stated(r"on wide actuators, (\d+) to (\d+) dB on narrow ones")
    most, = stated(r"By default no shipped actuator is felt more than (\d+) dB weaker than not flattened")
    text, _ = pacini("bench", "actuators", DEMO, "-o", folder / "bench", "--repeat", "1", "--json")
    level = {(row["profile"], row["played"]): row["level"] for row in rows(json.loads(text), "profile", "played", "level")
             if "clip" not in row}
    cost = {name: level[name, "not flattened"] - level[name, "strength 0"] for name, _ in level}
    for name, decibels in cost.items():
        profile = json.loads((SOURCE / f"profiles/{name}.json").read_text())
        if decibels == 0 or "resonance" not in profile:
            continue
        span, q = profile["range"], profile["resonance"]["q"]
        is_narrow = q >= 8 or (q >= 3 and span["highFrequency"] <= 4 * span["lowFrequency"])
        low, high = narrow if is_narrow else wide
        check(f"flattening {name} costs {low:.0f} to {high:.0f} dB", low - 1 < decibels < high + 1, f"{decibels:.1f} dB")
    for name in cost:
        lost = level[name, "not flattened"] - level[name, "adapted"]
        check(f"{name} is by default felt at most {most:.0f} dB weaker", lost <= most, f"{lost:.1f} dB")
    check("it is measured on at least six actuators", sum(value != 0 for value in cost.values()) >= 6)


def plugin():
    done = subprocess.run([options.plugin_tests, "[.bench]"], capture_output=True, text=True)
    low, high = stated(r"([\d.]+) to ([\d.]+) % of one core at 48 kHz")
    loads = [float(share) for share in re.findall(r"one: median .*\(([\d.]+) %\)", done.stdout)]
    check(f"one instance takes {low} to {high} % of one core", loads and max(loads) < high * SLACK, str(loads))
    own, = stated(r"the plugin itself ([\d.]+) microseconds a block")
    blocks = re.search(r"translator ([\d.]+) us, plugin ([\d.]+) us", done.stdout)
    added = float(blocks.group(2)) - float(blocks.group(1)) if blocks else 1e9
    check(f"the plugin itself {own} microseconds", added < own * SLACK, f"{added:.2f}")
    late, = stated(r"late by the ([\d.]+) ms that it reports")
    check(f"the README says {late} ms too", stated(r"% of one core at 48 kHz, ([\d.]+) ms latency") == [late])
    latency = re.search(r"latency \d+ frames at 48 kHz, ([\d.]+) ms", done.stdout)
    check(f"late by {late} ms", latency and abs(float(latency.group(1)) - late) < 0.05, latency and latency.group(1))


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("pacini")
parser.add_argument("--plugin-tests")
parser.add_argument("--write-sizes", action="store_true")
options = parser.parse_args()
with tempfile.TemporaryDirectory(prefix="pacini-claims-") as name:
    for claims in (sizes, likeness, speed, strength):
        claims(Path(name))
if options.plugin_tests:
    plugin()
print("failed: " + ", ".join(failures) if failures else "all claims hold")
sys.exit(1 if failures else 0)
