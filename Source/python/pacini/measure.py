"""Measuring an actuator: play a sweep, analyse its recordings, fit an equaliser, verify that it is flat.

>>> sweep = pacini.measure.sweep()
>>> recording = pacini.measure.simulate(sweep, profile="l5-wristband")
>>> measured = pacini.measure.analyse([recording], sweep, full_scale=49.03)
>>> flat = pacini.measure.fit(measured.profile)
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._arguments import checked, listed, numbers, path, within, wrong
from ._arrays import FloatArray, PathLike, as_rate, as_sound, is_path
from ._errors import Error
from ._files import text_of
from ._profile import AnyProfile, Profile, as_profile
from ._progress import Progress, counted
from ._warnings import warn_of

Array = npt.NDArray[np.float64]

#: m/s^2
GRAVITY = 9.80665


@dataclass(frozen=True)
class Sweep:
    """Test signal of a measurement, with its description, which the analysis needs.

    Attributes
    ----------
    signal : array of float32, (frames,)
        The sound to play.
    sample_rate : int
        Hz.
    description : str
        JSON, as ``pacini measure sweep`` writes it.
    levels : list of float
        Peak levels of the sweeps, dB re full scale.
    lowered, gain : float
        Level that was taken away because an equaliser would pass full scale, and gain of the equaliser, dB.
    equalized_for : str
        Name of the profile whose equaliser was applied; empty without one.
    """

    signal: npt.NDArray[np.float32]
    sample_rate: int
    description: str
    levels: list[float]
    lowered: float
    gain: float
    equalized_for: str

    @checked
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


@checked
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
    """Makes the test signal of a measurement: exponential sweeps.

    Parameters
    ----------
    low, high : float, optional
        Frequencies at the two ends, Hz [10; through an equaliser a little below the profile's range] and [1500].
    duration : float, default 20
        Length of a sweep, s; doubling it improves the signal-to-noise ratio by 3 dB.
    pause : float, default 1
        Silence between sweeps, s; longer than the decay of the actuator.
    repeats : int, default 1
        Sweeps at each level, 1 to 100.
    levels : sequence of float
        Peak levels, dB re full scale. Several show the onset of distortion.
    sample_rate : float, default 48000
        2000 to 384000 Hz.
    profile : Profile, str or path, optional
        Apply the equaliser of this profile, to verify it.

    Returns
    -------
    Sweep

    Raises
    ------
    Error
        A parameter is out of its range.
    """
    rate = as_rate(sample_rate)
    handle = None if profile is None else as_profile(profile)._handle
    signal, about = _native.make_sweep(
        10.0 if low is None else low,
        high,
        low is not None,
        duration,
        pause,
        repeats,
        list(levels),
        float(rate),
        handle,
    )
    return Sweep(signal, rate, about["json"], about["levels"], about["lowered"], about["gain"], about["equalized_for"])


@dataclass(frozen=True)
class Recording:
    """Recording of a sweep.

    Attributes
    ----------
    samples : array, (frames,) or (channels, frames)
        Up to three axes of an accelerometer, or a microphone; full scale is 1.
    sample_rate : int
        Hz.
    """

    samples: FloatArray
    sample_rate: int

    @classmethod
    @checked
    def load(cls, path: PathLike) -> Recording:
        samples, rate, doubts = _native.read_audio(os.fsdecode(path), False, False, False)
        warn_of(path, doubts)
        return cls(samples.T, rate)


@checked
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
    """Simulates what an accelerometer on a worn actuator would record.

    Parameters
    ----------
    sweep : Sweep
        What is played.
    profile : Profile, str or path
        An actuator with a model of the body; its equaliser is not applied.
    wearer : int, default 0
        0 has the skin of the profile, 1 to 14 are simulated people.
    contact : float, default 0
        Level of a loose or a tight fit, -60 to 20 dB.
    latency : float, default 0.012
        Latency of player and recorder together, 0 to 1 s.
    drift : float, default 50
        Deviation of the recorder's clock, -5000 to 5000 ppm.
    noise : float, default 250
        Noise of the sensor, millionths of g per root of Hz.
    distortion : float, default 0
        Third-order distortion: factor of the cube of the drive, -1 to 1.
    range : float, default 5
        Acceleration at which the sensor clips, g.
    axes : int, default 3
        3, with a random orientation, or 1, along the movement.
    bits : int, default 12
        Resolution of the converter, 4 to 24.
    seed : int, default 1
        Seed of noise and orientation.

    Returns
    -------
    Recording

    Raises
    ------
    Error
        A parameter is out of its range, or the profile has no model of the body.
    """
    if not isinstance(sweep, Sweep):
        wrong("must be a Sweep", "sweep", sweep)
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


@checked
def analyse(
    recordings: Union[AnyRecording, Sequence[AnyRecording]],
    sweep: Union[Sweep, PathLike],
    *,
    full_scale: Optional[Union[float, Sequence[float]]] = None,
    smoothing: float = 1.0 / 12.0,
    points: int = 240,
    distortion_limit: float = 10.0,
    profile: Optional[AnyProfile] = None,
    name: str = "",
    progress: Progress = None,
) -> Measurement:
    """Finds the response of an actuator from recordings of a sweep.

    Parameters
    ----------
    recordings : Recording, path, or sequence of these
        One, or several of the same actuator attached anew or on other people.
    sweep : Sweep or path
        What was played: the sweep, or the file that describes it.
    full_scale : float or sequence of float, optional
        Acceleration of a sample of 1, m/s^2, for all channels or for each. Without it levels are relative.
    smoothing : float, default 1/12
        Bandwidth of the power average, octaves.
    points : int, default 240
        Points of the response, evenly spaced in octaves, 8 to 4096.
    distortion_limit : float, default 10
        Distortion whose drive level is stated, 0.01 to 100 %.
    profile : Profile, str or path, optional
        Has what was not measured, such as limits of the drive.
    name : str, optional
        Name of the new profile.
    progress : bool or callable, optional
        As of :func:`pacini.encode`.

    Returns
    -------
    Measurement

    Raises
    ------
    Error
        A recording cannot be read, or does not have the sweep in it.
    """
    if isinstance(recordings, Recording) or is_path(recordings):
        all_of_them: list[AnyRecording] = [recordings]
    else:
        all_of_them = listed(recordings, "recordings")
    if not all_of_them:
        raise Error("has nothing in it", "recordings")
    if isinstance(sweep, Sweep):
        description = sweep.description
    else:
        description = text_of(os.path.splitext(os.fsdecode(path(sweep, "sweep")))[0] + ".json")
    scale = numbers(np.atleast_1d(np.asarray(1.0 if full_scale is None else full_scale)), "full_scale")
    handles = []
    for one in counted(all_of_them, len(all_of_them), progress, "analysing"):
        recording = one if isinstance(one, Recording) else Recording.load(path(one, "recordings"))
        handles.append(
            _native.analyse_recording(
                as_sound(recording.samples, -1, "recordings"),
                as_rate(recording.sample_rate),
                description,
                scale,
                smoothing,
                within(points, 0, 2**31 - 1, "points"),
            )
        )
    base = None if profile is None else as_profile(profile)._handle
    found, made = _native.measurement_findings(
        handles, description, smoothing, distortion_limit, base, name, full_scale is not None
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
    """A section of an equaliser.

    Attributes
    ----------
    type : str
        ``"peak"``, ``"lowShelf"``, ``"highShelf"`` or ``"highpass"``.
    frequency : float
        Hz.
    gain : float
        dB.
    q : float
        Quality factor.
    order : int
        Order of a high-pass.
    """

    type: str
    frequency: float
    gain: float
    q: float
    order: int


@dataclass(frozen=True)
class Fit:
    """An equaliser, and how flat it makes the response.

    Attributes
    ----------
    sections : list of Section
        Its sections.
    rms, max : float
        Deviation from the mean that remains, dB.
    level, boost : float
        Mean level of the flat response, and largest boost, dB.
    reached_goal : bool
        Whether `max` is within the goal.
    profile : Profile or None
        The profile with the equaliser.
    """

    sections: list[Section]
    rms: float
    max: float
    level: float
    boost: float
    reached_goal: bool
    profile: Optional[Profile]


@checked
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
    """Fits the equaliser that flattens a response.

    Parameters
    ----------
    response : Measurement, Profile, str, path, or (frequencies, levels)
        What was measured; Hz and dB.
    profile : Profile, str or path, optional
        Receives the equaliser of a response of frequencies and levels.
    sections : int, optional
        Number of sections, 1 to 16 [the smallest that reaches the goal].
    sample_rate : float, default 48000
        Rate of the equaliser, 1000 to 10000000 Hz.
    max_boost : float, default 12
        Largest boost at any frequency, 0 to 40 dB.
    goal : float, default 2
        Largest deviation that decides the number of sections, dB; the RMS limit is a quarter of it.
    low, high : float, optional
        Range to flatten, Hz [that of the profile, else of the response].
    highpass : float, optional
        Frequency of a high-pass of order 5 that protects the actuator, 1 to 20000 Hz.
    boost_outside : bool, default False
        Allow boost outside of the range; below it this takes much power and travel.
    peaks_only : bool, default False
        Use no shelving filters.

    Returns
    -------
    Fit

    Raises
    ------
    Error
        The response is missing or not valid, or a parameter is out of its range.
    """
    target: Optional[Profile] = None if profile is None else as_profile(profile)
    measured = False
    if isinstance(response, Measurement):
        response = response.profile
    if isinstance(response, tuple):
        frequency, level = _response(response, "response")
    else:
        measured = True
        if target is not None:
            raise Error("is for responses of frequencies and levels", "profile")
        target = as_profile(response, "response")
        points = target.measured
        if len(points) == 0:
            raise Error("is missing in this profile; pacini.measure.analyse() makes one", "measurement", "invalidData")
        frequency, level = points["frequency"].tolist(), points["level"].tolist()
    found, flattened = _native.fit_equalizer(
        frequency,
        level,
        None if target is None else target._handle,
        measured,
        sample_rate,
        sections,
        max_boost,
        goal,
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


@checked
def verify(
    measurement: Union[Measurement, tuple[npt.ArrayLike, npt.ArrayLike]],
    profile: AnyProfile,
    *,
    tolerance: float = 4.0,
    low: Optional[float] = None,
    high: Optional[float] = None,
) -> Verification:
    """Judges whether an actuator is flat through its equaliser.

    Parameters
    ----------
    measurement : Measurement or (frequencies, levels)
        Response to a sweep that went through the equaliser; Hz and dB.
    profile : Profile, str or path
        The profile with the equaliser.
    tolerance : float, default 4
        Largest deviation from the mean, dB.
    low, high : float, optional
        Range that is judged, Hz [that of the profile].

    Returns
    -------
    Verification

    Raises
    ------
    Error
        The response is not valid, or a parameter is out of its range.
    """
    if isinstance(measurement, Measurement):
        measurement = (measurement.frequency, measurement.level)
    frequency, level = _response(measurement, "measurement")
    found, proven = _native.verify_response(frequency, level, as_profile(profile)._handle, tolerance, low, high)
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


def _response(response: object, where: str) -> tuple[list[float], list[float]]:
    if not isinstance(response, (tuple, list)) or len(response) != 2:
        wrong("must be a pair of frequencies and levels", where, response)
    return numbers(response[0], where), numbers(response[1], where)
