"""Haptic clips."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._arguments import checked, checked_class, listed, number, text, whole, wrong
from ._arrays import AMPLITUDE, FREQUENCY, TRANSIENT, PathLike, Points, as_points, points_of, rows_of
from ._document import Document, json_of
from ._errors import ArgumentError, Error
from ._formats import Loss, export_options, format_for, losses_of
from ._simplify import points
from ._warnings import warn, warn_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from typing_extensions import Unpack

    from ._options import ExportOptions


def _no_points(dtype: np.dtype[np.void]) -> Any:
    return field(default_factory=lambda: np.empty(0, dtype))


@checked_class
@dataclass(frozen=True, eq=False)
class Band:
    """A frequency band of a clip. A changed one is ``dataclasses.replace(band, amplitude=...)``.

    Parameters
    ----------
    low, centre, high : float
        Its edges and its centre, Hz.
    priority : int, default 0
        Bands of priority 0 are kept longest when an actuator has too few voices.
    amplitude : array_like of (time, amplitude), optional
        Amplitude over time; s, 1 is full drive.
    pitch : array_like of (time, frequency), optional
        Pitch over time; s, Hz.
    phase : float, default 0
        Phase of the carrier at the start, cycles, 0 to 1: 0 is a sine, 0.25 a cosine.
    """

    low: float
    centre: float
    high: float
    priority: int = 0
    amplitude: Points = _no_points(AMPLITUDE)
    pitch: Points = _no_points(FREQUENCY)
    phase: float = 0.0

    if TYPE_CHECKING:  # more is taken than is kept

        def __init__(
            self,
            low: float,
            centre: float,
            high: float,
            priority: int = 0,
            amplitude: npt.ArrayLike = ...,
            pitch: npt.ArrayLike = ...,
            phase: float = 0.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "amplitude", as_points(self.amplitude, AMPLITUDE, "amplitude"))
        object.__setattr__(self, "pitch", as_points(self.pitch, FREQUENCY, "pitch"))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Band):
            return NotImplemented
        return (
            (self.low, self.centre, self.high, self.priority, self.phase)
            == (other.low, other.centre, other.high, other.priority, other.phase)
            and np.array_equal(rows_of(self.amplitude, AMPLITUDE, ""), rows_of(other.amplitude, AMPLITUDE, ""))
            and np.array_equal(rows_of(self.pitch, FREQUENCY, ""), rows_of(other.pitch, FREQUENCY, ""))
        )


@checked_class
@dataclass(frozen=True, eq=False)
class NoiseBand:
    """A band of residual noise.

    Parameters
    ----------
    low, high : float
        Its edges, Hz.
    amplitude : array_like of (time, amplitude), optional
        RMS amplitude over time; s, 1 is full drive.
    """

    low: float
    high: float
    amplitude: Points = _no_points(AMPLITUDE)

    if TYPE_CHECKING:

        def __init__(self, low: float, high: float, amplitude: npt.ArrayLike = ...) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "amplitude", as_points(self.amplitude, AMPLITUDE, "amplitude"))


@checked_class
@dataclass(frozen=True)
class Source:
    """The sound that a clip was made from.

    Attributes
    ----------
    file : str
        Its name; empty where unknown.
    sample_rate : float
        Hz; 0 where unknown.
    channels : int
        0 where unknown.
    """

    file: str = ""
    sample_rate: float = 0.0
    channels: int = 0


@dataclass(frozen=True)
class SimplifiedLane:
    """What simplification did to one curve.

    Attributes
    ----------
    kind : str
        Such as ``"amplitude"``.
    band : int
        Index of its band.
    before, after : int
        Number of points.
    rms_error, max_error : float
        In the unit of the curve.
    """

    kind: str
    band: int
    before: int
    after: int
    rms_error: float
    max_error: float


EncoderValue = Union[bool, float, str]


class Clip(Document):
    """What a sound feels like, as a few curves and events.

    Curves are structured arrays of the fields time and amplitude or frequency, transients of time, amplitude and
    sharpness. What comes out looks into the clip without a copy and cannot be written to; change a copy and set it::

        envelope = clip.envelope.copy()
        envelope["amplitude"] *= 0.5
        clip.envelope = envelope

    Times are in s, frequencies in Hz, amplitudes linear with 1 as full drive. What is set is checked: a clip is always
    valid.

    Parameters
    ----------
    duration : float
        Length, s.
    bands : iterable of Band, optional
        Its bands, at most 32.
    name : str, optional
        Its name.
    envelope : array_like of (time, amplitude), optional
        Total amplitude, to which the sum of the bands is levelled; empty leaves the bands as they are.
    centroid : array_like of (time, frequency), optional
        Spectral centroid, Hz.
    transients : array_like of (time, amplitude, sharpness), optional
        Events; sharpness is 0 (dull) to 1 (crisp).
    noise : iterable of NoiseBand, optional
        Residual noise.
    markers : iterable of (time, name), optional
        Named points of time.
    source : Source, optional
        The sound that it was made from.

    Raises
    ------
    Error
        A value is out of its range; the error names it.
    """

    __slots__ = ()

    _handle: _native.ClipHandle

    @checked
    def __init__(
        self,
        duration: float,
        bands: Iterable[Band] = (),
        *,
        name: str = "",
        envelope: object = (),
        centroid: object = (),
        transients: object = (),
        noise: Iterable[NoiseBand] = (),
        markers: Iterable[tuple[float, str]] = (),
        source: Source = Source(),
    ) -> None:
        self._handle = _native.ClipHandle(number(duration, "duration"))
        self._edit(
            name=name,
            source=_source_tuple(source),
            envelope=rows_of(envelope, AMPLITUDE, "envelope"),
            centroid=rows_of(centroid, FREQUENCY, "centroid"),
            bands=_band_tuples(bands),
            noise=_noise_tuples(noise),
            transients=rows_of(transients, TRANSIENT, "transients"),
            markers=_marker_tuples(markers),
        )

    def _edit(self, **changes: Any) -> None:
        self._handle = self._handle.edited(**changes)

    # What it holds.

    @property
    def name(self) -> str:
        return self._handle.name

    @name.setter
    def name(self, value: str) -> None:
        self._edit(name=text(value, "name"))

    @property
    def duration(self) -> float:
        """Length in s."""
        return self._handle.duration

    @duration.setter
    def duration(self, value: float) -> None:
        self._edit(duration=number(value, "duration"))

    @property
    def source(self) -> Source:
        """The sound that it was made from."""
        return Source(*self._handle.source)

    @source.setter
    def source(self, value: Source) -> None:
        self._edit(source=_source_tuple(value))

    @property
    def encoder(self) -> dict[str, EncoderValue]:
        """The parameters of the encoder that made it."""
        return dict(self._handle.encoder)

    @property
    def envelope(self) -> Points:
        """Total amplitude, to which the sum of the bands is levelled where it is not empty."""
        return points_of(self._handle.envelope, AMPLITUDE)

    @envelope.setter
    def envelope(self, points: object) -> None:
        self._edit(envelope=rows_of(points, AMPLITUDE, "envelope"))

    @property
    def centroid(self) -> Points:
        """Spectral centroid."""
        return points_of(self._handle.centroid, FREQUENCY)

    @centroid.setter
    def centroid(self, points: object) -> None:
        self._edit(centroid=rows_of(points, FREQUENCY, "centroid"))

    @property
    def bands(self) -> tuple[Band, ...]:
        return tuple(
            Band(low, centre, high, priority, points_of(amplitude, AMPLITUDE), points_of(pitch, FREQUENCY), phase)
            for low, centre, high, priority, amplitude, pitch, phase in self._handle.bands
        )

    @bands.setter
    def bands(self, bands: Iterable[Band]) -> None:
        self._edit(bands=_band_tuples(bands))

    @property
    def noise(self) -> tuple[NoiseBand, ...]:
        return tuple(NoiseBand(low, high, points_of(a, AMPLITUDE)) for low, high, a in self._handle.noise)

    @noise.setter
    def noise(self, noise: Iterable[NoiseBand]) -> None:
        self._edit(noise=_noise_tuples(noise))

    @property
    def transients(self) -> Points:
        """Short events: when, how strong, and how sharp they feel, 0 to 1."""
        return points_of(self._handle.transients, TRANSIENT)

    @transients.setter
    def transients(self, points: object) -> None:
        self._edit(transients=rows_of(points, TRANSIENT, "transients"))

    @property
    def markers(self) -> list[tuple[float, str]]:
        """Named points of time."""
        return list(self._handle.markers)

    @markers.setter
    def markers(self, markers: Iterable[tuple[float, str]]) -> None:
        self._edit(markers=_marker_tuples(markers))

    @property
    def breakpoints(self) -> int:
        """Number of points of all curves."""
        return self._handle.breakpoints

    # Edits, each a new clip.

    @checked
    def copy(self) -> Clip:
        return Clip._of(self._handle)

    __copy__ = copy

    def __deepcopy__(self, memo: object) -> Clip:
        return Clip._of(self._handle)

    @checked
    def trimmed(self, start: float = 0.0, end: Optional[float] = None) -> Clip:
        """Cuts out a part, whose time starts at 0.

        Parameters
        ----------
        start : float, default 0
            s.
        end : float, optional
            s [the end of the clip].

        Returns
        -------
        Clip
        """
        return Clip._of(self._handle.trimmed(start, self.duration if end is None else end))

    @checked
    def without(self, start: float, end: float) -> Clip:
        """The clip without the part from `start` to `end`, in s; what is behind moves up."""
        return Clip._of(self._handle.without(start, end))

    def __getitem__(self, times: slice) -> Clip:
        """``clip[0.2:1.5]`` is the part between these times in s; negative ones count from the end."""
        if not isinstance(times, slice) or times.step is not None:
            raise ArgumentError("a clip is sliced by times in s: clip[0.2:1.5]")
        start, end = (
            other if time is None else number(time, where) + (self.duration if time < 0 else 0.0)
            for time, other, where in ((times.start, 0.0, "start"), (times.stop, self.duration, "end"))
        )
        return self.trimmed(start, max(start, end))

    __iter__ = None  # slices are of times: there is nothing to go through

    def __add__(self, other: Clip) -> Clip:
        """The other clip behind this one."""
        return Clip._of(self._handle.joined(other._handle)) if isinstance(other, Clip) else NotImplemented

    def __mul__(self, passes: int) -> Clip:
        """The clip so many times, one after the other."""
        return Clip._of(self._handle.repeated(passes)) if isinstance(passes, int) else NotImplemented

    __rmul__ = __mul__

    @checked
    def inserted(self, time: float, part: Clip) -> Clip:
        """The clip with `part` inserted at `time`, in s; what is behind moves back."""
        if not isinstance(part, Clip):
            wrong("must be a Clip", "part", part)
        return Clip._of(self._handle.inserted(time, part._handle))

    @checked
    def reversed(self) -> Clip:
        """The clip backwards."""
        return Clip._of(self._handle.reversed())

    @checked
    def transposed(self, semitones: float) -> Clip:
        """Higher or lower by -96 to 96 semitones."""
        return Clip._of(self._handle.transposed(semitones))

    @checked
    def stretched(self, ratio: float) -> Clip:
        """Longer (2 is twice as long) at the same pitch, 0.01 to 100."""
        return Clip._of(self._handle.stretched(ratio))

    @checked
    def simplified(
        self,
        count: Optional[int] = None,
        error: Optional[float] = None,
        *,
        method: str = "lagrangian",
        refit: bool = False,
    ) -> Clip:
        """Simplifies every curve.

        Parameters
        ----------
        count, error, method, refit
            As of :func:`pacini.simplify`; `error` is in the unit of each curve.

        Returns
        -------
        Clip
        """
        return self.simplified_report(count, error, method=method, refit=refit)[0]

    @checked
    def simplified_report(
        self,
        count: Optional[int] = None,
        error: Optional[float] = None,
        *,
        method: str = "lagrangian",
        refit: bool = False,
    ) -> tuple[Clip, list[SimplifiedLane]]:
        """:meth:`simplified`, and what that cost on each curve.

        Returns
        -------
        clip : Clip
        lanes : list of SimplifiedLane
        """
        handle, lanes = self._handle.simplified(method, points(count), error, refit)
        return Clip._of(handle), [SimplifiedLane(*lane) for lane in lanes]

    # Files.

    @classmethod
    @checked
    def load(cls, path: PathLike, *, strict: bool = False) -> Clip:
        """Reads a clip of any format.

        Parameters
        ----------
        path : path
            The file; content and extension decide the format.
        strict : bool, default False
            Refuse unknown keys instead of warning of them.

        Returns
        -------
        Clip

        Raises
        ------
        Error
            The file cannot be read or is not a clip; :class:`FileMissing` where there is none.
        """
        handle, _, passed = _native.read_clip(os.fsdecode(path), strict)
        warn_of(path, passed)
        return cls._of(handle)

    @checked
    def save(
        self,
        path: PathLike,
        *,
        format: Optional[str] = None,
        quantise: Optional[int] = None,
        overwrite: Optional[bool] = None,
        **options: Unpack[ExportOptions],
    ) -> list[Loss]:
        """Writes the clip; the file is complete or not there.

        Parameters
        ----------
        path : path
            Where.
        format : str, optional
            Name of one of :func:`pacini.formats` [by the extension].
        quantise : int, optional
            Bits of each value, 4 to 16, for the packed format.
        overwrite : bool, optional
            None replaces a clip that is there and no other file. True replaces every file but the recording that the
            clip was made from, False none.
        **options
            Options of ``pacini convert``, such as ``points``, ``profile``, ``split`` and ``events``.

        Returns
        -------
        list of Loss
            What the format loses or changes.

        Raises
        ------
        Error
            The file is not replaced, or cannot be written.
        """
        name = format_for(path, format)
        _, losses = self._handle.save(
            os.fsdecode(path), name, export_options("save", options), quantise or 0, overwrite
        )
        return losses_of(losses)

    @checked
    def to_bytes(
        self, format: str = "packed", *, quantise: Optional[int] = None, **options: Unpack[ExportOptions]
    ) -> bytes:
        """The bytes of a file.

        Parameters
        ----------
        format : str, default "packed"
            Name of one of :func:`pacini.formats` that writes one file.
        quantise, **options
            As of :meth:`save`.
        """
        files, _ = self._handle.written(format, export_options("to_bytes", options), quantise or 0)
        if len(files) != 1:
            raise Error("makes several files; save it to a folder", "format")
        return files[0][1]

    @classmethod
    @checked
    def from_bytes(cls, data: bytes, *, extension: str = "", strict: bool = False) -> Clip:
        """Reads a clip from the bytes of a file.

        Parameters
        ----------
        data : bytes
            The file.
        extension : str, optional
            Its extension, with the dot; counts where the content does not tell the format.
        strict : bool, default False
            As of :meth:`load`.
        """
        handle, _, passed = _native.read_clip_bytes(data, extension, strict)
        for message in passed:
            warn(message)
        return cls._of(handle)

    @classmethod
    @checked
    def from_dict(cls, content: dict[str, Any]) -> Clip:
        """Returns the clip of a dictionary, as :meth:`to_dict` returns it."""
        return cls._of(_native.ClipHandle.from_json(json_of(content, "clip").encode()))

    @checked
    def lint(self, format: str, **options: Unpack[ExportOptions]) -> list[Loss]:
        """States what the clip would lose in a format; see :func:`pacini.lint`."""
        _, losses = self._handle.written(format, export_options("lint", options), 0)
        return losses_of(losses)

    # As an object of Python.

    def __repr__(self) -> str:
        name = f" {self.name!r}" if self.name else ""
        return (
            f"<pacini.Clip{name}: {self.duration:.3f} s, {len(self.bands)} bands, {self.breakpoints} breakpoints, "
            f"{len(self.transients)} transients>"
        )

    # To look at and listen to.

    def plot(self, ax: Optional[Axes] = None, **style: Any) -> Axes:
        """Draws the bands over time by their pitch, as wide as they are strong, with transients as stems; with
        matplotlib, into `ax` or a new figure."""
        from ._display import plot_clip

        return plot_clip(self, ax, **style)

    def _repr_svg_(self) -> str:
        from ._display import clip_svg

        return clip_svg(self)

    def _repr_html_(self) -> str:
        from ._display import clip_html

        return clip_html(self)


def _source_tuple(source: Source) -> tuple[str, float, int]:
    if not isinstance(source, Source):
        wrong("must be a Source", "source", source)
    return (
        text(source.file, "source.file"),
        number(source.sample_rate, "source.sample_rate"),
        whole(source.channels, "source.channels"),
    )


_Rows = npt.NDArray[np.float64]


def _band_tuples(bands: Iterable[Band]) -> list[tuple[float, float, float, int, _Rows, _Rows, float]]:
    tuples = []
    for i, band in enumerate(listed(bands, "bands")):
        if not isinstance(band, Band):
            wrong("must be a Band", f"bands[{i}]", band)
        if band.low > band.centre or band.centre > band.high:
            raise Error("needs low <= centre <= high", f"bands[{i}]", "invalidData")
        tuples.append(
            (
                float(band.low),
                float(band.centre),
                float(band.high),
                int(band.priority),
                rows_of(band.amplitude, AMPLITUDE, f"bands[{i}].amplitude"),
                rows_of(band.pitch, FREQUENCY, f"bands[{i}].pitch"),
                float(band.phase),
            )
        )
    return tuples


def _noise_tuples(noise: Iterable[NoiseBand]) -> list[tuple[float, float, _Rows]]:
    tuples = []
    for i, band in enumerate(listed(noise, "noise")):
        if not isinstance(band, NoiseBand):
            wrong("must be a NoiseBand", f"noise[{i}]", band)
        if band.low > band.high:
            raise Error("needs low <= high", f"noise[{i}]", "invalidData")
        tuples.append((float(band.low), float(band.high), rows_of(band.amplitude, AMPLITUDE, f"noise[{i}].amplitude")))
    return tuples


def _marker_tuples(markers: Iterable[Sequence[Any]]) -> list[tuple[float, str]]:
    tuples = []
    for i, marker in enumerate(listed(markers, "markers")):
        if not isinstance(marker, (tuple, list)) or len(marker) != 2:
            wrong("must be a pair of a time and a name", f"markers[{i}]", marker)
        tuples.append((number(marker[0], f"markers[{i}].time"), text(marker[1], f"markers[{i}].name")))
    return tuples
