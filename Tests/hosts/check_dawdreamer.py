#!/usr/bin/env python3
"""The VST3 in DawDreamer: sidechain in, haptic out, parameters, automation, state, offline.

check_dawdreamer.py PLUGIN.vst3     exit 0, 1 on a failed check, 77 when DawDreamer is not there
"""
import sys
import tempfile
from pathlib import Path

from host_test import RATE, check, failures, skip

try:
    import dawdreamer
    import numpy as np
    from host_sounds import sounds
except ImportError as error:
    skip(error)

SECONDS = 1.5


class Host:
    def __init__(self, path, block):
        self.engine = dawdreamer.RenderEngine(RATE, block)
        self.plugin = self.engine.make_plugin_processor("pacini", path)
        self.plugin.enable_all_buses()
        self.index = {p["name"]: p["index"] for p in self.plugin.get_parameters_description()}

    def set(self, name, normal):
        self.plugin.set_parameter(self.index[name], normal)

    def render(self, sound):
        main = self.engine.make_playback_processor("main", sound[:2])
        side = self.engine.make_playback_processor("side", sound[2:3])
        self.engine.load_graph([(main, []), (side, []), (self.plugin, ["main", "side"])])
        self.engine.render(SECONDS)
        return self.engine.get_audio()


def main():
    path = str(Path(sys.argv[1]).resolve())
    sound = sounds()
    host = Host(path, 512)
    check("3 inputs and 3 outputs", (host.plugin.get_num_input_channels(), host.plugin.get_num_output_channels()) == (3, 3))
    latency = host.plugin.get_latency_samples()
    check("a latency below 5 ms", 0 < latency < 0.005 * RATE, f"{latency} frames")

    usual = host.render(sound)
    n = usual.shape[1]
    passed = [np.array_equal(usual[c, lag:], sound[c, : n - lag]) for lag in (0, latency) for c in (0, 1)]
    check("the sound passes bit by bit", all(passed[:2]) or all(passed[2:]))
    check("the haptic output moves", np.abs(usual[2]).max() > 0.05, f"peak {np.abs(usual[2]).max():.3f}")
    check("and stays within full drive", np.abs(usual[2]).max() <= 1.0)
    check("the same again is the same again", np.array_equal(Host(path, 512).render(sound), usual))
    check("blocks of another size change nothing", np.array_equal(Host(path, 64).render(sound), usual))

    other = Host(path, 512)
    other.set("Source", 0.5)
    touched = other.render(sound)
    quiet = sound.copy()
    quiet[:2] = 0
    alone = Host(path, 512)
    alone.set("Source", 0.5)
    check("with the sidechain as source, the main input is not felt", np.array_equal(alone.render(quiet)[2], touched[2]))
    check("but the sidechain is", np.abs(touched[2]).max() > 0.05 and not np.array_equal(touched[2], usual[2]))

    other = Host(path, 512)
    other.set("Main output", 0.25)
    replaced = other.render(sound)
    check("the haptic signal can replace the sound", np.array_equal(replaced[0], replaced[2])
          and np.array_equal(replaced[2], usual[2]))

    other = Host(path, 512)
    other.set("Bypass", 1.0)
    bypassed = other.render(sound)
    check("bypassed, the sound passes and nothing is felt", np.array_equal(bypassed[:2], usual[:2])
          and not bypassed[2].any())
    for name, choices in (("Source", ("Main", "Sidechain", "Mix")),
                          ("Main output", ("Sound (haptic output separate)", "Haptic replaces sound",
                                           "Sound left, haptic right", "Mono sound left, haptic right",
                                           "Haptic added to one channel"))):
        said = []
        for i in range(len(choices)):
            other.set(name, i / (len(choices) - 1))
            said.append(other.plugin.get_parameter_text(other.index[name]))
        check(f"{name} has its choices where hosts put them", said == list(choices), str(said))

    other = Host(path, 512)
    muted = [other.index[name] for name in ("Rumble mute", "Texture mute", "Transients mute")]
    steps = np.ones(int(2 * RATE), dtype=np.float32)
    steps[: RATE // 2] = 0
    for index in muted:
        other.plugin.set_automation(index, steps)
    automated = other.render(sound)
    check("automation mutes from where it says", np.abs(automated[2, RATE // 4 : RATE // 2]).max() > 0.05
          and np.abs(automated[2, RATE:]).max() == 0)

    first = Host(path, 512)
    first.set("Intensity", 0.3)
    first.set("Actuator", 3 / 31)
    wanted = first.render(sound)
    with tempfile.TemporaryDirectory() as folder:
        state = str(Path(folder) / "state")
        first.plugin.save_state(state)
        second = Host(path, 512)
        second.plugin.load_state(state)
        same = [abs(first.plugin.get_parameter(i) - second.plugin.get_parameter(i)) < 1e-6 for i in first.index.values()]
        check("a saved state brings every parameter back", all(same))
        check("and sounds the same", np.array_equal(second.render(sound)[2, RATE // 2:], wanted[2, RATE // 2:]))
    for name in ("Intensity", "Attack", "Actuator", "Bypass"):
        text = first.plugin.get_parameter_text(first.index[name])
        check(f"{name} has a text", len(text) > 0, text)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
