"""Bearings of drawn shafts: their loads, rating lives and losses, and the tilts of the gears."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from tribodyn.gears.case import GearCase
from tribodyn.gears.supports import BearingUnderLoad, GearSupport
from tribodyn.geometry.drive import SIDES
from tribodyn.input.tables.drawn_bearings import BearingOfShaft, friction_data, held_by, sized
from tribodyn.quantities.catalogue import GROUPS
from tribodyn.quantities.quantity import Quantity
from tribodyn.standards.rolling_bearings import (
    BALLS,
    STATIC_FACTOR,
    basic_life,
    equivalent_load,
    fatigue_load_limit,
    life_factor,
    life_of_rows,
    reference_life_of_balls,
    reference_life_of_rollers,
    reference_viscosity,
    row_rating,
    running_time,
    static_load,
)
from tribodyn.train.elastic.rolling_bearing import BallRow, BearingRows, outer_conformity
from tribodyn.tribology.losses.loss import oil_state
from tribodyn.tribology.losses.palmgren import DRAG_FACTORS, palmgren
from tribodyn.tribology.oil import LubricantData


class RatedBearing(NamedTuple):
    """A rolling bearing with its numbers by the names of the catalogue, and what is to be said of it."""

    name: str  # pinion-1 is the first one of the pinion's shaft
    numbers: dict[str, float]
    remarks: tuple[str, ...]


class TurningShaft(NamedTuple):
    """A drawn shaft, if it is one, at its speed."""

    name: str
    held: GearSupport | None
    speed: float  # rad/s


def shafts_of_pair(case: GearCase) -> tuple[TurningShaft, ...]:
    """The shafts of a pair."""
    ratio = abs(float(case.drive.pinion.teeth / case.drive.gear.teeth))
    return tuple(
        TurningShaft(side, held, case.operating.pinion_speed * (1.0 if side == "pinion" else ratio))
        for side, held in zip(SIDES, case.supports[:2], strict=True)
    )


def rated_bearings(
    shafts: Sequence[TurningShaft], oil: LubricantData | None = None
) -> Iterator[RatedBearing]:
    """Go through the bearings of drawn shafts, under the mean loads of their meshes.

    Lives need a speed and C; losses the oil besides, and C_0 of balls. What is missing is left out and said.
    """
    for name, held, speed in shafts:
        for number, bearing in enumerate(held.bearings if held is not None else (), start=1):
            yield _rated(f"{name}-{number}", bearing, speed, oil)


def _rated(name: str, bearing: BearingUnderLoad, speed: float, oil: LubricantData | None) -> RatedBearing:
    table, force = sized(bearing.table), bearing.force
    radial, axial = math.hypot(force[0], force[1]), abs(force[2])
    numbers = {"radial_load": radial, "axial_load": axial, "tilting_moment": math.hypot(force[3], force[4])}
    if table.type is None:  # springs and matrices have no life
        return RatedBearing(name, numbers, ())
    remarks = []
    angle, factor = table.contact_angle or 0.0, table.static_factor or STATIC_FACTOR
    equivalent = equivalent_load(
        table.type,
        radial,
        axial,
        static_rating=table.static_rating,
        static_factor=factor,
        contact_angle=angle,
        rows=table.thrust_rows,
    )
    numbers["equivalent_load"] = equivalent.load
    if table.static_rating is not None:
        static = static_load(table.type, radial, axial, contact_angle=angle, rows=table.thrust_rows)
        numbers |= {"static_safety": table.static_rating / static} if static > 0.0 else {}
        if static > table.static_rating:
            remarks.append(
                f"Bearing {name}: the static load is above C_0: elements dent the raceways (ISO 76)."
            )
    if table.dynamic_rating is None:
        remarks.append(f"Bearing {name}: no life without dynamic_rating, C of its catalogue.")
    elif speed > 0.0 and equivalent.load > 0.0:
        life = basic_life(table.type, table.dynamic_rating, equivalent.load)
        numbers["rating_life"] = running_time(life, speed)
        numbers |= _modified(table, equivalent.load, speed, numbers["rating_life"], oil)
        numbers["reference_life"] = running_time(_reference_life(bearing), speed)
        if table.contamination_factor is not None and "modified_life" not in numbers and oil is not None:
            needed = "fatigue_load_limit, C_u, or static_rating, C_0 of its catalogue"
            remarks.append(f"Bearing {name}: no modified life without {needed}.")
    if table.type in BALLS and table.static_rating is None:
        by_load = table.type == "deep-groove-ball" or (
            table.type == "angular-contact-ball" and angle < math.radians(20.0)
        )
        rest = ", and P with the largest Y" if by_load else ""
        remarks.append(
            f"Bearing {name}: without static_rating, C_0 of its catalogue, no static safety and loss{rest}."
        )
    in_oil = friction_data(bearing.table)
    if oil is not None and speed > 0.0 and in_oil is not None and table.type in DRAG_FACTORS:
        if table.static_rating is not None or table.type not in BALLS:
            torque = palmgren(in_oil, speed, oil_state(oil), radial, axial)
            numbers["power_bearing"] = float(torque.idle + torque.loaded) * speed
    return RatedBearing(name, numbers, tuple(remarks))


def _modified(
    table: BearingOfShaft, load: float, speed: float, life: float, oil: LubricantData | None
) -> dict[str, float]:
    """κ, a_ISO and the modified life (s); what cannot be told is left out."""
    if oil is None or not table.pitch_diameter or table.type is None:
        return {}
    ratio = float(oil.inlet_viscosity / oil.density) / reference_viscosity(table.pitch_diameter, speed)
    limit, quantities = table.fatigue_load_limit, {"viscosity_ratio": ratio}
    if limit is None and table.static_rating is not None:
        limit = fatigue_load_limit(table.type, table.static_rating, table.pitch_diameter)
    if table.contamination_factor is None or limit is None:
        return quantities
    factor = life_factor(table.type, ratio, table.contamination_factor * limit / load)
    return quantities | {"life_factor": factor, "modified_life": factor * life}


def _reference_life(bearing: BearingUnderLoad) -> float:
    """L_10r, revolutions, by the loads of the rolling elements."""
    table: Any = sized(bearing.table)
    rows = _rows(table)
    rating = row_rating(table.type, table.dynamic_rating, len(rows))
    sizes = rating, table.element_diameter, table.pitch_diameter, table.contact_angle or 0.0
    lives = []
    for number, row in enumerate(rows):
        loads = bearing.loads[number * table.elements : (number + 1) * table.elements]
        if isinstance(row, BallRow):
            grooves = row.conformity, outer_conformity(row)
            lives.append(reference_life_of_balls([load for (load,) in loads], *sizes, *grooves))
        else:
            lives.append(reference_life_of_rollers(loads, *sizes))
    return life_of_rows(table.type, lives)


def _rows(table: BearingOfShaft) -> tuple[Any, ...]:
    """Rows of a rolling bearing."""
    held = held_by(table)
    return held.rows if isinstance(held, BearingRows) else (held,)


def bearing_part(shafts: Sequence[TurningShaft], oil: LubricantData | None = None) -> dict[str, Any]:
    """What a summary has of drawn shafts: ``bearings``, by their names; nothing where none is drawn."""
    bearings = {bearing.name: bearing.numbers for bearing in rated_bearings(shafts, oil)}
    return {"bearings": bearings} if bearings else {}


def bearing_rows(
    rated: Mapping[str, Mapping[str, Any]], quantities: Sequence[Quantity] = GROUPS["bearings"]
) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Heading and rows of a table of bearings, as `bearing_part` has them, or others; "–": not determined."""
    shown = [one for one in quantities if any(one.name in numbers for numbers in rated.values())]
    rows = [
        (name, *(one.written(numbers[one.name]) if one.name in numbers else "–" for one in shown))
        for name, numbers in rated.items()
    ]
    return ("", *(f"{one.symbol or one.label}{f' ({one.unit})' if one.unit else ''}" for one in shown)), rows


def bearing_remarks(shafts: Sequence[TurningShaft], oil: LubricantData | None = None) -> list[str]:
    """What is missing of the bearings' data, and what their numbers leave out."""
    rated = list(rated_bearings(shafts, oil))
    remarks = [remark for bearing in rated for remark in bearing.remarks]
    if any("equivalent_load" in bearing.numbers for bearing in rated):
        remarks.append(
            "Bearings: under the mean load of the duty, without application and dynamic factor; basic rating "
            "life L_10h without the influence of oil, cleanness and misalignment, L_10mh with those of oil "
            "and cleanness, L_10rh with clearance and misalignment; in the efficiency are losses of [losses]."
        )
    return remarks


def opening_part(case: GearCase, width: float) -> dict[str, float]:
    """Misalignment over the common face (m), of drawn shafts and matrices, and of the scenario besides."""
    if case.supports.pinion is None and case.supports.gear is None:
        return {}
    by_shafts = case.supports.misalignment.in_plane
    whole = case.mesh.modifications.misalignment.in_plane
    return {"shaft_misalignment": by_shafts * width, "given_misalignment": (whole - by_shafts) * width}
