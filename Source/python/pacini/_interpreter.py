"""The one interpreter of a process that the package works in."""

from __future__ import annotations

import importlib
from typing import Any


def _is_main() -> bool:
    for name in ("_interpreters", "_xxsubinterpreters"):
        try:
            module: Any = importlib.import_module(name)
        except ImportError:
            continue

        def number(identity: Any) -> int:
            return int(identity[0] if isinstance(identity, tuple) else identity)

        return number(module.get_current()) == number(module.get_main())
    return True


if not _is_main():
    raise ImportError("pacini works in the main interpreter only, as NumPy does; use processes or threads instead")
