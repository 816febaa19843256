"""A gear in a mesh as its damage sees it, and the teeth on which damage is."""

from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np

from tribodyn.compliance.energy import LoadedTooth, loaded_tooth
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData, Side
from tribodyn.geometry.helix import normal_module
from tribodyn.mesh.teeth.fields import FlankPlaces, ToothFields
from tribodyn.numerics.shapes import Array, Float

#: Depth below what touches from which a place of a flank does not: more than teeth approach under load.
CLEAR = 20e-6
#: Strips of the face among which damage is told from sound material: of the whole face, and of a slice.
_STRIPS, _STRIPS_OF_SLICE = 64, 8


class DamagedGear(NamedTuple):
    """One gear of a mesh."""

    #: teeth: of the gear and of its mate, as their materials
    teeth: tuple[LoadedTooth, LoadedTooth]
    materials: tuple[MaterialData, MaterialData]
    width: float  # over which the teeth of both touch, m
    module: float  # in the normal section, m
    solved: bool  # whether compliances are those of finite elements

    @property
    def loaded(self) -> LoadedTooth:
        """The gear's own tooth."""
        return self.teeth[0]


def damaged_gear(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], side: Side, solved: bool
) -> DamagedGear:
    """One gear of a pair; `materials` are those of pinion and gear."""
    sides = SIDES if side == "pinion" else SIDES[::-1]
    one, two = (loaded_tooth(assembly, each) for each in sides)
    first, second = (materials[SIDES.index(each)] for each in sides)
    module = float(normal_module(assembly.drive))
    return DamagedGear((one, two), (first, second), float(assembly.common_width), module, solved)


class Damage(Protocol):
    """Damage of one tooth, as numbers: a kind."""

    @property
    def tooth(self) -> int:
        """Number of the tooth, from 0."""
        ...

    @property
    def early(self) -> float:
        """By how much the other teeth may stand out against this one, m."""
        ...

    def on_flank(self, gear: DamagedGear, flank: int, places: FlankPlaces) -> ToothFields | None:
        """What it does to a flank of the tooth; None: nothing."""
        ...


@dataclass(frozen=True)
class DamagedTeeth:
    """Damage of the teeth of a gear, as `fields.OwnFields` once it is known in which mesh."""

    damage: tuple[Damage, ...]
    gear: DamagedGear | None = None
    of_gap_alone: bool = False

    @property
    def early(self) -> float:
        """See `fields.OwnFields`."""
        return max((each.early for each in self.damage), default=0.0)

    def in_mesh(self, gear: DamagedGear) -> "DamagedTeeth":
        """The same in a mesh."""
        return replace(self, gear=gear)

    def fields(self, tooth: int, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `fields.OwnFields`."""
        if self.gear is None:
            raise ValueError("damage acts by the mesh that its gear is in: call in_mesh first")
        total = None
        for each in self.damage:
            more = each.on_flank(self.gear, flank, places) if each.tooth == tooth else None
            if more is not None:
                total = more if total is None else total.beside(more)
        return total


def strips(gear: DamagedGear, places: FlankPlaces) -> Float[Array, "slice strip"]:
    """Middles (m, from the middle of the face) of equally wide strips of every slice."""
    count = len(places.face)
    each = max(_STRIPS_OF_SLICE, _STRIPS // count)
    within = (np.arange(each) + 0.5) / each - 0.5
    return places.face[:, None] + gear.width / count * within


def arc(gear: DamagedGear, places: FlankPlaces) -> Float[Array, " node"]:
    """Length along the profile (m) from the lowest place of the path of contact, towards the tip."""
    distance = places.distance if gear.loaded.side == "pinion" else -places.distance
    at = gear.loaded.contact(distance)
    x, y = np.asarray(at.x), np.asarray(at.y)
    steps = np.hypot(np.diff(x), np.diff(y)) * np.sign(np.diff(x))
    length = np.concatenate([[0.0], np.cumsum(steps)])
    return length - length.min()
