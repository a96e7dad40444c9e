"""Text files that Python reads itself."""

from __future__ import annotations

import os

from ._arrays import PathLike
from ._errors import Error


def text_of(path: PathLike) -> str:
    """The text of a file. Raises :class:`pacini.Error`."""
    name = os.fsdecode(path)
    try:
        with open(path, encoding="utf-8") as file:
            return file.read()
    except FileNotFoundError:
        raise Error("does not exist; check the name and the folder", name, "io") from None
    except OSError as error:
        raise Error(error.strerror or "cannot be read", name, "io") from None
    except UnicodeDecodeError:
        raise Error("is not a text of UTF-8", name, "invalidData") from None
