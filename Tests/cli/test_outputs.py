"""What the command writes and says stays as it is, byte for byte, until it is changed on purpose: clips, every export,
drive signals, what is felt, reports and messages of the demo sounds. After such a change `test_outputs.py --make`
(with the environment of command.py) writes Tests/golden/outputs.json anew; the difference in it says what changed.
"""
import hashlib
import json
import re
import subprocess
import sys

from command import COMMAND, SANITIZED, SOURCE, CommandTest

GOLDEN = SOURCE / "Tests/golden/outputs.json"
DEMO = SOURCE / "Resources/demo"
PROFILES = ["l5-wristband", "lra-175", "quest-controller"]
QUICK = ["hjif"]  # formats whose search for the best file takes long


def hashed(content):
    return hashlib.sha256(content).hexdigest()[:16]


def outputs(folder):
    """Runs the command in an empty folder; name -> hash of everything that it wrote and said."""
    made = {}

    def run(name, *arguments, **options):
        done = subprocess.run([COMMAND, *arguments], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, **options)
        said = done.stdout + b"\n--\n" + done.stderr + f"\n{done.returncode}".encode()
        said = re.sub(rb"[0-9.]+ m?s\b|[0-9.]+ (?:times )?real time|\"(?:seconds|runTime\w*)\": ?[0-9.e-]+", b"T", said)
        if str(SOURCE).encode() in said:  # the length of its name decides how wide a column is
            said = re.sub(rb"  +", b"  ", said)
        made[f"says {name}"] = hashed(said.replace(str(SOURCE).encode(), b"SOURCE").replace(str(folder).encode(), b"FOLDER"))

    for sound in sorted(DEMO.glob("*.flac")):
        (folder / sound.name).write_bytes(sound.read_bytes())
    sounds = sorted(path.name for path in folder.iterdir())
    run("encode packed", "encode", "-j1", *sounds, "-o", "packed/", "--format", "packed")
    run("encode bands", "encode", "-j1", *sounds, "-o", "bands/", "--format", "packed", "--audible", "0")
    run("encode json", "encode", "-j1", *sounds, "-o", "json/", "--format", "json")
    clips = [f"packed/{sound.replace('.flac', '.pacb')}" for sound in sounds]
    run("render", "render", "-j1", *clips, "-o", "drive/", "--encoding", "pcm16")
    for profile in PROFILES:
        run(f"render {profile}", "render", "-j1", *clips, "-o", f"by-{profile}/", "--profile", profile, "--encoding", "pcm16")
    run("felt", "render", "-j1", *clips, "-o", "felt/", "--profile", "l5-wristband", "--felt", "--encoding", "pcm16")
    (folder / "workshop.scene.json").write_bytes((DEMO / "workshop.scene.json").read_bytes())
    run("scene", "render", "workshop.scene.json", "--clips", "packed", "-o", "scene.wav", "--encoding", "pcm16")
    run("targets", "lint", "--targets")
    targets = [line.split()[0] for line in
               subprocess.run([COMMAND, "lint", "--targets"], capture_output=True, check=True).stdout.decode().splitlines()
               if "read only" not in line]
    for target in targets:
        quick = ["--quick"] if target in QUICK else []
        run(f"convert {target}", "convert", "-j1", *quick, *clips, f"{target}/", "--format", target)
        run(f"lint {target}", "lint", *quick, *clips, "--target", target)
    for target in ["ahap", "android-xml"]:
        run(f"convert {target} split", "convert", "-j1", *clips, f"{target}-split/", "--format", target, "--split",
            "--points", "20")
    for target in targets:
        read = sorted(str(path.relative_to(folder)) for path in (folder / target).glob("*")
                      if not path.name.startswith("pacini.manifest"))
        run(f"read {target}", "info", *read)
        if target in {"haptic", "ahap", "hjif", "haps", "android", "tact", "csv"}:
            run(f"back {target}", "convert", "-j1", *read, f"back-{target}/", "--format", "json")
    run("info", "info", *clips, *sounds[:2])
    run("info scene", "info", "workshop.scene.json", "--clips", "packed")
    run("info json", "info", "--json", *clips)
    run("lint scene", "lint", "workshop.scene.json", "--clips", "packed")
    run("profiles", "profiles")
    for profile in PROFILES:
        run(f"profile {profile}", "info", profile)
    (folder / "broken.json").write_text('{"format": "pacini.clip", "version": 1, "name": 3, "bands": [{"pitch": "x"}]}')
    (folder / "broken.scene.json").write_text('{"format": "pacini.scene", "version": 1, "plays": [{"clip": 4, "nun": 1}]}')
    (folder / "cut.pacb").write_bytes((folder / clips[0]).read_bytes()[:100] if (folder / clips[0]).exists() else b"")
    (folder / "noise.haptic").write_text("{ not json")
    for name in ["broken.json", "broken.scene.json", "cut.pacb", "noise.haptic", "nothing.wav"]:
        run(f"refuses {name}", "info", name)
        run(f"does not render {name}", "render", name, "-o", "x.wav")
        run(f"does not convert {name}", "convert", name, "x.ahap")
    run("no such format", "convert", clips[0], "x.unknown")
    run("no such name", "convert", clips[0], "x", "--format", "hapic")
    run("help", "help")
    for command in ["encode", "render", "info", "convert", "lint", "profiles", "play", "compare", "measure", "texture", "plot", "bench"]:
        run(f"help {command}", "help", command)
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.name.startswith("pacini.manifest"):
            made[str(path.relative_to(folder))] = hashed(path.read_bytes())
    return made


class Outputs(CommandTest):
    def test_nothing_changed_by_itself(self):
        if SANITIZED:
            self.skipTest("the release build tells")
        golden, made = json.loads(GOLDEN.read_text()), outputs(self.folder)
        self.assertGreater(len(made), 300)
        different = sorted(name for name in golden.keys() | made.keys() if golden.get(name) != made.get(name))
        self.assertEqual(different, [], f"{len(different)} differ; if that was meant: test_outputs.py --make")


if __name__ == "__main__" and "--make" in sys.argv:
    import tempfile
    from pathlib import Path
    with tempfile.TemporaryDirectory() as temporary:
        GOLDEN.write_text(json.dumps(outputs(Path(temporary)), indent=0, sort_keys=True) + "\n")
