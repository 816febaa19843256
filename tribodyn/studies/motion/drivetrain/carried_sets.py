"""Planetary sets of a recorded train: what is carried by what, and which meshes are of which planet."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.geometry.drive import SIDES
from tribodyn.numerics.shapes import Array, Int
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.mesh_groups import together

#: Distance from a set's axis below which a body turns about it, m.
_ON_AXIS = 1e-9


class CarriedSet(NamedTuple):
    """A planetary set of a record; bodies and meshes by number, planets in the order of their meshes."""

    name: str
    carrier: int
    planets: tuple[int, ...]
    meshes: dict[int, tuple[int, ...]]  # of the bodies on its axis, with every planet that they meet
    met: dict[int, tuple[int, ...]]  # these planets
    between: tuple[int, ...]  # meshes of planets with each other


def carriers(record: Record) -> Int[Array, " body"]:
    """Number of the body with which each body is carried about its axis; -1: none."""
    carrier_of = record.geometry.get("carrier")
    return np.full(len(record["body"]), -1) if carrier_of is None else np.asarray(carrier_of, int)


def place_of(record: Record, name: str, m: int) -> float:
    """What the geometry of a record says of a mesh, by its number."""
    return float(np.atleast_1d(record.geometry[name])[m])


def driver_of(record: Record, m: int, end: str = "driver") -> int:
    """The body that drives a mesh, or that is driven in it."""
    return int(record.geometry["gear_body"][int(place_of(record, f"{end}_gear", m))])


def sets_of(record: Record) -> list[CarriedSet]:
    """The planetary sets of a record; none where meshes have no names."""
    if not record.names_meshes:
        return []
    carried, centre = carriers(record), record.geometry["centre"]
    by_carrier: dict[int, dict[int, dict[int, int]]] = {}
    between: dict[int, list[int]] = {}
    for m in range(len(record.meshes)):
        ends = driver_of(record, m), driver_of(record, m, "driven")
        carrier = int(carried[ends[0]])
        if carrier < 0:
            continue
        central, planet = sorted(ends, key=lambda body: np.hypot(*(centre[body] - centre[carrier])))
        if np.hypot(*(centre[central] - centre[carrier])) > _ON_AXIS:
            between.setdefault(carrier, []).append(m)
        else:
            by_carrier.setdefault(carrier, {}).setdefault(central, {})[planet] = m
    sets = []
    for carrier, meshes in by_carrier.items():
        planets = tuple(dict.fromkeys(planet for mesh_of in meshes.values() for planet in mesh_of))
        met = {body: tuple(planet for planet in planets if planet in of) for body, of in meshes.items()}
        each = {body: tuple(meshes[body][planet] for planet in of) for body, of in met.items()}
        name = record.meshes[next(iter(each.values()))[0]].rsplit("-", 2)[0]
        sets.append(CarriedSet(name, carrier, planets, each, met, tuple(between.get(carrier, ()))))
    return sets


def mesh_labels(record: Record) -> list[str]:
    """Names of the meshes, one for all that a member of a set has with its planets."""
    groups = [group for each in sets_of(record) for group in (*each.meshes.values(), each.between)]
    return _labels(list(record.meshes), groups)


def body_labels(record: Record) -> list[str]:
    """Names of the bodies, one for all planets of a set that are alike."""
    names = list(map(str, record["body"] if "body" in record else SIDES))
    groups: dict[tuple[int, str], list[int]] = {}
    for number, carried in enumerate(sets_of(record)):
        for planet in carried.planets:
            groups.setdefault((number, names[planet].rpartition("-")[0]), []).append(planet)
    return _labels(names, list(groups.values()))


def _labels(names: list[str], groups: Sequence[Sequence[int]]) -> list[str]:
    labels = list(names)
    for group in groups:
        for number in group:
            labels[number] = together(names[one] for one in group)
    return labels
