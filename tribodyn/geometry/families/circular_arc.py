"""The circular-arc family: a path of contact of two circular arcs that meet at the pitch point.

The chord of an arc of diameter D makes asin(|r|/D) with the arc's tangent, so that on either side
α = α_P + asin(|r|/D): the pressure angle grows away from P on both. A negative diameter bends the arc the
other way; with D_2 = −D_1 both arcs are one circle. With α_P = 0 the arcs are the generating circles of
cycloidal teeth (`cycloidal`).
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.drive import Drive, reference_radii
from tribodyn.geometry.families import Family, unshifted
from tribodyn.geometry.limits.sizes import refuse_shift, require_reach
from tribodyn.geometry.path import PerContact
from tribodyn.numerics.elementary import cos, log, minimum, namespace, sin, sqrt, where
from tribodyn.numerics.iteration import newton
from tribodyn.numerics.parameter import Parameter

_NEWTON_STEPS = 8


class ArcPath(NamedTuple):
    """Two arcs through the pitch point; closed forms but for the inverse of `rotation`.

    With β = α − α_P = asin(r/D): dφ = cos β dβ D/(r_p cos(α_P + β)), which integrates to
    φ = [β cos α_P − sin α_P ln(cos(α_P + β)/cos α_P)] D/r_p.
    """

    #: pinion_pitch_radius, gear_pitch_radius: pitch radii, m
    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    angle: Any  # pressure angle α_P at the pitch point, rad
    #: approach_diameter, recess_diameter: D of either arc, m; negative where α falls away from P
    approach_diameter: Any
    recess_diameter: Any

    def _diameter(self, r: PerContact) -> PerContact:
        """Diameter with the sign of r or r_p φ, so that r over it is the sine of β."""
        return where(r < 0, -self.approach_diameter, self.recess_diameter)

    def pressure_angle(self, r: PerContact) -> PerContact:
        """Pressure angle, rad; NaN beyond the ends of a diameter."""
        sine = r / self._diameter(r)
        return self.angle + namespace(sine).arcsin(sine)

    def pressure_angle_slope(self, r: PerContact) -> PerContact:
        """Slope dα/dr, rad/m; at P itself the recess's."""
        diameter = self._diameter(r)
        return 1 / (diameter * sqrt(1 - (r / diameter) ** 2))

    def rotation(self, r: PerContact) -> PerContact:
        """Pinion angle φ, rad."""
        diameter = self._diameter(r)
        sine = r / diameter
        return self._turned(namespace(sine).arcsin(sine)) * diameter / self.pinion_pitch_radius

    def _turned(self, beta: PerContact) -> PerContact:
        """Pinion angle in units of D/r_p."""
        return cos(self.angle) * beta - sin(self.angle) * log(cos(self.angle + beta) / cos(self.angle))

    def signed_distance(self, rotation: PerContact) -> PerContact:
        """Signed distance r (m) at the pinion angle φ."""
        xp = namespace(self, rotation)
        rolled = xp.asarray(rotation * self.pinion_pitch_radius)
        diameter = self._diameter(rolled)
        target = rolled / diameter
        start = minimum(target * cos(self.angle), 0.98 * (np.pi / 2 - self.angle))
        return diameter * sin(newton(_step_to_rotation, start, _NEWTON_STEPS, self, target))


def _step_to_rotation(beta: PerContact, path: ArcPath, target: PerContact) -> PerContact:
    return beta - (path._turned(beta) - target) * cos(path.angle + beta) / cos(beta)


class ArcShape(NamedTuple):
    """Diameters of the two arcs, m; negative where the pressure angle falls away from the pitch point."""

    approach_diameter: Any
    recess_diameter: Any


def working_path(drive: Drive) -> ArcPath:
    """Two arcs of the drive's diameters and pressure angle."""
    return ArcPath(*reference_radii(drive), drive.pressure_angle, *drive.shape)


def arc_ends(path: ArcPath) -> tuple[float, float]:
    """Signed distances (m) up to which each arc serves: to where α comes near 90° or falls to 0."""

    def end(diameter: float) -> float:
        if diameter > 0:
            return 0.999 * diameter * math.cos(path.angle)
        return -0.999 * diameter * math.sin(path.angle)

    return -end(path.approach_diameter), end(path.recess_diameter)


def check(drive: Drive) -> None:
    """Refuse profile shift, no arc at all, arcs that end before the teeth do, and undercut."""
    refuse_shift(drive)
    for name, diameter in drive.shape._asdict().items():
        if diameter == 0:
            raise InputError(f"drive.shape.{name}", "0 mm", "an arc needs a diameter", "use another one")
    path = working_path(drive)
    require_reach(drive, path, *arc_ends(path), _advice)


def _advice(drive: Drive, half: int) -> tuple[str, Any, str]:
    name = "approach_diameter" if half < 0 else "recess_diameter"
    diameter = getattr(drive.shape, name)
    remedy = "use a larger one or lower teeth" if diameter > 0 else "use a more negative one, or lower teeth"
    return f"shape.{name}", f"{1e3 * diameter:.4g} mm", remedy


FAMILY = Family(
    "circular-arc",
    working_path,
    unshifted(working_path),
    shiftable=False,
    check=check,
    shape=ArcShape,
    parameters=(
        Parameter(
            "approach_diameter",
            "signed length",
            "of the arc on which contact approaches P",
            example='"45 mm"',
        ),
        Parameter(
            "recess_diameter", "signed length", "of the arc on which it recedes from P", example='"45 mm"'
        ),
    ),
    corner=True,
    about="path of two circular arcs; pressure_angle at the pitch point, "
    "shape.approach_diameter, recess_diameter",
)
