"""Clip files of all formats: what there is, and what each of them loses."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Optional

from . import _native
from ._arrays import PathLike
from ._errors import Error


@dataclass(frozen=True)
class Format:
    """A format of clips."""

    name: str
    extension: str
    title: str
    is_read: bool
    is_written: bool
    keeps: str


@dataclass(frozen=True)
class Loss:
    """What a format loses or changes of a clip in one place."""

    kind: str
    time: float
    duration: float
    error: float
    message: str


def formats() -> list[Format]:
    """All formats, Pacini's own first."""
    return [Format(*entry) for entry in _native.formats()]


def losses_of(entries: Sequence[tuple[str, float, float, float, str]]) -> list[Loss]:
    return [Loss(*entry) for entry in entries]


def format_for(path: PathLike, format: Optional[str]) -> str:
    """The format to write to a file, by its extension unless it is named."""
    if format is not None:
        return format
    extension = os.path.splitext(os.fspath(path))[1].lower()
    found = _native.format_written_to(extension)
    if found is None:
        raise Error(f"{os.fspath(path)} has the extension of no format that is written; say which", "format")
    return found


def export_options(options: dict[str, Any]) -> _native.ExportOptions:
    """Options of formats: points, frequency_points, sample_rate, split, quick, events, max_points, min_segment,
    max_segment, profile, strength."""
    given = dict(options)
    profile = given.pop("profile", None)
    if profile is not None:
        from ._profile import as_profile

        given["profile"] = as_profile(profile)._handle
    return _native.ExportOptions(**given)
