"""From sounds to clips, from clips to signals, and how close they are."""

from __future__ import annotations

import json
import os
import threading
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._arrays import FloatArray, PathLike, as_rate, as_sound, is_path
from ._clip import Clip
from ._errors import Error
from ._files import text_of
from ._parameters import ENCODE, check_names, unknown, with_keywords
from ._profile import AnyProfile, as_profile
from ._progress import Progress, counted, shown
from ._scene import Scene

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import EncodeOptions

Sound = Union[PathLike, FloatArray, Sequence[float]]
AnySettings = Union[PathLike, Mapping[str, Any]]


@dataclass(frozen=True)
class Method:
    """A translation method; `output` is clip or signal."""

    name: str
    output: str
    description: str


def methods() -> list[Method]:
    """The translation methods: Pacini's own, a2vt, and those that it can be compared with."""
    return [Method(*entry) for entry in _native.methods()]


class Preset(NamedTuple):
    """Options of :func:`encode` for a kind of sound."""

    name: str
    purpose: str


def presets() -> list[Preset]:
    """The presets of :func:`encode`; the first is the default."""
    return [Preset(*entry) for entry in _native.presets()]


class _Wanted(NamedTuple):
    """How sounds are encoded: what the native encoder is made of."""

    method: str
    preset: str
    options: dict[str, Any]
    settings: str
    allow_nan: bool
    allow_truncated: bool


def _settings_text(settings: Optional[AnySettings]) -> str:
    if settings is None:
        return ""
    if not is_path(settings):
        return json.dumps(settings)
    return text_of(settings)


def check_options(options: dict[str, Any]) -> None:
    """Raises what :func:`encode` would raise of every sound: for many of them this is known before the first."""
    own = {"method": "", "preset": "", "settings": None, "allow_nan": False, "allow_truncated": False}
    given = {name: value for name, value in options.items() if name not in own and value is not None}
    if found := unknown(given, ENCODE):
        raise Error(f"is no option of pacini.encode(){found[1]}", found[0])
    chosen = {**own, **{name: value for name, value in options.items() if name in own and value is not None}}
    _native.EncoderHandle(
        str(chosen["method"]), str(chosen["preset"]), given, _settings_text(chosen["settings"]),
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
                warnings.warn(f"settings: {doubt}", stacklevel=5)
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
        for doubt in handle.sound_doubts:
            warnings.warn(f"{os.fsdecode(sound)}: {doubt}", stacklevel=4)
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
    """The clip of a sound: a file, or samples as (frames,) or (channels, frames) with their rate in Hz.

    `axis` is the one that the frames of an array are on. float32 samples that lie in memory frame by frame (one
    channel, or (frames, channels) in C order with ``axis=0``) are read where they are; others are converted piece by
    piece. `settings` is a file as of ``pacini encode --print-settings``, or its object; `method` (a2vt), `preset` (one
    of :func:`presets`) and the other options, those of ``pacini encode``, come before it, and options before the
    preset. None is the method's own. `name` and `source` (a file name) go
    into clips of arrays. The interpreter's lock is free meanwhile; `progress` is True for a bar of tqdm, or a function
    of the share that is done. Raises :class:`pacini.Error`.
    """
    given = {name: value for name, value in options.items() if value is not None}
    check_names("encode", given, ENCODE)
    wanted = _Wanted(method or "", preset or "", given, _settings_text(settings), allow_nan, allow_truncated)
    return Clip._of(_translated(sound, sample_rate, axis, name, source, progress, "clip", wanted))


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
    """The drive signal that a method makes of a sound, and its rate: for methods that make no clip, see
    :func:`methods`. The sound is given as to :func:`encode`."""
    wanted = _Wanted(method, "", {}, "", allow_nan, allow_truncated)
    signal, rate = _translated(sound, sample_rate, axis, "", "", progress, "signal", wanted)
    return signal, rate


def encode_files(
    paths: Union[PathLike, Iterable[PathLike]],
    *,
    threads: Optional[int] = None,
    progress: Progress = None,
    **options: Any,
) -> Iterator[tuple[PathLike, Union[Clip, Error]]]:
    """Encodes many files, or one, on several threads, and yields each path as it was given with its clip, or with what
    is wrong with it, as they get ready. Options are those of :func:`encode`; what is wrong with them is raised at
    once."""
    check_options(options)
    todo: list[PathLike] = [paths] if is_path(paths) else list(paths)
    workers = threads if threads is not None else os.cpu_count() or 1
    over = threading.Event()

    def go_on(share: float) -> None:
        if over.is_set():
            raise InterruptedError

    def one(path: PathLike) -> Union[Clip, Error]:
        try:
            return encode(path, progress=go_on, **options)
        except Error as error:
            return error

    def results() -> Iterator[tuple[PathLike, Union[Clip, Error]]]:
        with ThreadPoolExecutor(workers) as pool:
            running: dict[Future[Union[Clip, Error]], PathLike] = {}
            waiting = iter(todo)
            try:
                while True:
                    while len(running) < 2 * workers:
                        try:
                            path = next(waiting)
                        except StopIteration:
                            break
                        running[pool.submit(one, path)] = path
                    if not running:
                        return
                    done, _ = wait(running, return_when=FIRST_COMPLETED)
                    for future in done:
                        yield running.pop(future), future.result()
            finally:
                over.set()
                pool.shutdown(wait=False, cancel_futures=True)

    return counted(results(), len(todo), progress, "encoding")


@dataclass(frozen=True)
class RenderReport:
    """What was done to play a clip or a scene. `reduction` is the most (dB) that was taken to keep within the limits of
    the actuator, `predicted_error` what leaving things out costs (dB below the whole)."""

    reduction: float
    predicted_error: float
    adaptations: list[tuple[str, str]]
    left_out: list[tuple[str, str, float]]


def _rendered(
    content: Union[Clip, Scene],
    options: _native.RenderOptions,
    dtype: npt.DTypeLike,
    progress: Progress,
) -> tuple[FloatArray, RenderReport]:
    wanted = np.dtype(dtype)
    if wanted not in (np.float32, np.float64):
        raise Error("must be float32 or float64", "dtype")
    with shown(progress, "rendering") as tell:
        if isinstance(content, Clip):
            made = _native.render_clip(content._handle, options, tell)
        elif isinstance(content, Scene):
            made = _native.render_scene(content._handle, options, tell)
        else:
            raise Error("must be a Clip or a Scene", "content")
    samples, reduction, error, adaptations, left_out = made
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


def render(
    content: Union[Clip, Scene],
    sample_rate: float = 48000,
    *,
    profile: Optional[AnyProfile] = None,
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
    """The drive signal of a clip as (frames,), or of a scene as (actuators, frames); (frames,) for one actuator.

    `profile` is the actuator that plays it, or its name. The other parameters are the options of ``pacini render``;
    `gain` is in dB, `transpose` in semitones, times are in s.
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
    return _rendered(content, options, dtype, progress)[0]


def explain(
    content: Union[Clip, Scene],
    sample_rate: float = 48000,
    *,
    profile: Optional[AnyProfile] = None,
    tolerance: float = -60.0,
    strength: float = _native.STANDARD_STRENGTH,
    gain: float = 0.0,
) -> RenderReport:
    """What :func:`render` does to play it: what is fitted to the actuator, and what is left out."""
    options = _render_options(profile, sample_rate, gain=gain, tolerance=tolerance, strength=strength)
    return _rendered(content, options, np.float32, None)[1]


def felt(
    content: Union[Clip, Scene],
    sample_rate: float = 48000,
    *,
    profile: AnyProfile,
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
    """The acceleration of the skin that the profile's model of the body predicts, as :func:`render` has it: 1 is
    `full_scale` m/s^2. `wearer` is 0 as in the profile, or 1 to 14, simulated people."""
    options = _render_options(profile, sample_rate, protect=protect, gain=gain, start=start, end=end, strength=strength)
    options.feel({"wearer": wearer, "full_scale": full_scale})
    return _rendered(content, options, dtype, progress)[0]


@dataclass(frozen=True)
class Comparison:
    """How much of a sound a haptic signal keeps. None is what says nothing, such as of a silent reference.

    `match` is how well people would say that it matches, 0 to 100, `match_of_sound` that of the sound itself; `hts` the
    haptic translation similarity, `ceiling` that of the sound itself, `hts_f` what is felt on both sides; `lsd` the
    log-spectral distance in dB; SNRs of envelopes in dB, 60 is equal; centroid errors in %; `f1` the events within 25
    ms. `values` has all of ``pacini compare --json``.
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
        """What people would say of its strength, tempo and roughness."""
        impression: dict[str, Any] = self.values["impression"]
        return impression

    def __repr__(self) -> str:
        match = "-" if self.match is None else f"{self.match:.1f}"
        return f"<pacini.Comparison match {match}, HTS {self.hts:.1f} of {self.ceiling:.1f}>"


def _read_samples(path: PathLike, *allowed: bool) -> tuple[Any, int]:
    """(frames, channels) of a file and its rate; what the reader lets pass of it is a warning."""
    samples, rate, doubts = _native.read_audio(os.fsdecode(path), *allowed)
    for doubt in doubts:
        warnings.warn(f"{os.fsdecode(path)}: {doubt}", stacklevel=4)
    return samples, rate


def _read_for_comparison(
    sound: Sound, rate: Optional[float], axis: int, where: str, allow_truncated: bool
) -> tuple[Any, int]:
    if is_path(sound):
        samples, own = _read_samples(sound, False, allow_truncated, True)
        return samples.T, own
    return as_sound(sound, axis), as_rate(rate, where)


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
    """Measures how much of `reference`, a sound, is in `candidate`, a signal to be felt.

    Both are files, or samples as :func:`encode` takes them at `sample_rate` (`candidate_rate` where the other's is not
    the same); a clip or a scene is rendered as it is. `onsets` are when events of the sound are known to happen in s,
    `events` those of the candidate (else they are found in it), `ambiguous` ones count neither way. Samples that are
    no numbers or far beyond full scale are errors, or with `allow_nan` silence, and so are those around them that they
    reach through filters; :attr:`Comparison.not_finite` tells how many there are.
    """
    source, source_rate = _read_for_comparison(reference, sample_rate, axis, "sample_rate", allow_truncated)
    if isinstance(candidate, (Clip, Scene)):
        rate = as_rate(48000 if candidate_rate is None else candidate_rate, "candidate_rate")
        target, target_rate = render(candidate, rate), rate
    else:
        target, target_rate = _read_for_comparison(
            candidate,
            candidate_rate if candidate_rate is not None else sample_rate,
            axis,
            "candidate_rate",
            allow_truncated,
        )
    return Comparison(
        _native.compare(
            source,
            source_rate,
            target,
            target_rate,
            None if onsets is None else [float(t) for t in onsets],
            None if events is None else [float(t) for t in events],
            [float(t) for t in ambiguous],
            allow_nan,
        )
    )


def read_audio(
    path: PathLike, *, allow_nan: bool = False, allow_truncated: bool = False
) -> tuple[npt.NDArray[np.float32], int]:
    """The samples of an audio file as (frames,) or (channels, frames), full scale 1, and its rate in Hz."""
    samples, rate = _read_samples(path, allow_nan, allow_truncated, False)
    return (samples[:, 0] if samples.shape[1] == 1 else samples.T), rate


def write_audio(
    path: PathLike,
    sound: FloatArray,
    sample_rate: float,
    *,
    axis: int = -1,
    encoding: str = "float32",
    overwrite: Optional[bool] = None,
) -> int:
    """Writes a WAV or FLAC file (float32, pcm24 or pcm16) that is complete or not there. Returns how many samples were
    beyond full scale and clipped.

    A sound that is there may be a recording: it is replaced only if `overwrite` is True, or if ``pacini`` marked it as
    rendered and nobody changed it since; with False nothing is replaced."""
    return _native.write_audio(os.fsdecode(path), as_sound(sound, axis), as_rate(sample_rate), encoding, overwrite)


def convert(path: PathLike, output: PathLike, **options: Any) -> list[Any]:
    """Reads a clip of any format and writes it to another; returns what that loses. Options as of
    :meth:`Clip.save`."""
    clip = Clip.load(path)
    if os.path.exists(output) and os.path.samefile(path, output):
        raise Error("is both input and output; name another output", os.fsdecode(output), "io")
    return clip.save(output, **options)


def lint(content: Union[Clip, PathLike], format: str, **options: Any) -> list[Any]:
    """What a clip would lose in a format."""
    clip = content if isinstance(content, Clip) else Clip.load(content)
    return clip.lint(format, **options)


def read(path: PathLike) -> Union[Clip, Scene]:
    """A clip of any format, or a scene."""
    try:
        with open(path, "rb") as file:
            start = file.read(4096)
    except OSError:
        return Clip.load(path)  # which says what is wrong with it
    return Scene.load(path) if b'"pacini.scene"' in start else Clip.load(path)
