"""Settings, from their common descriptions."""

from __future__ import annotations

import inspect
import json
from collections.abc import Mapping
from typing import Any, Callable, TypeVar

from . import _native
from ._arguments import check_names, flag, number, text

_Function = TypeVar("_Function", bound=Callable[..., Any])
_KINDS = {"number": "Optional[float]", "whole": "Optional[int]", "truth": "Optional[bool]", "choice": "Optional[str]"}

_OPTIONS: dict[str, Callable[[Any, str], Any]] = {
    "number": number,
    "whole": number,
    "truth": flag,
    "choice": text,
    "profile": lambda value, _: value,
}


def _by_name(described: str) -> dict[str, dict[str, Any]]:
    return {one["option"][2:].replace("-", "_"): one for one in json.loads(described)}


ENCODE = _by_name(_native.encode_parameters())
EXPORT = _by_name(_native.export_parameters())
"""With `profile`, which is no number, choice or flag."""
TEXTURE = _by_name(_native.texture_parameters())
LIVE = _by_name(_native.translator_parameters())


def checked_options(function: str, options: Mapping[str, Any], known: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """The options that are not None, by names that are known, with values of the types that are described."""
    check_names(function, options, known)
    given = {name: value for name, value in options.items() if value is not None}
    return {name: _OPTIONS[known[name]["kind"]](value, name) for name, value in given.items()}


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
