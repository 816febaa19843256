"""Viscosity and limiting shear stress of the lubricant in the contact."""

from tribodyn.numerics.elementary import exp, law, log, maximum, minimum

#: Above this the exponential overflows; 1 − exp(−η …) has long reached 1.
MAXIMUM_EXPONENT = 600.0


@law
def log_roelands_viscosity(pressure, temperature_rise, log_inlet_viscosity, index, temperature_coefficient):
    """Average viscosity in the contact, ln of Pa·s, from the logarithm of the one at the inlet, η0 in Pa·s.

    η = η0 exp{(ln η0 + 9.67) [−1 + (1 + 5.1e-9 p)^z] − K_T ΔT}, Roelands (1966); Liu & Ni (21). The exponent
    is clipped (near a cycloid's pitch point the Hertz pressure diverges).
    """
    rise = exp(index * log(1.0 + 5.1e-9 * pressure)) - 1.0
    exponent = (log_inlet_viscosity + 9.67) * rise - temperature_coefficient * temperature_rise
    exponent = maximum(minimum(exponent, MAXIMUM_EXPONENT), -MAXIMUM_EXPONENT)
    return log_inlet_viscosity + exponent


@law
def limiting_shear_share(asperity_share, coefficient, limiting_share):
    """Shear stress that the fluid cannot exceed over the pressure, τ_lim/p = Λ_lim (1 − λ); Liu & Ni (20).

    With `limiting_share` 0 it is Λ_lim: the variant that brings Liu & Ni's friction levels closest.
    """
    return coefficient * (1.0 - limiting_share * asperity_share)
