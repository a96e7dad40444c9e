"""Sounds for the tests in hosts."""
import numpy as np

from host_test import RATE


def sounds():
    """Two seconds of left, right and sidechain: a hum with clicks, a tone, another tone on and off."""
    random = np.random.default_rng(7)
    t = np.arange(int(2 * RATE)) / RATE
    click = np.exp(-150 * (t % 0.25))
    left = 0.4 * np.sin(2 * np.pi * 60 * t) + 0.3 * click * random.uniform(-1, 1, t.size)
    right = 0.3 * np.sin(2 * np.pi * 220 * t)
    side = 0.5 * np.sin(2 * np.pi * 100 * t) * (t % 0.5 < 0.25)
    return np.stack([left, right, side]).astype(np.float32)
