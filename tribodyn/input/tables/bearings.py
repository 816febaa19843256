"""Shafts and bearings (`models/bearings/`): their tables, rules, and what the dynamics read of them."""

import math
from collections.abc import Collection, Iterator
from typing import Annotated, Literal, cast

import numpy as np
from pydantic import Field

from tribodyn.dynamics.data import ROLLERS, BearingData, BearingType, RollingBearing, radial_stiffness
from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.geometry.drive import SIDES
from tribodyn.input import units
from tribodyn.input.quantity import Count, InUnit, NotNegative, Number, Table, written
from tribodyn.input.tables.gears.model_files import OWN_VALUES, Described
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


Stiffness = Annotated[float, InUnit(units.positive(units.STIFFNESS))]
#: Name of the bearings of all that no table names.
DEFAULT = "default"
#: Contact angle from which a bearing carries no radial load to speak of.
MAXIMUM_CONTACT_ANGLE = math.radians(60.0)


class Rolling(Table):
    """The rolling bearings of a shaft, from whose type, size and load the stiffness follows."""

    type: BearingType
    elements: Annotated[int, Field(strict=True, ge=3, le=1000)]
    diameter: Annotated[float, InUnit(units.positive(units.LENGTH), "12 mm")] | None = None
    length: Annotated[float, InUnit(units.positive(units.LENGTH), "12 mm")] | None = None
    contact_angle: Annotated[float, InUnit(units.not_negative(units.ANGLE_KIND), "15 deg")] = written("0 deg")
    radial_load: Annotated[float, InUnit(units.positive(units.FORCE))]
    count: Count = 2


class Bearing(Table):
    """Shaft and bearing of one gear: stiffness given, or from the rolling bearings alone."""

    stiffness_x: Stiffness | None = None
    stiffness_y: Stiffness | None = None
    rolling: Rolling | None = None
    stiffness_axial: Stiffness | None = None
    stiffness_tilt: Annotated[float, InUnit(units.positive(units.TORSIONAL_STIFFNESS))] | None = None
    span: Annotated[float, InUnit(units.positive(units.LENGTH), "100 mm")] | None = None
    matrix: Rows = None
    matrix_units: MatrixUnits = None
    damping_ratio: NotNegative | None = None
    damping_ratio_x: NotNegative | None = None
    damping_ratio_y: NotNegative | None = None


class Bearings(Described, extra="allow"):
    """Bearings by what they carry: a gear, a shaft or a body, or "default" (`models/bearings/`).

    Those of a planet are between every planet and its pin on the carrier.
    """

    __pydantic_extra__: dict[str, Bearing]  # pyright: ignore[reportIncompatibleVariableOverride]

    @property
    def by_name(self) -> dict[str, Bearing]:
        """The bearings by the names under which they stand."""
        return dict(self.__pydantic_extra__ or {})

    def of(self, name: str) -> Bearing | None:
        """The bearings of that name, else those of all that none names; None: none."""
        return self.by_name.get(name, self.by_name.get(DEFAULT))

    @property
    def written_out(self) -> bool:
        """Whether these are a scenario's own numbers, not those of a class or a file."""
        return self.title == OWN_VALUES


def bearing_of(bearing: Bearing) -> BearingData:
    """Return stiffness and damping of one bearing that breaks no rule."""
    ratio_x = bearing.damping_ratio if bearing.damping_ratio_x is None else bearing.damping_ratio_x
    ratio_y = bearing.damping_ratio if bearing.damping_ratio_y is None else bearing.damping_ratio_y
    stiffness_x, stiffness_y = bearing.stiffness_x, bearing.stiffness_y
    if bearing.matrix is not None:
        ratio = cast(float, bearing.damping_ratio)
        return BearingData.of_matrix(matrix_of(bearing.matrix, bearing.matrix_units), ratio)
    if bearing.rolling is not None:
        numbers = bearing.rolling.model_dump()
        sizes = {name: numbers[name] or 0.0 for name in ("diameter", "length")}
        stiffness_x = stiffness_y = radial_stiffness(RollingBearing(**{**numbers, **sizes}))
    return BearingData(
        cast(float, stiffness_x),
        cast(float, stiffness_y),
        cast(float, ratio_x),
        cast(float, ratio_y),
        bearing.stiffness_axial,
        bearing.stiffness_tilt,
        bearing.span,
    )


def broken_bearing_rules(bearings: Bearings, drawn_sides: Collection[str] = ()) -> Iterator[InputError]:
    """Go through what is wrong with the bearings of a pair of gears, and what is missing.

    Nothing is missing of gears whose shafts are `drawn_sides`.
    """
    yield from broken_bearings(bearings, [*SIDES, DEFAULT], "gear")
    if {*SIDES, DEFAULT} <= set(bearings.by_name):
        rule = "has no effect: pinion and gear have bearings of their own"
        yield InputError(f"bearings.{DEFAULT}", None, rule, "write [bearings.pinion] and [bearings.gear]")
    for side in SIDES:
        if side not in drawn_sides and bearings.of(side) is None:
            remedy = (
                f"add [bearings.{side}] with stiffness_x, stiffness_y and damping_ratio, or [shaft.{side}]"
            )
            yield InputError(f"bearings.{side}", rule="missing", remedy=remedy)


def broken_bearings(bearings: Bearings, known: Collection[str], what: str) -> Iterator[InputError]:
    """Go through what is wrong with bearings, which carry something `known`; a file's are those of a pair."""
    for name, bearing in bearings.by_name.items():
        if name not in known and name not in SIDES:
            yield unknown_name(f"bearings.{name}", name, known, what)
        yield from broken_bearing(f"bearings.{name}", bearing)


def broken_bearing(key: str, bearing: Bearing) -> Iterator[InputError]:
    """Go through what is missing in the bearing at a key, or given twice."""
    yield from broken_matrix(f"{key}.matrix", bearing.matrix, bearing.matrix_units)
    if bearing.matrix is not None:
        yield from _broken_with_matrix(key, bearing)
        return
    for name in ("stiffness_x", "stiffness_y"):
        stiffness = getattr(bearing, name)
        if bearing.rolling is None and stiffness is None:
            remedy = f'add {name} = "1e9 N/m", or the table [{key}.rolling]'
            yield InputError(f"{key}.{name}", rule="missing", remedy=remedy)
        elif bearing.rolling is not None and stiffness is not None:
            rule = f"contradicts [{key}.rolling], from which it follows"
            yield InputError(f"{key}.{name}", f"{stiffness:g} N/m", rule, "give the one or the other")
    if bearing.stiffness_tilt is not None and bearing.span is not None:
        rule = "contradicts stiffness_tilt, which stands in its place"
        yield InputError(f"{key}.span", f"{1e3 * bearing.span:g} mm", rule, "give the one or the other")
    if bearing.rolling is not None:
        yield from _broken_rolling(f"{key}.rolling", bearing.rolling)
    each = (bearing.damping_ratio_x, bearing.damping_ratio_y)
    if bearing.damping_ratio is not None and any(ratio is not None for ratio in each):
        rule = "contradicts damping_ratio_x and damping_ratio_y"
        remedy = "write the one for both axes, or both of the others"
        yield InputError(f"{key}.damping_ratio", bearing.damping_ratio, rule, remedy)
    elif bearing.damping_ratio is None and any(ratio is None for ratio in each):
        remedy = "add damping_ratio = 0.05, for both axes"
        yield InputError(f"{key}.damping_ratio", rule="missing", remedy=remedy)


def _broken_with_matrix(key: str, bearing: Bearing) -> Iterator[InputError]:
    """What a matrix says already, and the damping that it lacks."""
    for name in type(bearing).model_fields:
        if name.startswith(("matrix", "damping_ratio")) or getattr(bearing, name) is None:
            continue
        rule = "contradicts matrix, which has all of the stiffness"
        yield InputError(f"{key}.{name}", None, rule, "give the one or the other")
    for name in ("damping_ratio_x", "damping_ratio_y"):
        if getattr(bearing, name) is not None:
            rule = "has no meaning with a matrix, whose motions are not along the axes"
            yield InputError(f"{key}.{name}", None, rule, "write damping_ratio = 0.05, of all of them")
    if bearing.damping_ratio is None:
        yield InputError(f"{key}.damping_ratio", rule="missing", remedy="add damping_ratio = 0.05")


def _broken_rolling(key: str, rolling: Rolling) -> Iterator[InputError]:
    needed, other = ("length", "diameter") if rolling.type in ROLLERS else ("diameter", "length")
    if getattr(rolling, needed) is None:
        rule = f'missing: type = "{rolling.type}" needs it'
        yield InputError(f"{key}.{needed}", rule=rule, remedy=f'add {needed} = "12 mm"')
    if getattr(rolling, other) is not None:
        yield InputError(
            f"{key}.{other}", rule=f'has no effect with type = "{rolling.type}"', remedy=f"leave {other} out"
        )
    if rolling.contact_angle >= MAXIMUM_CONTACT_ANGLE:
        remedy = "write a smaller angle, or give stiffness_x and stiffness_y"
        yield InputError(f"{key}.contact_angle", rule="60 deg or more: a thrust bearing", remedy=remedy)
