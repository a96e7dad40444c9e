"""From sounds to clips, from clips to signals, and how close they are."""

from __future__ import annotations

import os
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._arguments import check_names, checked, wrong
from ._arrays import FloatArray, PathLike, as_rate, as_sound, is_path
from ._clip import Clip
from ._document import json_of
from ._errors import Error
from ._files import text_of
from ._formats import Loss, formats
from ._parameters import ENCODE, EXPORT, checked_options, with_keywords
from ._profile import AnyProfile, as_profile
from ._progress import Progress, shown
from ._scene import Scene
from ._warnings import warn, warn_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import EncodeOptions, ExportOptions

Sound = Union[PathLike, FloatArray, Sequence[float]]
AnySettings = Union[PathLike, Mapping[str, Any]]


@dataclass(frozen=True)
class Method:
    """A translation method.

    Attributes
    ----------
    name : str
        What :func:`encode` and :func:`translate` call it.
    output : str
        ``"clip"`` or ``"signal"``.
    description : str
        One sentence.
    """

    name: str
    output: str
    description: str


@checked
def methods() -> list[Method]:
    """The translation methods: Pacini's own, ``a2vt``, and those that it can be compared with.

    Returns
    -------
    list of Method
    """
    return [Method(*entry) for entry in _native.methods()]


class Preset(NamedTuple):
    """Options of :func:`encode` for a kind of sound."""

    name: str
    purpose: str


@checked
def presets() -> list[Preset]:
    """The presets of :func:`encode`; the first is the default.

    Returns
    -------
    list of Preset
    """
    return [Preset(*entry) for entry in _native.presets()]


class _Wanted(NamedTuple):
    """How sounds are encoded: what the native encoder is made of."""

    method: str
    preset: str
    options: dict[str, Any]
    settings: str
    allow_nan: bool
    allow_truncated: bool


def settings_text(settings: Optional[AnySettings]) -> str:
    """The text of a settings document; empty for none. Raises :class:`pacini.Error`."""
    if settings is None:
        return ""
    if is_path(settings):
        return text_of(settings)
    if not isinstance(settings, Mapping):
        wrong("must be a file or a dictionary", "settings", settings)
    return json_of(dict(settings), "settings")


def check_options(function: str, options: dict[str, Any]) -> None:
    """Raises what :func:`encode` would raise of every sound: for many of them this is known before the first."""
    own = {"method": "", "preset": "", "settings": None, "allow_nan": False, "allow_truncated": False}
    given = {name: value for name, value in options.items() if name not in own and value is not None}
    given = checked_options(function, given, ENCODE)
    chosen = {**own, **{name: value for name, value in options.items() if name in own and value is not None}}
    _native.EncoderHandle(
        str(chosen["method"]), str(chosen["preset"]), given, settings_text(chosen["settings"]),
        bool(chosen["allow_nan"]), bool(chosen["allow_truncated"]),
    )  # fmt: skip


class _Encoders(threading.local):
    """The encoder that a thread used last, with its filters and transforms."""

    wanted: Optional[_Wanted] = None
    handle: Optional[_native.EncoderHandle] = None

    def take(self, wanted: _Wanted) -> _native.EncoderHandle:
        handle = self.handle if wanted == self.wanted else None
        self.wanted = self.handle = None  # not while it works: it may be left in its midst
        if handle is None:
            handle = _native.EncoderHandle(*wanted)
            for doubt in handle.doubts:
                warn(f"settings: {doubt}")
        return handle

    def give_back(self, handle: _native.EncoderHandle, wanted: _Wanted) -> None:
        self.wanted, self.handle = wanted, handle


_encoders = _Encoders()


def _translated(
    sound: Sound,
    sample_rate: Optional[float],
    axis: int,
    name: str,
    source: str,
    progress: Progress,
    result_kind: str,
    wanted: _Wanted,
) -> Any:
    handle = _encoders.take(wanted)
    if handle.makes_clip != (result_kind == "clip"):
        method = wanted.method or "the method of the settings"
        raise Error(
            f"{method} makes a drive signal; use pacini.translate()"
            if result_kind == "clip"
            else f"{method} makes a clip; use pacini.encode()",
            "method",
        )
    if is_path(sound):
        if sample_rate is not None:
            raise Error("is for sounds in arrays; a file has its own", "sample_rate")
        with shown(progress, os.path.basename(os.fsdecode(sound))) as tell:
            result = handle.encode_file(os.fsdecode(sound), tell)
        warn_of(sound, handle.sound_doubts)
    else:
        samples = as_sound(sound, axis)
        rate = as_rate(sample_rate)
        with shown(progress, name or "sound") as tell:
            result = handle.encode_array(samples, rate, name, source, tell)
        if result_kind == "signal":
            result = (result, rate)
    _encoders.give_back(handle, wanted)
    return result


@with_keywords(ENCODE)
@checked
def encode(
    sound: Sound,
    sample_rate: Optional[float] = None,
    *,
    axis: int = -1,
    method: Optional[str] = None,
    preset: Optional[str] = None,
    settings: Optional[AnySettings] = None,
    allow_nan: bool = False,
    allow_truncated: bool = False,
    name: str = "",
    source: str = "",
    progress: Progress = None,
    **options: Unpack[EncodeOptions],
) -> Clip:
    """Encodes a sound as a haptic clip.

    The interpreter's lock is free meanwhile.

    Parameters
    ----------
    sound : path or array of float32 or float64
        An audio file, or samples, full scale 1, as (frames,) or (channels, frames). float32 samples that lie in memory
        frame by frame are read in place: one channel, or (frames, channels) in C order with ``axis=0``.
    sample_rate : float, optional
        Rate of samples in an array, 8000 to 768000 Hz. Not for files.
    axis : int, default -1
        Axis of the frames; 0 for arrays of soundfile, which are (frames, channels).
    method : str, optional
        Name of one of :func:`methods` that makes a clip ["a2vt"].
    preset : str, optional
        Name of one of :func:`presets`. Overrides `settings`; options override the preset.
    settings : path or mapping, optional
        A file that ``pacini encode --print-settings`` wrote, or its content.
    allow_nan : bool, default False
        Take samples that are not finite as 0 instead of raising.
    allow_truncated : bool, default False
        Encode the part that remains of a truncated file instead of raising.
    name, source : str, optional
        Name and file name that a clip of an array states.
    progress : bool or callable, optional
        True shows a bar (tqdm); a function is called with the share that is done, 0 to 1.
    **options
        Parameters of the method, listed below; None is the method's own value.

    Returns
    -------
    Clip

    Raises
    ------
    Error
        The sound cannot be read, or an option is out of its range. :class:`FileMissing` where there is no file.
    ArgumentError
        There is no such option, or an argument is of the wrong type.

    Examples
    --------
    >>> clip = pacini.encode("door.wav", preset="music")
    >>> clip = pacini.encode(samples, 48000, bands=8)
    """
    given = checked_options("encode", options, ENCODE)
    wanted = _Wanted(method or "", preset or "", given, settings_text(settings), allow_nan, allow_truncated)
    return Clip._of(_translated(sound, sample_rate, axis, name, source, progress, "clip", wanted))


@checked
def translate(
    sound: Sound,
    sample_rate: Optional[float] = None,
    *,
    method: str,
    axis: int = -1,
    allow_nan: bool = False,
    allow_truncated: bool = False,
    progress: Progress = None,
) -> tuple[npt.NDArray[np.float32], int]:
    """Translates a sound by a method that makes a drive signal, not a clip; see :func:`methods`.

    Parameters
    ----------
    sound, sample_rate, axis, allow_nan, allow_truncated, progress
        As of :func:`encode`.
    method : str
        Name of one of :func:`methods`.

    Returns
    -------
    signal : array of float32, (frames,)
        The drive, 1 is full drive.
    sample_rate : int
        Its rate in Hz.

    Raises
    ------
    Error
        As of :func:`encode`; the method makes a clip.
    """
    wanted = _Wanted(method, "", {}, "", allow_nan, allow_truncated)
    signal, rate = _translated(sound, sample_rate, axis, "", "", progress, "signal", wanted)
    return signal, rate


@dataclass(frozen=True)
class RenderReport:
    """What was done to play a clip or a scene.

    Attributes
    ----------
    reduction : float
        Largest gain reduction of the protection, dB.
    predicted_error : float
        Error of what is not played, dB re the whole: of what nobody feels, and of what the actuator cannot play.
    adaptations : list of (str, str)
        What was fitted to the actuator, and why.
    left_out : list of (str, str, float)
        What is not computed, why, and its level in dB.
    """

    reduction: float
    predicted_error: float
    adaptations: list[tuple[str, str]]
    left_out: list[tuple[str, str, float]]


def _rendered(
    content: Union[Clip, Scene],
    options: _native.RenderOptions,
    dtype: npt.DTypeLike,
    progress: Progress,
    designed_for: Optional[AnyProfile] = None,
) -> tuple[FloatArray, RenderReport]:
    try:
        wanted = np.dtype(dtype)
    except TypeError:
        wrong("must be float32 or float64", "dtype", dtype)
    if wanted not in (np.float32, np.float64):
        raise Error("must be float32 or float64", "dtype")
    if not isinstance(content, (Clip, Scene)):
        wrong("must be a Clip or a Scene", "content", content)
    alike: list[tuple[str, str]] = []
    handle: Union[_native.ClipHandle, _native.SceneHandle] = content._handle
    if designed_for is not None:
        scene = _native.SceneHandle.of_clip(handle) if isinstance(handle, _native.ClipHandle) else handle
        handle, alike, unlike = _native.transparent(scene, as_profile(designed_for, "designed_for")._handle, options)
        for where, what in unlike:
            warn(what if isinstance(content, Clip) else f"{where}: {what}")
    with shown(progress, "rendering") as tell:
        if isinstance(handle, _native.ClipHandle):
            made = _native.render_clip(handle, options, tell)
        else:
            made = _native.render_scene(handle, options, tell)
    samples, reduction, error, adaptations, left_out, unplayable = made
    adaptations = [*alike, *adaptations]
    for what in unplayable:
        warn(f"{what}, so it is left out")
    signal = samples[0] if isinstance(content, Clip) or samples.shape[0] == 1 else samples
    return signal.astype(wanted, copy=False), RenderReport(reduction, error, adaptations, left_out)


def _render_options(
    profile: Optional[AnyProfile],
    sample_rate: float,
    *,
    protect: bool = True,
    leave_out: bool = True,
    adapt: bool = True,
    seed: int = 0,
    **described: Any,
) -> _native.RenderOptions:
    """`described`: what ``pacini render`` has options of, by its names in Python."""
    options = _native.RenderOptions(
        None if profile is None else as_profile(profile)._handle, {"sample_rate": as_rate(sample_rate), **described}
    )
    options.set(protect, leave_out, adapt, seed)
    return options


@checked
def render(
    content: Union[Clip, Scene],
    sample_rate: float = 48000,
    *,
    profile: Optional[AnyProfile] = None,
    designed_for: Optional[AnyProfile] = None,
    protect: bool = True,
    gain: float = 0.0,
    transpose: float = 0.0,
    stretch: float = 1.0,
    delay: float = 0.0,
    start: float = 0.0,
    end: Optional[float] = None,
    variation: float = 0.0,
    variation_per: str = "breakpoint",
    seed: int = 0,
    tolerance: float = -60.0,
    leave_out: bool = True,
    adapt: bool = True,
    mapping: Optional[str] = None,
    max_boost: float = 6.0,
    strength: float = _native.STANDARD_STRENGTH,
    carriers: Optional[str] = None,
    follow_envelope: Optional[bool] = None,
    pulse: Optional[str] = None,
    pulse_frequency: Optional[float] = None,
    pulse_cycles: float = 1.0,
    dtype: npt.DTypeLike = np.float32,
    progress: Progress = None,
) -> FloatArray:
    """Renders a clip or a scene as the drive signal of an actuator, as ``pacini render`` does.

    Parameters
    ----------
    content : Clip or Scene
        What is rendered.
    sample_rate : float, default 48000
        Rate of the drive, 2000 to 768000 Hz.
    profile : Profile, str or path, optional
        The actuator, by its profile, the name of a shipped one, or a file. Without it the drive is flat.
    designed_for : Profile, str or path, optional
        The actuator on which the content was designed: it feels alike on that of `profile`. What cannot is a warning.
    protect : bool, default True
        Keep the drive within the limits of the actuator.
    gain : float, default 0
        Gain in dB, -120 to 60.
    transpose : float, default 0
        Shift in pitch in semitones, -96 to 96.
    stretch : float, default 1
        Ratio of the durations at the same pitch, 0.01 to 100.
    delay : float, default 0
        Silence in front, 0 to 3600 s.
    start, end : float, optional
        The part that is rendered, 0 to 86400 s.
    variation : float, default 0
        Random deviation of the bands' amplitudes, 0 to 1, from `seed`.
    variation_per : str, default "breakpoint"
        ``"breakpoint"`` or ``"band"``: what has one random factor.
    seed : int, default 0
        Seed of the variation, 0 to 2^64 - 1.
    tolerance : float, default -60
        Error that leaving out may cost, -300 to 0 dB re the whole.
    leave_out : bool, default True
        Skip what nobody would feel, within `tolerance`.
    adapt : bool, default True
        Fit pitches and levels to the range of the actuator.
    mapping : str, optional
        How frequencies beyond its range are moved: ``"clamp"``, ``"rescale"`` or ``"fold"`` [as the profile says].
    max_boost : float, default 6
        Largest boost for flattening the resonance, 0 to 40 dB.
    strength : float, default 0.4
        How much of the resonance is kept, 0 to 1: from as flat to as strong as can be.
    carriers : str, optional
        Frequencies of the sinusoids: ``"fixed"``, ``"pitch"`` or ``"centroid"`` [as the clip was made].
    follow_envelope : bool, optional
        Match the sum of the bands to the total envelope [as the clip was made].
    pulse : str, optional
        Waveform of events: ``"adaptive"``, ``"square"`` or ``"sine"`` [as the clip was made].
    pulse_frequency : float, optional
        Frequency of square and sine pulses, 1 to 2000 Hz [the resonance of the actuator].
    pulse_cycles : float, default 1
        Their periods, 0.1 to 100.
    dtype : numpy dtype, default float32
        float32 or float64.
    progress : bool or callable, optional
        As of :func:`encode`.

    Returns
    -------
    array, (frames,) or (actuators, frames)
        The drive; 1 is full drive. Two dimensions only for a scene of several actuators.

    Raises
    ------
    Error
        A parameter is out of its range, or the profile cannot be read.
    """
    options = _render_options(
        profile,
        sample_rate,
        protect=protect,
        gain=gain,
        transpose=transpose,
        stretch=stretch,
        delay=delay,
        start=start,
        end=end,
        variation=variation,
        variation_per=variation_per,
        seed=seed,
        tolerance=tolerance,
        leave_out=leave_out,
        adapt=adapt,
        mapping=mapping,
        max_boost=max_boost,
        strength=strength,
        carriers=carriers,
        follow_envelope=follow_envelope,
        pulse=pulse,
        pulse_frequency=pulse_frequency,
        pulse_cycles=pulse_cycles,
    )
    return _rendered(content, options, dtype, progress, designed_for)[0]


@checked
def explain(
    content: Union[Clip, Scene],
    sample_rate: float = 48000,
    *,
    profile: Optional[AnyProfile] = None,
    designed_for: Optional[AnyProfile] = None,
    tolerance: float = -60.0,
    strength: float = _native.STANDARD_STRENGTH,
    gain: float = 0.0,
) -> RenderReport:
    """States what :func:`render` does to play a clip or a scene: what it adapts, reduces and leaves out.

    Parameters
    ----------
    content, sample_rate, profile, designed_for, tolerance, strength, gain
        As of :func:`render`.

    Returns
    -------
    RenderReport
    """
    options = _render_options(profile, sample_rate, gain=gain, tolerance=tolerance, strength=strength)
    return _rendered(content, options, np.float32, None, designed_for)[1]


@checked
def felt(
    content: Union[Clip, Scene],
    sample_rate: float = 48000,
    *,
    profile: AnyProfile,
    designed_for: Optional[AnyProfile] = None,
    wearer: int = 0,
    full_scale: float = _native.FELT_FULL_SCALE,
    gain: float = 0.0,
    start: float = 0.0,
    end: Optional[float] = None,
    strength: float = _native.STANDARD_STRENGTH,
    protect: bool = True,
    dtype: npt.DTypeLike = np.float32,
    progress: Progress = None,
) -> FloatArray:
    """Predicts the acceleration of the skin, by the profile's model of the body.

    Parameters
    ----------
    content, sample_rate, designed_for, gain, start, end, strength, protect, dtype, progress
        As of :func:`render`.
    profile : Profile, str or path
        An actuator with a model of the body.
    wearer : int, default 0
        0 to 14: 0 is the person of the profile, the others are simulated people.
    full_scale : float
        Acceleration that 1 stands for, 0.001 to 1000000 m/s^2; the default is that of ``pacini render --felt``.

    Returns
    -------
    array, (frames,) or (actuators, frames)
        Acceleration over `full_scale`: multiply by it for m/s^2.

    Raises
    ------
    Error
        As of :func:`render`; the profile has no model of the body.
    """
    options = _render_options(profile, sample_rate, protect=protect, gain=gain, start=start, end=end, strength=strength)
    options.feel({"wearer": wearer, "full_scale": full_scale})
    return _rendered(content, options, dtype, progress, designed_for)[0]


@dataclass(frozen=True)
class Comparison:
    """How much of a sound a haptic signal keeps. A figure is None where it says nothing, such as of a silent reference.

    Attributes
    ----------
    match, match_of_sound : float or None
        Predicted rating by people of how well it matches, 35.4 (nothing is felt) to 71; of the sound itself.
    hts, ceiling : float
        Haptic translation similarity, 0 to 100; of the sound itself.
    hts_f : float
        The same over what can be felt on both sides.
    lsd : float or None
        Log-spectral distance in third octaves, dB; 0 is equal.
    wide_snr, band_snr, band_snr_per_band : float or None
        SNR of envelopes, dB; 60 is equal.
    low_kept, beat_kept : float or None
        How far low envelopes and the beat follow those of the sound; 1 is equal.
    centroid_error, centroid_bias : float or None
        Median error of the spectral centroid and its sign, %.
    f1, f1_within_10_ms : float or None
        F-measure of events within 25 and 10 ms; None without known onsets.
    values : dict
        All that ``pacini compare --json`` states of a file.
    """

    values: dict[str, Any]

    def _figure(self, key: str) -> Optional[float]:
        value: Optional[float] = self.values[key]
        return value

    @property
    def match(self) -> Optional[float]:
        return self._figure("match")

    @property
    def match_of_sound(self) -> Optional[float]:
        return self._figure("matchOfSound")

    @property
    def hts(self) -> float:
        return float(self.values["hts"])

    @property
    def ceiling(self) -> float:
        return float(self.values["ceiling"])

    @property
    def hts_f(self) -> float:
        return float(self.values["htsF"])

    @property
    def lsd(self) -> Optional[float]:
        return self._figure("lsd")

    @property
    def wide_snr(self) -> Optional[float]:
        return self._figure("wideSnr")

    @property
    def band_snr(self) -> Optional[float]:
        return self._figure("bandSnr")

    @property
    def band_snr_per_band(self) -> Optional[float]:
        return self._figure("bandSnrPerBand")

    @property
    def low_kept(self) -> Optional[float]:
        """How far the envelopes of 30 to 120 and 120 to 300 Hz follow those of the sound: correlation, -1 to 1."""
        return self._figure("lowKept")

    @property
    def beat_kept(self) -> Optional[float]:
        """Level in the strongest low events against that between them, as a share of the same ratio of the sound."""
        return self._figure("beatKept")

    @property
    def centroid_error(self) -> Optional[float]:
        return self._figure("centroidError")

    @property
    def centroid_bias(self) -> Optional[float]:
        return self._figure("centroidBias")

    @property
    def f1(self) -> Optional[float]:
        return self._figure("f1")

    @property
    def f1_within_10_ms(self) -> Optional[float]:
        return self._figure("f1Within10ms")

    @property
    def not_finite(self) -> int:
        """Samples of both that were no numbers, or far beyond full scale."""
        return int(self.values["notFinite"])

    @property
    def match_parts(self) -> Optional[dict[str, float]]:
        parts: Optional[dict[str, float]] = self.values["matchParts"]
        return parts

    @property
    def impression(self) -> dict[str, Any]:
        """Predicted ratings of strength, tempo and roughness."""
        impression: dict[str, Any] = self.values["impression"]
        return impression

    def __repr__(self) -> str:
        match = "-" if self.match is None else f"{self.match:.1f}"
        return f"<pacini.Comparison match {match}, HTS {self.hts:.1f} of {self.ceiling:.1f}>"


def _read_samples(path: PathLike, *allowed: bool) -> tuple[Any, int]:
    """Returns the samples of a file, (frames, channels), and its rate. Tolerated problems are warnings."""
    samples, rate, doubts = _native.read_audio(os.fsdecode(path), *allowed)
    warn_of(path, doubts)
    return samples, rate


def _read_for_comparison(
    sound: Sound, rate: Optional[float], axis: int, where: str, where_rate: str, allow_truncated: bool
) -> tuple[Any, int]:
    if is_path(sound):
        samples, own = _read_samples(sound, False, allow_truncated, True)
        return samples.T, own
    return as_sound(sound, axis, where), as_rate(rate, where_rate)


def _clip_extensions() -> set[str]:
    return {one.extension for one in formats() if one.is_read}


@checked
def compare(
    reference: Sound,
    candidate: Union[Sound, Clip, Scene],
    sample_rate: Optional[float] = None,
    *,
    candidate_rate: Optional[float] = None,
    axis: int = -1,
    onsets: Optional[Sequence[float]] = None,
    events: Optional[Sequence[float]] = None,
    ambiguous: Sequence[float] = (),
    allow_nan: bool = False,
    allow_truncated: bool = False,
) -> Comparison:
    """Measures how much of a sound a haptic signal keeps, as ``pacini compare`` does.

    Parameters
    ----------
    reference : path or array
        The sound: a file, or samples as of :func:`encode`.
    candidate : path, array, Clip or Scene
        What is felt: a sound, or a clip or a scene, or a file of one, which is rendered without an actuator.
    sample_rate, candidate_rate : float, optional
        Rates of arrays, 2000 to 768000 Hz; that of the candidate is by default the same, for clips 48000.
    axis : int, default -1
        Axis of the frames of arrays.
    onsets : sequence of float, optional
        When events of the sound happen, s. Needed for `f1`.
    events : sequence of float, optional
        When events of the candidate happen, s [found in it].
    ambiguous : sequence of float, optional
        Onsets that count neither as hits nor as misses, s.
    allow_nan : bool, default False
        Take samples that are not finite, or far beyond full scale, as silence, with all that filters make of them;
        :attr:`Comparison.not_finite` counts them.
    allow_truncated : bool, default False
        Compare the part that remains of truncated files.

    Returns
    -------
    Comparison

    Raises
    ------
    Error
        A file cannot be read, a rate is missing or out of its range, a sample is not finite.

    Warns
    -----
    UserWarning
        Onsets are after the end of the sound.
    """
    source, source_rate = _read_for_comparison(
        reference, sample_rate, axis, "reference", "sample_rate", allow_truncated
    )
    end = source.shape[-1] / source_rate
    late = 0 if onsets is None else sum(time > end + 0.1 for time in onsets)
    if late:
        warn(f"{late} of the {len(onsets or ())} onsets are after the end of the sound, {end:.2f} s; give seconds")
    if is_path(candidate) and os.path.splitext(os.fsdecode(candidate))[1].lower() in _clip_extensions():
        candidate = read(candidate)
    if isinstance(candidate, (Clip, Scene)):
        rate = as_rate(48000 if candidate_rate is None else candidate_rate, "candidate_rate")
        target, target_rate = render(candidate, rate), rate
    else:
        target, target_rate = _read_for_comparison(
            candidate,
            candidate_rate if candidate_rate is not None else sample_rate,
            axis,
            "candidate",
            "candidate_rate",
            allow_truncated,
        )
    return Comparison(
        _native.compare(
            source,
            source_rate,
            target,
            target_rate,
            onsets,
            events,
            list(ambiguous),
            allow_nan,
        )
    )


@checked
def read_audio(
    path: PathLike, *, allow_nan: bool = False, allow_truncated: bool = False
) -> tuple[npt.NDArray[np.float32], int]:
    """Reads an audio file.

    Parameters
    ----------
    path : path
        A file of any format that Pacini reads.
    allow_nan, allow_truncated : bool, default False
        As of :func:`encode`.

    Returns
    -------
    samples : array of float32, (frames,) or (channels, frames)
        Full scale is 1.
    sample_rate : int
        Hz.

    Raises
    ------
    Error
        The file cannot be read. What the reader lets pass is a warning.
    """
    samples, rate = _read_samples(path, allow_nan, allow_truncated, False)
    return (samples[:, 0] if samples.shape[1] == 1 else samples.T), rate


@checked
def write_audio(
    path: PathLike,
    sound: FloatArray,
    sample_rate: float,
    *,
    axis: int = -1,
    encoding: str = "float32",
    overwrite: Optional[bool] = None,
) -> int:
    """Writes a WAV or FLAC file, which is complete or not there.

    Parameters
    ----------
    path : path
        Where; the extension, .wav or .flac, decides the format.
    sound : array of float32 or float64, (frames,) or (channels, frames)
        Full scale is 1.
    sample_rate : float
        2000 to 768000 Hz.
    axis : int, default -1
        Axis of the frames.
    encoding : str, default "float32"
        ``"float32"`` (WAV only), ``"pcm24"`` or ``"pcm16"``.
    overwrite : bool, optional
        None replaces only what ``pacini`` rendered and nobody changed since: any other sound may be a recording. True
        replaces every file, False none.

    Returns
    -------
    int
        Number of samples beyond full scale, which were clipped.

    Raises
    ------
    Error
        The file exists and is not replaced, or cannot be written.
    """
    return _native.write_audio(os.fsdecode(path), as_sound(sound, axis), as_rate(sample_rate), encoding, overwrite)


@checked
def convert(
    path: PathLike,
    output: PathLike,
    *,
    format: Optional[str] = None,
    quantise: Optional[int] = None,
    overwrite: Optional[bool] = None,
    **options: Unpack[ExportOptions],
) -> list[Loss]:
    """Converts a clip file to another format.

    Parameters
    ----------
    path : path
        A clip of any format that is read.
    output : path
        Where.
    format, quantise, overwrite, **options
        As of :meth:`Clip.save`.

    Returns
    -------
    list of Loss
        What the format loses or changes.

    Raises
    ------
    Error
        The clip cannot be read or written.
    """
    check_names("convert", options, EXPORT)
    clip = Clip.load(path)
    if os.path.exists(output) and os.path.samefile(path, output):
        raise Error("is also the input; choose another output", os.fsdecode(output), "io")
    return clip.save(output, format=format, quantise=quantise, overwrite=overwrite, **options)


@checked
def lint(content: Union[Clip, PathLike], format: str, **options: Unpack[ExportOptions]) -> list[Loss]:
    """States what a clip would lose in a format, without writing it.

    Parameters
    ----------
    content : Clip or path
        The clip.
    format : str
        Name of one of :func:`formats`.
    **options
        As of :meth:`Clip.save`.

    Returns
    -------
    list of Loss
    """
    if not isinstance(content, Clip) and not is_path(content):
        wrong("must be a Clip or a file", "content", content)
    clip = content if isinstance(content, Clip) else Clip.load(content)
    return clip.lint(format, **options)


@checked
def read(path: PathLike) -> Union[Clip, Scene]:
    """Reads a clip of any format, or a scene.

    Parameters
    ----------
    path : path
        The file.

    Returns
    -------
    Clip or Scene

    Raises
    ------
    Error
        The file is neither, or cannot be read.
    """
    try:
        with open(path, "rb") as file:
            start = file.read(4096)
    except OSError:
        return Clip.load(path)  # which says what is wrong with it
    return Scene.load(path) if b'"pacini.scene"' in start else Clip.load(path)
