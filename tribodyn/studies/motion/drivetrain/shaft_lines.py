"""Drawn shafts of a gearbox as a record keeps them: sections, gears, bearings, and their bending."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.gears.drawn_system import DrawnSystem
from tribodyn.numerics.parameter import Variable
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.reader import Record
from tribodyn.train.elastic.beam_matrices import SIX

#: Of drawn shafts, in the group "geometry"; numbers of shafts count from 0.
SHAFT_GEOMETRY: dict[str, Variable] = {
    "section_shaft": Variable(("section",), "1", "number of the drawn shaft that each section is of"),
    "section_start": Variable(("section",), "m", "z where each section begins"),
    "section_end": Variable(("section",), "m", "z where each section ends"),
    "section_diameter": Variable(("section",), "m", "diameter of each section"),
    "station_shaft": Variable(("station",), "1", "number of the drawn shaft that each station is on"),
    "station_z": Variable(("station",), "m", "z of each station of an axis"),
    "station_centre": Variable(("station", "axis"), "m", "x, y of each station, without load"),
    "station_moved": Variable(
        ("station", "axis"), "m", "displacement of each station in x, y under the mean loads"
    ),
    "station_follows": Variable(
        ("station", "direction", "place", "motion"),
        "1",
        "displacement of each station in x, y, z by x, y, z, tilt_x, tilt_y of each carried body; no modes",
    ),
    "station_at_rest": Variable(
        ("station", "direction"), "m", "displacement of each station where no carried body is displaced"
    ),
    "carried_body": Variable(("place",), "1", "number of each body that a drawn shaft carries"),
    "carried_z": Variable(("place",), "m", "z of each body that a drawn shaft carries"),
    "seat_z": Variable(("seat",), "m", "z of each bearing of a drawn shaft, as bearing_names are in order"),
    "seat_shaft": Variable(("seat",), "1", "number of the drawn shaft that each bearing holds"),
    "seat_force": Variable(
        ("seat", "direction"), "N", "force of the shaft on each bearing in x, y, z under the mean loads"
    ),
    "face_width": Variable(("gear",), "m", "face width of each gear"),
}


#: And of a housing that gives.
HOUSING_GEOMETRY: dict[str, Variable] = {
    "seat_spot": Variable(("seat",), "1", "number of the housing's seat that each bearing is in; -1: none"),
    "housing_follows": SHAFT_GEOMETRY["station_follows"]._replace(
        dims=("spot", "direction", "place", "motion"),
        long_name="displacement of each seat of the housing, likewise",
    ),
    "housing_at_rest": SHAFT_GEOMETRY["station_at_rest"]._replace(
        dims=("spot", "direction"), long_name="displacement of each seat of the housing, likewise"
    ),
}


def shaft_arrays(
    system: DrawnSystem, numbers: Mapping[int, int], face_widths: list[float]
) -> dict[str, np.ndarray]:
    """Arrays of `SHAFT_GEOMETRY`, and of `HOUSING_GEOMETRY` where there is one.

    `numbers` are the record's of bodies by the case's.
    """
    rows: dict[str, list[Any]] = {name: [] for name in SHAFT_GEOMETRY}
    settled = system.settled
    ends = _stations(system)
    for number, shaft in enumerate(system.shafts):
        start = shaft.start
        for section in shaft.drawing.section:
            rows["section_shaft"].append(number)
            rows["section_start"].append(start)
            start += section.length
            rows["section_end"].append(start)
            rows["section_diameter"].append(section.diameter)
        for place, first in ends[number]:
            rows["station_shaft"].append(number)
            rows["station_z"].append(shaft.start + place)
            rows["station_centre"].append(shaft.centre)
            rows["station_moved"].append(settled.moved[first : first + 2])
        for body, place in shaft.points:
            rows["carried_body"].append(numbers[body])
            rows["carried_z"].append(shaft.start + place)
        for bearing in shaft.drawing.bearing:
            rows["seat_shaft"].append(number)
            rows["seat_z"].append(shaft.start + bearing.position)
    firsts = [first for of_shaft in ends for _, first in of_shaft]
    rows["station_follows"], rows["station_at_rest"] = _followed(system, firsts)
    housing = system.housing
    if housing is not None:
        start = len(settled.moved) - housing.coordinates
        held = [bearing.seat for bearing in settled.structure.bearings]
        rows["seat_spot"] = [housing.seats.index(name) if name else -1 for name in held]
        rows["housing_follows"], rows["housing_at_rest"] = _followed(
            system, [start + housing.seat(name) for name in housing.seats]
        )
    rows["seat_force"] = [bearing.force[:3] for bearing in settled.bearings]
    rows["face_width"] = list(face_widths)
    return {name: np.array(values) for name, values in rows.items()}


def deflections(record: Record, what: str = "station") -> Float[Array, "time spot 3"]:
    """Displacement of every station of the shafts, or of every seat of the housing, in x, y and z, m."""
    parts = record.geometry
    bodies = np.asarray(parts["carried_body"], int)
    moved = np.stack([record[name][:, bodies] for name in ("x", "y", "z", "tilt_x", "tilt_y")], axis=-1)
    return parts[f"{what}_at_rest"] + np.einsum("ndbi,tbi->tnd", parts[f"{what}_follows"], moved)


def _stations(system: DrawnSystem) -> list[list[tuple[float, int]]]:
    """Of every shaft the places of its nodes, and their first coordinates in the structure."""
    count, found = 0, []
    for places in system.settled.structure.along:
        found.append([(place, SIX * (count + node)) for node, place in enumerate(places)])
        count += len(places)
    return found


def _followed(system: DrawnSystem, firsts: list[int]) -> tuple[Any, Any]:
    """Displacements of nodes, by their first coordinates, from those of the carried bodies; and at rest."""
    settled, bodies = system.settled, len(system.bodies)
    nodes = np.add.outer(firsts, np.arange(3))
    follows = system.reduced.recovery[nodes, : SIX * bodies].reshape(len(firsts), 3, bodies, SIX)[..., :-1]
    rest = settled.moved[nodes] - np.einsum("ndbi,bi->nd", follows, settled.points[:, :-1])
    return follows, rest


def rounded_down(times: float) -> float:
    """A magnification as 1, 2 or 5 times a power of ten that is no larger."""
    power = 10.0 ** np.floor(np.log10(times))
    return float(max(digit for digit in (1.0, 2.0, 5.0) if digit * power <= times * (1.0 + 1e-9)) * power)
