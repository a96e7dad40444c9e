"""Pacini: sound to touch. Analysis, clips and synthesis of haptic signals.

>>> import pacini
>>> clip = pacini.encode("door.wav")
>>> drive = pacini.render(clip, profile="l5-wristband")
>>> pacini.compare("door.wav", clip).match

Sounds are files, or float32 and float64 arrays as (frames,) or (channels, frames). What goes wrong is a
:class:`pacini.Error`, with its place.
"""

from __future__ import annotations

import atexit as _atexit

# The first one before NumPy, which breaks for the main interpreter what another one touches.
from . import _interpreter, _native, measure  # noqa: F401
from ._clip import Band, Clip, NoiseBand, SimplifiedLane, Source
from ._errors import ArgumentError, Error, FileError, FileMissing
from ._formats import Format, Loss, formats
from ._many import compare_files, encode_files
from ._profile import Profile
from ._scene import Scene
from ._simplify import SIMPLIFIERS, simplify
from ._sound import (
    Comparison,
    Method,
    Preset,
    RenderReport,
    compare,
    convert,
    encode,
    explain,
    felt,
    lint,
    methods,
    presets,
    read,
    read_audio,
    render,
    translate,
    write_audio,
)
from ._texture import Texture
from ._translator import Translator

__version__: str = _native.VERSION

# Work that Ctrl+C has left to itself must not be there when the process takes its memory away.
_atexit.register(_native.wait_for_abandoned_work)

__all__ = [
    "SIMPLIFIERS",
    "ArgumentError",
    "Band",
    "Clip",
    "Comparison",
    "Error",
    "FileError",
    "FileMissing",
    "Format",
    "Loss",
    "Method",
    "NoiseBand",
    "Preset",
    "Profile",
    "RenderReport",
    "Scene",
    "SimplifiedLane",
    "Source",
    "Texture",
    "Translator",
    "compare",
    "compare_files",
    "convert",
    "encode",
    "encode_files",
    "explain",
    "felt",
    "formats",
    "lint",
    "measure",
    "methods",
    "presets",
    "read",
    "read_audio",
    "render",
    "simplify",
    "translate",
    "write_audio",
]
