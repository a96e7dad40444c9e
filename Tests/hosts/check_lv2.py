#!/usr/bin/env python3
"""The LV2 in a small host on lilv, and what its Turtle files say.

check_lv2.py LV2RENDER FOLDER_OF_LV2     exit 0, 1 on a failed check, 77 when lilv or numpy is not there
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from host_test import RATE, check, failures, needs, skip

try:
    import numpy as np
    from host_sounds import sounds
except ImportError as error:
    skip(error)
if not Path(sys.argv[1]).exists():
    skip("liblilv-dev was missing when this was built")

URI = "urn:pacini:translator"


def check_turtle(folder):
    """Against LV2's own vocabularies. These know groups and hints of ports only; hosts read them of properties, too."""
    said = subprocess.run(["lv2_validate", *map(str, sorted(Path(folder).rglob("*.ttl")))], capture_output=True, text=True,
                          timeout=60)
    found = re.findall(r"^error: (.*)\n((?:\s+\S+\n)*)", said.stderr + said.stdout, re.MULTILINE)
    ours = [f"{what}: {' '.join(where.split())}" for what, where in found
            if not (what.endswith("lv2core#Port>") and where.split()[1].endswith(("port-groups#group", "#portProperty")))]
    check("the files are valid by LV2's vocabularies", "checked" in said.stderr + said.stdout and not ours, ours[:3])


def main():
    needs("lv2_validate", "sord_validate")
    tool, folder = (str(Path(argument).resolve()) for argument in sys.argv[1:3])
    # The specifications lie in the usual places.
    specifications = [str(path) for path in sorted(Path("/usr/lib").glob("*/lv2")) + [Path("/usr/lib/lv2")]]
    environment = dict(os.environ, LV2_PATH=os.pathsep.join([folder, *specifications]))
    environment.pop("DISPLAY", None)
    sound = sounds()
    with tempfile.TemporaryDirectory() as scratch:
        scratch = Path(scratch)
        sound.T.tofile(scratch / "in")

        def render(*options, block=512, rate=RATE):
            done = subprocess.run([tool, URI, str(rate), str(block), str(scratch / "in"), str(scratch / "out"), *options],
                                  env=environment, capture_output=True, text=True, timeout=120)
            if done.returncode != 0:
                print(done.stderr)
                sys.exit(1)
            return np.fromfile(scratch / "out", dtype=np.float32).reshape(-1, 3).T, done.stdout

        def value(name, number):
            return ["--set", f"{URI}:{name}={number}"]

        def save(settings):
            state = str(scratch / "settings.ttl")
            render(*settings, "--save", state)
            return state

        usual, said = render("--latency")
        latency = int(said)
        check("a latency below 5 ms", 0 < latency < 0.005 * RATE, f"{latency} frames")
        check("the sound passes bit by bit, late by the latency",
              all(np.array_equal(usual[c, latency:], sound[c, :-latency]) for c in (0, 1)))
        check("the haptic output moves", 0.05 < np.abs(usual[2]).max() <= 1.0, f"peak {np.abs(usual[2]).max():.3f}")
        for block in (1, 37, 4096):
            check(f"blocks of {block} change nothing", np.array_equal(render(block=block)[0], usual))
        side = render(*value("source", 1))[0]
        check("the sidechain can be the source", np.abs(side[2]).max() > 0.05 and not np.array_equal(side[2], usual[2]))
        check("the haptic signal can replace the sound", np.array_equal(render(*value("outputMode", 1))[0][0], usual[2]))
        softer = render(*value("intensity", -12))[0]
        ratio = 20 * np.log10(np.abs(softer[2, RATE:]).max() / np.abs(usual[2, RATE:]).max())
        check("values are in their unit: -12 dB", abs(ratio + 12) < 0.5, f"{ratio:.2f} dB")
        muted = render("--at", str(RATE // 2), *value("rumbleMute", 1), *value("textureMute", 1),
                       *value("transientMute", 1))[0]
        check("automation mutes from where it says", np.array_equal(muted[2, : RATE // 2], usual[2, : RATE // 2])
              and np.abs(muted[2, RATE:]).max() == 0)

        # Bypass is a parameter of ours and a port that hosts switch: either is enough.
        half = str(RATE // 2)
        back = ["--at", str(RATE)]
        for what, off, on in (("parameter", value("bypass", 1), value("bypass", 0)),
                              ("port", ["--port", "enabled=0"], ["--port", "enabled=1"])):
            off_from, said = render("--sets", "--at", half, *off)
            silent = slice(RATE // 2 + RATE // 10, None)
            check(f"bypassed by the {what}, nothing is felt", np.array_equal(off_from[2, : RATE // 2], usual[2, : RATE // 2])
                  and np.abs(off_from[2, silent]).max() == 0)
            check(f"bypassed by the {what}, the sound passes", np.array_equal(off_from[:2], usual[:2]))
            check(f"bypassed by the {what}, the plugin sends nothing", said == "", f"{len(said.splitlines())} values")
            again = render("--at", half, *off, *back, *on)[0]
            check(f"and it plays again when the {what} is back", np.abs(again[2, RATE + RATE // 2 :]).max() > 0.05)
        both = render("--at", half, "--port", "enabled=0", *value("bypass", 1), *back, "--port", "enabled=1")[0]
        check("a host that lets it play again leaves the parameter alone", np.abs(both[2, silent]).max() == 0)
        check("the plugin sends no value that does not change", render("--sets", *value("attack", 20))[1] == "")

        asked = render("--sets", *value("attack", 20), "--at", half, "--get", f"{URI}:attack")[1].split()
        check("asked for a value, the plugin tells it", asked == [f"{URI}:attack", "20"], " ".join(asked))
        told = dict(line.rsplit(" ", 1) for line in
                    render("--sets", *value("intensity", -12), "--at", half, "--get", "all")[1].splitlines())
        check("asked for all, it tells all", len(told) == 62 and told.get(f"{URI}:intensity") == "-12", f"{len(told)} values")

        parameters = {}
        for line in render("--parameters")[1].splitlines():
            uri, low, high, default, *points = line.split("\t")
            named = dict(reversed(point.split(" ", 1)) for point in points)
            parameters[uri.rpartition(":")[2]] = [float(low), float(high), float(default),
                                                  {text: float(at) for text, at in named.items()}]
        check("every parameter has its range", len(parameters) == 62
              and all(low <= default <= high and low < high for low, high, default, _ in parameters.values()),
              f"{len(parameters)} of them")
        choices = {name: (high, named) for name, (_, high, _, named) in parameters.items() if named}
        free = {name: set(range(20 + further, 31 + further))  # numbers without an actuator
                for further, names in ((0, ["profile"]), (1, [f"actuator{n}" for n in range(2, 9)])) for name in names}
        check("choices are the whole numbers of their range, less those without an actuator",
              all(set(named.values()) == set(range(int(high) + 1)) - free.get(name, set())
                  for name, (high, named) in choices.items())
              and {"source", "outputMode", "profile", "actuator8", "pan", "panLaw", "places"} <= set(choices),
              f"{len(choices)} of them")

        def choice(name, text):
            return value(name, choices[name][1].get(text, -1)) if name in choices else value(name, -1)

        check("Mix is the mix", all(np.array_equal(render(*choice("source", "Mix"), *value("sourceMix", share))[0][2], one[2])
                                    for share, one in ((0, usual), (1, side))))
        replaced = render(*choice("outputMode", "Haptic replaces sound"))[0]
        check("Haptic replaces sound does so", all(np.array_equal(replaced[c], usual[2]) for c in (0, 1)))
        added = render(*choice("outputMode", "Haptic added to one channel"), *value("outputChannel", 2))[0]
        check("Haptic added to one channel does so", np.array_equal(added[0], usual[0])
              and np.abs(added[1] - usual[1] - usual[2]).max() < 1e-6)
        second = render("--preset", f"{URI}:preset2")[0]
        check("a preset is heard", not np.array_equal(second[2], usual[2]))
        said = render("--sets", "--preset", f"{URI}:preset2")[1]
        sent = dict(line.rsplit(" ", 1) for line in said.splitlines())
        holds = dict(line.rsplit(" ", 1) for line in render(
            "--sets", "--preset", f"{URI}:preset2", "--at", half, "--get", "all")[1].splitlines()[len(said.splitlines()):])
        changed = {uri for uri, number in holds.items() if abs(float(number) - parameters[uri.rpartition(":")[2]][2]) > 1e-6}
        check("a preset tells the host each value that it changed", changed and changed <= set(sent),
              f"{len(changed - set(sent))} of {len(changed)} are not told")
        check("and no other value than it holds", all(number == holds.get(uri) for uri, number in sent.items()))
        check("so is the one that was chosen before its values were changed",
              np.array_equal(render("--load", save(value("intensity", -40)), "--preset", f"{URI}:preset1")[0], usual))

        state = str(scratch / "state.ttl")
        wanted = render(*value("profile", 3), *value("intensity", -6), "--save", state)[0]
        restored = render("--load", state)[0]
        check("a saved state sounds the same", np.array_equal(restored[2, RATE:], wanted[2, RATE:])
              and not np.array_equal(restored[2], usual[2]))

        np.ascontiguousarray(np.tile(sound, (1, 20)).T).tofile(scratch / "in")
        playing, resting = min((tuple(map(float, render("--silence", "60", "--port", "freeWheeling=0", block=256)[1].split()))
                                for _ in range(3)), key=lambda shares: shares[1] / shares[0])
        check("silence costs next to nothing", resting < 0.2 * playing,
              f"{100 * resting:.3f} % of a core, {100 * playing:.3f} % while it plays")

    check_turtle(folder)
    turtle = "".join(path.read_text() for path in Path(folder).rglob("*.ttl"))
    check("the files name the plugin", URI in turtle)
    for name in ("intensity", "profile", "gateRelease", "bypass"):
        check(f"the files name {name}", f":{name}" in turtle)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
