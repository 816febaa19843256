"""Drawn shafts of a gearbox as a record keeps them: sections, gears, bearings, and their bending."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.gears.drawn_system import DrawnSystem
from tribodyn.numerics.parameter import Variable

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
    "carried_body": Variable(("place",), "1", "number of each body that a drawn shaft carries"),
    "carried_z": Variable(("place",), "m", "z of each body that a drawn shaft carries"),
    "seat_z": Variable(("seat",), "m", "z of each bearing of a drawn shaft, as bearing_names are in order"),
    "seat_shaft": Variable(("seat",), "1", "number of the drawn shaft that each bearing holds"),
    "seat_force": Variable(
        ("seat", "direction"), "N", "force of the shaft on each bearing in x, y, z under the mean loads"
    ),
    "face_width": Variable(("gear",), "m", "face width of each gear"),
}


def shaft_arrays(
    system: DrawnSystem, numbers: Mapping[int, int], face_widths: list[float]
) -> dict[str, np.ndarray]:
    """Arrays of `SHAFT_GEOMETRY`; `numbers` are the record's of bodies by the case's."""
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
    rows["seat_force"] = [bearing.force[:3] for bearing in settled.bearings]
    rows["face_width"] = list(face_widths)
    return {name: np.array(values) for name, values in rows.items()}


def _stations(system: DrawnSystem) -> list[list[tuple[float, int]]]:
    """Of every shaft the places where its motion is known, and their first coordinates in the structure."""
    structure, point, bearing = system.settled.structure, 0, 0
    found = []
    for shaft in system.shafts:
        points, seats = shaft.points, shaft.drawing.bearing
        known = dict(
            zip((place for _, place in points), structure.points[point : point + len(points)], strict=True)
        )
        nodes = structure.nodes[bearing : bearing + len(seats)]
        known |= dict(zip((seat.position for seat in seats), nodes, strict=True))
        found.append(sorted(known.items()))
        point, bearing = point + len(points), bearing + len(seats)
    return found
