"""Scenes: clips that play together."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterable, Mapping
from typing import Any, Optional

from . import _native
from ._arrays import PathLike
from ._clip import Clip
from ._errors import Error


class Scene:
    """Clips that play together on one actuator or several, and what happens to them. Never changes.

    `plays` are mappings as in scene files: ``{"clip": 0, "start": 0.5, "gain": -6, "pan": 1, "transposition": 2,
    "loop": 0.5, "passes": 3}``; `changes` such as ``{"time": 1, "play": 0, "parameter": "gain", "value": -20}``.
    """

    __slots__ = ("_handle",)

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
        **options: Any,
    ) -> None:
        listed = list(clips)
        for i, clip in enumerate(listed):
            if not isinstance(clip, Clip):
                raise Error("must be a Clip", f"clips[{i}]")
        content = {
            "format": "pacini.scene",
            "version": 1,
            "name": name,
            "duration": duration,
            "gain": gain,
            "actuators": actuators,
            **options,
            "clips": [str(i) for i in range(len(listed))],
            "plays": [{"clip": i} for i in range(len(listed))] if plays is None else [dict(play) for play in plays],
            "changes": [dict(change) for change in changes],
        }
        try:
            text = json.dumps(content, allow_nan=False)
        except (TypeError, ValueError) as error:
            raise Error(str(error), "scene", "invalidData") from None
        self._handle = _native.SceneHandle.from_json(text, [clip._handle for clip in listed])

    @classmethod
    def _of(cls, handle: _native.SceneHandle) -> Scene:
        scene = cls.__new__(cls)
        scene._handle = handle
        return scene

    @classmethod
    def load(cls, path: PathLike, *, clips: PathLike = "", strict: bool = False) -> Scene:
        """Reads a scene; clip files that it names are looked for in the folder `clips`, by default beside it."""
        handle, passed = _native.SceneHandle.read(os.fsdecode(path), os.fsdecode(clips), strict)
        for message in passed:
            warnings.warn(f"{os.fsdecode(path)}: {message}", stacklevel=2)
        return cls._of(handle)

    def save(self, path: PathLike, *, overwrite: Optional[bool] = None) -> None:
        """Writes a scene with its clips in it; the file is complete or not there. A scene that is there is replaced,
        and no file of another kind unless `overwrite` is True; with False nothing is."""
        self._handle.save(os.fsdecode(path), overwrite)

    def to_dict(self) -> dict[str, Any]:
        """All that is in the scene, as in its file, with the clips."""
        content: dict[str, Any] = json.loads(self._handle.to_json())
        return content

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
    def plays(self) -> list[dict[str, Any]]:
        plays: list[dict[str, Any]] = self.to_dict()["plays"]
        return plays

    @property
    def changes(self) -> list[dict[str, Any]]:
        changes: list[dict[str, Any]] = self.to_dict()["changes"]
        return changes

    def lint(self) -> list[tuple[str, str]]:
        """What in it does nothing, or less than is written there: places and what is wrong with them."""
        return self._handle.lint()

    def __eq__(self, other: object) -> bool:
        return self._handle == other._handle if isinstance(other, Scene) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return _scene_of_json, (self._handle.to_json(),)

    def __repr__(self) -> str:
        return f"<pacini.Scene {self.name!r}: {len(self.clips)} clips, {len(self.plays)} plays>"


def _scene_of_json(text: str) -> Scene:
    return Scene._of(_native.SceneHandle.from_json(text, []))
