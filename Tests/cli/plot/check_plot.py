#!/usr/bin/env python3
"""Runs `pacini plot` and looks at what it writes.

check_plot.py PACINI SOUND    exit 0, or a traceback of the first claim that does not hold
"""
import json
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

SVG = "{http://www.w3.org/2000/svg}"
BANDS = (80, 200, 500)
ENVELOPE = [(0.0, 0.1), (0.5, 0.9), (1.5, 0.3), (2.0, 0.0)]
CLIP = {
    "format": "pacini.clip", "version": 1, "name": "T\u00fcr <1> & \"2\"", "duration": 2.0,
    "envelope": [{"time": t, "amplitude": a} for t, a in ENVELOPE],
    "centroid": [{"time": 0.0, "frequency": 100.0}, {"time": 2.0, "frequency": 300.0}],
    "bands": [{"lowFrequency": f * 0.7, "centreFrequency": f, "highFrequency": f * 1.4, "priority": 0,
               "amplitude": [{"time": 0.1 * i, "amplitude": 0.1 + 0.05 * (i % 3)} for i in range(12)],
               "pitch": [{"time": 0.0, "frequency": f}]} for f in BANDS],
    "transients": [{"time": 0.2, "amplitude": 0.8, "sharpness": 0.1}, {"time": 0.9, "amplitude": 0.5, "sharpness": 0.9},
                   {"time": 1.9, "amplitude": 0.4, "sharpness": 0.9}],
    "markers": [{"time": 1.0, "name": "turn"}],
}
EMPTY = {"format": "pacini.clip", "version": 1, "duration": 0.0, "bands": []}
SHORTEST = {"format": "pacini.clip", "version": 1, "duration": 5e-324, "bands": []}
SAMPLE = {"format": "pacini.clip", "version": 1, "duration": 1 / 48000, "bands": [],
          "envelope": [{"time": 0.0, "amplitude": 1.0}]}


def run(pacini, *arguments, expect=0):
    done = subprocess.run([pacini, "plot", *map(str, arguments)], capture_output=True, text=True, timeout=300)
    assert done.returncode == expect, (arguments, done.returncode, done.stdout, done.stderr)
    return done


def png_size(path):
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    assert data[12:16] == b"IHDR", path
    return struct.unpack(">II", data[16:24])


def groups(svg):
    """Title of each group with the paths that lie directly in it."""
    found = {}
    for group in svg.iter(SVG + "g"):
        title = group.find(SVG + "title")
        if title is not None:
            found.setdefault(title.text, []).extend(path.get("d") for path in group.findall(SVG + "path"))
    return found


def vertices(path):
    return [tuple(map(float, pair.split())) for pair in path.replace("M", "L").strip("LZ").split("L")]


def check_svg(path):
    svg = ElementTree.parse(path).getroot()
    assert svg.tag == SVG + "svg"
    assert svg.find(SVG + "title").text == CLIP["name"]
    texts = ["".join(text.itertext()) for text in svg.iter(SVG + "text")]
    for text in [CLIP["name"], "Drive signal rendered from the clip (1 = full drive)", "Total envelope (1 = full drive)",
                 "Time (s)", "Centre (Hz)", "Frequency (Hz)", "spectral centroid", "turn", "80", "200", "500",
                 "\u221214 dB"]:
        assert text in texts, (text, texts)

    curves = groups(svg)
    for name in ["total envelope", "breakpoints", "spectral centroid", "dull (sharpness below \u2153)",
                 *(f"amplitude at {f} Hz" for f in BANDS), *(f"pitch at {f} Hz" for f in BANDS)]:
        assert curves.get(name), (name, sorted(curves))
    for f in BANDS:
        area, line, dots = curves[f"amplitude at {f} Hz"]
        assert dots.count("M") == 12
    assert curves["breakpoints"][0].count("M") == len(ENVELOPE)
    stems = curves["crisp (above \u2154)"][0]
    assert stems.count("M") == 2

    # Straight in time and in amplitude: the line goes through its breakpoints.
    line = vertices(curves["total envelope"][0])
    (left, _), (right, zero) = line[0], line[-1]
    top = line[1][1]
    for (t, a), (x, y) in zip(ENVELOPE, line):
        assert abs(x - (left + (right - left) * t / 2.0)) < 0.02, (t, x)
        assert abs(y - (zero + (top - zero) * a / 0.9)) < 0.02, (a, y)


def check_errors(pacini, folder, clip):
    before = sorted(folder.iterdir())
    done = run(pacini, clip, "-o", folder / "missing/out.png", expect=1)
    assert done.stderr.startswith(f"pacini: {folder}/missing/out.png: "), done.stderr
    done = run(pacini, clip, "-o", folder / "out.gif", expect=2)
    assert "out.gif" in done.stderr and ".png" in done.stderr, done.stderr
    for size in ["1600", "1600x", "x1000", "10x10", "1600x1000x3", "1e3x500", "99999x1000", "-500x500"]:
        run(pacini, clip, "-o", folder / "out.png", "--size", size, expect=2)
    run(pacini, clip, "-o", folder / "out.png", "--from", 1, "--to", 0.5, expect=2)
    for part in [["--from", 2.5], ["--from", 1, "--to", 1.0000000001]]:
        done = run(pacini, clip, "-o", folder / "out.png", *part, expect=1)
        assert "--from" in done.stderr, done.stderr
    for arguments in [[folder / "none.json"], [clip, "--sound", folder / "none.wav"], [clip, "--profile", "none"]]:
        done = run(pacini, *arguments, "-o", folder / "out.png", expect=1)
        assert done.stderr.startswith("pacini: ") and "none" in done.stderr, done.stderr
    broken = folder / "broken.json"
    broken.write_text('{"format": "pacini.clip", "version": 1, "duration": -1, "bands": []}')
    done = run(pacini, broken, "-o", folder / "out.png", expect=1)
    assert done.stderr.startswith(f"pacini: {broken}: duration: "), done.stderr
    broken.unlink()
    assert sorted(folder.iterdir()) == before, "a failed run left a file"


def main(pacini, sound):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        clip = folder / "clip.json"
        clip.write_text(json.dumps(CLIP), encoding="utf-8")

        report = json.loads(run(pacini, clip, "--json").stdout)
        assert report["input"] == str(clip) and report["output"] == str(folder / "clip.png"), report
        assert (report["width"], report["height"]) == (1600, 1000) == png_size(folder / "clip.png"), report

        run(pacini, clip, "-o", folder / "part.png", "--size", "641x402", "--from", 0.5, "--to", 0.6, "--dark")
        assert png_size(folder / "part.png") == (641, 402)
        run(pacini, clip, "-o", folder / "clip.svg")
        check_svg(folder / "clip.svg")
        for number, unusual in enumerate([EMPTY, SHORTEST, SAMPLE]):
            (folder / "unusual.json").write_text(json.dumps(unusual))
            run(pacini, folder / "unusual.json", "-o", folder / f"unusual{number}.svg")
            ElementTree.parse(folder / f"unusual{number}.svg")

        # A sound is encoded first and shown as it is; with a profile its drive signal as well.
        run(pacini, sound, "-o", folder / "sound.svg", "--profile", "l5-wristband")
        names = groups(ElementTree.parse(folder / "sound.svg").getroot())
        assert any(n.startswith(f"Sound: {sound.name}") for n in names), sorted(names)
        assert any(n.startswith("Drive signal for L5") for n in names), sorted(names)
        assert sum(n.startswith("pitch at ") for n in names) == 12, sorted(names)
        run(pacini, clip, "--sound", sound, "-o", folder / "with.svg")
        names = groups(ElementTree.parse(folder / "with.svg").getroot())
        assert not any(n.startswith("Drive signal") for n in names), sorted(names)

        check_errors(pacini, folder, clip)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
