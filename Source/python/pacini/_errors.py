"""What goes wrong, as exceptions."""

from __future__ import annotations


class Error(ValueError):
    """Input or a parameter that Pacini cannot take.

    `where` is its place, such as ``bands[2].amplitude[7].time`` or a parameter's name, empty for the whole input.
    `code` is one of invalidArgument, invalidData, unsupportedVersion, truncated, notFinite, tooLarge, io and diskFull.
    """

    def __init__(self, message: str, where: str = "", code: str = "invalidArgument") -> None:
        super().__init__(message, where, code)
        self.message = message
        self.where = where
        self.code = code

    def __str__(self) -> str:
        return f"{self.where}: {self.message}" if self.where else self.message
