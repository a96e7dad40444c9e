"""Scenes: clips that play together."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any, Optional

from . import _native
from ._arguments import checked, entries, wrong
from ._arrays import PathLike
from ._clip import Clip
from ._document import JsonDocument, json_of
from ._texture import Texture
from ._warnings import warn_of


class Scene(JsonDocument):
    """Clips that play together on one actuator or several. A scene never changes.

    Parameters
    ----------
    clips : iterable of Clip
        The clips that plays refer to by their index.
    plays : iterable of mappings, optional
        As in scene files, such as ``{"clip": 0, "start": 0.5, "gain": -6, "pan": 1, "transposition": 2, "loop": 0.5,
        "passes": 3}``: times in s, gain in dB, transposition in semitones [each clip once, from 0 on].
    changes : iterable of mappings, optional
        Such as ``{"time": 1, "play": 0, "parameter": "gain", "value": -20}``.
    name : str, optional
        Its name.
    duration : float, default 0
        Length in s; 0 is until the last play ends.
    gain : float, default 0
        Gain of the whole, dB.
    actuators : int, default 1
        Number of actuators, 1 to 16.
    textures : iterable of Texture, optional
        The textures that plays refer to by their index: ``{"texture": 0, "duration": 4, "speed": 0.2}``; changes of
        ``"speed"`` and ``"force"`` move them.
    **options
        Other entries of scene files.

    Raises
    ------
    Error
        The scene is not valid; the error names the entry.
    """

    __slots__ = ()

    _handle: _native.SceneHandle

    @checked
    def __init__(
        self,
        clips: Iterable[Clip],
        plays: Optional[Iterable[Mapping[str, Any]]] = None,
        changes: Iterable[Mapping[str, Any]] = (),
        *,
        name: str = "",
        duration: float = 0.0,
        gain: float = 0.0,
        actuators: int = 1,
        textures: Iterable[Texture] = (),
        **options: Any,
    ) -> None:
        listed, surfaces = list(clips), list(textures)
        for i, clip in enumerate(listed):
            if not isinstance(clip, Clip):
                wrong("must be a Clip", f"clips[{i}]", clip)
        for i, texture in enumerate(surfaces):
            if not isinstance(texture, Texture):
                wrong("must be a Texture", f"textures[{i}]", texture)
        content = {
            "format": "pacini.scene",
            "version": 1,
            "name": name,
            "duration": duration,
            "gain": gain,
            "actuators": actuators,
            **options,
            "clips": [str(i) for i in range(len(listed))],
            "textures": [{"texture": texture.to_dict()} for texture in surfaces],
            "plays": [{"clip": i} for i in range(len(listed))] if plays is None else _entries(plays, "plays"),
            "changes": _entries(changes, "changes"),
        }
        self._handle = _native.SceneHandle.from_json(json_of(content, "scene"), [clip._handle for clip in listed])

    @classmethod
    @checked
    def load(cls, path: PathLike, *, clips: PathLike = "", strict: bool = False) -> Scene:
        """Reads a scene.

        Parameters
        ----------
        path : path
            The file.
        clips : path, optional
            Folder of the clip files that it names [beside it].
        strict : bool, default False
            Refuse unknown keys instead of warning of them.

        Raises
        ------
        Error
            The scene or one of its clips cannot be read.
        """
        handle, passed = _native.SceneHandle.read(os.fsdecode(path), os.fsdecode(clips), strict)
        warn_of(path, passed)
        return cls._of(handle)

    @property
    def name(self) -> str:
        return self._handle.name

    @property
    def duration(self) -> float:
        """Length in s; 0 is until the last play ends."""
        return self._handle.duration

    @property
    def actuators(self) -> int:
        return self._handle.actuators

    @property
    def clips(self) -> list[Clip]:
        return [Clip._of(handle) for handle in self._handle.clips]

    @property
    def textures(self) -> list[Texture]:
        return [Texture.from_dict(entry["texture"]) for entry in self.to_dict().get("textures", [])]

    @property
    def plays(self) -> list[dict[str, Any]]:
        plays: list[dict[str, Any]] = self.to_dict()["plays"]
        return plays

    @property
    def changes(self) -> list[dict[str, Any]]:
        changes: list[dict[str, Any]] = self.to_dict()["changes"]
        return changes

    @checked
    def lint(self) -> list[tuple[str, str]]:
        """Finds entries that do nothing, or less than they state.

        Returns
        -------
        list of (str, str)
            Place and what is wrong there.
        """
        return self._handle.lint()

    def __reduce__(self) -> tuple[Any, ...]:
        return _scene_of_json, (self._handle.to_json(),)

    def __repr__(self) -> str:
        return f"<pacini.Scene {self.name!r}: {len(self.clips)} clips, {len(self.plays)} plays>"


def _entries(given: Iterable[Mapping[str, Any]], where: str) -> list[dict[str, Any]]:
    return [dict(entries(one, f"{where}[{i}]")) for i, one in enumerate(given)]


def _scene_of_json(text: str) -> Scene:
    return Scene._of(_native.SceneHandle.from_json(text, []))
