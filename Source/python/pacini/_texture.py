"""Textures: models of a surface, a river or an engine that are played by speed and force."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._arguments import checked, wrong
from ._arrays import PathLike, as_rate, as_sound, is_path
from ._document import JsonDocument, json_of
from ._errors import ArgumentError, Error
from ._parameters import TEXTURE, checked_options
from ._profile import AnyProfile, as_profile
from ._progress import Progress, shown
from ._warnings import warn_of

if TYPE_CHECKING:
    from ._sound import Sound

Course = Union[float, npt.ArrayLike]


class Texture(JsonDocument):
    """What a hand feels of a surface, or a seat of an engine, by speed and force.

    A texture never changes, and never repeats when it is played. :meth:`of_recording` makes one, :meth:`load` reads
    one, :meth:`render` plays it. It is noise whose spectrum follows the speed, and tones in proportion to it.

    >>> engine = pacini.Texture.of_recording("engine.wav", times=t, speed=rpm)
    >>> drive = engine.render([0.2, 0.9, 0.4], times=[0, 2, 3], profile="l5-wristband")
    """

    __slots__ = ()

    _handle: _native.TextureHandle

    @checked
    def __init__(self) -> None:
        raise ArgumentError("Texture() makes none; take Texture.of_recording(), load() or from_dict()")

    @classmethod
    @checked
    def of_recording(
        cls,
        sound: Sound,
        sample_rate: Optional[float] = None,
        *,
        speed: Course = (),
        force: Course = (),
        times: npt.ArrayLike = (),
        name: Optional[str] = None,
        axis: int = -1,
        **options: Any,
    ) -> Texture:
        """Makes a texture of a recording, as ``pacini texture analyse`` does.

        Parameters
        ----------
        sound : path or array
            Of an accelerometer or a microphone; channels are averaged.
        sample_rate : float, optional
            Hz, for arrays.
        speed, force : array_like, optional
            Any units, 0 or more: at each of `times`, or evenly over the recording [one speed throughout].
        times : array_like, optional
            When, s.
        name : str, optional
            Its name [that of the file].
        axis : int, default -1
            The axis of the frames in an array.
        **options
            ``order``, ``pitch``, ``tones``, ``recorded_speed``, ``full_speed``, ``full_force``, as of the command.

        Raises
        ------
        Error
            The recording is too short, silent or never moves; an option is out of its range.
        """
        options = checked_options("of_recording", options, TEXTURE)
        if is_path(sound):
            from ._sound import read_audio  # which knows scenes, and those textures

            if name is None:
                name = os.path.splitext(os.path.basename(os.fsdecode(sound)))[0]
            samples, rate = read_audio(sound)
        else:
            samples, rate = as_sound(sound, axis), as_rate(sample_rate)
        length = samples.shape[-1] / rate
        speeds = _values(speed, "speed")
        forces = _values(force, "force")
        if len(forces) and not len(speeds):
            speeds = np.ones(len(forces))
        moments = _moments(times, len(speeds), length)
        if len(forces) not in (0, len(speeds)):
            raise Error(f"must have as many values as the speed, {len(speeds)}", "force")
        handle, about = _native.analyse_texture(
            samples, int(rate), moments.tolist(), speeds.tolist(), forces.tolist(), name or "", options
        )
        for doubt in about["warnings"]:
            warnings.warn(doubt, stacklevel=2)
        return cls._of(handle)

    @classmethod
    @checked
    def load(cls, path: PathLike, *, strict: bool = False) -> Texture:
        """Reads a texture file.

        Parameters
        ----------
        path : path
            The file.
        strict : bool, default False
            Refuse unknown keys instead of warning of them.

        Raises
        ------
        Error
            It cannot be read.
        """
        handle, passed = _native.TextureHandle.read(os.fsdecode(path), strict)
        warn_of(path, passed)
        return cls._of(handle)

    @classmethod
    @checked
    def from_dict(cls, content: dict[str, Any]) -> Texture:
        """Returns the texture of a dictionary, as :meth:`to_dict` returns it and texture files contain it."""
        return cls._of(_native.TextureHandle.from_json(json_of(content, "texture")))

    @property
    def name(self) -> str:
        return str(self.to_dict().get("name", ""))

    @property
    def full_speed(self) -> float:
        """The speed that counts as 1, in the unit of the recording."""
        return float(self.to_dict()["fullSpeed"])

    @property
    def full_force(self) -> float:
        """The force that counts as 1, likewise."""
        return float(self.to_dict()["fullForce"])

    @checked
    def render(
        self,
        speed: Course,
        force: Course = 1.0,
        *,
        times: npt.ArrayLike = (),
        duration: Optional[float] = None,
        sample_rate: float = 48000,
        profile: Optional[AnyProfile] = None,
        gain: float = 0.0,
        seed: int = 1,
        progress: Progress = None,
    ) -> npt.NDArray[np.float32]:
        """Plays the texture by speed and force.

        Parameters
        ----------
        speed, force : float or array_like
            0 to 1; beyond that they are limited, NaN is 0. At each of `times`, which straight lines join; without
            `times` an array has one value for each frame of the output.
        times : array_like, optional
            When, s, ascending.
        duration : float, optional
            Length, s [until the last value of the speed].
        sample_rate : float, default 48000
            Of the output, Hz.
        profile : Profile, str or path, optional
            The actuator that the drive is for; without it the drive is flat.
        gain : float, default 0
            dB; the drive stays within full drive and the limits of the profile.
        seed : int, default 1
            Of the noise: the same arguments give the same samples.
        progress : callable, optional
            Takes the share that is done, 0 to 1.

        Returns
        -------
        array of float32, (frames,)
            The drive signal.

        Raises
        ------
        Error
            The profile is a motor, a value is out of its range, or the length is not known.
        """
        rate = as_rate(sample_rate)
        fixed = _values(times, "times")
        speeds = _values(speed, "speed")
        forces = _values(force, "force")
        if np.any(np.diff(fixed) < 0):
            raise Error("must ascend", "times")
        frames = len(speeds) if np.ndim(speed) == 1 and not len(fixed) else None
        if duration is None and frames is not None:
            duration = frames / rate
        curves = []
        for where, given, values in (("speed", speed, speeds), ("force", force, forces)):
            if np.ndim(given) == 0:
                moments = np.zeros(1)
            elif len(fixed):
                if len(fixed) != len(values):
                    raise Error(f"must have as many values as times, {len(fixed)}", where)
                moments = fixed
            else:
                moments = np.arange(len(values)) / rate
            curves.append((moments.tolist(), np.nan_to_num(values, nan=0.0, posinf=1.0, neginf=0.0).tolist()))
        options = {"sample_rate": rate, "gain": gain, "duration": duration}
        handle = None if profile is None else as_profile(profile)._handle
        with shown(progress, "rendering") as tell:
            return np.asarray(self._handle.render(curves[0], curves[1], handle, seed, options, tell), np.float32)

    def __repr__(self) -> str:
        content = self.to_dict()
        tones = len(content.get("tones", []))
        return f"<pacini.Texture {self.name!r}: {len(content['nodes'])} speeds, {tones} tones>"


def _values(given: Course, where: str) -> npt.NDArray[np.float64]:
    try:
        values = np.atleast_1d(np.asarray(given))
    except (TypeError, ValueError):
        values = np.empty(1, object)
    if values.size and values.dtype.kind not in "fiu":
        wrong("must be a number or an array of numbers", where, given)
    values = values.astype(np.float64)
    if values.ndim != 1:
        raise Error(f"has {values.ndim} dimensions; give one", where)
    return values


def _moments(times: npt.ArrayLike, count: int, length: float) -> npt.NDArray[np.float64]:
    moments = _values(times, "times")
    if not len(moments):
        return np.linspace(0.0, length, count) if count > 1 else np.zeros(count)
    if len(moments) != count:
        raise Error(f"must have as many values as the speed, {count}", "times")
    if np.any(np.diff(moments) < 0):
        raise Error("must ascend", "times")
    return moments
