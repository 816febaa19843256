"""From a case to the surfaces and the lubricant of its contacts, as the friction law in use wants them."""

import math
from typing import Protocol

from tribodyn.errors import InputError
from tribodyn.geometry.drive import Drive
from tribodyn.geometry.material import MaterialData
from tribodyn.tribology.contact import Contact
from tribodyn.tribology.data import FrictionData, LubricantData
from tribodyn.tribology.mean_friction import MeanConditions, mean_conditions

#: Pressure angle at the pitch point below which Niemann's formula has no meaning: radius and speed vanish.
LEAST_ANGLE = math.radians(1.0)


class Duty(Protocol):
    """Nominal speed of the pinion (rad/s) and constant torque on the gear (N m)."""

    @property
    def pinion_speed(self) -> float: ...  # noqa: D102
    @property
    def gear_torque(self) -> float: ...  # noqa: D102


class Geared(Protocol):
    """What a case tells of its pair of gears."""

    @property
    def family(self) -> str: ...  # noqa: D102
    @property
    def drive(self) -> Drive: ...  # noqa: D102


class Lubricated(Geared, Protocol):
    """What a case must tell of its contacts."""

    @property
    def materials(self) -> tuple[MaterialData, MaterialData]: ...  # noqa: D102
    @property
    def roughness(self) -> float: ...  # noqa: D102
    @property
    def mean_roughness(self) -> float: ...  # noqa: D102
    @property
    def lubricant(self) -> LubricantData: ...  # noqa: D102
    @property
    def operating(self) -> Duty: ...  # noqa: D102
    @property
    def friction(self) -> FrictionData: ...  # noqa: D102


def contact_of(case: Lubricated) -> Contact:
    """Numbers of the friction law.

    Raises
    ------
    InputError
        If the law needs a mean over a mesh for which it has no meaning.
    """
    from tribodyn.tribology.laws import friction_law

    law = friction_law(case.friction.law)
    pinion, gear = case.materials
    lubricant = case.lubricant
    compliance = [(1 - m.poisson_ratio**2) / m.youngs_modulus for m in case.materials]
    density = [lubricant.density if law.lubricant_heat else m.density for m in case.materials]
    # the printed Peclet number has no heat capacity in it; 1 J/(m³ K) is what that amounts to
    heat = [
        rho * m.specific_heat if law.heat_capacity else 1.0
        for rho, m in zip(density, case.materials, strict=True)
    ]
    coefficient = float(case.friction.coefficient or 0.0)
    if law.mean is not None:
        coefficient = float(law.mean(nominal_conditions(case)))
    return Contact(
        effective_modulus=2.0 / sum(compliance),
        hardness=min(pinion.hardness, gear.hardness),
        roughness=case.roughness,
        asperity_friction=lubricant.asperity_friction,
        limiting_shear_coefficient=lubricant.limiting_shear_coefficient,
        inlet_viscosity=lubricant.inlet_viscosity,
        pressure_viscosity=lubricant.pressure_viscosity,
        viscosity_pressure_index=lubricant.viscosity_pressure_index,
        temperature_viscosity=lubricant.temperature_viscosity,
        pinion_conductivity=pinion.thermal_conductivity,
        gear_conductivity=gear.thermal_conductivity,
        pinion_heat_capacity=heat[0],
        gear_heat_capacity=heat[1],
        coulomb_coefficient=coefficient,
        asperity_log_factor=law.asperity_log_factor,
        limiting_share=law.limiting_share,
        mean_roughness=case.mean_roughness,
        viscosity_pressure_factor=law.viscosity_pressure_factor,
        peclet_sliding=law.peclet_sliding,
    )


def nominal_conditions(case: Lubricated) -> MeanConditions:
    """Conditions at the pitch point at nominal speed and constant torque, for a mean friction coefficient."""
    from tribodyn.geometry.families import family

    path = family(case.family).working_path(case.drive)
    angle = float(path.pressure_angle(0.0))
    if angle < LEAST_ANGLE or case.operating.gear_torque <= 0.0:
        raise InputError(
            "friction.law",
            f'"{case.friction.law}"',
            "is a mean over the mesh from radius, speed and load at the pitch point, which vanish here",
            "use a law of the local contact, such as masjedi-khonsari or xu",
        )
    gear_radius = float(path.gear_pitch_radius)
    return mean_conditions(
        case.operating.gear_torque / gear_radius,
        float(path.pinion_pitch_radius),
        gear_radius,
        angle,
        case.operating.pinion_speed,
        min(case.drive.pinion.face_width, case.drive.gear.face_width),
        case.lubricant.inlet_viscosity,
        case.lubricant.density,
        case.mean_roughness,
        case.lubricant.load_exponent,
    )
