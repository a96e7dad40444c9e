"""Many sounds, on several threads."""

from __future__ import annotations

import inspect
import os
import threading
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from pathlib import Path
from typing import Any, Callable, Optional, TypeVar, Union, cast

import numpy as np

from . import _native
from ._arguments import check_names, checked, listed
from ._arrays import FloatArray, PathLike, is_path
from ._clip import Clip
from ._errors import Error
from ._formats import formats
from ._progress import Progress, counted
from ._sound import Comparison, Sound, check_options, compare, encode
from ._warnings import warn

# A file, samples, or samples with their rate, as soundfile.read() returns them.
AnySound = Union[Sound, "tuple[FloatArray, float]"]
_MOST_THREADS = 1024
S = TypeVar("S", bound=AnySound)
T = TypeVar("T")
R = TypeVar("R")


def _on_threads(
    items: list[T], threads: Optional[int], work: Callable[[T, Callable[[float], None]], R]
) -> Iterator[tuple[T, Union[R, Error]]]:
    """Each item with work(item, go_on) of it, or its Error, as they are ready. go_on() ends work that nobody awaits."""
    workers = threads if threads is not None else os.cpu_count() or 1
    if not 1 <= workers <= _MOST_THREADS:
        raise Error(f"must be 1 to {_MOST_THREADS}", "threads")
    over = threading.Event()

    def go_on(share: float) -> None:
        if over.is_set():
            raise InterruptedError

    def one(item: T) -> Union[R, Error]:
        try:
            return work(item, go_on)
        except Error as error:
            return error

    with ThreadPoolExecutor(workers) as pool:
        running: dict[Future[Union[R, Error]], T] = {}
        waiting = iter(items)
        try:
            while True:
                while len(running) < 2 * workers:
                    try:
                        item = next(waiting)
                    except StopIteration:
                        break
                    running[pool.submit(one, item)] = item
                if not running:
                    return
                done, _ = wait(running, return_when=FIRST_COMPLETED)
                for future in done:
                    yield running.pop(future), future.result()
        finally:
            over.set()
            pool.shutdown(wait=False, cancel_futures=True)


@checked
def encode_files(
    sounds: Union[S, Iterable[S]],
    *,
    sample_rate: Optional[float] = None,
    axis: int = -1,
    threads: Optional[int] = None,
    progress: Progress = None,
    **options: Any,
) -> Iterator[tuple[S, Union[Clip, Error]]]:
    """Encodes many sounds, or one, on several threads.

    Parameters
    ----------
    sounds : iterable of paths and arrays
        Files, arrays of samples, and pairs of samples and their rate, as ``soundfile.read()`` returns them; or one
        path or one array.
    sample_rate : float, optional
        Rate of arrays that come without one, Hz. Files have their own.
    axis : int, default -1
        Axis of the frames of all arrays; 0 for those of soundfile.
    threads : int, optional
        Number of threads [number of processors].
    progress : bool or callable, optional
        As of :func:`encode`, over all sounds.
    **options
        As of :func:`encode`. Errors in them are raised at once.

    Yields
    ------
    sound : path, array or pair
        A sound as it was given, in the order in which they are ready.
    result : Clip or Error
        Its clip, or what is wrong with the sound; the others go on.

    Examples
    --------
    >>> for path, clip in pacini.encode_files(["door.wav", "rain.wav"]):
    ...     print(path, clip)
    """
    check_options("encode_files", options)
    alone = is_path(sounds) or isinstance(sounds, np.ndarray)
    todo = [cast(S, sounds)] if alone else cast("list[S]", listed(sounds, "sounds"))

    def one(sound: S, go_on: Callable[[float], None]) -> Clip:
        if is_path(sound):
            return encode(sound, progress=go_on, **options)
        if isinstance(sound, tuple) and len(sound) == 2:
            samples, rate = cast("tuple[FloatArray, float]", sound)
            return encode(samples, rate, axis=axis, progress=go_on, **options)
        return encode(cast(Sound, sound), sample_rate, axis=axis, progress=go_on, **options)

    return counted(_on_threads(todo, threads, one), len(todo), progress, "encoding")


def _by_stem(folder: Path, endings: set[str]) -> dict[str, list[Path]]:
    """Files below `folder` by their path in it without ending."""
    found: dict[str, list[Path]] = {}
    for path in sorted(folder.rglob("*")):
        if path.suffix.lower() in endings and path.is_file():
            found.setdefault(path.relative_to(folder).with_suffix("").as_posix(), []).append(path)
    return found


def _pairs_of(reference: Path, candidate: Path) -> list[tuple[str, Union[tuple[Path, Path], Error]]]:
    """Sounds of two folders whose paths agree but for their endings; a clip where there is no sound of its name."""
    for folder in (reference, candidate):
        if not folder.is_dir():
            raise Error("is no folder; pacini.compare() compares two files", str(folder))
    sounds = set(_native.audio_extensions())
    references = _by_stem(reference, sounds)
    clips = _by_stem(candidate, {one.extension for one in formats() if one.is_read})
    candidates = {**clips, **_by_stem(candidate, sounds)}
    pairs: list[tuple[str, Union[tuple[Path, Path], Error]]] = []
    for stem, files in references.items():
        for file in files:
            name = file.relative_to(reference).as_posix()
            others = candidates.get(stem, [])
            if len(others) == 1:
                pairs.append((name, (file, others[0])))
            elif others:
                pairs.append((name, Error(f"has two counterparts, {others[0]} and {others[1]}; remove one", name)))
            else:
                pairs.append((name, Error(f"has no counterpart {stem}.* in {candidate}", name)))
    for stem in candidates.keys() - references.keys():
        warn(f"{candidates[stem][0]}: has no reference")
    return pairs


@checked
def compare_files(
    reference: PathLike,
    candidate: PathLike,
    *,
    threads: Optional[int] = None,
    progress: Progress = None,
    **options: Any,
) -> Iterator[tuple[str, Union[Comparison, Error]]]:
    """Compares the sounds of two folders, as ``pacini compare`` does, on several threads.

    Parameters
    ----------
    reference : path
        Folder of sounds, with all folders in it.
    candidate : path
        Folder of what is felt: sounds, or clips where no sound has their name. Two files are a pair if their paths in
        the folders agree but for their endings.
    threads : int, optional
        Number of threads [number of processors].
    progress : bool or callable, optional
        As of :func:`encode`, over all pairs.
    **options
        As of :func:`compare`.

    Yields
    ------
    name : str
        Path of the reference in its folder, in the order in which they are ready.
    result : Comparison or Error
        What :func:`compare` says, or what is wrong with the pair; the others go on.

    Raises
    ------
    Error
        One of both is no folder.

    Warns
    -----
    UserWarning
        A candidate has no reference.

    Examples
    --------
    >>> scores = dict(pacini.compare_files("sounds", "clips"))
    """
    check_names("compare_files", options, inspect.signature(compare).parameters)
    pairs = _pairs_of(Path(os.fsdecode(reference)), Path(os.fsdecode(candidate)))

    def one(pair: tuple[str, Union[tuple[Path, Path], Error]], go_on: Callable[[float], None]) -> Comparison:
        if isinstance(pair[1], Error):
            raise pair[1]
        go_on(0.0)
        return compare(*pair[1], **options)

    results = ((pair[0], result) for pair, result in _on_threads(pairs, threads, one))
    return counted(results, len(pairs), progress, "comparing")
