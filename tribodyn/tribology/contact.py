"""What the closures need to know of the two surfaces and the lubricant, and the Hertz line contact."""

import math
from typing import Any, NamedTuple

from tribodyn.numerics.elementary import exp, law, log, maximum, sqrt


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


class Logarithms(NamedTuple):
    """Natural logarithms of what a contact has whatever its load and speed, so that no evaluation takes them.

    Attributes
    ----------
    modulus : of E' in Pa
    material : of G = α_PV E'
    hardness : of V = H_v/E'
    roughness : of σ in m
    inlet_viscosity : of η0 in Pa·s
    asperity_factor : of the factor inside the logarithm of the asperity load ratio
    """

    modulus: Any
    material: Any
    hardness: Any
    roughness: Any
    inlet_viscosity: Any
    asperity_factor: Any


@law
def logarithms(contact):
    """Logarithms of the numbers of a `Contact`."""
    modulus = log(contact.effective_modulus)
    return Logarithms(
        modulus,
        log(contact.pressure_viscosity) + modulus,
        log(contact.hardness) - modulus,
        log(contact.roughness),
        log(contact.inlet_viscosity),
        log(contact.asperity_log_factor),
    )


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

    The exact mean at P is ρ̄² = M a (`geometry.pitch_point`). A contact beside P covers P while that is nearer
    than a; for it there is no closed form, but ρ⁴ = ρ̄⁴ + 14 (M a)² − 15 (M a)⁴/ρ̄⁴ is exact at P and where the
    contact's edge is at P, goes over to ρ̄ = ρ far away, and between meets the mean over a flank of curvature
    k/√s to 10 %. With a² = 8 w' ρ̄/(π E') it is a polynomial in ρ̄, to whose root Newton's steps come down.
    A load below 1 N/m counts as that; with M = 0 the radius stays as it is.
    """
    scale = pitch_point_length * pitch_point_length * 8.0 * maximum(line_load, 1.0)
    scale = exp(log(maximum(scale / (math.pi * effective_modulus), 1e-60)) / 3.0)  # ρ̄ at P
    fourth = (radius / scale) * (radius / scale) * (radius / scale) * (radius / scale)
    root = sqrt(1.0 + (radius / scale) * (radius / scale))
    for _ in range(6):
        square = root * root
        cube = square * root
        value = cube * cube + 14.0 * cube - 15.0 - fourth * square
        root = root - value / (6.0 * cube * square + 42.0 * square - 2.0 * fourth * root)
    return scale * root
