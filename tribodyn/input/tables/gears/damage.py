"""Damage of single teeth in a scenario: its table, and what it means."""

from collections.abc import Sequence
from math import inf, pi
from typing import Annotated, Literal, NamedTuple

import numpy as np
from pydantic import Field

from tribodyn.geometry.drive import Side
from tribodyn.input import units
from tribodyn.input.quantity import (
    Column,
    Columns,
    InUnit,
    Number,
    Positive,
    Table,
    Text,
    csv_file,
    written,
)
from tribodyn.input.tables.gears.model_files import DriveTable, Gear
from tribodyn.mesh.teeth.damage.gear import Damage, DamagedTeeth
from tribodyn.mesh.teeth.damage.patch import BrokenTip, MissingMap, Patch, Scuffing, Spall
from tribodyn.mesh.teeth.damage.root_crack import RootCrack
from tribodyn.mesh.teeth.fields import CARRYING, LEADING, TRAILING, OwnFields

#: Damaged teeth of a scenario, at most.
MOST_DAMAGE = 200

_Length = Annotated[float, InUnit(units.positive(units.LENGTH), "2 mm")]
_FLANKS = {"leading": LEADING, "trailing": TRAILING}
_ENDS = {"+z": 1, "-z": -1}
#: Width over which a patch begins, where none is given, m.
EDGE = 0.2e-3


class MissingTable(Columns):
    """Missing material over a flank: at every height (0 at the root's end of the path, 1 at the tip's)."""

    height: Annotated[Column, units.NUMBER]
    face: Annotated[Column, units.LENGTH]
    depth: Annotated[Column, units.DEVIATION]


class DamageTable(Table):
    """Damage of one tooth."""

    gear: Text = Field(examples=["pinion"])
    tooth: Annotated[int, Field(strict=True)] = Field(examples=[5])
    kind: Literal["crack", "spall", "pit", "broken-tip", "scuffing"]
    flank: Literal["leading", "trailing"] | None = None
    depth: _Length | None = None
    angle: Annotated[float, InUnit(units.positive(units.ANGLE_KIND), "60 deg")] | None = None
    tangent: Annotated[float, InUnit(units.positive(units.ANGLE_KIND), "30 deg")] | None = None
    deepest: Literal["+z", "-z"] | None = None
    height: Number | None = None
    radius: _Length | None = None
    length: _Length | None = None
    width: _Length | None = None
    face: Annotated[float, InUnit(units.LENGTH, "0 mm")] = written("0 mm")
    diameter: _Length | None = None
    shape: Literal["rectangle", "ellipse"] | None = None
    edge: _Length | None = None
    factor: Positive | None = None
    map: Annotated[MissingTable, csv_file("height", "face", "depth")] | None = None


Damages = Annotated[tuple[DamageTable, ...], Field(max_length=MOST_DAMAGE)]


class GearPlace(NamedTuple):
    """A gear that can be damaged: the pairs that it belongs to, and what it is in each; the first counts."""

    pairs: tuple[tuple[DriveTable, Side], ...]

    @property
    def table(self) -> Gear:
        """The gear as it is written."""
        drive, side = self.pairs[0]
        return getattr(drive, side)

    def flank(self, table: DamageTable) -> int:
        """The damaged flank."""
        if table.flank is not None:
            return _FLANKS[table.flank]
        return CARRYING[self.pairs[0][1]]

    def touched(self, flank: int) -> tuple[DriveTable, Side]:
        """A pair in which the flank carries; the first one where none does."""
        return next((pair for pair in self.pairs if CARRYING[pair[1]] == flank), self.pairs[0])


def damage_of(tables: Sequence[DamageTable], gear: GearPlace) -> tuple[OwnFields, ...]:
    """What teeth of a gear have by these tables, which are its own and have passed the rules."""
    if not tables:
        return ()
    return (DamagedTeeth(tuple(_damage(table, gear.flank(table)) for table in tables)),)


def _damage(table: DamageTable, flank: int) -> Damage:
    tooth, width = table.tooth - 1, inf if table.width is None else table.width
    edge = EDGE if table.edge is None else table.edge
    if table.kind == "crack":
        deepest = _ENDS.get(table.deepest or "", 0)
        return RootCrack(tooth, flank, table.depth or 0.0, *angles_of(table), table.face, width, deepest)
    if table.kind == "broken-tip":
        return BrokenTip(tooth, table.height, table.radius, table.face, width, edge)
    if table.map is not None:
        return _mapped(table.map, tooth, flank)
    if table.kind == "pit":
        size = table.diameter or 0.0
        patch = Patch(table.height, table.radius, size, table.face, size, edge, "ellipse")
        return Spall(tooth, flank, patch, table.depth or 0.0)
    shape = table.shape or "rectangle"
    patch = Patch(table.height, table.radius, table.length or 0.0, table.face, width, edge, shape)
    if table.kind == "scuffing":
        return Scuffing(tooth, flank, patch, table.factor or 1.0)
    return Spall(tooth, flank, patch, table.depth or 0.0)


def angles_of(table: DamageTable) -> tuple[float, float]:
    """Angles of a crack, and of the fillet where it starts, to the tooth's axis, rad."""
    tangent = pi / 6 if table.tangent is None else table.tangent
    return pi / 2 - tangent if table.angle is None else table.angle, tangent


def _mapped(table: MissingTable, tooth: int, flank: int) -> MissingMap:
    height, face, depth = table.in_si()
    heights, faces = np.unique(height), np.unique(face)
    missing = np.empty((len(heights), len(faces)))
    missing[np.searchsorted(heights, height), np.searchsorted(faces, face)] = depth
    return MissingMap(tooth, flank, heights, faces, missing)
