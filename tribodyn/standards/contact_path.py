"""The path of contact of an involute pair and its points A, AB, B, C, D, DE, E, as the standards name them.

Of both gears the pinion drives: contact begins at A, where the gear's tip meets the pinion's root. Distances
g are along the path from A, m. Teeth and radii of an internal gear are negative, and so are the radii of
curvature of its flanks and the centre distance.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.standards.loss_factors import equal_loads

#: Points of the path in the order in which they are passed.
POINTS = ("A", "AB", "B", "C", "D", "DE", "E")


def transverse_angle(pressure_angle: float, helix_angle: float) -> float:
    """Transverse pressure angle α_t, rad: tan α_t = tan α_n/cos β, ISO 21771."""
    return math.atan(math.tan(pressure_angle) / math.cos(helix_angle))


class ContactPath(NamedTuple):
    """What the path of contact of an involute pair depends on; (pinion, gear)."""

    teeth: tuple[float, float]
    #: base_radius, tip_radius: r_b and r_a, m
    base_radius: tuple[float, float]
    tip_radius: tuple[float, float]
    pressure_angle: float  # α_wt, transverse, at the working pitch circles, rad
    base_helix_angle: float = 0.0  # β_b, rad, ≥ 0
    overlap_ratio: float = 0.0  # ε_β

    @property
    def ratio(self) -> float:
        """Gear ratio u = z2/z1."""
        return self.teeth[1] / self.teeth[0]

    @property
    def sense(self) -> float:
        """−1 where the pinion is internal, else 1: its torque has the sign of its radius, not its speed."""
        return -1.0 if self.teeth[0] < 0.0 else 1.0

    def pinion_torque(self, gear_torque: float) -> float:
        """Torque on the pinion, N m, that balances one on the gear, positive against its own motion."""
        return gear_torque / abs(self.ratio) * self.sense

    @property
    def centre_distance(self) -> float:
        """Distance a of the axes, m."""
        return sum(self.base_radius) / float(np.cos(self.pressure_angle))

    @property
    def pitch_radius(self) -> tuple[float, float]:
        """Working pitch radii r_w, m."""
        cosine = float(np.cos(self.pressure_angle))
        return self.base_radius[0] / cosine, self.base_radius[1] / cosine

    @property
    def base_pitch(self) -> float:
        """Transverse base pitch p_et, m."""
        return 2.0 * np.pi * self.base_radius[0] / self.teeth[0]

    @property
    def length(self) -> float:
        """Length g_α of the path, m."""
        return sum(self._tip_tangents) - self.centre_distance * float(np.sin(self.pressure_angle))

    @property
    def contact_ratio(self) -> float:
        """Transverse contact ratio ε_α."""
        return self.length / self.base_pitch

    @property
    def total_contact_ratio(self) -> float:
        """Total contact ratio ε_γ = ε_α + ε_β."""
        return self.contact_ratio + self.overlap_ratio

    @property
    def tip_contact_ratios(self) -> tuple[float, float]:
        """Contact ratios ε_1 and ε_2 of the pinion's and the gear's addendum; their sum is ε_α.

        ISO/TR 15144-1:2014, (93) and (94).
        """
        (first, second), tangent = self._tip_tangents, float(np.tan(self.pressure_angle))
        pinion, gear = self.base_radius
        return (first - pinion * tangent) / self.base_pitch, (second - gear * tangent) / self.base_pitch

    @property
    def _tip_tangents(self) -> tuple[float, float]:
        """Lengths of the tangents to the base circles up to the tip circles, m, with the sign of the gear."""
        first, second = (
            float(np.copysign(np.sqrt(tip**2 - base**2), base))
            for tip, base in zip(self.tip_radius, self.base_radius, strict=True)
        )
        return first, second


def point_distances(path: ContactPath) -> Float[Array, " point"]:
    """Distances g_Y of the `POINTS` from A, m: ISO/TR 15144-1:2014, (34) to (40).

    B and D are a base pitch from the ends, so that one pair alone carries between them where ε_α < 2; AB and
    DE lie in the middle between A and B, D and E.
    """
    length, pitch = path.length, path.base_pitch
    single = length - pitch
    pitch_point = length - path.tip_contact_ratios[0] * pitch
    return np.array([0.0, single / 2.0, single, pitch_point, pitch, pitch + single / 2.0, length])


def curvature_radii(path: ContactPath, distance: Any) -> tuple[Any, Any]:
    """Transverse radii of curvature ρ_1, ρ_2 of pinion and gear at a distance from A, m."""
    first = path._tip_tangents[0] - path.length + distance
    return first, path.centre_distance * np.sin(path.pressure_angle) - first


def equivalent_radius(path: ContactPath, distance: Any) -> Any:
    """Normal radius of relative curvature ρ_n,Y, m: ISO/TR 15144-1:2014, (43) and (45)."""
    first, second = curvature_radii(path, distance)
    return first * second / (first + second) / np.cos(path.base_helix_angle)


def rolling_speeds(path: ContactPath, distance: Any, pinion_speed: float) -> tuple[Any, Any]:
    """Tangential speeds v_r1, v_r2 of both flanks, m/s: ISO/TR 15144-1, (14), (15).

    Pinion speed in rad/s, positive in the pinion's own sense of rotation.
    """
    first, second = curvature_radii(path, distance)
    speed = pinion_speed * path.sense
    return speed * first, speed / path.ratio * second


def loss_factor(path: ContactPath) -> float:
    """Gear loss factor H_v of unmodified flanks: ISO/TR 15144-1:2014, (91) and (92).

    H_v = (ε_1² + ε_2² + 1 − ε_α)(1/z_1 + 1/z_2) π/cos β_b for ε_α < 2, else half of
    ε_α (1/z_1 + 1/z_2) π/cos β_b. Of a pitch point beyond an end of the path the integral that the former is.
    """
    first, second = path.tip_contact_ratios
    total = first + second
    lean, (pinion, gear) = float(np.cos(path.base_helix_angle)), path.teeth
    if total < 2.0:
        return equal_loads(first, second, pinion, gear / pinion) / lean
    return 0.5 * total * (1.0 / pinion + 1.0 / gear) * np.pi / lean


def load_share(path: ContactPath, distance: Any, quality: float = 7.0) -> Any:
    """Load sharing factor X_Y of unmodified gears with ε_α < 2: ISO/TR 15144-1:2014, clause 11.

    Spur gears have `single_pair_share`. Helical gears have the same times `buttressing` up to ε_β = 0.8, and
    `buttressing` over ε_α from ε_β = 1.2 on; between both X_Y is linear in ε_β. From memory of the report.
    """
    share = min(max((path.overlap_ratio - 0.8) / 0.4, 0.0), 1.0)
    single = (1.0 - share) * single_pair_share(path, distance, quality)
    return (single + share / path.contact_ratio) * buttressing(path, distance)


def flash_share(path: ContactPath, distance: Any, quality: float = 7.0) -> Any:
    """Load sharing factor X_Γ of unmodified gears with ε_α < 2: ISO/TS 6336-20:2017, clause 9.

    As `load_share`, but narrow helical gears are those with ε_γ < 2, wide ones all others; there is a step.
    """
    wide = path.overlap_ratio > 0.0 and path.total_contact_ratio >= 2.0
    single = 1.0 / path.contact_ratio if wide else single_pair_share(path, distance, quality)
    return single * buttressing(path, distance)


def single_pair_share(path: ContactPath, distance: Any, quality: float = 7.0) -> Any:
    """Share of a pair that meets over the whole face at once: ISO/TR 15144-1:2014, (46) to (48).

    From (Q − 2)/15 at A and E it grows by a third up to B and D, between which one pair carries all. Q is the
    grade of the coarser gear by ISO 1328-1, and 7 for finer ones.
    """
    first = (max(quality, 7.0) - 2.0) / 15.0
    length, pitch = path.length, path.base_pitch
    double = length - pitch
    if double <= 0.0:
        return np.ones_like(np.asarray(distance, dtype=float))
    rising, falling = np.asarray(distance) / double, (length - np.asarray(distance)) / double
    shared = np.minimum(first + np.minimum(rising, falling) / 3.0, 1.0)
    # B and D belong to the single pair; rounding decides nothing
    return np.where(np.minimum(rising, falling) > 1.0 - 1e-9, 1.0, shared)


def buttressing(path: ContactPath, distance: Any) -> Any:
    """Factor X_but by which the ends of a tooth of helical gears carry more; 1 of spur gears.

    1.3 at both ends, 1 + 0.3 ε_β where ε_β < 1; it falls to 1 over 0.2 sin β_b of the parameter Γ of the
    path, which is 0 at C and −1 at the pinion's base tangent point. ISO/TS 6336-20:2017, clause 9.
    """
    peak = 1.0 + 0.3 * min(path.overlap_ratio, 1.0)
    width = 0.2 * np.sin(path.base_helix_angle) * path.base_radius[0] * np.tan(path.pressure_angle)
    from_ends = np.minimum(distance, path.length - np.asarray(distance))
    if width == 0.0:
        return np.ones_like(from_ends)
    return np.maximum(peak - (peak - 1.0) * from_ends / width, 1.0)


def helical_load_factor(total_contact_ratio: float) -> float:
    """Helical load factor K_Bγ over ε_γ: ISO/TR 15144-1:2014, (88) to (90).

    1 up to ε_γ = 2, 1 + 0.2 √((ε_γ − 2)(5 − ε_γ)) up to 3.5, then 1.3.
    """
    if total_contact_ratio <= 2.0:
        return 1.0
    if total_contact_ratio < 3.5:
        return 1.0 + 0.2 * float(np.sqrt((total_contact_ratio - 2.0) * (5.0 - total_contact_ratio)))
    return 1.3
