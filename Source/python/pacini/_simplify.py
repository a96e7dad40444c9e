"""Simplification of curves: few breakpoints for many."""

from __future__ import annotations

from typing import Optional

import numpy as np
import numpy.typing as npt

from . import _native
from ._arguments import checked, numbers
from ._errors import Error

SIMPLIFIERS = ("visvalingam", "douglas-peucker", "optimal", "streaming", "lagrangian")


def points(count: Optional[int]) -> Optional[int]:
    if count is not None and count < 0:
        raise Error("must be a whole number of points", "count")
    return count


@checked
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
    x, y = numbers(times, "times"), numbers(values, "values")
    if len(x) != len(y):
        raise Error("must be as many as the values", "times")
    rows = np.ascontiguousarray(np.stack([x, y], axis=1))
    kept = np.asarray(_native.simplify_rows(rows, method, points(count), error, refit))
    return kept[:, 0], kept[:, 1]
