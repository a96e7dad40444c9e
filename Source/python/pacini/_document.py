"""What clips, profiles, textures and scenes share: each is a document that a file holds."""

from __future__ import annotations

import json
import os
from typing import Any, Optional, TypeVar

from ._arguments import checked
from ._arrays import PathLike
from ._errors import Error

Self = TypeVar("Self", bound="Document")


class Document:
    """A document of the program, equal to another of its kind that holds the same."""

    __slots__ = ("_handle",)

    _handle: Any

    @classmethod
    def _of(cls: type[Self], handle: Any) -> Self:
        document = cls.__new__(cls)
        document._handle = handle
        return document

    @checked
    def to_dict(self) -> dict[str, Any]:
        """All that is in it, as in its file."""
        content: dict[str, Any] = json.loads(self._handle.to_json())
        return content

    def __eq__(self, other: object) -> bool:
        return self._handle == other._handle if isinstance(other, type(self)) else NotImplemented

    def __reduce__(self) -> tuple[Any, ...]:
        return _of_json, (type(self), type(self._handle), self._handle.to_json())


class JsonDocument(Document):
    """A document whose file is JSON and nothing else."""

    __slots__ = ()

    @checked
    def save(self, path: PathLike, *, overwrite: Optional[bool] = None) -> None:
        """Writes the file, a scene with its clips in it; the file is complete or not there.

        Parameters
        ----------
        path : path
            Where.
        overwrite : bool, optional
            None replaces a file of this kind and no other. True replaces every file, False none.

        Raises
        ------
        Error
            The file is not replaced, or cannot be written.
        """
        self._handle.save(os.fsdecode(path), overwrite)


def _of_json(kind: type[Document], handle: Any, text: Any) -> Document:
    return kind._of(handle.from_json(text))


def json_of(content: Any, kind: str) -> str:
    """The text of a dictionary that a user gave; what JSON cannot hold is refused."""
    try:
        return json.dumps(content, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise Error(str(error), kind, "invalidData") from None
