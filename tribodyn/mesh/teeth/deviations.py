"""Deviations of single teeth: run-out of a gear, errors of pitch, profile and helix of every flank.

Lengths are along the flank's normal, positive where material is missing, but for eccentricity and wobble.
What is written of a gear holds for the flanks that carry: the leading one of a gear that drives, the trailing
one of a gear that is driven, both of an idler or a planet.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.modification import MOST_WAVES, SPREAD, Limits, sampled
from tribodyn.mesh.teeth.fields import LEADING, FlankPlaces, ToothFields, height_share, sound
from tribodyn.numerics.curve import FormulaError, evaluated
from tribodyn.numerics.shapes import Array, Float


def _gap_alone(gap: Float[Array, "slice node"], places: FlankPlaces) -> ToothFields:
    return sound(places)._replace(gap=gap * np.ones((len(places.face), len(places.roll))))


@dataclass(frozen=True)
class RunOut:
    """A gear whose axis is not the one that it turns about: shifted by an eccentricity, tilted by a wobble.

    In mid-face the gear's axis stands off by the eccentricity, and at z by the vector sum of eccentricity and
    wobble times z. Angles are directions from the axis of tooth 0 in the gear's own sense of rotation. With ξ
    the direction from the line of centres (`FlankPlaces.turned` and the angle), the leading flank lacks
    −e sin(ξ + α) along the transverse normal and the trailing one e sin(ξ − α), of an internal gear, which
    its mate pushes outwards, with −α: of one gear the error is e sin(θ + α_w), with sidebands of the mesh
    orders at ± its rotation (physics 11).
    """

    teeth: int
    eccentricity: float = 0.0  # m
    eccentricity_angle: float = 0.0  # rad
    wobble: float = 0.0  # angle between both axes, rad
    wobble_angle: float = 0.0  # rad
    face_width: float = 0.0  # m
    of_gap_alone: bool = True

    @property
    def early(self) -> float:
        """Of opposite teeth."""
        return 2.0 * self.eccentricity + self.wobble * self.face_width

    def fields(self, tooth: int, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `fields.OwnFields`."""
        behind = places.turned + 2.0 * np.pi * tooth / self.teeth
        gap, outward = np.zeros_like(behind), np.sign(places.radius) * places.pressure_angle
        tilted = self.wobble * places.face[:, None]
        parts = (self.eccentricity, self.eccentricity_angle), (tilted, self.wobble_angle)
        for offset, angle in parts:
            direction = behind + angle
            if flank == LEADING:
                gap = gap - offset * np.sin(direction + outward)
            else:
                gap = gap + offset * np.sin(direction - outward)
        return _gap_alone(gap * places.lean, places)


@dataclass(frozen=True)
class PitchErrors:
    """Index deviations: how much a flank of each tooth is behind its place; the other one is ahead."""

    errors: tuple[float, ...]  # m along the normal
    flank: int  # that is behind: `LEADING` or `TRAILING`
    of_gap_alone: bool = True

    @property
    def early(self) -> float:
        """Of all teeth."""
        return float(np.ptp(self.errors))

    def fields(self, tooth: int, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `fields.OwnFields`."""
        error = self.errors[tooth]
        return _gap_alone(np.array(error if flank == self.flank else -error), places)


@dataclass(frozen=True)
class ToothSample:
    """Deviations of every tooth, drawn within tolerances: a normal distribution, a third of them its spread.

    Pitch as `modification.sampled`, which keeps single and total pitch, as `PitchErrors` of `flank`; profile
    slope and form (one to three waves) and helix slope of every flank by itself. The same for the same seed
    and number of the gear.
    """

    limits: Limits
    teeth: int
    seed: int
    gear: int
    face_width: float  # over which the helix slope is, m
    flank: int
    of_gap_alone: bool = True

    @property
    def early(self) -> float:
        """By the tolerances."""
        return sum(self.limits) - self.limits.single_pitch

    @cached_property
    def _pitch(self) -> Float[Array, " tooth"]:
        """Of all teeth, which are drawn together."""
        return sampled(self.limits, self.teeth, self.seed, self.gear).pitch

    def fields(self, tooth: int, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `fields.OwnFields`."""
        pitch = float(self._pitch[tooth])
        random = np.random.default_rng([self.seed, self.gear, 1 + tooth, flank])
        share = np.clip(random.standard_normal(3) / SPREAD, -1.0, 1.0)
        waves, phase = random.integers(1, MOST_WAVES + 1), random.uniform(0.0, 2.0 * np.pi)
        along = height_share(places)
        gap = pitch if flank == self.flank else -pitch
        gap = gap + share[0] * self.limits.profile_slope * (along - 0.5)
        gap = gap + abs(share[1]) * self.limits.profile_form / 2.0 * np.cos(
            2.0 * np.pi * waves * along + phase
        )
        lead = share[2] * self.limits.helix_slope * places.face[:, None] / self.face_width
        return _gap_alone(gap + lead, places)


@dataclass(frozen=True)
class MeasuredFlanks:
    """Errors of chosen teeth as they were measured, over height and face; linear between the points.

    `height` is `fields.height_share`, `face` the place from the middle of the face. What is measured beyond
    the ends counts as at the ends.
    """

    teeth: tuple[int, ...]
    height: Float[Array, " height"]
    face: Float[Array, " face"]  # m; a single one: even along the face
    errors: Float[Array, "tooth height face"]  # m along the normal
    flanks: tuple[int, ...]  # that have them
    of_gap_alone: bool = True

    @property
    def early(self) -> float:
        """Of all teeth, those that were not measured included."""
        return float(np.max(self.errors, initial=0.0) - np.min(self.errors, initial=0.0))

    def fields(self, tooth: int, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `fields.OwnFields`."""
        if tooth not in self.teeth or flank not in self.flanks:
            return None
        error = self.errors[self.teeth.index(tooth)]
        along = height_share(places)
        by_height = np.stack([np.interp(along, self.height, column) for column in error.T])  # (face, node)
        if len(self.face) == 1:
            return _gap_alone(by_height, places)
        columns = [np.interp(places.face, self.face, node) for node in by_height.T]
        return _gap_alone(np.stack(columns, axis=-1), places)


@dataclass(frozen=True)
class FormulaErrors:
    """Errors of every tooth by a formula, of `FORMULA_VARIABLES`, in µm along the normal."""

    formula: str
    teeth: int
    face_width: float  # m
    flanks: tuple[int, ...]  # that have them
    of_gap_alone: bool = True

    @property
    def early(self) -> float:
        """Of all teeth, at a few places of their flanks."""
        height, face = np.linspace(0.0, 1.0, 9), np.array([-0.5, 0.0, 0.5])[:, None]
        values = [formula_value(self.formula, n, self.teeth, height, face) for n in range(self.teeth)]
        return 1e-6 * float(np.ptp(values))

    def fields(self, tooth: int, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `fields.OwnFields`."""
        if flank not in self.flanks:
            return None
        height, face = height_share(places), places.face[:, None] / self.face_width
        try:
            value = formula_value(self.formula, tooth, self.teeth, height, face)
        except FormulaError as error:  # at a place that a check did not see
            rule = f"{error}: at tooth {tooth + 1}, between places where it is"
            raise InputError("modification.tooth_formula", f'"{self.formula}"', rule) from None
        return _gap_alone(1e-6 * value, places)


#: Of `FormulaErrors`: number of the tooth, from 1; number of teeth; place along the profile, 0 at the root's
#: end of the path and 1 at the tip's; place on the face, −½ … ½.
FORMULA_VARIABLES = ("i", "z", "h", "f")


def formula_value(
    formula: str, tooth: int, teeth: int, height: Float[Array, " node"], face: Float[Array, "slice 1"]
) -> Float[Array, "slice node"]:
    """Value of a formula; raises `formula.FormulaError`."""
    values = (float(tooth + 1), float(teeth), height, face)
    return evaluated(formula, dict(zip(FORMULA_VARIABLES, values, strict=True))) + 0.0 * height
