"""Arrays of sound and of points, as the native module takes them."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from ._arguments import number, refuse_masked
from ._errors import ArgumentError, Error

if TYPE_CHECKING:
    from typing_extensions import TypeIs

FloatArray = npt.NDArray[np.floating[Any]]
Points = npt.NDArray[np.void]
PathLike = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]

AMPLITUDE = np.dtype([("time", np.float64), ("amplitude", np.float64)])
FREQUENCY = np.dtype([("time", np.float64), ("frequency", np.float64)])
_MOST_CHANNELS = 64  # of any sound
TRANSIENT = np.dtype([("time", np.float64), ("amplitude", np.float64), ("sharpness", np.float64)])


def is_path(value: object) -> TypeIs[PathLike]:
    return isinstance(value, (str, bytes, os.PathLike))


def as_sound(samples: object, axis: int, where: str = "sound") -> FloatArray:
    """A view as (frames,) or (channels, frames); `axis` is the one that the frames are on. Never a copy of an array."""
    refuse_masked(samples, where)
    try:
        array = np.asarray(samples)
    except (TypeError, ValueError):  # rows of different lengths
        array = np.asarray(None)
    if array.dtype.kind not in "fiu":
        raise ArgumentError("must be a file or an array of float32 or float64", where)
    if array.dtype not in (np.float32, np.float64) or not array.dtype.isnative:
        full = f": sound / {2 ** (8 * array.itemsize - 1)}" if array.dtype.kind == "i" else ""
        raise Error(f"has samples of {array.dtype}; give float32 or float64 with a full scale of 1{full}", where)
    if array.ndim not in (1, 2):
        raise Error(f"has {array.ndim} dimensions; give (frames,) or (channels, frames)", where)
    if not -array.ndim <= axis < array.ndim:
        raise Error(f"must be one of the {array.ndim} axes of the sound", "axis")
    if any(stride % array.itemsize for stride in array.strides):
        array = array.copy()  # a field of a record: samples are not whole steps apart
    moved = np.moveaxis(array, axis, -1)
    if moved.ndim == 2 and moved.shape[0] > _MOST_CHANNELS >= moved.shape[1]:
        raise Error(
            f"has {moved.shape[0]} channels of {moved.shape[1]} frames; give axis={0 if axis in (-1, 1) else 1} if it "
            "is the other way round",
            where,
        )
    return moved


def as_rate(rate: object, where: str = "sample_rate") -> int:
    """A whole sample rate in Hz."""
    if rate is None:
        raise Error("is needed for sounds in arrays, in Hz", where)
    rate = number(rate, where)
    if not rate.is_integer() or not 0 < rate < 1e9:
        raise Error("must be a whole number of Hz", where)
    return int(rate)


def points_of(rows: npt.NDArray[np.float64], dtype: np.dtype[np.void]) -> Points:
    """Rows of the native module as a structured array, which looks into the same memory."""
    if len(rows) == 0:
        points = np.empty(0, dtype)
        points.flags.writeable = False
        return points
    return rows.view(dtype)[:, 0]


def as_points(points: object, dtype: np.dtype[np.void], where: str) -> Points:
    """Points of any kind that :func:`rows_of` takes as a structured array: their own, where they are one."""
    if isinstance(points, np.ndarray) and points.dtype == dtype and points.ndim == 1:
        return points
    return points_of(rows_of(points, dtype, where), dtype)


def rows_of(points: object, dtype: np.dtype[np.void], where: str) -> npt.NDArray[np.float64]:
    """Points of a structured array, or rows of plain numbers, as the native module takes them."""
    assert dtype.names is not None
    columns = len(dtype.names)
    refuse_masked(points, where)
    try:
        array = np.asarray(points)
        if array.dtype.names is not None:
            if array.ndim != 1 or any(name not in array.dtype.names for name in dtype.names):
                raise Error(f"must have the fields {', '.join(dtype.names)}", where)
            return np.stack([array[name].astype(np.float64) for name in dtype.names], axis=1)
        rows = np.array(points, dtype=np.float64, order="C")
    except (TypeError, ValueError) as error:
        if isinstance(error, Error):
            raise
        raise Error(f"must be points of {', '.join(dtype.names)}", where) from None
    if rows.size == 0:
        return np.empty((0, columns))
    if rows.ndim != 2 or rows.shape[1] != columns:
        raise Error(f"must be points of {', '.join(dtype.names)}", where)
    return rows
