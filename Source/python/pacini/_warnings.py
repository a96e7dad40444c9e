"""Warnings, which point to the line of the user."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterable
from types import FrameType
from typing import Optional

from ._arrays import PathLike


def warn(message: str) -> None:
    """Warns where the package was called."""
    level = 1
    frame: Optional[FrameType] = sys._getframe()
    while frame is not None and str(frame.f_globals.get("__name__", "")).split(".")[0] == "pacini":
        frame = frame.f_back
        level += 1
    warnings.warn(message, stacklevel=level)


def warn_of(path: PathLike, doubts: Iterable[str]) -> None:
    """Warns of what was tolerated in a file."""
    for doubt in doubts:
        warn(f"{os.fsdecode(path)}: {doubt}")
