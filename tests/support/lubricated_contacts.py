"""Lubricated contacts of two papers, as the laws of film and friction take them."""

import math

from tribodyn.tribology.contact import Contact

#: Liu & Ni (2022), Table 2; solid 7850 kg/m³, 460 J/(kg K).
LIU_NI = Contact(
    effective_modulus=2.06e11 / 0.91,
    hardness=2.3e9,
    roughness=3e-7,
    asperity_friction=0.11,
    limiting_shear_coefficient=0.091,
    inlet_viscosity=0.35,
    pressure_viscosity=2.5e-8,
    viscosity_pressure_index=0.57,
    temperature_viscosity=0.045,
    pinion_conductivity=60.5,
    gear_conductivity=60.5,
    pinion_heat_capacity=7850 * 460.0,
    gear_heat_capacity=7850 * 460.0,
    coulomb_coefficient=0.06,
    asperity_log_factor=4470.0,
    limiting_share=1.0,
    mean_roughness=3e-7 / math.sqrt(math.pi),
    viscosity_pressure_factor=1.0,
    peclet_sliding=0.0,
)
#: A point of contact of Liu & Ni's drive, SI units.
POINT = dict(
    line_load=3.85e5,
    curvature=1 / 8.98e-3,
    entrainment=0.134,
    sliding=0.0447,
    pinion_speed=0.156,
    gear_speed=0.112,
)

#: Veciana et al. (2024), Table 2.
VECIANA = LIU_NI._replace(
    effective_modulus=231e9,
    hardness=6e9,
    roughness=0.2e-6,
    asperity_friction=0.12,
    limiting_shear_coefficient=0.06,
    inlet_viscosity=0.01,
    pressure_viscosity=1.5e-8,
    viscosity_pressure_index=0.58,
    temperature_viscosity=0.03,
    pinion_heat_capacity=769.2 * 434,
    gear_heat_capacity=769.2 * 434,
    peclet_sliding=1.0,
)
