"""Bearings of drawn shafts: rolling bearings by type and size, springs, matrices."""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field

from tribodyn.input import units
from tribodyn.input.quantity import InUnit, Positive, Switch, Table, Text, written
from tribodyn.input.tables.bearings import MatrixUnits, Rows, Stiffness, matrix_of
from tribodyn.standards.rolling_bearings import static_factors
from tribodyn.train.elastic.bearing_sizes import NEEDLE, PROPORTIONS, estimated
from tribodyn.train.elastic.bearing_types import (
    Arrangement,
    four_point,
    paired,
    preload_of_force,
    self_aligning_balls,
    spherical_rollers,
    toroidal_rollers,
)
from tribodyn.train.elastic.rolling_bearing import BallRow, BearingRows, RollerRow
from tribodyn.train.elastic.system import Matrix
from tribodyn.tribology.losses.bearings import BearingInOil

Size = Annotated[float, InUnit(units.positive(units.LENGTH), "30 mm")]
Place = Annotated[float, InUnit(units.not_negative(units.LENGTH), "20 mm")]
Fit = Annotated[float, InUnit(units.DEVIATION, "10 um")]
Rating = Annotated[float, InUnit(units.positive(units.FORCE), "30 kN")]


def _designation(value: object) -> object:
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


#: Series of dimensions as catalogues name it: "63", 222, "C31".
Series = Annotated[Text, BeforeValidator(_designation)]
DrawnType = Literal[
    "deep-groove-ball",
    "angular-contact-ball",
    "four-point-contact-ball",
    "self-aligning-ball",
    "cylindrical-roller",
    "needle-roller",
    "tapered-roller",
    "spherical-roller",
    "toroidal-roller",
]
#: Sizes of the inside of a bearing with balls, and with rollers; those from which it is estimated instead.
SIZES = ("elements", "element_diameter", "pitch_diameter")
ROLLER_SIZES = (*SIZES, "roller_length")
OF_CATALOGUE = ("bore", "outside_diameter")
#: Types that always have two rows; catalogues rate four points of contact as two rows.
_TWO_ROWS = ("self-aligning-ball", "spherical-roller", "four-point-contact-ball")
#: Springs along x, y and z, and about x and y.
SPRINGS = ("stiffness_x", "stiffness_y", "stiffness_axial", "stiffness_tilt")


class BearingOfShaft(Table):
    """A bearing of a shaft: a rolling bearing by type and size, springs, or a matrix."""

    position: Place
    type: DrawnType | None = None
    bore: Size | None = None
    outside_diameter: Size | None = None
    elements: Annotated[int, Field(strict=True, ge=3, le=1000)] | None = None
    element_diameter: Size | None = None
    pitch_diameter: Size | None = None
    roller_length: Size | None = None
    contact_angle: Annotated[float, InUnit(units.positive(units.ANGLE_KIND), "14 deg")] | None = None
    thrust: Literal["+z", "-z"] | None = None
    arrangement: Arrangement | None = None
    rows: Literal[1, 2] | None = None
    row_distance: Size | None = None
    raceway_radius: Size | None = None
    clearance: Fit = written("0 um")
    preload: Fit = written("0 um")
    preload_force: Rating | None = None
    locating: Switch = True
    force: Literal["linear", "in-time"] = "linear"
    seat: Text | None = None
    dynamic_rating: Rating | None = None
    static_rating: Rating | None = None
    fatigue_load_limit: Rating | None = None
    contamination_factor: Annotated[float, Field(strict=True, gt=0, le=1)] | None = None
    static_factor: Positive | None = None
    series: Series | None = None
    stiffness_x: Stiffness | None = None
    stiffness_y: Stiffness | None = None
    stiffness_axial: Stiffness | None = None
    stiffness_tilt: Annotated[float, InUnit(units.positive(units.TORSIONAL_STIFFNESS))] | None = None
    matrix: Rows = None
    matrix_units: MatrixUnits = None

    @property
    def thrust_rows(self) -> int:
        """Rows that share a radial load and take thrust both ways, as ISO 281 counts them: 2 of O and X."""
        return 2 if self.arrangement in ("O", "X") else 1


def sized(table: BearingOfShaft) -> BearingOfShaft:
    """The bearing with the sizes of its inside, estimated where the table has the catalogue's alone."""
    if table.type is None or None in (table.bore, table.outside_diameter, table.static_rating):
        return table
    bore, outside, rating = table.bore or 0.0, table.outside_diameter or 0.0, table.static_rating or 0.0
    rows = 2 if table.arrangement is not None or table.rows == 2 or table.type in _TWO_ROWS else 1
    found = estimated(table.type, bore, outside, rating, min(table.contact_angle or 0.0, 1.0), rows)
    inside: dict[str, Any] = dict(zip(ROLLER_SIZES, found, strict=True))
    return table.model_copy(update={**inside, "bore": None, "outside_diameter": None})


def friction_data(table: BearingOfShaft) -> BearingInOil | None:
    """A rolling bearing as the formulas of its friction take it; None: springs, or a matrix.

    Where the inside is given, bore and outside diameter follow from it by the usual proportions.
    """
    inside = sized(table)
    if table.type is None or inside.pitch_diameter is None:
        return None
    pair = table.arrangement is not None or table.rows == 2
    angle, pitch = table.contact_angle or 0.0, inside.pitch_diameter
    height = (inside.element_diameter or 0.0) / PROPORTIONS.get(table.type, NEEDLE)
    return BearingInOil(
        table.type,
        pitch,
        rows=2 if pair else 1,
        both_ways=table.thrust_rows == 2,
        contact_angle=angle,
        static_rating=table.static_rating,
        static_factors=static_factors(table.type, contact_angle=angle, rows=table.thrust_rows),
        bore=max(pitch - height, 0.0) if table.bore is None else table.bore,
        outside_diameter=pitch + height if table.outside_diameter is None else table.outside_diameter,
        series=table.series or "",
    )


def held_by(table: BearingOfShaft) -> BallRow | RollerRow | BearingRows | Matrix:
    """A bearing that breaks no rule as the physics takes it."""
    table = sized(table)
    if table.matrix is not None:
        return matrix_of(table.matrix, table.matrix_units)
    if table.type is None:
        x, y, z, tilt = (getattr(table, name) or 0.0 for name in SPRINGS)
        return tuple(map(tuple, np.diag([x, y, z, tilt, tilt]).tolist()))
    sizes: Any = {
        "elements": table.elements,
        "diameter": table.element_diameter,
        "pitch_diameter": table.pitch_diameter,
        "clearance": table.clearance,
        "contact_angle": table.contact_angle or 0.0,
        "thrust": {"+z": 1, "-z": -1, None: 0}[table.thrust],
        "preload": table.preload,
        "located": table.locating,
    }
    if table.type.endswith("ball"):
        balls = BallRow(**sizes)
        if table.type == "four-point-contact-ball":
            return four_point(balls)._replace(sliding=not table.locating)
        return self_aligning_balls(balls) if table.type == "self-aligning-ball" else _pair(balls, table)
    rollers = RollerRow(**sizes, length=table.roller_length or 0.0)
    if table.type == "spherical-roller":
        return spherical_rollers(rollers)
    if table.type == "toroidal-roller":
        return toroidal_rollers(rollers, table.raceway_radius or 0.0)
    return _pair(rollers, table)


def _pair(row: BallRow | RollerRow, table: BearingOfShaft) -> BallRow | RollerRow | BearingRows:
    """One row, or two of them, preloaded."""
    if table.preload_force is not None:
        row = row._replace(preload=preload_of_force(row, table.preload_force))
    if table.arrangement is None and table.rows != 2:
        return row
    pair = paired(row, table.row_distance or 0.0, table.arrangement or "tandem")
    return pair._replace(sliding=not table.locating)
