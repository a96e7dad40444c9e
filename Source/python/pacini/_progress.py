"""Progress of long work: a function of the share that is done, or a bar of tqdm where that is installed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any, Callable, Optional, TypeVar, Union

Progress = Union[None, bool, Callable[[float], object]]
T = TypeVar("T")


def _tqdm() -> Any:
    try:
        from tqdm.auto import tqdm  # type: ignore[import-untyped,unused-ignore]
    except ImportError:
        return None
    return tqdm


@contextmanager
def shown(progress: Progress, label: str) -> Iterator[Optional[Callable[[float], object]]]:
    """Returns the function to call with the share that is done, up to 1: `progress` itself, or a bar for True."""
    if progress is None or progress is False:
        yield None
        return
    if progress is not True:
        yield progress
        progress(1.0)  # what is done within a tenth of a second tells nothing before
        return
    tqdm = _tqdm()
    if tqdm is None:
        yield None
        return
    with tqdm(total=100, desc=label, unit="%", bar_format="{l_bar}{bar}| {elapsed}<{remaining}") as bar:

        def update(share: float) -> None:
            bar.update(100.0 * share - bar.n)

        yield update
        bar.update(100.0 - bar.n)


def counted(items: Iterable[T], total: int, progress: Progress, label: str) -> Iterator[T]:
    """The items, with the share of them that came."""
    tqdm = _tqdm() if progress is True else None
    if tqdm is not None:
        yield from tqdm(items, total=total, desc=label)
        return
    for done, item in enumerate(items, 1):
        yield item
        if callable(progress):
            progress(done / total)
