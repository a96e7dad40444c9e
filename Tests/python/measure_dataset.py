"""What a million sounds cost, from a folder to three targets, by the commands that Resources/docs/datasets.md prints:

    PACINI_COMMAND=... PYTHONPATH=build/release/python:Tests/python \
        build/python-venv/bin/python -B Tests/python/measure_dataset.py [COUNT]

No test: 2000 different sounds of .5 to 2.5 s take some minutes. Files are warm, the least of two runs counts.
"""

import json
import os
import resource
import shutil
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pacini
from sounds import knocks, run

RATE = 48000
WORKERS = os.cpu_count() or 1


def sound(seed):
    """Knocks, a tone that glides and noise that swells, each of its own length and share."""
    random = np.random.default_rng(seed)
    seconds = random.uniform(0.5, 2.5)
    made = random.uniform(0, 1) * knocks(seconds, seed=seed)
    t = np.arange(len(made)) / RATE
    glide = np.sin(2 * np.pi * (random.uniform(40, 200) * t + random.uniform(-20, 60) * t * t))
    swell = np.sin(np.pi * t / seconds) ** 2 * random.standard_normal(len(t))
    return 0.5 * made + random.uniform(0, 0.3) * glide + random.uniform(0, 0.1) * swell


def size(folder):
    return sum(path.stat().st_size for path in Path(folder).rglob("*") if path.is_file())


def taken(*arguments):
    """Seconds and processor seconds of a command."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    run(*arguments)
    seconds, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 2000
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.chdir(folder)
        Path("sounds").mkdir()
        length = 0.0
        for seed in range(count):
            samples = sound(seed)
            length += len(samples) / RATE
            pacini.write_audio(f"sounds/{seed:06}.wav", samples.astype("f4"), RATE, encoding="pcm16")
        print(f"{count} sounds, {length / count:.2f} s each, {size('sounds') / count / 1e3:.0f} kB; {WORKERS} workers")
        steps = {
            "encode": (
                "encode",
                "sounds",
                "-o",
                "clips/",
                "--format",
                "packed",
                "--manifest",
                "clips/run.manifest.json",
            ),
            "render": ("render", "clips", "-o", "drives/", "--manifest", "drives/run.manifest.json"),
            "compare": ("compare", "sounds", "drives", "--manifest", "compare.manifest.json"),
            "haptic": ("convert", "clips", "haptic/", "--format", "haptic"),
            "ahap": ("convert", "clips", "ios/", "--format", "ahap"),
            "android": ("convert", "clips", "android/", "--format", "android"),
        }
        written = {"render": "drives", "encode": "clips", "haptic": "haptic", "ahap": "ios", "android": "android"}
        for step, arguments in steps.items():
            found = []
            for _ in range(2):
                out = Path(written.get(step, "compare.manifest.json"))
                shutil.rmtree(out) if out.is_dir() else out.unlink(missing_ok=True)
                found.append(taken(*arguments, "-q", *(["--force"] if step == "render" else [])))
            seconds, busy = (min(values) for values in zip(*found))
            bytes_each = size(out) / count if out.is_dir() else out.stat().st_size / count
            print(
                f"{step:8} {1e3 * seconds / count:7.2f} ms each, {1e6 * busy / count / 3600:6.2f} processor hours"
                f" and {1e6 * bytes_each / 1e9:6.2f} GB for a million, {busy / seconds:.2f} processors busy"
            )
        start = time.perf_counter()
        measured = json.loads(Path("compare.manifest.json").read_text())["files"]
        match = {Path(file["input"]).stem: (file.get("report") or {}).get("match", 0) for file in measured}
        encoded = json.loads(Path("clips/run.manifest.json").read_text())["files"]
        bytes_of = {Path(file["input"]).stem: sum(out["bytes"] for out in file["outputs"]) for file in encoded}
        good = [name for name in bytes_of if match.get(name, 0) > 60 and bytes_of[name] < 2000]
        print(f"filter   {1e3 * (time.perf_counter() - start) / count:7.2f} ms each, {len(good)} of {count} kept")


if __name__ == "__main__":
    main()
