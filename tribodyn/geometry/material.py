"""What gears are made of, and their masses where they are given."""

from dataclasses import dataclass


@dataclass(frozen=True)
class MaterialData:
    """What a gear is made of.

    Parameters
    ----------
    name : name of the material's file, or its title
    youngs_modulus : E, Pa
    poisson_ratio : ν, 0 ≤ ν < 0.5
    density : ρ of the solid, kg/m³
    thermal_conductivity : K, W/(m K)
    specific_heat : c_p, J/(kg K)
    hardness : Vickers hardness as a pressure, Pa
    """

    name: str
    youngs_modulus: float
    poisson_ratio: float
    density: float
    thermal_conductivity: float
    specific_heat: float
    hardness: float


@dataclass(frozen=True)
class BodyMass:
    """Mass (kg) and polar moment of inertia (kg m²) of a gear; None: computed from outline, bore, width."""

    mass: float | None = None
    inertia: float | None = None
