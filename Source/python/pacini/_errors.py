"""Errors as exceptions."""

from __future__ import annotations

import errno
from typing import Any


class Error(ValueError):
    """Input or a parameter that Pacini cannot take.

    `where` is its place, such as ``bands[2].amplitude[7].time`` or a parameter's name, empty for the whole input.
    `code` is one of invalidArgument, invalidData, unsupportedVersion, truncated, notFinite, tooLarge, io and diskFull.
    Errors of the last two are :class:`FileError`, too; those of calls that cannot be are :class:`ArgumentError`.
    """

    def __new__(cls, message: str, where: str = "", code: str = "invalidArgument") -> Any:
        if cls is Error and code in ("io", "diskFull"):
            return FileError.__new__(FileMissing if message.startswith("does not exist") else FileError)
        return super().__new__(cls, message, where, code)

    def __init__(self, message: str, where: str = "", code: str = "invalidArgument") -> None:
        super().__init__(message, where, code)
        self.message = message
        self.where = where
        self.code = code

    def __str__(self) -> str:
        return f"{self.where}: {self.message}" if self.where else self.message


class ArgumentError(Error, TypeError):
    """A call that cannot be: an argument of the wrong type, one that is missing, or an option that there is not."""


class FileError(Error, OSError):
    """A file that cannot be read or written, named by `where` and `filename`."""

    def __new__(cls, *_: str) -> Any:
        return OSError.__new__(cls)

    def __init__(self, message: str, where: str = "", code: str = "io") -> None:
        super().__init__(message, where, code)
        self.filename = where or None
        self.strerror = message
        self.errno = errno.ENOSPC if code == "diskFull" else None


class FileMissing(FileError, FileNotFoundError):
    """A file that does not exist."""

    def __init__(self, message: str, where: str = "", code: str = "io") -> None:
        super().__init__(message, where, code)
        self.errno = errno.ENOENT
