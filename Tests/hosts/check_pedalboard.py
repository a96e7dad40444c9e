#!/usr/bin/env python3
"""The VST3 in Pedalboard, which knows main buses only: it loads, passes sound, names its parameters, keeps its state.

check_pedalboard.py PLUGIN.vst3     exit 0, 1 on a failed check, 77 when Pedalboard is not there
"""
import sys
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

    other = pedalboard.load_plugin(path)
    other.raw_state = plugin.raw_state
    check("the state comes back", {k: v.raw_value for k, v in other.parameters.items()}
          == {k: v.raw_value for k, v in plugin.parameters.items()})
    other(sound, RATE)  # from the second time on Pedalboard knows the latency
    check("and sounds the same", np.array_equal(other(sound, RATE), softer))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
