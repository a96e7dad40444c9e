"""Settings, from their common descriptions."""

from __future__ import annotations

import difflib
import inspect
import json
from typing import Any, Callable, Optional, TypeVar

from . import _native

_Function = TypeVar("_Function", bound=Callable[..., Any])
_KINDS = {"number": "Optional[float]", "whole": "Optional[int]", "truth": "Optional[bool]", "choice": "Optional[str]"}


def _by_name(described: str) -> dict[str, dict[str, Any]]:
    return {one["option"][2:].replace("-", "_"): one for one in json.loads(described)}


ENCODE = _by_name(_native.encode_parameters())
EXPORT = _by_name(_native.export_parameters())
"""With `profile`, which is no number, choice or flag."""


def unknown(options: dict[str, Any], known: dict[str, dict[str, Any]]) -> Optional[tuple[str, str]]:
    """Returns the first unknown option and a suggestion; None if all are known."""
    for name in options:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            return name, f"; did you mean {near[0]}?" if near else ""
    return None


def check_names(function: str, options: dict[str, Any], known: dict[str, dict[str, Any]]) -> None:
    """Refuses keywords as Python does, and names the nearest."""
    if found := unknown(options, known):
        raise TypeError(f"{function}() got an unexpected keyword argument '{found[0]}'{found[1]}")


def _line(name: str, one: dict[str, Any]) -> str:
    limits = " or ".join(one.get("choices", [])) or (f"{one['lowest']} to {one['highest']}" if "lowest" in one else "")
    told = f"{limits} {one['unit']}".strip()
    return f"    {name}: {one['text']}{f' ({told})' if told else ''} [{one.get('default', one.get('usually', ''))}]"


def with_keywords(known: dict[str, dict[str, Any]]) -> Callable[[_Function], _Function]:
    """Shows the parameters that a function takes as ``**options`` in its signature and its help, with their ranges."""

    def decorated(function: _Function) -> _Function:
        own = inspect.signature(function)
        listed = [one for one in own.parameters.values() if one.kind != inspect.Parameter.VAR_KEYWORD]
        keywords = [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=_KINDS[one["kind"]])
            for name, one in known.items()
        ]
        function.__signature__ = own.replace(parameters=[*listed, *keywords])  # type: ignore[attr-defined]
        lines = "\n".join(_line(name, one) for name, one in known.items())
        notes = "Notes\n    -----\n    Options, with ranges and defaults:"
        function.__doc__ = f"{function.__doc__}\n    {notes}\n\n{lines}\n    "
        return function

    return decorated
