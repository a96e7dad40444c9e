"""Measuring an actuator: play a sweep, analyse its recordings, fit an equaliser, verify that it is flat.

>>> sweep = pacini.measure.sweep()
>>> recording = pacini.measure.simulate(sweep, profile="l5-wristband")
>>> measured = pacini.measure.analyse([recording], sweep, full_scale=49.03)
>>> flat = pacini.measure.fit(measured.profile)
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._arrays import FloatArray, PathLike, as_rate, as_sound, is_path
from ._errors import Error
from ._files import text_of
from ._profile import AnyProfile, Profile, as_profile
from ._progress import Progress, counted

Array = npt.NDArray[np.float64]

#: m/s^2
GRAVITY = 9.80665


@dataclass(frozen=True)
class Sweep:
    """What is played to measure, and its description, which the analysis needs. `levels` are those that are played, dB
    re full scale; `lowered` by how much an equaliser made it necessary to lower them."""

    signal: npt.NDArray[np.float32]
    sample_rate: int
    description: str
    levels: list[float]
    lowered: float
    gain: float
    equalized_for: str

    def save(self, path: PathLike, *, overwrite: bool = False) -> None:
        """Writes the sound, and its description beside it, as ``pacini measure sweep`` does. A description that is
        there is replaced only if `overwrite` is True, a sound as by :func:`pacini.write_audio`."""
        from ._sound import write_audio

        text = os.fsdecode(path)
        description = os.path.splitext(text)[0] + ".json"
        if description == text:
            raise Error("is named as its description is; name a sound", text)
        if os.path.lexists(description) and not overwrite:
            raise Error("exists; overwrite=True replaces it", description, "io")
        write_audio(text, self.signal, self.sample_rate, encoding="pcm24", overwrite=overwrite or None)
        _native.write_text(description, self.description)


def sweep(
    *,
    low: Optional[float] = None,
    high: float = 1500.0,
    duration: float = 20.0,
    pause: float = 1.0,
    repeats: int = 1,
    levels: Sequence[float] = (-10.0,),
    sample_rate: float = 48000,
    profile: Optional[AnyProfile] = None,
) -> Sweep:
    """The sweeps of a measurement: from `low` to `high` Hz, each `duration` s long, at each of the `levels` (dB re full
    scale; several show where distortion begins). With a `profile` they go through its equaliser, to verify it."""
    rate = as_rate(sample_rate)
    handle = None if profile is None else as_profile(profile)._handle
    signal, about = _native.make_sweep(
        10.0 if low is None else float(low),
        float(high),
        low is not None,
        float(duration),
        float(pause),
        int(repeats),
        [float(level) for level in levels],
        float(rate),
        handle,
    )
    return Sweep(signal, rate, about["json"], about["levels"], about["lowered"], about["gain"], about["equalized_for"])


@dataclass(frozen=True)
class Recording:
    """Channels of a recording: up to three axes of an accelerometer, or a microphone, as (frames,) or (channels,
    frames)."""

    samples: FloatArray
    sample_rate: int

    @classmethod
    def load(cls, path: PathLike) -> Recording:
        samples, rate, doubts = _native.read_audio(os.fsdecode(path), False, False, False)
        for doubt in doubts:
            warnings.warn(f"{os.fsdecode(path)}: {doubt}", stacklevel=2)
        return cls(samples.T, rate)


def simulate(
    sweep: Sweep,
    *,
    profile: AnyProfile = "l5-wristband",
    wearer: int = 0,
    contact: float = 0.0,
    latency: float = 0.012,
    drift: float = 50.0,
    noise: float = 250.0,
    distortion: float = 0.0,
    range: float = 5.0,
    axes: int = 3,
    bits: int = 12,
    seed: int = 1,
) -> Recording:
    """What an accelerometer on a worn actuator would record, to learn and to test by. `range` is in g; `noise` in
    millionths of g per root of Hz, `latency` in s, `drift` of the clocks in ppm, `contact` in dB."""
    samples = _native.simulate_recording(
        sweep.signal, float(sweep.sample_rate), as_profile(profile)._handle, wearer, contact, latency, drift, noise,
        distortion, range, axes, bits, seed,
    )  # fmt: skip
    return Recording(samples, sweep.sample_rate)


@dataclass(frozen=True)
class Level:
    """What was found at one level of the sweeps (`drive`, dB re full scale): levels in dB re 1 m/s^2 at full drive,
    distortion in %."""

    drive: float
    frequency: Array
    level: Array
    snr: Array
    distortion: Array


@dataclass(frozen=True)
class Measurement:
    """What recordings say of an actuator. The response is `level` (dB re 1 m/s^2 at full drive) over `frequency` (Hz),
    `spread` the deviation between recordings; `profile` is a profile with all of it."""

    frequency: Array
    level: Array
    spread: Array
    resonance: float
    q: float
    plateau: float
    felt: tuple[float, float]
    even: tuple[float, float]
    rise_time: Optional[float]
    fall_time: Optional[float]
    distortion: float
    distortion_drive: Optional[float]
    outliers: list[int]
    levels: list[list[Level]]
    latencies: list[float]
    drifts: list[Optional[float]]
    warnings: list[str]
    profile: Profile


AnyRecording = Union[Recording, PathLike]


def analyse(
    recordings: Union[AnyRecording, Sequence[AnyRecording]],
    sweep: Union[Sweep, PathLike],
    *,
    full_scale: Union[float, Sequence[float]] = 1.0,
    smoothing: float = 1.0 / 12.0,
    points: int = 240,
    distortion_limit: float = 10.0,
    profile: Optional[AnyProfile] = None,
    name: str = "",
    progress: Progress = None,
) -> Measurement:
    """Finds the response of an actuator from recordings of a sweep, of one actuator attached anew or on other people.

    `full_scale` is the acceleration (m/s^2) of a sample of 1, for all channels or for each; `profile` has what was not
    measured, such as limits of the drive.
    """
    listed: list[AnyRecording] = (
        [recordings] if isinstance(recordings, Recording) or is_path(recordings) else list(recordings)
    )
    if not listed:
        raise Error("has nothing in it", "recordings")
    if isinstance(sweep, Sweep):
        description = sweep.description
    else:
        description = text_of(os.path.splitext(os.fsdecode(sweep))[0] + ".json")
    scale = [float(s) for s in full_scale] if isinstance(full_scale, Sequence) else [float(full_scale)]
    handles = []
    for one in counted(listed, len(listed), progress, "analysing"):
        recording = one if isinstance(one, Recording) else Recording.load(one)
        handles.append(
            _native.analyse_recording(
                as_sound(recording.samples, -1),
                as_rate(recording.sample_rate),
                description,
                scale,
                float(smoothing),
                int(points),
            )
        )
    base = None if profile is None else as_profile(profile)._handle
    found, made = _native.measurement_findings(
        handles, description, float(smoothing), float(distortion_limit), base, name
    )
    times: tuple[Optional[float], Optional[float]] = found["times"] or (None, None)
    return Measurement(
        frequency=found["frequency"],
        level=found["level"],
        spread=found["spread"],
        resonance=found["resonance"][0],
        q=found["resonance"][1],
        plateau=found["plateau"],
        felt=found["felt"],
        even=found["even"],
        rise_time=times[0],
        fall_time=times[1],
        distortion=found["distortion"],
        distortion_drive=found["distortion_drive"],
        outliers=found["outliers"],
        levels=[[_level(entry) for entry in handle.levels] for handle in handles],
        latencies=[handle.latency for handle in handles],
        drifts=[handle.drift for handle in handles],
        warnings=[f"{where}: {message}" for handle in handles for where, message in handle.warnings],
        profile=Profile._of(made),
    )


def _level(entry: dict[str, Any]) -> Level:
    return Level(entry["drive"], entry["frequency"], entry["level"], entry["snr"], entry["distortion"])


@dataclass(frozen=True)
class Section:
    """A section of an equaliser: peak, lowShelf, highShelf or highpass."""

    type: str
    frequency: float
    gain: float
    q: float
    order: int


@dataclass(frozen=True)
class Fit:
    """An equaliser: what it leaves of the deviation from the mean (dB), and the profile with it, if one was given."""

    sections: list[Section]
    rms: float
    max: float
    level: float
    boost: float
    reached_goal: bool
    profile: Optional[Profile]


def fit(
    response: Union[AnyProfile, Measurement, tuple[npt.ArrayLike, npt.ArrayLike]],
    *,
    profile: Optional[AnyProfile] = None,
    sections: Optional[int] = None,
    sample_rate: float = 48000,
    max_boost: float = 12.0,
    goal: float = 2.0,
    low: Optional[float] = None,
    high: Optional[float] = None,
    highpass: Optional[float] = None,
    boost_outside: bool = False,
    peaks_only: bool = False,
) -> Fit:
    """The equaliser that makes a response as flat as can be: of a measurement, of a profile with one, or frequencies
    and levels. `sections` is their number, 1 to 16, or as few as reach the `goal` (dB)."""
    target: Optional[Profile] = None if profile is None else as_profile(profile)
    measured = False
    if isinstance(response, Measurement):
        response = response.profile
    if isinstance(response, tuple):
        frequency, level = response
    else:
        measured = True
        if target is not None:
            raise Error("is for responses of frequencies and levels", "profile")
        target = as_profile(response)
        points = target.measured
        if len(points) == 0:
            raise Error("is missing in this profile; pacini.measure.analyse() makes one", "measurement", "invalidData")
        frequency, level = points["frequency"], points["level"]
    found, flattened = _native.fit_equalizer(
        _numbers(frequency),
        _numbers(level),
        None if target is None else target._handle,
        measured,
        float(sample_rate),
        sections,
        float(max_boost),
        float(goal),
        low,
        high,
        highpass,
        boost_outside,
        not peaks_only,
    )
    return Fit(
        [Section(*section) for section in found["sections"]],
        found["rms"],
        found["max"],
        found["level"],
        found["boost"],
        found["reached_goal"],
        None if flattened is None else Profile._of(flattened),
    )


@dataclass(frozen=True)
class Verification:
    """Whether an actuator is flat through its equaliser, and its profile with the proof."""

    passed: bool
    low: float
    high: float
    tolerance: float
    mean_deviation: float
    standard_deviation: float
    worst_deviation: float
    worst_frequency: float
    profile: Profile


def verify(
    measurement: Union[Measurement, tuple[npt.ArrayLike, npt.ArrayLike]],
    profile: AnyProfile,
    *,
    tolerance: float = 4.0,
    low: Optional[float] = None,
    high: Optional[float] = None,
) -> Verification:
    """Judges what was measured of a sweep that went through the profile's equaliser: whether it stays within
    `tolerance` dB of its mean."""
    frequency, level = (
        (measurement.frequency, measurement.level) if isinstance(measurement, Measurement) else measurement
    )
    found, proven = _native.verify_response(
        _numbers(frequency), _numbers(level), as_profile(profile)._handle, float(tolerance), low, high
    )
    return Verification(
        passed=found["passed"],
        low=found["low"],
        high=found["high"],
        tolerance=found["tolerance"],
        mean_deviation=found["mean_deviation"],
        standard_deviation=found["standard_deviation"],
        worst_deviation=found["worst_deviation"],
        worst_frequency=found["worst_frequency"],
        profile=Profile._of(proven),
    )


def _numbers(values: npt.ArrayLike) -> list[float]:
    numbers: list[float] = np.asarray(values, np.float64).ravel().tolist()
    return numbers
