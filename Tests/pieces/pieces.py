"""Twelve pieces of music, speech and film sound, made by synthesis, so that their stems are known."""

import numpy

RATE = 44100
SECONDS = 6.0


class _Studio:
    """Instruments; their noise is the same each time."""

    def __init__(self):
        self.random = numpy.random.default_rng(2026)

    def noise(self, low, high, frames):
        """White noise between two frequencies, with an RMS of 1."""
        spectrum = numpy.fft.rfft(self.random.standard_normal(frames))
        frequency = numpy.fft.rfftfreq(frames, 1 / RATE)
        spectrum[(frequency < low) | (frequency > high)] = 0
        samples = numpy.fft.irfft(spectrum, frames)
        return samples / numpy.std(samples)

    def kick(self, pitch=50.0, decay=0.16):
        time = _time(0.5)
        phase = 2 * numpy.pi * numpy.cumsum(pitch * (1 + 2.5 * numpy.exp(-time / 0.018))) / RATE
        click = self.random.standard_normal(len(time)) * numpy.exp(-time / 0.003)
        return numpy.sin(phase) * numpy.exp(-time / decay) + 0.25 * click

    def snare(self):
        time = _time(0.25)
        drum = numpy.sin(2 * numpy.pi * 185 * time) * numpy.exp(-time / 0.05)
        return 0.5 * drum + 0.25 * self.noise(900, 9000, len(time)) * numpy.exp(-time / 0.07)

    def hat(self, decay=0.03):
        time = _time(0.15)
        return 0.2 * self.noise(6000, 15000, len(time)) * numpy.exp(-time / decay)

    def voice(self, pitch, syllables):
        """Vowels with formants and a gliding pitch, fricatives between them; a number of syllables a second."""
        time = _time(SECONDS)
        glide = 1 + 0.12 * numpy.sin(2 * numpy.pi * 0.6 * time) + 0.05 * numpy.sin(2 * numpy.pi * 2.1 * time)
        phase = numpy.cumsum(pitch * glide) / RATE
        spectrum = numpy.fft.rfft(sum(numpy.cos(2 * numpy.pi * k * phase) / k for k in range(1, 40)))
        frequency = numpy.fft.rfftfreq(len(time), 1 / RATE)
        formants = [(550, 90, 1.0), (1400, 120, 0.6), (2500, 160, 0.35), (3400, 250, 0.2)]
        spectrum *= sum(gain / (1 + ((frequency - centre) / width) ** 2) for centre, width, gain in formants)
        vowels = numpy.fft.irfft(spectrum, len(time))
        beat = numpy.pi * syllables * time
        opening = numpy.clip(numpy.sin(beat + numpy.sin(2 * numpy.pi * 0.7 * time)), 0, 1) ** 0.7
        vowels *= opening * (numpy.sin(2 * numpy.pi * 0.31 * time + 1) > -0.8)
        fricatives = self.noise(3500, 9000, len(time)) * numpy.clip(numpy.sin(beat + 2.2), 0, 1) ** 8
        return 0.175 * vowels / numpy.std(vowels) + 0.05 * fricatives

    def boom(self, seconds=2.5):
        time = _time(seconds)
        low = 0.3 * self.noise(25, 180, len(time)) * numpy.exp(-time / 0.6)
        return low + 0.3 * self.noise(200, 8000, len(time)) * numpy.exp(-time / 0.12)

    def sword(self):
        time = _time(0.6)
        ring = 0.3 * numpy.sin(2 * numpy.pi * 3100 * time) * numpy.exp(-time / 0.15)
        return ring + 0.2 * self.noise(2000, 12000, len(time)) * numpy.exp(-time / 0.03)

    def splinter(self):
        time = _time(0.1)
        return 0.1 * self.random.random() * self.noise(1500, 9000, len(time)) * numpy.exp(-time / 0.01)

    def beat(self, tempo, kick, snare, hats, pitch=50.0, decay=0.16):
        return {
            "kick": _placed((at, self.kick(pitch, decay)) for at in _steps(tempo, kick)),
            "snare": _placed((at, self.snare()) for at in _steps(tempo, snare)),
            "hats": _placed((at, self.hat()) for at in _steps(tempo, hats)),
        }


def _time(seconds):
    return numpy.arange(int(seconds * RATE)) / RATE


def _placed(sounds):
    """All of `sounds`, (seconds, samples) each, in SECONDS."""
    result = numpy.zeros(int(SECONDS * RATE))
    for at, samples in sounds:
        start = int(at * RATE)
        count = min(len(samples), len(result) - start)
        if count > 0:
            result[start : start + count] += samples[:count]
    return result


def _steps(tempo, pattern):
    """Times of the sixteenths that `pattern` has an x for."""
    step = 60 / tempo / 4
    return [i * step for i in range(int(SECONDS / step)) if pattern[i % len(pattern)] == "x"]


def _bass(pitch, seconds):
    time = _time(seconds)
    tone = sum(numpy.sin(2 * numpy.pi * pitch * k * time) / k**1.5 for k in range(1, 8))
    return 0.5 * tone * numpy.minimum(1, time / 0.01) * numpy.minimum(1, (seconds - time) / 0.03)


def _chord(pitches, seconds):
    time = _time(seconds)
    tone = sum(numpy.sin(2 * numpy.pi * f * k * time + k) / k**1.2 for f in pitches for k in range(1, 12))
    return 0.08 * tone * numpy.minimum(1, time / 0.02) * numpy.minimum(1, (seconds - time) / 0.1)


def _chords(*all_pitches):
    seconds = SECONDS / len(all_pitches)
    return _placed((i * seconds, _chord(pitches, seconds)) for i, pitches in enumerate(all_pitches))


def pieces():
    """(name, {stem: samples}) of each, the mix at a peak of 0.9."""
    studio = _Studio()
    minor, major = [220, 261.6, 329.6], [174.6, 220, 261.6]
    pad = _chords(minor, major, minor, major)
    guitar = 0.6 * numpy.tanh(4 * _chords([82.4, 123.5, 164.8], [98, 146.8, 196]))
    eighths, sixteenths, backbeat = "x.", "x", "....x.......x..."

    def line(pitches, step, seconds, count):
        return _placed((i * step, _bass(pitches[i % len(pitches)], seconds)) for i in range(count))

    def brushes():
        swing = 0.6 + 0.4 * numpy.sin(4 * numpy.pi * _time(SECONDS))
        return 0.08 * studio.noise(2000, 9000, len(swing)) * swing

    made = {
        "house": {**studio.beat(124, "x...", backbeat, "..x."), "chord": pad},
        "rock": {**studio.beat(100, "x.....x.x.......", backbeat, eighths, 60.0), "guitar": guitar},
        "trap": {
            **studio.beat(140, "x.......x..x....", "........x.......", sixteenths, 42.0, 0.45),
            "bass": _placed((at, _bass(43.7, 0.5)) for at in _steps(140, "x.......")),
        },
        "drum and bass": {
            **studio.beat(172, "x.........x.....", backbeat, eighths, 55.0, 0.1),
            "bass": line([41.2, 55, 49], 0.7, 0.65, 9),
        },
        "jazz": {
            "bass": line([65.4, 73.4, 82.4, 98], 0.5, 0.45, 12),
            "brushes": brushes(),
            "ride": _placed((i * 0.5 + 0.33 * (i % 2), studio.hat(0.09)) for i in range(12)),
        },
        "bass line": {
            "bass": line([55, 55, 110, 65.4, 73.4, 55, 82.4, 49], 0.25, 0.22, 24),
            "hats": _placed((i * 0.25 + 0.125, studio.hat()) for i in range(24)),
        },
        "song": {
            **studio.beat(96, "x.......x.x.....", backbeat, eighths, 55.0),
            "voice": 1.2 * studio.voice(210, 3.2),
            "chord": pad,
        },
        "rap": {
            **studio.beat(88, "x..x......x.....", backbeat, eighths, 48.0, 0.25),
            "voice": studio.voice(115, 6.0),
        },
        "speech": {"voice": studio.voice(120, 4.2)},
        "speech over a drone": {
            "voice": studio.voice(180, 4.0),
            "drone": 0.25 * studio.noise(40, 90, int(SECONDS * RATE)),
        },
        "film, fight": {
            "hits": _placed((at, studio.boom(0.5)) for at in (0.5, 1.3, 1.6, 3.1, 4.4)),
            "swords": _placed((at, studio.sword()) for at in (0.9, 2.2, 2.5, 3.7, 5.0)),
            "voice": 0.5 * studio.voice(130, 3.0),
        },
        "film, explosion": {
            "boom": _placed([(0.6, studio.boom()), (3.2, 1.2 * studio.boom())]),
            "debris": _placed((1 + 0.09 * i + 0.05 * studio.random.random(), studio.splinter()) for i in range(50)),
        },
    }
    for name, stems in made.items():
        gain = 0.9 / numpy.max(numpy.abs(sum(stems.values())))
        yield name, {stem: gain * samples for stem, samples in stems.items()}
