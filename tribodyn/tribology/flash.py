"""Flash temperature of the sliding contact."""

import math

from tribodyn.numerics.elementary import absolute, law, sqrt

ROOT_PI = math.sqrt(math.pi)


@law
def flash_temperature_rise(heat_flux, half_width, pinion_speed, gear_speed, solids):
    """Average temperature rise ΔT in the contact, K.

    ΔT = 2 a_H q/{√π [K_1 √(1 + Pe_1) + K_2 √(1 + Pe_2)]}, Pe_j = a_H |u_j| (ρ_s c_p)_j/(2 K_j): Tian &
    Kennedy (1994); Liu & Ni (22), who leave the solid's heat capacity per volume ρ_s c_p out of Pe.

    Parameters
    ----------
    heat_flux : q, W/m²
    half_width : a_H, m
    pinion_speed, gear_speed : speeds of the heat sources along the surfaces, m/s, any sign
    solids : Surfaces, or any record with these four of its fields
        pinion_conductivity, gear_conductivity (W/(m K)), pinion_heat_capacity, gear_heat_capacity (J/(m³ K)).
    """
    # K √(1 + Pe) with K drawn into the root, which saves two divisions
    pinion_flow = 0.5 * half_width * absolute(pinion_speed) * solids.pinion_heat_capacity
    gear_flow = 0.5 * half_width * absolute(gear_speed) * solids.gear_heat_capacity
    conducted = sqrt(solids.pinion_conductivity * (solids.pinion_conductivity + pinion_flow)) + sqrt(
        solids.gear_conductivity * (solids.gear_conductivity + gear_flow)
    )
    return heat_flux * (2.0 / ROOT_PI * half_width / conducted)
