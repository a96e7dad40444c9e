#!/usr/bin/env python3
"""Example cards of the web page, written into page/index.html: name, picture and buttons of eight sounds.

make_cards.py [--check]    Needs numpy and soundfile. With --check nothing is written, and the exit code is 1 where the
page differs.

The picture has the sound above, and below it what touch has of it: the level between 20 Hz and 1 kHz in 20 ms, with a
tick at each onset. It is drawn with the page, before any sound is loaded.
"""
import re
import sys
from pathlib import Path

import numpy as np
import soundfile

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "Source/web/page/index.html"
BEGIN, END = "<!-- cards, by make_cards.py -->", "<!-- end of cards -->"
# File, name, what it shows.
CARDS = [("library/heartbeat", "Heartbeat", "two soft hits a beat"),
         ("demo/knock_wood_bridge", "Knock on wood", "two hard hits"),
         ("library/footsteps", "Footsteps", "a heavy and a light part"),
         ("demo/drums_tabla_pattern", "Tabla", "a rhythm, high and low"),
         ("library/engine_loop", "Engine", "a tone that goes on"),
         ("library/explosion", "Explosion", "a hit with a long decay"),
         ("library/rain", "Rain", "heard high, felt low"),
         ("library/ui_click", "Button", "the smallest clip")]
WIDTH, SOUND, TOUCH = 120, 34, 26  # units of the picture; heights of its halves
MIDDLE, FLOOR = SOUND / 2 + 1, SOUND + TOUCH + 4


def columns(samples):
    """The largest magnitude of each column."""
    edges = np.linspace(0, len(samples), WIDTH + 1).astype(int)
    return np.array([np.abs(samples[a:max(b, a + 1)]).max() for a, b in zip(edges, edges[1:])])


def felt(samples, rate):
    """The level of what lies between 20 Hz and 1 kHz, in Hann windows of 20 ms."""
    spectrum = np.fft.rfft(samples)
    f = np.fft.rfftfreq(len(samples), 1 / rate)
    low = np.fft.irfft(np.where((f > 20) & (f < 1000), spectrum, 0), len(samples))
    window = np.hanning(int(.02 * rate))
    return np.sqrt(np.convolve(low ** 2, window / window.sum(), "same"))


def onsets(level, rate):
    """Where the level is at least a quarter of the loudest and three times that of 30 ms before: shares of the whole."""
    hop, back = int(.005 * rate), int(.03 * rate)
    found, last = [], -1.0
    for n in range(0, len(level), hop):
        before = level[n - back] if n >= back else 0
        if level[n] > .25 * level.max() and level[n] > 3 * before and n / rate - last > .08:
            found.append(n / len(level))
            last = n / rate
    return found


def number(value):
    return f"{value:.1f}".removesuffix(".0")


def picture(samples, rate):
    sound = columns(samples)
    sound = sound / sound.max() * SOUND / 2
    level = felt(samples, rate)
    touch = columns(level)
    touch = touch / touch.max() * TOUCH
    bars = "".join(f"M{x} {number(MIDDLE - max(h, .3))}v{number(2 * max(h, .3))}" for x, h in enumerate(sound))
    top = "".join(f"L{x} {number(FLOOR - h)}" for x, h in enumerate(touch))
    ticks = "".join(f"M{number(share * WIDTH)} {number(FLOOR)}v-{TOUCH}" for share in onsets(level, rate))
    return (f'<svg viewBox="0 0 {WIDTH} {int(FLOOR) + 1}" preserveAspectRatio="none" aria-hidden="true">'
            f'<path class="sound" d="{bars}"/><path class="touch" d="M0 {number(FLOOR)}{top}V{number(FLOOR)}z"/>'
            f'<path class="event" d="{ticks}"/></svg>')


def card(path, name, about):
    samples, rate = soundfile.read(ROOT / f"Resources/{path}.flac", always_2d=True)
    mono = samples.mean(axis=1)
    file = f"{path.split('/')[1]}.flac"
    return (f'        <li class="card" data-file="{file}">\n'
            f'          <button type="button" class="open">{picture(mono, rate)}<strong>{name}</strong>'
            f'<span>{len(mono) / rate:.1f} s, {about}</span></button>\n'
            f'          <button type="button" class="play" aria-label="Play {name}">Play</button>\n'
            f'          <button type="button" class="feel" aria-label="Feel {name}">Feel</button>\n        </li>')


def alike(a, b):
    """Whether texts are the same but for the last digit of their numbers, which is another on other machines."""
    digits = re.compile(r"-?[0-9]+(?:\.[0-9]+)?")
    x, y = ([float(one) for one in digits.findall(text)] for text in (a, b))
    return digits.sub("0", a) == digits.sub("0", b) and all(abs(p - q) < .11 for p, q in zip(x, y))


def main():
    text = PAGE.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    made = f"{before}{BEGIN}\n" + "\n".join(card(*one) for one in CARDS) + f"\n        {END}{after}"
    if "--check" in sys.argv:
        sys.exit(0 if alike(made, text) else "index.html: its cards are not those of make_cards.py: run it")
    PAGE.write_text(made, encoding="utf-8")


if __name__ == "__main__":
    main()
