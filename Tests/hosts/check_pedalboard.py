#!/usr/bin/env python3
"""The VST3 in Pedalboard, which knows main buses only: it loads, passes sound, names its parameters,
refuses nonsense, keeps its state.

check_pedalboard.py PLUGIN.vst3     exit 0, 1 on a failed check, 77 when Pedalboard is not there
"""
import sys
import tempfile
from pathlib import Path

from host_test import RATE, check, failures, skip

try:
    import numpy as np
    import pedalboard
except ImportError as error:
    skip(error)


def main():
    path = str(Path(sys.argv[1]).resolve())
    plugin = pedalboard.load_plugin(path)
    check("it is an effect", plugin.is_effect and not plugin.is_instrument, plugin.name)
    names = set(plugin.parameters)
    check("parameters", len(names) >= 23, f"{len(names)}")
    t = np.arange(RATE) / RATE
    sound = np.stack([0.4 * np.sin(2 * np.pi * 60 * t), 0.3 * np.sin(2 * np.pi * 220 * t)]).astype(np.float32)
    passed = plugin(sound, RATE)
    # Pedalboard takes away the latency that it read when it loaded the plugin, at 44.1 kHz.
    n = RATE - 200
    lags = [lag for lag in range(100) if np.array_equal(passed[:, lag : lag + n], sound[:, :n])]
    check("the sound passes bit by bit, in time from its first block", lags == [0], f"{lags} frames late")

    plugin.main_output = "Haptic replaces sound"
    felt = plugin(sound, RATE)
    check("the haptic signal can replace the sound", np.array_equal(felt[0], felt[1]) and np.abs(felt).max() > 0.05
          and not np.array_equal(felt[0], sound[0]))
    plugin.intensity_db = -12.0
    softer = plugin(sound, RATE)
    ratio = 20 * np.log10(np.abs(softer[0, RATE // 2 : -200]).max() / np.abs(felt[0, RATE // 2 : -200]).max())
    check("values are in their unit: -12 dB", abs(ratio + 12) < 0.5, f"{ratio:.2f} dB")

    by_name = {parameter.name: parameter for parameter in plugin._parameters}
    for name, place, text, elsewhere in (("Intensity", 0.3, "-6 dB", "1e9"), ("Attack", 0.6, "20 ms", "201"),
                                         ("Actuator", 3 / 31, "Flat drive", "40"), ("Bypass", 1.0, "off", "2")):
        parameter = by_name[name]
        before = parameter.raw_value
        parameter.raw_value = place
        place = parameter.raw_value
        refused = {wrong: parameter.get_raw_value_for_text(wrong) for wrong in ("abc", "", "nan", "1e", elsewhere)}
        check(f"{name}: text that is no value of it leaves the value that it has",
              all(abs(value - place) < 1e-6 for value in refused.values()), f"{place:.3f}: {refused}")
        read = parameter.get_text_for_raw_value(parameter.get_raw_value_for_text(text))
        check(f"{name}: text that is one is read", read.lower().startswith(text.lower().split(" ")[0]), f"{text}: {read}")
        parameter.raw_value = before
    texts = [by_name["Actuator"].get_text_for_raw_value(slot / 31) for slot in range(32)]
    free = [slot for slot, text in enumerate(texts) if text.startswith("No actuator (flat)")]
    check("numbers without an actuator say so", free == list(range(20, 31)), free)

    other = pedalboard.load_plugin(path)
    other.raw_state = plugin.raw_state
    check("the state comes back", {k: v.raw_value for k, v in other.parameters.items()}
          == {k: v.raw_value for k, v in plugin.parameters.items()})
    with tempfile.TemporaryDirectory() as folder:
        preset = Path(folder) / "host.vstpreset"
        preset.write_bytes(plugin.preset_data)
        third = pedalboard.load_plugin(path)
        third.load_preset(str(preset))
        check("a preset file of the host brings it, too", {k: v.raw_value for k, v in third.parameters.items()}
              == {k: v.raw_value for k, v in plugin.parameters.items()})
    other(sound, RATE)  # from the second time on Pedalboard knows the latency
    check("and sounds the same", np.array_equal(other(sound, RATE), softer))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
