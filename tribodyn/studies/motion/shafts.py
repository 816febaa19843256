"""Shafts as drawn in a gearbox: where they stand, under which loads, and what they are to the bodies.

Every body that a drawn shaft carries moves by itself; shafts, bearings and housing couple them, about the
operating point under the mean loads of the meshes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tribodyn.errors import InputError
from tribodyn.input.tables.drawn_shafts import DrawnShaft
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.coupling import CoupledMatrices
from tribodyn.train.layout import TrainLayout
from tribodyn.train.structure import IN_SPACE, place_in_space, turn_of


@dataclass(frozen=True)
class ShaftData:
    """A drawn shaft in its place."""

    name: str
    key: str  # of the drawing in the scenario, dotted
    drawing: DrawnShaft
    points: tuple[tuple[int, float], ...]  # bodies that it carries, and where along it, m
    centre: tuple[float, float]  # of its axis, m
    start: float  # z of its start, m
    sense: int  # of rotation, +1: counter-clockwise seen from +z
    speed: float  # rad/s


def starts(
    shafts: Sequence[tuple[DrawnShaft, Mapping[int, float]]], meshing: Sequence[tuple[int, int]]
) -> list[float]:
    """z of the starts of shafts: faces that mesh stand opposite each other, that of the first at z = 0.

    Every shaft with the places of its bodies; `meshing` are bodies that mesh.
    """
    place_of = {body: (n, place) for n, (_, bodies) in enumerate(shafts) for body, place in bodies.items()}
    found: dict[int, float] = {}
    for first in range(len(shafts)):
        if first in found:
            continue
        found[first] = -min(shafts[first][1].values(), default=0.0)
        waiting = [first]
        while waiting:
            here = waiting.pop()
            for pair in meshing:
                for one, other in (pair, pair[::-1]):
                    if one in place_of and other in place_of and place_of[one][0] == here:
                        there, place = place_of[other]
                        if there not in found:
                            found[there] = found[here] + place_of[one][1] - place
                            waiting.append(there)
    return [found[n] for n in range(len(shafts))]


def check_room_of_shafts(
    shafts: Sequence[ShaftData],
    gears: Sequence[tuple[str, int, float, float]],
    centres: Sequence[Sequence[float]],
) -> None:
    """Raise InputError where a shaft penetrates a gear of another.

    `gears` are names, bodies, tip radii and face widths; `centres` of the bodies, m.
    """
    shaft_of = {body: (shaft, place) for shaft in shafts for body, place in shaft.points}
    for shaft in shafts:
        for name, body, tip, width in gears:
            if body not in shaft_of or shaft_of[body][0] is shaft:
                continue
            carrier, place = shaft_of[body]
            middle = carrier.start + place
            apart = float(np.hypot(*(np.subtract(centres[body], shaft.centre))))
            start = shaft.start
            for number, section in enumerate(shaft.drawing.section):
                end = start + section.length
                inside = start < middle + width / 2.0 and end > middle - width / 2.0
                overlap = section.diameter / 2.0 + tip - apart
                if inside and overlap > 0.0:
                    rule = (
                        f"penetrates {name} on the shaft {carrier.name} by {1e3 * overlap:.3g} mm: "
                        f"their axes are {1e3 * apart:.6g} mm apart, its tip circle reaches {1e3 * tip:.6g} mm"
                    )
                    remedy = "end the shaft before, make it thinner there, or change an azimuth or a position"
                    raise InputError(f"{shaft.key}.section.{number}.diameter", None, rule, remedy)
                start = end


def places_of(bodies: Sequence[int], layout: TrainLayout, modes: int) -> list[int]:
    """Places in the state of six directions of bodies of the model, and of all coordinates of no body."""
    places = []
    for body in bodies:
        places += [place_in_space(body, direction, layout) for direction in range(IN_SPACE)]
        places.append(turn_of(body, layout))
    return places + list(range(layout.half - modes, layout.half))


def in_own_senses(
    matrix: Float[Array, "coordinate coordinate"], senses: Sequence[int], modes: int
) -> Float[Array, "coordinate coordinate"]:
    """A matrix whose rotations about z are counter-clockwise in the senses of the bodies."""
    signs = np.array([sign for sense in senses for sign in (*[1.0] * IN_SPACE, float(sense))] + [1.0] * modes)
    return matrix * np.outer(signs, signs)
