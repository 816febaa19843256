"""A gear of a gearbox beside its measurement: which flank is which, where places on it are in its mesh.

The datum face is one of its ends. Teeth that are counted clockwise in the measurement mesh in this order or
the other way round, by the sense of rotation.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.exchange.measured_gear import LEFT, RIGHT, NominalGear
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Side, body_of, reference_radius, tip_circle_radius
from tribodyn.geometry.path import radius
from tribodyn.mesh.teeth.fields import LEADING, TRAILING, FlankPlaces, OwnTeeth
from tribodyn.mesh.teeth.table import flank_places
from tribodyn.numerics.shapes import Array, Float

#: Ends of a face: at the most negative z and at the most positive.
START, END = "start", "end"


class MeshingFlank(NamedTuple):
    """A flank of a gear in a mesh in which it is touched."""

    assembly: Assembly
    side: Side  # what the gear is there
    way: int  # 1: it carries in this mesh; -1: it is its back flank

    def roll_lengths(self, base_radius: float) -> tuple[float, float]:
        """Lengths of roll (m) at the path's ends near the root and near the tip: heights 0 and 1."""
        ends = [float(limit) for limit in self.assembly.limits]
        own = ends if self.side == "pinion" else [-ends[1], -ends[0]]
        path = self.assembly.path_of(self.side)
        reach = [float(radius(path, np.array(each))) for each in own]
        low, high = (math.sqrt(max(each**2 - base_radius**2, 0.0)) for each in reach)
        return low, high

    def places(self, height: Float[Array, " node"], face: Float[Array, " slice"]) -> FlankPlaces:
        """Places at shares of the path and along the face (m from its middle)."""
        begin, end = (float(limit) for limit in self.assembly.limits)
        distance = begin + (end - begin) * (height if self.side == "pinion" else 1.0 - height)
        roll = np.asarray(self.assembly.path.rotation(distance))
        driver, driven = flank_places(self.assembly, roll, face, self.way)
        return driver if self.side == "pinion" else driven


@dataclass(frozen=True)
class MountedGear:
    """A gear as it is mounted and turns."""

    name: str
    key: str  # where it stands in the scenario, dotted
    sense: int  # +1 counter-clockwise seen from +z, −1 clockwise
    flanks: Mapping[int, MeshingFlank]  # `LEADING`, `TRAILING`
    carrying: tuple[int, ...]  # flanks with which it carries; the first one places a tooth
    own: OwnTeeth  # what its teeth have of their own
    edition: int = 2013  # of ISO 1328-1

    @property
    def _of(self) -> MeshingFlank:
        return self.flanks[self.carrying[0]]

    @property
    def nominal(self) -> NominalGear:
        """As it was drawn."""
        drive, side = self._of.assembly.drive, self._of.side
        body, beta = body_of(drive, side), float(drive.helix_angle)
        right = (beta > 0.0) == (side == "pinion" or int(body.teeth) < 0)
        stretch = math.cos(beta)
        return NominalGear(
            teeth=abs(int(body.teeth)),
            internal=int(body.teeth) < 0,
            module=float(drive.module) * stretch,
            pressure_angle=math.atan(math.tan(float(drive.pressure_angle)) * stretch),
            helix_angle=abs(beta),
            hand=None if beta == 0.0 else "right" if right else "left",
            profile_shift=float(body.profile_shift) / stretch,
            face_width=float(body.face_width),
            tip_diameter=2.0 * abs(float(tip_circle_radius(drive, side))),
        )

    @property
    def teeth(self) -> int:
        """Number of its teeth."""
        return abs(int(body_of(self._of.assembly.drive, self._of.side).teeth))

    @property
    def face_width(self) -> float:
        """Width of its face, m."""
        return float(body_of(self._of.assembly.drive, self._of.side).face_width)

    @property
    def reference_radius(self) -> float:
        """Radius of its reference circle, m."""
        return abs(float(reference_radius(self._of.assembly.drive, self._of.side)))

    @property
    def base_radius(self) -> float:
        """Radius of its base circle, m."""
        return self.reference_radius * math.cos(float(self._of.assembly.drive.pressure_angle))

    @property
    def lean(self) -> float:
        """Cosine of the base helix angle: deviation along the normal over that in the transverse section."""
        drive = self._of.assembly.drive
        return 1.0 / math.hypot(
            1.0, math.tan(float(drive.helix_angle)) * math.cos(float(drive.pressure_angle))
        )

    def clockwise(self, datum: str) -> bool:
        """Whether it turns clockwise, looked at from its datum face."""
        return (self.sense > 0) == (datum == START)

    def side(self, flank: int, datum: str) -> str:
        """Which flank the leading or the trailing one is for whoever looks at the datum face."""
        return RIGHT if self.clockwise(datum) == (flank == LEADING) else LEFT

    def along(self, from_datum: Float[Array, " point"], datum: str) -> Float[Array, " point"]:
        """Places from the middle of the face, along z, of distances from the datum face; and back."""
        return from_datum - self.face_width / 2.0 if datum == START else self.face_width / 2.0 - from_datum

    def from_datum(self, face: Float[Array, " point"], datum: str) -> Float[Array, " point"]:
        """Distances from the datum face of places along z from the middle of the face."""
        return self.face_width / 2.0 + face if datum == START else self.face_width / 2.0 - face

    def tooth(self, number: int, datum: str) -> int:
        """Tooth of the scenario, from 0, by its number in the measurement, from 1."""
        return (1 - number if self.clockwise(datum) else number - 1) % self.teeth

    def behind(self, flank: int, datum: str) -> float:
        """What a flank lacks along its normal over the arc of the base circle that it is clockwise."""
        ahead = 1.0 if self.clockwise(datum) else -1.0
        return self.lean * (-ahead if flank == LEADING else ahead)

    def measuring_height(self, flank: int, diameter: float | None) -> float:
        """Height at which the pitch was measured, or the end of the path next to it."""
        low, high = self.flanks[flank].roll_lengths(self.base_radius)
        r = self.reference_radius if diameter is None else diameter / 2.0
        length = math.sqrt(max(r**2 - self.base_radius**2, 0.0))
        return min(1.0, max(0.0, (length - low) / (high - low)))

    def refuse_other(self, nominal: NominalGear, file: str) -> None:
        """Refuse the measurement of another gear."""
        for field, own, theirs in zip(NominalGear._fields, self.nominal, nominal, strict=True):
            if theirs is None or own is None:
                continue
            close = own == theirs
            if isinstance(theirs, float) and isinstance(own, float):
                close = abs(own - theirs) <= _CLOSE[field]
            if not close:
                rule = f"{_shown(field, theirs)} in the measurement, {_shown(field, own)} in the scenario"
                remedy = "name the gear that was measured with --gear, or correct one of them"
                raise InputError(f"{self.key}: {field.replace('_', ' ')}", None, rule, remedy, file)


#: How far numbers of a file may be from those of the scenario: m, rad, modules.
_CLOSE = {
    "module": 1e-6,
    "pressure_angle": 2e-4,
    "helix_angle": 2e-4,
    "profile_shift": 2e-3,
    "face_width": 1e-4,
    "tip_diameter": 2e-4,
}
_UNITS = {
    **dict.fromkeys(("module", "face_width", "tip_diameter"), (1e3, " mm")),
    **dict.fromkeys(("pressure_angle", "helix_angle"), (180.0 / math.pi, " deg")),
}


def _shown(field: str, value: object) -> str:
    if isinstance(value, bool):
        return "internal" if value else "external"
    if isinstance(value, float):
        factor, unit = _UNITS.get(field, (1.0, ""))
        return f"{factor * value:.6g}{unit}"
    return str(value)


def other_flank(flank: int) -> int:
    """The leading flank for the trailing one, and back."""
    return TRAILING if flank == LEADING else LEADING
