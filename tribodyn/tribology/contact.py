"""What the closures need to know of the two surfaces and the lubricant, and the Hertz line contact."""

import math
from typing import Any, NamedTuple

from tribodyn.elementary import exp, law, log, maximum, sqrt


class Contact(NamedTuple):
    """Surfaces, lubricant and the parameters of the friction law in use; floats, SI.

    Attributes
    ----------
    effective_modulus : E', 1/E' = ½[(1 − ν1²)/E1 + (1 − ν2²)/E2], Pa
    hardness : Vickers hardness H_v of the softer surface, Pa
    roughness : composite rms roughness σ, m
    asperity_friction : friction coefficient f_c of touching asperities
    limiting_shear_coefficient : Λ_lim, limiting shear stress over pressure
    inlet_viscosity : η0, Pa·s
    pressure_viscosity : α_PV, 1/Pa
    viscosity_pressure_index : Roelands' z
    temperature_viscosity : K_T, 1/K
    pinion_conductivity, gear_conductivity : W/(m K)
    pinion_heat_capacity, gear_heat_capacity : per volume ρ_s c_p of the solids, J/(m³ K)
    coulomb_coefficient : friction coefficient of the Coulomb law and of the laws that give the mesh one mean
    asperity_log_factor : the factor inside the logarithm of the asperity load ratio, 4470
    limiting_share : 1: the limiting shear stress follows the pressure on the fluid, p(1 − λ); 0: the whole p
    mean_roughness : arithmetic mean roughness Ra of the flanks, m
    viscosity_pressure_factor : pressure in Roelands' law over the mean pressure: 1, or 4/π for the greatest
    peclet_sliding : 1: both Péclet numbers contain the sliding speed; 0: each surface's own speed
    """

    effective_modulus: Any
    hardness: Any
    roughness: Any
    asperity_friction: Any
    limiting_shear_coefficient: Any
    inlet_viscosity: Any
    pressure_viscosity: Any
    viscosity_pressure_index: Any
    temperature_viscosity: Any
    pinion_conductivity: Any
    gear_conductivity: Any
    pinion_heat_capacity: Any
    gear_heat_capacity: Any
    coulomb_coefficient: Any
    asperity_log_factor: Any
    limiting_share: Any
    mean_roughness: Any
    viscosity_pressure_factor: Any
    peclet_sliding: Any


@law
def hertz_half_width(line_load, curvature, effective_modulus):
    """Half width a_H = √(8 w' ρ/(π E')) of a line contact, m (Johnson, Contact Mechanics, ch. 4)."""
    return sqrt(8.0 * line_load / (math.pi * effective_modulus * curvature))


@law
def hertz_pressure(line_load, curvature, effective_modulus):
    """Greatest Hertz pressure p_H = √(w' E'/(2π ρ)), Pa."""
    return sqrt(line_load * effective_modulus * curvature / (2.0 * math.pi))


@law
def averaged_radius(radius, line_load, effective_modulus, pitch_point_length):
    """Equivalent radius averaged over the half width a of its own contact, m; for one that vanishes at P.

    ρ̄⁴ = ρ⁴ + (M a)², a = √(8 w' ρ̄/(π E')). At P, where ρ = 0, ρ̄² = M a is the exact mean of
    `geometry.pitch_point`; far from P ρ̄ = ρ, the difference falling like (M a/ρ²)². With M = 0 it is ρ
    everywhere. The quartic is convex above its largest root, to which Newton's steps come down.
    """
    strength = pitch_point_length * pitch_point_length * 8.0 * maximum(line_load, 1.0)
    strength = strength / (math.pi * effective_modulus)
    fourth = radius * radius * radius * radius
    root = radius + exp(log(maximum(strength, 1e-60)) / 3.0)
    for _ in range(6):
        cube = root * root * root
        root = (3.0 * cube * root + fourth) / (4.0 * cube - strength)
    return root
