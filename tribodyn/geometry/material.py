"""What gears are made of, and their masses where they are given."""

from dataclasses import dataclass


@dataclass(frozen=True)
class MaterialData:
    """What a gear is made of."""

    name: str  # name of the material's file, or its title
    youngs_modulus: float  # E, Pa
    poisson_ratio: float  # ν, 0 ≤ ν < 0.5
    density: float  # ρ of the solid, kg/m³
    thermal_conductivity: float  # K, W/(m K)
    specific_heat: float  # c_p, J/(kg K)
    hardness: float  # Vickers hardness as a pressure, Pa


@dataclass(frozen=True)
class BodyMass:
    """Mass (kg) and polar moment of inertia (kg m²) of a gear; None: computed from outline, bore, width."""

    mass: float | None = None
    inertia: float | None = None
