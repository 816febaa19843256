"""A stiffness matrix of a support, as a rotor or a finite element program gives it."""

from collections.abc import Iterator
from typing import Literal

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.input.quantity import Number
from tribodyn.numerics.shapes import Array, Float

Rows = tuple[tuple[Number, ...], ...] | None
MatrixUnits = Literal["N, m, rad", "N, mm, rad"] | None
_ROWS = 6
#: Difference of two elements that should be equal, and a negative eigenvalue, over the largest: of printed
#: digits.
_PRINTED = 1e-3
EXAMPLE = "six rows of six numbers: x, y, z, tilts about x and y, rotation about z"


def matrix_of(rows: tuple[tuple[float, ...], ...], unit: str | None) -> tuple[tuple[float, ...], ...]:
    """Return the five by five matrix of a table that breaks no rule, N/m, N and N m/rad; symmetric."""
    matrix = _in_si(rows, unit)[:5, :5]
    return tuple(map(tuple, ((matrix + matrix.T) / 2.0).tolist()))


def _in_si(rows: tuple[tuple[float, ...], ...], unit: str | None) -> Float[Array, "6 6"]:
    """N/mm to N/m, N mm/mm (a moment over a displacement) is N, N mm/rad to N m/rad."""
    metre = 1e-3 if unit == "N, mm, rad" else 1.0
    length = np.array([1.0, 1.0, 1.0, metre, metre, metre])  # forces and moments
    return np.array(rows) * length[:, None] / np.array([metre, metre, metre, 1.0, 1.0, 1.0])


def broken_matrix(
    key: str, rows: tuple[tuple[float, ...], ...] | None, unit: str | None
) -> Iterator[InputError]:
    """Go through what is wrong with a matrix at a key, and its units beside it; the first of it alone."""
    if rows is None:
        if unit is not None:
            rule, remedy = "has no effect without matrix", "add the matrix, or leave it out"
            yield InputError(f"{key}_units", quoted(unit), rule, remedy)
        return
    if unit is None:
        rule = "missing: a matrix has no meaning without its units"
        yield InputError(f"{key}_units", rule=rule, remedy=f'add {_last(key)}_units = "N, m, rad"')
        return
    if len(rows) != _ROWS or any(len(row) != _ROWS for row in rows):
        shown = f"{len(rows)} rows of {', '.join(sorted({str(len(row)) for row in rows}))}"
        yield InputError(key, shown, "must be six by six", f"write {EXAMPLE}")
        return
    matrix = np.array(rows)
    if np.any(matrix[5]) or np.any(matrix[:, 5]):
        rule = "holds the rotation about z: that is the drive's, and bearings let it turn"
        yield InputError(key, None, rule, "write zeros in the sixth row and the sixth column")
        return
    scale = np.sqrt(np.abs(np.diag(matrix)))[:5]
    size = np.where(scale > 0.0, scale, 1.0)
    scaled = matrix[:5, :5] / np.outer(size, size)  # the signs of the diagonal are looked at below
    apart = np.abs(scaled - scaled.T)
    if np.max(apart) > _PRINTED * max(1.0, float(np.max(np.abs(scaled)))):
        i, j = (int(place) for place in np.unravel_index(np.argmax(apart), apart.shape))
        rule = (
            f"is not symmetric: {matrix[i, j]:g} in row {i + 1} and column {j + 1}, "
            f"{matrix[j, i]:g} in row {j + 1} and column {i + 1}"
        )
        remedy = "write the symmetric part: linear springs have no other, and that of oil films is not taken"
        yield InputError(key, None, rule, remedy)
        return
    lowest = float(np.min(np.linalg.eigvalsh((scaled + scaled.T) / 2.0)))
    if lowest < -_PRINTED:
        rule = "is not positive semi-definite: it pushes the gear away from rest in some direction"
        yield InputError(key, None, rule, "check signs and units: tilts are right-handed, dx/dz = +tilt_y")


def _last(key: str) -> str:
    return key.rpartition(".")[2]
