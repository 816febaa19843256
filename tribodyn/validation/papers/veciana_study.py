"""Drives and lubricant of Veciana et al. (2024), Tables 2 and 3, and the efficiencies of their study."""

import math
from functools import cache
from typing import Any, Literal, NamedTuple

import numpy as np

from tribodyn.geometry.drive import MaterialData
from tribodyn.studies.efficiency.mesh_positions import Array
from tribodyn.studies.efficiency.published import TorqueRatio, UnitContact, rotations, torque_ratio
from tribodyn.tribology.closure import closure, without_nominal_conditions
from tribodyn.tribology.contact import Surfaces
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import Closure, LawInput
from tribodyn.tribology.oil import LubricantData

#: Readings of the friction laws. "A" is the mixed law as printed: Roelands at the mean pressure, sliding
#: speed in the Péclet numbers; "B" has the maximum pressure and each surface's own speed.
Law = Literal["EHL", "MEHL A", "MEHL B"]
LAWS: tuple[Law, ...] = ("EHL", "MEHL A", "MEHL B")

PINION_TEETH = 27.0
PRESSURE_ANGLE = math.radians(20.0)
PITCH_LINE_SPEED = 12.5  # m/s
PITCH_POINT_PRESSURE = 668e6  # Pa, of the involute
WIDTH_OVER_DIAMETER = 0.8
EFFECTIVE_MODULUS = 231e9  # Pa
#: The paper's choice of the generating circles d_g1/d_1.
CHOSEN = 0.17
#: The paper's drives: (gear ratio, module m).
DRIVES = ((1.0, 2e-3), (2.0, 2e-3), (3.0, 2e-3), (1.0, 4e-3), (1.0, 6e-3))

#: Modulus and density are not read: E' is given, and the density in the Péclet numbers is the lubricant's.
STEEL = MaterialData("steel", 210e9, 0.3, 7850.0, 60.5, 434.0, hardness=6.0e9)
LUBRICANT = LubricantData(
    asperity_friction=0.12,
    limiting_shear_coefficient=0.06,
    inlet_viscosity=0.010,
    pressure_viscosity=1.5e-8,
    viscosity_pressure_index=0.58,
    temperature_viscosity=0.03,
    density=769.2,
)
SURFACES = Surfaces(
    effective_modulus=EFFECTIVE_MODULUS,
    hardness=STEEL.hardness,
    roughness=0.20e-6,
    mean_roughness=0.20e-6 / math.sqrt(math.pi),
    inlet_viscosity=LUBRICANT.inlet_viscosity,
    pressure_viscosity=LUBRICANT.pressure_viscosity,
    pinion_conductivity=STEEL.thermal_conductivity,
    gear_conductivity=STEEL.thermal_conductivity,
    # density of the lubricant, specific heat of the steel, as printed
    pinion_heat_capacity=LUBRICANT.density * STEEL.specific_heat,
    gear_heat_capacity=LUBRICANT.density * STEEL.specific_heat,
)
_NAMES: dict[Law, str] = {
    "EHL": "xu",
    "MEHL A": "masjedi-khonsari-veciana",
    "MEHL B": "masjedi-khonsari-veciana-peak",
}


@cache
def closure_of(name: Law) -> Closure:
    """Return the surfaces and laws of a reading."""
    friction = FRICTION_LAWS[_NAMES[name]]
    inputs = LawInput(SURFACES, LUBRICANT, (STEEL, STEEL), without_nominal_conditions)
    return closure(inputs, FILM_LAWS[friction.film], friction)


class DriveUnderLaw(NamedTuple):
    """One drive of the study under one law."""

    ratio: float  # i
    module: float  # m
    law: Law

    @property
    def pinion_radius(self) -> float:
        """Pitch radius of the pinion, m."""
        return self.module * PINION_TEETH / 2.0

    @property
    def pinion_speed(self) -> float:
        """Speed of the pinion, rad/s."""
        return PITCH_LINE_SPEED / self.pinion_radius

    @property
    def face_width(self) -> float:
        """Face width, m."""
        return WIDTH_OVER_DIAMETER * 2.0 * self.pinion_radius

    @property
    def input_torque(self) -> float:
        """Γ_1 that presses the involute to 668 MPa at its pitch point, N m: W'_0 = 2π R p_H²/E'."""
        radius = self.pinion_radius * math.sin(PRESSURE_ANGLE) * self.ratio / (1.0 + self.ratio)
        line_load = 2.0 * math.pi * radius * PITCH_POINT_PRESSURE**2 / EFFECTIVE_MODULUS
        return line_load * self.face_width * self.pinion_radius * math.cos(PRESSURE_ANGLE)

    def solve(self, pair: UnitContact) -> TorqueRatio:
        """Solve a pair of this drive."""
        return torque_ratio(pair, self.input_torque, self.pinion_speed, self.face_width, closure_of(self.law))

    def involute_pair(self, rotation: Any = None) -> UnitContact:
        """Return the involute of the drive."""
        return involute_contact(PINION_TEETH, self.pinion_radius, self.ratio, PRESSURE_ANGLE, rotation)

    def cycloid_pair(
        self,
        approach_circle: Any,
        recess_circle: Any = None,
        rotation: Any = None,
        exact_speeds: bool = False,
    ) -> UnitContact:
        """Return the cycloid with generating circles d_g1, d_g2 over d_1 (one given: both)."""
        circles = approach_circle, approach_circle if recess_circle is None else recess_circle
        return cycloid_contact(PINION_TEETH, self.pinion_radius, self.ratio, *circles, rotation, exact_speeds)

    def involute(self) -> float:
        """Efficiency of the involute."""
        return float(self.solve(self.involute_pair()).efficiency)

    def cycloid(self, approach_circle: Any, recess_circle: Any = None, exact_speeds: bool = False) -> Any:
        """Efficiency of the cycloid, array like its circles."""
        pair = self.cycloid_pair(approach_circle, recess_circle, exact_speeds=exact_speeds)
        return self.solve(pair).efficiency

    def crossover(self) -> float:
        """Circles d_g1 = d_g2 over d_1 at which the cycloid is as efficient as the involute."""
        from scipy.optimize import brentq

        level = self.involute()
        root: Any = brentq(lambda circle: float(self.cycloid(circle)) - level, 0.1, 0.4, xtol=1e-7)
        return float(root)


def contact_height(pair: UnitContact) -> float:
    """Radial height of the pinion's flank between its first and last contact, m.

    The radius of a contact point follows from its arms: (A, T) are its components about the pinion's axis.
    Pass a pair whose first and last points are the ends of contact.
    """
    radius = np.hypot(pair.pinion_normal_arm, pair.pinion_friction_arm)
    return float(radius[..., -1] - radius[..., 0])


def involute_contact(
    pinion_teeth: float,
    pinion_radius: Any,
    ratio: Any,
    pressure_angle: float,
    rotation: tuple[Array, Array] | None = None,
) -> UnitContact:
    """An involute pair: A = r_b, T = r sin α ± ψ r_b1 (Veciana (51), (52), (57)).

    Of the working pitch radius (m) and pressure angle (rad), i = d_2/d_1; the rotation is (ψ, weights), those
    of `rotations` if not given.
    """
    psi, weight = rotation or rotations(pinion_teeth)
    base = pinion_radius * math.cos(pressure_angle) + np.zeros_like(psi)
    pinion = pinion_radius * math.sin(pressure_angle) + psi * base
    gear = ratio * pinion_radius * math.sin(pressure_angle) - psi * base
    return UnitContact(
        rotation=psi,
        weight=weight,
        pinion_normal_arm=base,
        gear_normal_arm=ratio * base,
        pinion_friction_arm=pinion,
        gear_friction_arm=gear,
        curvature=1.0 / pinion + 1.0 / gear,
        pinion_speed=pinion,
        gear_speed=gear / ratio,
    )


def cycloid_contact(
    pinion_teeth: float,
    pinion_radius: float,
    ratio: float,
    approach_circle: Any,
    recess_circle: Any,
    rotation: tuple[Array, Array] | None = None,
    exact_speeds: bool = False,
) -> UnitContact:
    """A cycloidal pair: a = |ψ|/(2c), A = r cos a, T = r sin a ± d_g sin a (Veciana (24)-(40), (A9)-(A13)).

    The generating circles are c_h = d_g1/d_1 and c_e = d_g2/d_1, scalars or arrays (…). `exact_speeds`: the
    rolling speeds contain the motion of the contact along the path, r κ. Veciana (43)-(50) leave it out and
    take angular speed times lever arm; sliding is the same either way.
    """
    psi, weight = rotation or rotations(pinion_teeth)
    circles = np.asarray(approach_circle, dtype=float), np.asarray(recess_circle, dtype=float)
    share = np.where(psi < 0, circles[0][..., None], circles[1][..., None])
    angle = np.abs(psi) / (2.0 * share)
    generating = 2.0 * pinion_radius * share
    distance = np.sign(psi) * generating * np.sin(angle)
    pinion, gear = 2.0 * pinion_radius, 2.0 * pinion_radius * ratio
    inner = np.where(psi < 0, pinion, gear)  # the flank inside its pitch circle: a hypocycloid
    outer = np.where(psi < 0, gear, pinion)
    radius = 2.0 * np.sin(angle) * (outer + generating) * (inner - generating) / (pinion + gear)
    pinion_arm = pinion_radius * np.sin(angle) + distance
    gear_arm = ratio * pinion_radius * np.sin(angle) - distance
    along_path = np.abs(distance) / (2.0 * share) if exact_speeds else 0.0
    return UnitContact(
        rotation=psi,
        weight=weight,
        pinion_normal_arm=pinion_radius * np.cos(angle),
        gear_normal_arm=ratio * pinion_radius * np.cos(angle),
        pinion_friction_arm=pinion_arm,
        gear_friction_arm=gear_arm,
        curvature=1.0 / radius,
        pinion_speed=pinion_arm + along_path,
        gear_speed=gear_arm / ratio + along_path,
    )
