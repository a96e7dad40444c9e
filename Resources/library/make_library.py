#!/usr/bin/env python3
"""Makes the sounds of the library beside this file, out of nothing but numbers.

make_library.py    Needs numpy and soundfile. The same samples each time: every sound has a seed of its own.
"""
from pathlib import Path

import numpy as np
import soundfile

HERE = Path(__file__).resolve().parent
RATE = 24000  # Hz: what is felt ends at 1 kHz, what matters to the ear of these sounds below 12


def seconds(duration):
    return np.arange(int(duration * RATE)) / RATE


def noise(seed, count):
    return np.random.default_rng(seed).standard_normal(count)


def band(signal, low, high):
    """What lies between two frequencies, by a filter without delay and with soft edges."""
    spectrum = np.fft.rfft(signal)
    f = np.fft.rfftfreq(len(signal), 1 / RATE)
    gain = 1 / np.sqrt(1 + (low / np.maximum(f, 1e-3)) ** 8) / np.sqrt(1 + (f / high) ** 8)
    return np.fft.irfft(spectrum * gain, len(signal))


def mixed(duration, parts):
    """Sounds that begin at given times, in one of that length."""
    out = np.zeros(int(duration * RATE))
    for start, part in parts:
        at = int(start * RATE)
        end = min(len(out), at + len(part))
        out[at:end] += part[:end - at]
    return out


def struck(frequencies, decays, duration, attack=0.001):
    """Decaying partials with a short attack."""
    t = seconds(duration)
    out = sum(a * np.sin(2 * np.pi * f * t) * np.exp(-t / d) for (f, a), d in zip(frequencies, decays))
    return out * np.minimum(1, t / attack)


def ui_click():
    click = struck([(180, 1.0), (1900, .5), (4200, .25)], [.018, .006, .003], .12)
    return mixed(.3, [(.02, click), (.11, .45 * click)])


def notification():
    def bell(f):
        return struck([(f, 1), (2.01 * f, .4), (3.98 * f, .2)], [.3, .18, .08], .9, .003) + \
            mixed(.9, [(0, .8 * struck([(120, 1)], [.05], .3))])
    return mixed(1.4, [(.02, bell(523.25)), (.2, bell(659.26)), (.38, 1.15 * bell(783.99))])


def heartbeat():
    low = struck([(48, 1), (75, .6)], [.09, .06], .4, .01)
    high = struck([(58, .8), (90, .5)], [.06, .04], .3, .008)
    return mixed(4.0, [(beat * .92 + shift, gain * part) for beat in range(4)
                       for shift, gain, part in ((.05, 1, low), (.36, .65, high))])


def footsteps():
    parts = []
    for i in range(6):
        heel = struck([(85 + 4 * (i % 3), 1), (210, .3)], [.035, .02], .2, .002)
        gravel = band(noise(40 + i, int(.22 * RATE)), 700, 5000) * np.exp(-seconds(.22) / .05)
        parts += [(.1 + .52 * i, (1 - .15 * (i % 2)) * heel), (.11 + .52 * i, .16 * gravel), (.2 + .52 * i, .08 * gravel)]
    return mixed(3.4, parts)


def weapon():
    shot = band(noise(50, int(.5 * RATE)), 40, 9000) * np.exp(-seconds(.5) / .035)
    thump = struck([(70, 1.2), (110, .8)], [.08, .05], .5)
    bolt = struck([(320, .6), (2600, .5)], [.015, .006], .1)
    one = mixed(.6, [(0, shot), (0, 1.5 * thump), (.13, .35 * bolt), (.19, .3 * bolt)])
    return mixed(2.0, [(.05, one), (.55, one), (.75, one), (.95, one)])


def explosion():
    t = seconds(3.2)
    blast = band(noise(60, len(t)), 25, 6000) * (np.exp(-t / .12) + .35 * np.exp(-t / .9))
    drop = np.sin(2 * np.pi * np.cumsum(38 + 70 * np.exp(-t / .15)) / RATE) * np.exp(-t / .55)
    debris = mixed(3.2, [(at, .25 * a * band(noise(61 + i, int(.1 * RATE)), 300, 4000) * np.exp(-seconds(.1) / .02))
                         for i, (at, a) in enumerate(((.5, 1), (.72, .7), (.93, .9), (1.2, .5), (1.35, .6), (1.7, .35)))])
    return mixed(3.3, [(.05, blast), (.05, 1.4 * drop), (.05, debris)])


def engine_loop():
    """Whole turns, so that it loops without a seam."""
    t = seconds(4.0)
    speed = 32 + 4 * np.sin(2 * np.pi * t / 4.0)
    phase = 2 * np.pi * np.cumsum(speed) / RATE
    pulse = sum(np.sin(k * phase + .7 * k) / k ** .8 for k in range(1, 14))
    firing = 1 + .35 * np.sin(phase / 2)
    return .5 * pulse * firing + .05 * band(noise(70, len(t)), 200, 2500) * (1 + np.sin(phase))


def rain():
    t = seconds(4.0)
    generator = np.random.default_rng(80)
    parts = []
    for at in np.sort(generator.uniform(.02, 3.9, 90)):
        f, a = generator.uniform(180, 900), generator.uniform(.1, .7) ** 2
        parts.append((at, a * struck([(f, 1), (3.1 * f, .4)], [.008, .004], .05)))
    return .05 * band(noise(81, len(t)), 500, 6000) + mixed(4.0, parts)


def texture():
    """A rough surface under a finger that goes to and fro."""
    t = seconds(3.0)
    speed = np.abs(np.sin(2 * np.pi * t / 1.5))
    ridges = np.sin(2 * np.pi * np.cumsum(30 + 150 * speed) / RATE)
    return speed * (.5 * np.maximum(ridges, 0) ** 3 + .18 * band(noise(90, len(t)), 80, 1500))


def music_bed():
    beat = 60 / 96
    kick = struck([(52, 1.3), (104, .3)], [.12, .04], .4, .002)
    hat = band(noise(100, int(.08 * RATE)), 5000, 11000) * np.exp(-seconds(.08) / .02)
    parts = [(beat * i, kick) for i in range(10)] + [(beat * (i + .5), .12 * hat) for i in range(10)]
    for i, root in enumerate((55.0, 55.0, 65.41, 65.41, 73.42, 73.42, 49.0, 49.0, 55.0, 55.0)):
        t = seconds(.9 * beat)
        bass = sum(np.sin(2 * np.pi * k * root * t) / k ** 1.5 for k in range(1, 6)) * np.exp(-t / .35)
        chord = sum(np.sin(2 * np.pi * root * r * t) for r in (4, 4.7568, 5.9932)) * np.exp(-t / .5)
        parts += [(beat * i, .6 * bass * np.minimum(1, t / .008)), (beat * i, .12 * chord * np.minimum(1, t / .03))]
    return mixed(10 * beat, parts)


SOUNDS = [ui_click, notification, heartbeat, footsteps, weapon, explosion, engine_loop, rain, texture, music_bed]


def main():
    for make in SOUNDS:
        sound = make()
        if make is not engine_loop:
            fade = int(.01 * RATE)
            sound[-fade:] *= np.linspace(1, 0, fade)
        sound = .89 * sound / np.max(np.abs(sound))
        file = HERE / f"{make.__name__}.flac"
        soundfile.write(file, np.round(sound * 32767).astype(np.int16), RATE, subtype="PCM_16")
        print(f"{make.__name__}: {len(sound) / RATE:.2f} s, {file.stat().st_size} B")


if __name__ == "__main__":
    main()
