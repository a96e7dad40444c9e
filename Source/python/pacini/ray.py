"""Many sounds on many machines, with Ray (``pip install pacini[ray]``).

>>> import pacini.ray
>>> table = pacini.ray.encode("sounds/", "clips/", address="auto", compare=True)
>>> table.to_pandas().nsmallest(10, "match")

What travels between the machines are paths, not samples: every machine must see the sounds, in a shared folder or at a
URL that fsspec knows, such as ``s3://bucket/sounds/rain.flac``. The bytes of a clip do not depend on who makes it.

On the command line: ``pacini encode sounds/ -o clips/ --ray auto``, which is
``python3 -m pacini.ray sounds/ -o clips/ --address auto``.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import importlib
import json
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any, Optional, Union

import pacini

from ._arrays import PathLike, is_path
from ._errors import Error
from ._parameters import ENCODE
from ._progress import Progress, counted
from ._sound import check_options, settings_text

SOUNDS = (".wav", ".flac", ".ogg", ".opus", ".mp3", ".aif", ".aiff", ".caf", ".w64", ".au")
TABLE = "run.parquet"
_PARTS = ".pacini-run"
_PART_SECONDS = 5.0  # of work that a stop may cost at most, beside what is under way

# Columns of the table, in their order, by the types of Arrow.
_COLUMNS = {
    "input": "string",
    "output": "string",
    "bytes": "int64",
    "sha256": "string",
    "duration": "float64",
    "seconds": "float64",
    "breakpoints": "int64",
    "events": "int64",
    "match": "float64",
    "hts": "float64",
    "error": "string",
    "where": "string",
    "input_bytes": "int64",
    "input_time": "float64",
    "settings": "string",
}


@dataclass(frozen=True)
class _Item:
    """A sound, where its clip goes, how large and how old it is (0 where nobody knows), and the SHA-256 of the clip
    that a run made of it before."""

    input: str
    output: str
    bytes: int = 0
    time: float = 0.0
    made: Optional[str] = None


@dataclass(frozen=True)
class _Settings:
    format: str
    options: dict[str, Any]
    compare: bool
    overwrite: bool

    def text(self) -> str:
        """All that the bytes of a clip depend on, besides its sound."""
        return json.dumps([pacini.__version__, self.format, self.options], sort_keys=True)


def _module(name: str, needed_for: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise Error(f"is needed for {needed_for}: pip install 'pacini[ray]'", name) from error


def _is_url(path: str) -> bool:
    return "://" in path


def _files(path: str) -> tuple[Any, str]:
    """The file system of a path, and the path on it."""
    fsspec = _module("fsspec", "URLs")
    system, inside = fsspec.core.url_to_fs(path)
    return system, inside


def _joined(folder: str, name: str) -> str:
    return f"{folder.rstrip('/')}/{name}" if _is_url(folder) else os.path.join(folder, *name.split("/"))


# What workers do.


@contextmanager
def _local(path: str) -> Iterator[str]:
    """The path of a sound on this machine: it keeps its name, which clips know."""
    if not _is_url(path):
        yield path
        return
    system, inside = _files(path)
    with tempfile.TemporaryDirectory(prefix="pacini-") as folder:
        here = os.path.join(folder, inside.rsplit("/", 1)[-1])
        try:
            system.get_file(inside, here)
        except OSError as error:
            raise Error(str(error) or "cannot be read", path, "io") from error
        yield here


def _write(path: str, data: bytes) -> None:
    """Whole or not at all."""
    if _is_url(path):
        system, inside = _files(path)
        system.makedirs(inside.rsplit("/", 1)[0], exist_ok=True)
        system.pipe_file(inside, data)
        return
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    handle, temporary = tempfile.mkstemp(prefix=".pacini-", dir=os.path.dirname(path) or ".")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def _content(path: str) -> Optional[bytes]:
    """Of a file; None where there is none."""
    try:
        if _is_url(path):
            system, inside = _files(path)
            return bytes(system.cat_file(inside))
        with open(path, "rb") as file:
            return file.read()
    except FileNotFoundError:
        return None


def _check_replaced(item: _Item, data: bytes, settings: _Settings) -> None:
    """Raises an error where something stands at the output that is not a run's own: as ``pacini encode`` does."""
    if settings.overwrite:
        return
    there = _content(item.output)
    if there is None or there == data or hashlib.sha256(there).hexdigest() == item.made:
        return
    reason = "exists, and nothing in it says that Pacini made it"
    with contextlib.suppress(Error):
        clip = pacini.Clip.from_bytes(there, extension=os.path.splitext(item.output)[1])
        if clip._handle.seal == "whole" and clip.source.file == os.path.basename(item.input):
            return
        reason = "was edited since it was encoded" if clip._handle.seal == "broken" else "exists and may be edited"
    raise Error(f"{reason}; overwrite=True replaces it", item.output, "io")


def _encode_one(item: _Item, settings: _Settings) -> dict[str, Any]:
    started = time.perf_counter()
    row: dict[str, Any] = dict.fromkeys(_COLUMNS)
    row.update(input=item.input, output=item.output, input_bytes=item.bytes, input_time=item.time)
    row["settings"] = settings.text()
    try:
        with _local(item.input) as sound:
            clip = pacini.encode(sound, **settings.options)
            data = clip.to_bytes(settings.format)
            _check_replaced(item, data, settings)
            _write(item.output, data)
            row.update(bytes=len(data), sha256=hashlib.sha256(data).hexdigest(), duration=clip.duration)
            row.update(breakpoints=clip.breakpoints, events=len(clip.transients))
            if settings.compare:
                measured = pacini.compare(sound, clip)
                row.update(match=measured.match, hts=measured.hts)
    except Error as error:
        row.update(error=error.message, where=error.where)
    except OSError as error:
        row.update(error=str(error), where=item.output)
    except Exception as error:  # one sound, not its batch
        row.update(error=f"{type(error).__name__}: {error}", where=item.input)
    row["seconds"] = time.perf_counter() - started
    return row


def _encode_batch(items: Sequence[_Item], settings: _Settings) -> list[dict[str, Any]]:
    return [_encode_one(item, settings) for item in items]


# What there is to do.


def _items(sounds: Union[PathLike, Iterable[PathLike]], output: str, extension: str) -> list[_Item]:
    """Sounds of a folder keep their place below it; those of a list have their names alone."""
    named: list[tuple[str, str, int, float]] = []  # path, name of the clip without its ending, bytes, time
    if is_path(sounds):
        root = os.fsdecode(sounds)
        if _is_url(root):
            system, inside = _files(root)
            found = system.find(inside, detail=True)
            paths = {inside: system.info(inside)} if not found and system.exists(inside) else found
            for path, about in sorted(paths.items()):
                if path.lower().endswith(SOUNDS):
                    name = path[len(inside) :].strip("/") or path.rsplit("/", 1)[-1]
                    named.append((system.unstrip_protocol(path), name, int(about.get("size") or 0), _time_of(about)))
        elif os.path.isdir(root):
            for folder, folders, files in os.walk(root):
                folders[:] = sorted(name for name in folders if not name.startswith("."))
                for file in sorted(files):
                    if file.lower().endswith(SOUNDS) and not file.startswith("."):
                        path = os.path.join(folder, file)
                        name = os.path.relpath(path, root).replace(os.sep, "/")
                        named.append((path, name, *_about(path)))
        else:
            named.append((root, os.path.basename(root), *_about(root)))
    else:
        for each in sounds:
            path = os.fsdecode(each)
            named.append((path, path.replace(os.sep, "/").rsplit("/", 1)[-1], *_about(path)))
    items: dict[str, _Item] = {}
    for path, name, size, age in named:
        target = _joined(output, name.rsplit(".", 1)[0] + extension)
        if target in items:
            raise Error(f"and {items[target].input} would both become {target}; rename one of them", path)
        items[target] = _Item(path, target, size, age)
    inputs = {_place(item.input) for item in items.values()}
    for item in items.values():
        if _place(item.output) in inputs:
            raise Error(f"would be replaced by the clip of {item.input}; name another folder", item.output)
    return list(items.values())


def _place(path: str) -> str:
    """The same for all ways of naming one file."""
    return path if _is_url(path) else os.path.realpath(path)


def _time_of(about: dict[str, Any]) -> float:
    """When a file was changed, as its file system tells; 0 if it does not."""
    for key in ("mtime", "LastModified", "last_modified", "updated"):
        value = about.get(key)
        if isinstance(value, (int, float)):
            return float(value)
        if hasattr(value, "timestamp"):
            return float(value.timestamp())  # type: ignore[union-attr]
    return 0.0


def _about(path: str) -> tuple[int, float]:
    try:
        if _is_url(path):
            system, inside = _files(path)
            about = system.info(inside)
            return int(about.get("size") or 0), _time_of(about)
        status = os.stat(path)
        return status.st_size, status.st_mtime
    except OSError:
        return 0, 0.0  # the worker says what is wrong with it


def _batches(items: Sequence[_Item], most: int) -> Iterator[list[_Item]]:
    """The largest first, and few large ones together, so that no machine is left with one at the end."""
    ordered = sorted(items, key=lambda item: (-item.bytes, item.input))
    share = max(1, sum(item.bytes for item in items) // max(1, len(items))) * most
    batch: list[_Item] = []
    size = 0
    for item in ordered:
        if batch and (len(batch) >= most or size + item.bytes > share):
            yield batch
            batch, size = [], 0
        batch.append(item)
        size += item.bytes
    if batch:
        yield batch


# The table, which is also the memory of a run.


class _Record:
    """Rows of this run and of those before it; a stop loses what came within the last seconds."""

    def __init__(self, output: str, arrow: Any) -> None:
        self._output = output
        self._arrow = arrow
        self._parquet = importlib.import_module("pyarrow.parquet")
        self._schema = arrow.schema([(name, getattr(arrow, kind)()) for name, kind in _COLUMNS.items()])
        self._system, self._folder = _files(output if _is_url(output) else os.path.abspath(output))
        self.rows: dict[str, dict[str, Any]] = {}
        self._new: list[dict[str, Any]] = []
        self._written = time.monotonic()
        table = f"{self._folder}/{TABLE}"
        if self._system.exists(table):
            try:
                self._read(table)
            except (self._arrow.ArrowException, KeyError) as error:
                raise Error("is no table of pacini.ray; move it away", f"{output}/{TABLE}", "invalidData") from error
        parts = self._parts()
        for path in parts:
            with contextlib.suppress(OSError, self._arrow.ArrowException, KeyError):
                self._read(path)  # or a stop left it half written: its sounds are encoded again
        self._number = len(parts)

    def _read(self, path: str) -> None:
        with self._system.open(path, "rb") as file:
            found = self._parquet.read_table(file).to_pylist()
        self.rows.update({row["output"]: {**dict.fromkeys(_COLUMNS), **row} for row in found})

    def _parts(self) -> list[str]:
        folder = f"{self._folder}/{_PARTS}"
        return sorted(self._system.ls(folder, detail=False)) if self._system.exists(folder) else []

    def made(self, item: _Item) -> _Item:
        """The sound with what is known of its clip."""
        row = self.rows.get(item.output)
        return item if row is None else replace(item, made=row["sha256"])

    def is_done(self, item: _Item, settings: _Settings) -> bool:
        row = self.rows.get(item.output)
        if row is None or row["error"] or row["input"] != item.input:
            return False
        # Older tables have a fourth setting, whether it was compared.
        if json.loads(row["settings"])[:3] != json.loads(settings.text()):
            return False
        if settings.compare and row["hts"] is None:
            return False
        if (row["input_bytes"], row["input_time"]) != (item.bytes, item.time):
            return False
        return bool(_about(item.output)[0] == row["bytes"])

    def add(self, rows: Sequence[dict[str, Any]]) -> None:
        kept = [self._with_known(row) for row in rows]
        self.rows.update({row["output"]: row for row in kept})
        self._new.extend(kept)
        if time.monotonic() - self._written > _PART_SECONDS:
            self._write(f"{self._folder}/{_PARTS}/part-{self._number:06}.parquet", self._new)
            self._number += 1
            self._new = []
            self._written = time.monotonic()

    def _with_known(self, row: dict[str, Any]) -> dict[str, Any]:
        """A row with what an earlier one says of the clip that is still there: all of it after an error, the measures
        where the clip and its sound are the same."""
        before = self.rows.get(row["output"])
        if before is None or before["input"] != row["input"]:
            return row
        if row["error"]:
            return {**before, "error": row["error"], "where": row["where"]}
        same = ("input_bytes", "input_time", "sha256")
        if row["hts"] is None and all(row[name] == before[name] for name in same):
            return {**row, "match": before["match"], "hts": before["hts"]}
        return row

    def _write(self, path: str, rows: Sequence[dict[str, Any]]) -> Any:
        table = self._arrow.Table.from_pylist(list(rows), schema=self._schema)
        sink = self._arrow.BufferOutputStream()
        self._parquet.write_table(table, sink)
        data = sink.getvalue().to_pybytes()
        _write(self._system.unstrip_protocol(path) if _is_url(self._output) else path, data)
        return table

    def finish(self, outputs: Sequence[str]) -> Any:
        """The table of what was asked for, in the order of its inputs; what other runs made stays in the file."""
        everything = sorted(self.rows.values(), key=lambda row: str(row["input"]))
        self._write(f"{self._folder}/{TABLE}", everything)
        if self._parts():
            self._system.rm(f"{self._folder}/{_PARTS}", recursive=True)
        wanted = set(outputs)
        rows = [row for row in everything if row["output"] in wanted]
        return self._arrow.Table.from_pylist(rows, schema=self._schema)


def encode(
    sounds: Union[PathLike, Iterable[PathLike]],
    output: PathLike,
    *,
    format: str = "packed",
    address: Optional[str] = None,
    compare: bool = False,
    overwrite: bool = False,
    batch: int = 32,
    retries: int = 3,
    progress: Progress = None,
    **options: Any,
) -> Any:
    """Encodes sounds on the machines of a Ray cluster.

    A run that was stopped is taken up by calling it again: clips that are up to date are left alone, with their
    measures. A sound that fails keeps the figures of the clip that is still there.

    Parameters
    ----------
    sounds : path, URL, or list of these
        A folder, a file or several files.
    output : path or URL
        Folder of the clips.
    address : str, optional
        Address of the cluster, such as ``"auto"`` or ``"ray://host:10001"`` [the one that this program is connected to,
        else this machine alone].
    format : str
        Name of one of :func:`pacini.formats`.
    compare : bool, default False
        Render each clip and compare it with its sound.
    overwrite : bool, default False
        Replace files that are not clips of this sound as Pacini made them. A sound is never replaced.
    batch : int, default 32
        Sounds in one task. At most two batches wait for each processor, so that memory does not depend on the number
        of sounds.
    retries : int, default 3
        How often the batch of a worker that died is tried again. Then its sounds are tried one by one, and the one
        that kills workers has an error.
    progress : bool or callable, optional
        As of :func:`pacini.encode`.
    **options
        As of :func:`pacini.encode`. Errors in them are raised before anything is done.

    Returns
    -------
    pyarrow.Table
        A row for each sound, also written as ``run.parquet`` into the folder: size, SHA-256, duration, breakpoints and
        events of the clip, `match` and `hts` if compared, seconds of work, and `error` with `where` for a sound that
        failed; the others go on.

    Raises
    ------
    Error
        An option, a folder or the cluster is not usable.
    """
    ray = _module("ray", "pacini.ray")
    arrow = _module("pyarrow", "the table of pacini.ray")
    if batch < 1 or retries < 0:
        raise Error("must be 1 or more" if batch < 1 else "must be 0 or more", "batch" if batch < 1 else "retries")
    known = {each.name: each for each in pacini.formats() if each.is_written}
    if format not in known:
        raise Error(f"is {format!r}; must be one of {', '.join(known)}", "format")
    target = os.fsdecode(output)
    if options.get("settings") is not None:  # by content: workers may not see the file
        try:
            options["settings"] = json.loads(settings_text(options["settings"]))
        except ValueError as error:
            raise Error(f"is no JSON ({error})", "settings") from None
    given = {name: value for name, value in options.items() if value is not None}
    check_options("encode", given)
    settings = _Settings(format, given, compare, overwrite)
    items = _items(sounds, target, known[format].extension)
    record = _Record(target, arrow)
    todo = [record.made(item) for item in items if not record.is_done(item, settings)]
    if todo:
        if not ray.is_initialized():
            ray.init(address=address, log_to_driver=False, include_dashboard=False)
        for _ in counted(_run(ray, todo, settings, batch, retries, record), len(todo), progress, "encoding"):
            pass
    return record.finish([item.output for item in items])


def _run(
    ray: Any, todo: Sequence[_Item], settings: _Settings, batch: int, retries: int, record: _Record
) -> Iterator[str]:
    """Yields each sound that is done."""
    work = ray.remote(num_cpus=1, max_retries=retries)(_encode_batch)
    waiting = _batches(todo, batch)
    alone: list[_Item] = []  # of batches that killed their workers
    running: dict[Any, list[_Item]] = {}
    try:
        while True:
            room = 2 * max(1, int(ray.cluster_resources().get("CPU", 1)))
            while len(running) < room:
                items = next(waiting, None) or ([alone.pop()] if alone else None)
                if items is None:
                    break
                running[work.remote(items, settings)] = items
            if not running:
                return
            done, _ = ray.wait(list(running), num_returns=1)
            for reference in done:
                items = running.pop(reference)
                try:
                    rows = ray.get(reference)
                except ray.exceptions.RayError as error:
                    if len(items) > 1:
                        alone.extend(items)
                        continue
                    row: dict[str, Any] = dict.fromkeys(_COLUMNS)
                    row.update(input=items[0].input, output=items[0].output, settings=settings.text())
                    row["error"] = f"a worker ended while it was encoded ({type(error).__name__})"
                    rows = [row]
                record.add(rows)
                yield from (str(row["input"]) for row in rows)
    finally:
        for reference in running:
            ray.cancel(reference, force=True)


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """``python -m pacini.ray``: 0 all is well, 1 some sounds failed, 2 wrong arguments."""
    parser = argparse.ArgumentParser(prog="python -m pacini.ray", description="Encodes sounds on a Ray cluster.")
    parser.add_argument("sounds", nargs="+", help="a folder, or files; URLs of fsspec too")
    parser.add_argument("-o", "--output", required=True, help="folder for the clips and run.parquet")
    parser.add_argument("--address", help="of the cluster, such as auto; default: this machine alone")
    parser.add_argument("--format", default="packed", help="of the clips (packed)")
    parser.add_argument("--compare", action="store_true", help="measure each clip: match and hts in the table")
    parser.add_argument("--overwrite", action="store_true", help="replace what Pacini did not make as it is there")
    parser.add_argument("--batch", type=int, default=32, help="sounds that a worker gets at a time (32)")
    parser.add_argument("--retries", type=int, default=3, help="after the death of a worker (3)")
    parser.add_argument("-q", "--quiet", action="store_true", help="no progress")
    for name in ("method", "preset", "settings"):
        parser.add_argument(f"--{name}", help="as of pacini encode")
    kinds: dict[str, Callable[[str], Any]] = {"number": float, "whole": int, "choice": str}
    for one in ENCODE.values():
        if one["kind"] == "truth":
            parser.add_argument(one["option"], action="store_const", const=True, help=one["text"])
        else:
            parser.add_argument(one["option"], type=kinds[one["kind"]], help=one["text"])
    for name in ("allow-nan", "allow-truncated"):
        parser.add_argument(f"--{name}", action="store_const", const=True, help="as of pacini encode")
    wanted = vars(parser.parse_args(arguments))
    sounds, quiet = wanted.pop("sounds"), wanted.pop("quiet")
    if wanted["method"] is None:
        del wanted["method"]
    try:
        table = encode(sounds[0] if len(sounds) == 1 else sounds, progress=not quiet, **wanted)
    except Error as error:
        print(f"pacini: {error}", file=sys.stderr)
        return 2
    failed = [row for row in table.to_pylist() if row["error"]]
    for row in failed:
        print(f"pacini: {row['input']}: {row['error']}", file=sys.stderr)
    print(f"{table.num_rows - len(failed)} encoded{f', {len(failed)} failed' if failed else ''}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
