"""Simplification of curves: few breakpoints for many."""

from __future__ import annotations

from typing import Optional

import numpy as np
import numpy.typing as npt

from . import _native
from ._errors import Error

SIMPLIFIERS = ("visvalingam", "douglas-peucker", "optimal", "streaming", "lagrangian")


def simplify(
    times: npt.ArrayLike,
    values: npt.ArrayLike,
    count: Optional[int] = None,
    error: Optional[float] = None,
    *,
    method: str = "lagrangian",
    refit: bool = False,
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Times and values of at most `count` points, or within `error` of the curve (vertically), or both.

    `method` is one of :data:`SIMPLIFIERS`: removal by triangle area, splitting at the largest deviation, the least
    largest error (slow), one pass, and the least squared error, which is what the encoder uses. With `refit` values are
    fitted by least squares.
    """
    x = np.asarray(times, np.float64)
    y = np.asarray(values, np.float64)
    if x.ndim != 1 or x.shape != y.shape:
        raise Error("must be as many as the values, in one dimension", "times")
    if count is not None and count < 0:
        raise Error("must be a number of points", "count")
    rows = np.ascontiguousarray(np.stack([x, y], axis=1))
    kept = np.asarray(_native.simplify_rows(rows, method, count, error, refit))
    return kept[:, 0], kept[:, 1]
