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
    """Simplifies a curve: few breakpoints for many.

    Parameters
    ----------
    times, values : array_like, (n,)
        The curve; times must not fall.
    count : int, optional
        Largest number of points.
    error : float, optional
        Largest vertical distance from the curve, in the unit of the values. Both limits hold where both are given.
    method : str, default "lagrangian"
        One of :data:`SIMPLIFIERS`: ``"visvalingam"`` removes by triangle area, ``"douglas-peucker"`` splits at the
        largest deviation, ``"optimal"`` has the least largest error (slow), ``"streaming"`` needs one pass,
        ``"lagrangian"``, the encoder's, has the least squared error.
    refit : bool, default False
        Fit the values of the points that are kept by least squares.

    Returns
    -------
    times, values : array of float64, (m,)

    Raises
    ------
    Error
        The curve is not one, or neither limit is given.
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
