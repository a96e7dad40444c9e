"""Arguments of public functions, checked by what their signatures state: errors name what is wrong."""

from __future__ import annotations

import difflib
import functools
import inspect
import operator
import os
from collections.abc import Iterable, Mapping
from typing import Any, Callable, NoReturn, Optional, TypeVar, cast

import numpy as np

from ._errors import ArgumentError, Error

_Function = TypeVar("_Function", bound=Callable[..., Any])
_Class = TypeVar("_Class", bound=type)
_Check = Callable[[Any, str], Any]


def wrong(message: str, where: str, value: object) -> NoReturn:
    """Raises the error of a value that is of the wrong type."""
    raise ArgumentError(f"{message}, not {_named(value)}", where)


def _named(value: object) -> str:
    if value is None or isinstance(value, (bool, int, float)):
        return repr(value)
    if isinstance(value, str):
        return repr(value) if len(value) < 60 else "a long text"
    kind = type(value).__name__
    return f"{'an' if kind[:1].lower() in 'aeiou' else 'a'} {kind}"


def number(value: object, where: str) -> float:
    """Any number but True and False."""
    if not isinstance(value, (bool, np.bool_, str, bytes)):
        try:
            return float(cast(Any, value))
        except OverflowError:
            raise Error("is too large", where) from None
        except (TypeError, ValueError):
            pass
    wrong("must be a number", where, value)


def whole(value: object, where: str) -> int:
    """A whole number; a float that is one counts."""
    if not isinstance(value, (bool, np.bool_, str, bytes)):
        try:
            return operator.index(cast(Any, value))
        except TypeError:
            pass
        if (found := number(value, where)).is_integer():
            return int(found)
        raise Error("must be a whole number", where)
    wrong("must be a whole number", where, value)


def within(value: int, lowest: int, highest: int, where: str) -> int:
    """A whole number that is within its range."""
    if not lowest <= value <= highest:
        raise Error(f"must be {lowest} to {highest}", where)
    return value


def count(value: object, where: str) -> int:
    """A whole number of 31 bits: what has a smaller range of its own is refused later."""
    return within(whole(value, where), -(2**31), 2**31 - 1, where)


def seed(value: object, where: str) -> int:
    return within(whole(value, where), 0, 2**64 - 1, where)


def flag(value: object, where: str) -> bool:
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    wrong("must be True or False", where, value)


def text(value: object, where: str) -> str:
    if isinstance(value, str):
        return value
    wrong("must be a text", where, value)


def path(value: object, where: str) -> Any:
    if isinstance(value, (str, bytes, os.PathLike)):
        if b"\0" in os.fsencode(value):
            raise Error("must not have a zero in it", where)
        return value
    wrong("must be a path", where, value)


def refuse_masked(values: object, where: str) -> None:
    """What lies below a mask would count as any other value."""
    if isinstance(values, np.ma.MaskedArray) and (masked := int(cast(Any, np.ma).count_masked(values))):
        raise ArgumentError(f"has {masked} masked values; give what stands in their place: {where}.filled(0)", where)


def numbers(values: object, where: str) -> list[float]:
    """Numbers in one dimension."""
    refuse_masked(values, where)
    try:
        array = np.asarray(values)
    except (TypeError, ValueError):
        array = np.empty((), object)
    if array.ndim == 1 and (array.size == 0 or array.dtype.kind in "fiu"):
        return array.astype(np.float64).tolist()  # type: ignore[no-any-return]
    wrong("must be a sequence of numbers", where, values)


def entries(value: object, where: str) -> Mapping[str, Any]:
    if isinstance(value, Mapping):
        return value
    wrong("must be a dictionary", where, value)


def listed(values: object, where: str) -> list[Any]:
    if isinstance(values, Iterable) and not isinstance(values, (str, bytes)):
        return list(values)
    wrong("must be a list", where, values)


def data(value: object, where: str) -> bytes:
    if isinstance(value, (bytes, bytearray, memoryview)):
        return bytes(value)
    wrong("must be bytes", where, value)


def progress(value: object, where: str) -> Any:
    if isinstance(value, bool) or callable(value):
        return value
    wrong("must be True, or a function of the share that is done", where, value)


# Arguments of functions that take options beside them.
_NAMES: dict[str, list[str]] = {}

# By the text of an annotation; the types that are not here are checked by those who take them.
_CHECKS: dict[str, _Check] = {
    "float": number,
    "int": count,
    "bool": flag,
    "str": text,
    "PathLike": path,
    "Sequence[float]": numbers,
    "dict[str, Any]": entries,
    "bytes": data,
    "Progress": progress,
}


def _check_of(parameter: inspect.Parameter) -> Optional[_Check]:
    annotation = str(parameter.annotation)
    if annotation.startswith("Optional["):
        annotation = annotation[len("Optional[") : -1]
    if annotation == "Progress":
        return lambda value, where: None if value is None else progress(value, where)
    if annotation.startswith("Iterable["):
        return listed
    if annotation == "int" and parameter.name == "seed":
        return seed
    return _CHECKS.get(annotation)


def meant(name: str, known: Iterable[str]) -> str:
    """A suggestion for a name that is none; empty where nothing is like it."""
    found = difflib.get_close_matches(name, list(known), 1)
    return f"; did you mean {found[0]}?" if found else ""


def checked_class(kind: _Class) -> _Class:
    """The same for what makes objects of a data class."""
    made: Any = kind
    made.__init__ = checked(made.__init__, kind.__name__)
    return kind


def checked(function: _Function, name: str = "") -> _Function:
    """Checks arguments by their annotations, and their names."""
    signature = inspect.signature(function)
    if not name:
        name = function.__qualname__.split(".")[-2] if function.__name__ == "__init__" else function.__name__
    parameters = signature.parameters
    known = [one for one in parameters if one not in ("self", "cls")]
    _NAMES.setdefault(name, []).extend(known)
    takes_any = any(one.kind == one.VAR_KEYWORD for one in parameters.values())
    checks = {one.name: check for one in parameters.values() if (check := _check_of(one)) is not None}
    defaults = {one.name: one.default for one in parameters.values()}

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        if not takes_any:
            check_names(name, kwargs, known)
        try:
            bound = signature.bind(*args, **kwargs)
        except TypeError as error:
            raise ArgumentError(f"{name}(): {error}") from None
        for key, value in bound.arguments.items():
            if key in checks and not (value is None and defaults[key] is None):
                bound.arguments[key] = checks[key](value, key)
        return function(*bound.args, **bound.kwargs)

    return cast(_Function, call)


def check_names(function: str, given: Iterable[str], known: Iterable[str]) -> None:
    """Refuses keywords that are none, and names the nearest."""
    for name in given:
        if name not in known:
            near = meant(name, [*known, *_NAMES.get(function, ())])
            raise ArgumentError(f"is no argument of {function}(){near}", name)
