"""A gear in a mesh as its damage sees it, and the teeth on which damage is."""

from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np

from tribodyn.compliance.energy import LoadedTooth, hertz_linear
from tribodyn.geometry.drive import MaterialData
from tribodyn.mesh.teeth.fields import FlankPlaces, ToothFields
from tribodyn.numerics.shapes import Array, Float

#: Strips of the face among which damage is told from sound material: of the whole face, and of a slice.
_STRIPS, _STRIPS_OF_SLICE = 64, 8


class DamagedGear(NamedTuple):
    """One gear of a mesh."""

    loaded: LoadedTooth
    #: of the gear and of its mate
    materials: tuple[MaterialData, MaterialData]
    width: float  # over which the teeth of both touch, m
    solved: bool  # whether compliances are those of finite elements


class Damage(Protocol):
    """Damage of one tooth, as numbers: a kind."""

    @property
    def tooth(self) -> int:
        """Number of the tooth, from 0."""
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

    def in_mesh(self, gear: DamagedGear) -> "DamagedTeeth":
        """The same in a mesh."""
        return replace(self, gear=gear)

    def fields(self, tooth: int, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `fields.OwnFields`."""
        if self.gear is None:
            raise ValueError("damage acts by the mesh that its gear is in: call in_mesh first")
        found = None
        for each in self.damage:
            more = each.on_flank(self.gear, flank, places) if each.tooth == tooth else None
            if more is not None:
                found = more if found is None else found.beside(more)
        return found


def strips(gear: DamagedGear, places: FlankPlaces) -> Float[Array, "slice strip"]:
    """Middles (m, from the middle of the face) of equally wide strips of every slice."""
    count = len(places.face)
    each = max(_STRIPS_OF_SLICE, _STRIPS // count)
    within = (np.arange(each) + 0.5) / each - 0.5
    return places.face[:, None] + gear.width / count * within


def arc(gear: DamagedGear, places: FlankPlaces) -> Float[Array, " node"]:
    """Length along the profile (m) from the lowest place of the path of contact, towards the tip."""
    own = places.distance if gear.loaded.side == "pinion" else -places.distance
    at = gear.loaded.contact(own)
    x, y = np.asarray(at.x), np.asarray(at.y)
    steps = np.hypot(np.diff(x), np.diff(y)) * np.sign(np.diff(x))
    length = np.concatenate([[0.0], np.cumsum(steps)])
    return length - length.min()


#: Depth below what touches from which a place of the face does not: more than teeth approach under load.
CLEAR = 20e-6


def partly_touching(gear: DamagedGear, missing: Float[Array, "slice strip node"]) -> ToothFields:
    """Fields of flanks with so much material missing (m) in every strip of the slices.

    Where a slice is damaged along its whole width, it is by the least of what is missing that it touches
    later. Where a part λ of it lies deeper than `CLEAR` under that, it carries on the rest: of its compliance
    the contact's, which no other part of the tooth shares, grows by λ/(1 − λ).
    """
    gap = missing.min(axis=1)
    deeper = np.clip((missing - gap[:, None]) / CLEAR, 0.0, 1.0)
    lost = np.mean(deeper**2 * (3.0 - 2.0 * deeper), axis=1)
    contact = float(hertz_linear(*gear.materials, gear.width))
    return ToothFields(gap, contact * lost / (1.0 - lost), np.ones_like(gap))
