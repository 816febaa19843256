"""Planetary sets of a recorded train: what is carried by what, and which meshes are of which planet."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.geometry.drive import SIDES
from tribodyn.numerics.shapes import Array, Int
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.mesh_groups import together


class CarriedSet(NamedTuple):
    """A planetary set of a record; bodies and meshes by number, planets in the order of their meshes."""

    name: str
    carrier: int
    planets: tuple[int, ...]
    meshes: dict[int, tuple[int, ...]]  # of the bodies on its axis, with every planet


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
    for m in range(len(record.meshes)):
        ends = driver_of(record, m), driver_of(record, m, "driven")
        carrier = int(carried[ends[0]])
        if carrier < 0:
            continue
        central, planet = sorted(ends, key=lambda body: np.hypot(*(centre[body] - centre[carrier])))
        by_carrier.setdefault(carrier, {}).setdefault(central, {})[planet] = m
    sets = []
    for carrier, meshes in by_carrier.items():
        planets = tuple(next(iter(meshes.values())))
        each = {body: tuple(mesh_of[planet] for planet in planets) for body, mesh_of in meshes.items()}
        name = record.meshes[next(iter(each.values()))[0]].rsplit("-", 2)[0]
        sets.append(CarriedSet(name, carrier, planets, each))
    return sets


def mesh_labels(record: Record) -> list[str]:
    """Names of the meshes, one for all that a member of a set has with its planets."""
    return _labels(list(record.meshes), [group for each in sets_of(record) for group in each.meshes.values()])


def body_labels(record: Record) -> list[str]:
    """Names of the bodies, one for all planets of a set."""
    names = record["body"] if "body" in record else SIDES
    return _labels(list(map(str, names)), [carried.planets for carried in sets_of(record)])


def _labels(names: list[str], groups: Sequence[Sequence[int]]) -> list[str]:
    labels = list(names)
    for group in groups:
        for number in group:
            labels[number] = together(names[one] for one in group)
    return labels
