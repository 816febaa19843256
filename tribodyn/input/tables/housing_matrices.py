"""A housing by matrices, ``housing.matrices``: its table, its units, and the super-element that it is."""

from typing import Annotated, Any

import numpy as np
from pydantic import Field

from tribodyn.errors import InputError, broken_list, quoted
from tribodyn.exchange.matrix_files import READERS, read_matrices
from tribodyn.input import units
from tribodyn.input.fields import PartName
from tribodyn.input.quantity import InUnit, Number, Reference, Table, Text
from tribodyn.input.units import NotAQuantity, factor_to_si
from tribodyn.train.elastic.beam_matrices import SIX
from tribodyn.train.elastic.superelement import Radiation, Soundness, SuperElement, modal_damping, sound

KEY = "housing.matrices"
Length = Annotated[float, InUnit(units.LENGTH, "120 mm")]
Matrix = tuple[tuple[Number, ...], ...]
#: Kinds of units of a consistent system, and difference of a force from what mass, length and time make it.
_KINDS = {"length": units.LENGTH, "mass": units.MASS, "time": units.TIME, "force": units.FORCE}
_SAME = 1e-3
_EXAMPLE = '"m, kg, s", or of a file in millimetres, tonnes and newtons "mm, t, s"'


class MatrixTable(Table):
    """Matrices over six directions of every seat and modal coordinates behind; a scenario names a file."""

    units: Text | None = None
    seats: tuple[Text, ...] = ()
    places: Matrix = ()
    mass: Matrix
    stiffness: Matrix
    damping: Matrix = ()
    points: tuple[Text, ...] = ()
    recovery: Matrix = ()
    area: Matrix = ()
    radiation: Matrix = ()
    radiation_frequency: tuple[Number, ...] = ()


Matrices = Annotated[MatrixTable, Reference(f"file of matrices ({', '.join(READERS)})", reader=read_matrices)]
Units = Annotated[Text, Field(examples=["mm, t, s"])]
SeatNames = Annotated[tuple[PartName, ...], Field(max_length=100)]
SeatPlaces = dict[PartName, tuple[Length, Length, Length]]


def scales(text: str, key: str) -> tuple[float, float, float, float]:
    """Factors to SI of length, mass, time and force of units written as "mm, t, s"; InputError at `key`."""
    found: dict[str, float] = {}
    for part in text.split(","):
        for name, kind in _KINDS.items():
            try:
                factor = factor_to_si(part.strip(), kind)
            except NotAQuantity:
                continue
            if name in found:
                raise InputError(key, quoted(text), f"names two units of {name}", f"write {_EXAMPLE}")
            found[name] = factor
            break
        else:
            rule = f"{quoted(part.strip())} is no unit of length, mass, time or force"
            raise InputError(key, quoted(text), rule, f"write {_EXAMPLE}")
    for name in ("length", "mass", "time"):
        if name not in found:
            raise InputError(key, quoted(text), f"has no unit of {name}", f"write {_EXAMPLE}")
    made = found["mass"] * found["length"] / found["time"] ** 2
    force = found.get("force", made)
    if abs(force - made) > _SAME * made:
        rule = f"units disagree: the unit of force is {force:g} N, and mass × length/time² is {made:g} N"
        raise InputError(key, quoted(text), rule, 'with "mm, s, N" the mass is in t; with "m, s, N" in kg')
    return found["length"], found["mass"], found["time"], made


def element_of(housing: Any) -> SuperElement:
    """The super-element of a ``[housing]`` with matrices, in SI units, on what holds it; InputError."""
    element, found = whole_of(housing)
    for error in broken_list("housing.held", housing.held, element.seats, "seat"):
        raise error
    if found.free and not housing.held:
        rule = "missing: the housing is free, and nothing holds it"
        raise InputError("housing.held", None, rule, "name the seats that are its feet, or reduce it held")
    return without(element, housing.held)


def whole_of(housing: Any) -> tuple[SuperElement, Soundness]:
    """The super-element that a table's matrices are, in SI units, and what was found of it; InputError."""
    table: MatrixTable = housing.matrices
    if housing.units and table.units and scales(housing.units, "housing.units") != scales(table.units, KEY):
        rule = f"units disagree: the file says {quoted(table.units)}"
        raise InputError("housing.units", quoted(housing.units), rule, "leave it out, or mend the file")
    text = housing.units or table.units
    if not text:
        rule = "missing: matrices have no meaning without their units"
        raise InputError("housing.units", None, rule, f"write {_EXAMPLE}")
    length, mass, time, force = scales(text, "housing.units" if housing.units else f"{KEY}.units")
    names = _names(housing, table)
    places = _places(housing, names, np.array(table.places, dtype=float) * length)
    given = {name: _rows(getattr(table, name), name) for name in ("mass", "stiffness", "damping")}
    modes = len(given["stiffness"]) - SIX * len(names)
    if modes < 0:
        rule = f"{len(given['stiffness'])} rows, and {len(names)} seats have {SIX * len(names)}"
        raise InputError(KEY, None, rule, "name as many seats as the matrices have")
    # a coordinate's unit: length, rad, and of modes what keeps their numbers
    unit = np.array([*len(names) * [length, length, length, 1.0, 1.0, 1.0], *modes * [mass**0.5 * length]])
    both = np.outer(unit, unit)
    for name, energy in (("mass", mass * length**2), ("stiffness", force * length)):
        _require_shape(given[name], name, len(unit))
        given[name] = given[name] * energy / both
    if len(given["damping"]):
        _require_shape(given["damping"], "damping", len(unit))
        damping = given["damping"] * force * length * time / both
    else:
        damping = np.zeros_like(both)
    recovery = _rows(table.recovery, "recovery").reshape(-1, 3, len(unit)) if table.recovery else None
    if (0 if recovery is None else len(recovery)) != len(table.points):
        rule = f"{len(table.points)} points, and recovery has {len(table.recovery)} rows, three of each"
        raise InputError(KEY, None, rule, "write x, y and z of each")
    element = SuperElement(names, places, modes, given["mass"], given["stiffness"], damping)
    if recovery is not None:
        element = element._replace(points=tuple(table.points), recovery=recovery * length / unit)
    if table.area or table.radiation:
        element = element._replace(
            radiation=_radiation(table, length**4 / both, force * length * time / both)
        )
    element, found = sound(element, KEY)
    if not len(given["damping"]):
        damping = modal_damping(element.mass, element.stiffness, housing.damping_ratio)
        element = element._replace(damping=damping)
    return element, found


def without(element: SuperElement, held: tuple[str, ...]) -> SuperElement:
    """The same with some seats held still."""
    kept = [place for place, name in enumerate(element.seats) if name not in held]
    rows = [SIX * seat + direction for seat in kept for direction in range(SIX)]
    rows += range(SIX * len(element.seats), element.coordinates)
    at = np.ix_(rows, rows)
    return element._replace(
        seats=tuple(element.seats[seat] for seat in kept),
        places=element.places[kept],
        mass=element.mass[at],
        stiffness=element.stiffness[at],
        damping=element.damping[at],
        recovery=element.recovery[:, :, rows] if element.points else element.recovery,
        radiation=None if element.radiation is None else element.radiation.at(rows),
    )


def _rows(rows: Any, name: str) -> Any:
    if len({len(row) for row in rows}) > 1:
        raise InputError(f"{KEY}.{name}", None, "rows differ in length", "write as many numbers in each")
    return np.array(rows, dtype=float)


def _radiation(table: MatrixTable, of_area: Any, of_resistance: Any) -> Radiation:
    """What a table says of sound, in SI units by factors of its elements."""
    area, count = np.zeros_like(of_area), len(of_area)
    if table.area:
        area = _rows(table.area, "area")
        _require_shape(area, "area", count)
    lines = np.array(table.radiation_frequency)
    if not table.radiation and not len(lines):
        return Radiation(area * of_area)
    key, rows = f"{KEY}.radiation", _rows(table.radiation, "radiation")
    if rows.shape != (len(lines) * count, count):
        rule = f"{len(lines)} frequencies and {count} coordinates, and radiation has {len(rows)} rows"
        raise InputError(key, None, rule, "write a whole matrix of every frequency, one behind the other")
    if not np.all(np.diff(lines, prepend=0.0) > 0.0):
        rule = "must be above 0 and increase"
        raise InputError(f"{KEY}.radiation_frequency", None, rule, "sort it, and leave 0 Hz out")
    return Radiation(area * of_area, lines, rows.reshape(-1, count, count) * of_resistance)


def _require_shape(matrix: Any, name: str, count: int) -> None:
    if matrix.shape != (count, count):
        shown = " by ".join(map(str, matrix.shape))
        rule = f"{name} is {shown}, and there are {count} coordinates"
        raise InputError(KEY, None, rule, "name as many seats as the matrices have")


def _names(housing: Any, table: MatrixTable) -> tuple[str, ...]:
    names = tuple(housing.seats or table.seats)
    if not names:
        rule = "missing: the file names no seats"
        raise InputError("housing.seats", None, rule, 'name them in its order: seats = ["A", "B"]')
    if len(set(names)) < len(names) or (housing.seats and table.seats and len(table.seats) != len(names)):
        rule = f"must name each of the {len(table.seats) or len(names)} seats once"
        raise InputError("housing.seats", quoted(list(names)), rule, "name them in the order of the file")
    return names


def _places(housing: Any, names: tuple[str, ...], of_file: Any) -> Any:
    if housing.places:
        for error in broken_list("housing.places", list(housing.places), names, "seat"):
            raise error
    if not housing.places and len(of_file) == len(names) and of_file.shape[1:] == (3,):
        return of_file
    missing = [name for name in names if name not in housing.places]
    if missing:
        rule = "missing: the file does not say where the seats are"
        example = f'{missing[0]} = ["0 mm", "0 mm", "120 mm"]'
        raise InputError(f"housing.places.{missing[0]}", None, rule, f"add {example}")
    return np.array([housing.places[name] for name in names])
