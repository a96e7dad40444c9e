#!/usr/bin/env python3
"""The VST3 in DawDreamer: sidechain in, haptic out, parameters, automation, without clicks, state, offline.

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

    def render(self, sound, seconds=SECONDS):
        main = self.engine.make_playback_processor("main", sound[:2])
        side = self.engine.make_playback_processor("side", sound[2:3])
        self.engine.load_graph([(main, []), (side, []), (self.plugin, ["main", "side"])])
        self.engine.render(seconds)
        return self.engine.get_audio()


HOLD = int(0.7 * RATE)  # frames for which a value stays
REST = int(0.2 * RATE)  # in which a change has passed
CHOICES = {"Source": 3, "Main output": 5, "Actuator": 32, "Pan": 3, "Pan law": 3, "Places": 2}


def places(host, name):
    """The places on its way that a parameter takes in turn: from end to end, both ways, and each choice."""
    index = host.index[name]
    if name in CHOICES:
        found = []
        for i in range(CHOICES[name]):
            host.set(name, i / (CHOICES[name] - 1))
            if not host.plugin.get_parameter_text(index).startswith("No actuator"):
                found.append(i / (CHOICES[name] - 1))
        return found + [0.0]
    if name.endswith(" mute") or name == "Bypass":
        return [0.0, 1.0, 0.0]
    usual, high = host.plugin.get_parameter(index), 0.75 if name == "Transposition" else 1.0  # or it is a high tone itself
    return [usual, 0.0, high, high / 2, 0.0, usual]


def tones(name, one_voice, frames):
    """A steady sound that a parameter matters to. It stays below every limiter, which would distort it."""
    gain = 0.04 if name == "Input gain" else 1.0
    parts = [(80, 0.03 * gain), (190, 0.02 * gain)]
    if name == "Brightness":
        parts = [(450, 0.02)]
    elif name == "Audible":
        parts = [(80, 0.1), (3000, 0.4)]
    elif one_voice:  # in which two tones would beat
        parts = [(80, 0.03)] if name.startswith("Rumble") else [(170, 0.03 * gain)]
    t = np.arange(frames) / RATE
    both = [sum(a * np.sin(2 * np.pi * f * t + 0.3 * c) for f, a in parts) for c in (0, 1)]
    return np.array([*both, 0.03 * np.sin(2 * np.pi * 170 * t)], dtype=np.float32)


def beyond(signal):
    """What of a signal lies beyond 1.5 kHz, by a Butterworth filter of order 16."""
    length = len(signal) + RATE // 10  # behind which it rings no more
    way = np.tan(np.pi * np.fft.rfftfreq(length)) / np.tan(np.pi * 1500 / RATE)
    response = np.ones_like(way, dtype=complex)
    for k in range(8):
        response *= way**2 / (way**2 - 2j * np.cos(np.pi * (2 * k + 1) / 32) * way - 1)
    return np.fft.irfft(np.fft.rfft(signal, length) * response, length)[: len(signal)]


def clicks(path, name, actuator):
    """The worst that the outputs hold when a parameter is automated: dB beyond 1.5 kHz re peak, step re the usual one."""
    host = Host(path, 480)
    ways = places(host, name)
    host = Host(path, 480)
    for other, place in (("Main output", 0.75 if name == "Bypass" else 1.0), ("Haptic channel", 1 / 15),
                         ("Actuator", actuator / 31)):
        host.set(other, place)
    if name == "Input gain":
        host.set("Gate", 0.0)  # or it opens
    if name == "Source mix":
        host.set("Source", 1.0)
    hold = 2 * HOLD if name.startswith("Delay") else HOLD
    frames = len(ways) * hold
    sound = tones(name, actuator > 0, frames)
    host.plugin.set_automation(host.index[name], np.repeat(np.array(ways, np.float32), hold))
    out = host.render(sound, frames / RATE)
    worst, heard = [-300.0, 0.0], 0
    for channel in range(2, 3) if name == "Audible" else range(3):  # whose sound is beyond 1.5 kHz itself
        y = out[channel]
        high, steps = np.abs(beyond(y)), np.abs(np.diff(y, prepend=0))
        for at in range(hold, frames - hold // 2, hold):
            around = [slice(at - REST, at), slice(at + hold - REST, at + hold)]
            now = slice(at, at + hold)
            peak = max(np.abs(y[s]).max() for s in around)
            if peak < 1e-4:
                continue
            heard += 1
            usual = max(steps[s].max() for s in around)
            if channel < 2:  # the sound, which the drive may have cancelled
                usual = max(usual, np.abs(np.diff(sound[channel, at - REST : at])).max())
            if high[now].max() > 2 * max(high[s].max() for s in around):
                worst[0] = max(worst[0], 20 * np.log10(high[now].max() / peak))
            worst[1] = max(worst[1], steps[now].max() / usual)
    return worst, heard


def check_clicks(path):
    """Every parameter that such a stereo track has: those of further actuators need further channels."""
    names = [name for name in Host(path, 480).index if name.split()[-1] not in "2345678"]
    for actuator in (0, 3):
        found = {name: clicks(path, name, actuator) for name in names}
        loud = {name: f"{level:.0f} dB, step {step:.1f}" for name, ((level, step), heard) in found.items()
                if level > -60 or step > 2 or not heard}
        check(f"no parameter clicks when it is automated, on actuator {actuator}", not loud, loud or f"{len(found)} of them")


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
    check_clicks(path)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
