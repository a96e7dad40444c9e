"""Actuator profiles."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._arguments import checked, numbers, wrong
from ._arrays import PathLike, is_path
from ._document import JsonDocument, json_of
from ._warnings import warn_of


class Profile(JsonDocument):
    """An actuator: what it can do, what it bears, and the equaliser that flattens it. A profile never changes.

    Parameters
    ----------
    name_or_path : str or path
        A shipped profile, see :meth:`names`, or a file.
    strict : bool, default False
        Refuse unknown keys instead of warning of them.

    Raises
    ------
    Error
        There is no such profile, or the file is not valid.

    Examples
    --------
    >>> pacini.render(clip, profile=pacini.Profile("l5-wristband"))
    """

    __slots__ = ()

    _handle: _native.ProfileHandle

    @checked
    def __init__(self, name_or_path: PathLike, *, strict: bool = False) -> None:
        text = os.fsdecode(name_or_path)
        if os.path.exists(text):
            self._handle, passed = _native.ProfileHandle.read(text, strict)
            warn_of(text, passed)
        else:
            self._handle = _native.ProfileHandle.shipped(text)

    @staticmethod
    @checked
    def names() -> list[str]:
        """The profiles that come with Pacini."""
        return _native.profile_names()

    @classmethod
    @checked
    def from_dict(cls, content: dict[str, Any]) -> Profile:
        """Returns the profile of a dictionary, as :meth:`to_dict` returns it and profile files contain it."""
        return cls._of(_native.ProfileHandle.from_json(json_of(content, "profile")))

    @property
    def name(self) -> str:
        return self._handle.name

    @property
    def measured(self) -> npt.NDArray[np.void]:
        """The response that was measured, with the fields frequency (Hz) and level (dB); empty without one."""
        frequency, level = _native.measured_response(self._handle)
        points = np.empty(len(frequency), [("frequency", np.float64), ("level", np.float64)])
        points["frequency"], points["level"] = frequency, level
        return points

    @checked
    def equalizer_response(
        self, frequencies: Sequence[float] | npt.NDArray[np.float64], sample_rate: float = 48000.0
    ) -> npt.NDArray[np.float64]:
        """Level of the profile's equaliser.

        Parameters
        ----------
        frequencies : array_like
            Hz, 0 to half the rate.
        sample_rate : float, default 48000
            Hz.

        Returns
        -------
        array of float64
            dB.
        """
        return _native_array(
            self._handle.equalizer_response(numbers(np.ravel(frequencies), "frequencies"), sample_rate)
        )

    def __hash__(self) -> int:
        return hash(self._handle.to_json())

    def __repr__(self) -> str:
        content = self.to_dict()
        return f"<pacini.Profile {self.name!r}: {content['technology']}, {content['resonance']['frequency']:g} Hz>"


def _native_array(array: Any) -> npt.NDArray[np.float64]:
    return np.asarray(array, np.float64)


AnyProfile = Union[Profile, PathLike]


def as_profile(profile: object, where: str = "profile") -> Profile:
    """A profile, or the one of this name or path."""
    if isinstance(profile, Profile):
        return profile
    if is_path(profile):
        return Profile(profile)
    wrong("must be a Profile, the name of one, or a file", where, profile)
