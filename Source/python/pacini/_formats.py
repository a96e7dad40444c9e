"""Clip files of all formats: the list of formats, and the losses of each."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Optional

from . import _native
from ._arguments import checked
from ._arrays import PathLike
from ._errors import Error
from ._parameters import EXPORT, checked_options


@dataclass(frozen=True)
class Format:
    """A format of clips.

    Attributes
    ----------
    name, extension, title : str
        What it is called here, in file names, and by people.
    is_read, is_written : bool
        Whether Pacini reads and writes it.
    keeps : str
        What it can hold.
    """

    name: str
    extension: str
    title: str
    is_read: bool
    is_written: bool
    keeps: str


@dataclass(frozen=True)
class Loss:
    """What a format loses or changes of a clip in one place.

    Attributes
    ----------
    kind : str
        Such as ``"pitch"``.
    time, duration : float
        Where, s.
    error : float
        How much, in the unit that the message names.
    message : str
        A sentence.
    """

    kind: str
    time: float
    duration: float
    error: float
    message: str


@checked
def formats() -> list[Format]:
    """All formats of clips, Pacini's own first.

    Returns
    -------
    list of Format
    """
    return [Format(*entry) for entry in _native.formats()]


def losses_of(entries: Sequence[tuple[str, float, float, float, str]]) -> list[Loss]:
    return [Loss(*entry) for entry in entries]


def format_for(path: PathLike, format: Optional[str]) -> str:
    """The format to write to a file, by its extension unless it is named."""
    if format is not None:
        return format
    extension = os.path.splitext(os.fsdecode(path))[1].lower()
    found = _native.format_written_to(extension)
    if found is None:
        raise Error(f"{os.fsdecode(path)} has the extension of no format that is written; say which", "format")
    return found


def export_options(function: str, options: Mapping[str, Any]) -> _native.ExportOptions:
    """Options of formats, those of ``pacini convert``, and `profile`."""
    given = checked_options(function, options, EXPORT)
    profile = given.pop("profile", None)
    if profile is None:
        return _native.ExportOptions(given, None)
    from ._profile import as_profile

    return _native.ExportOptions(given, as_profile(profile)._handle)
