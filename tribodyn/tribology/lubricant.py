"""What a case says of its lubricant and of the asperities in it, in SI units."""

from dataclasses import dataclass


@dataclass(frozen=True)
class LubricantData:
    """Lubricant and asperities, as film and friction laws make their parameters of them.

    Parameters
    ----------
    asperity_friction : float
        f_c, friction coefficient of the asperities.
    limiting_shear_coefficient : float
        Λ_lim, limiting shear stress over pressure.
    inlet_viscosity : float
        η0, dynamic viscosity at inlet temperature and ambient pressure, Pa s.
    pressure_viscosity : float
        α_PV, 1/Pa.
    viscosity_pressure_index : float
        z of Roelands' law.
    temperature_viscosity : float
        K_T, 1/K.
    density : float
        kg/m³; used by ISO/TR 14179-1 and by Veciana's variant of the Péclet number.
    load_exponent : float
        d of Niemann's lubricant factor X_L = w^−d; 0.0651 of mineral oil 75W90 (Diez-Ibarbia et al.).
    """

    asperity_friction: float
    limiting_shear_coefficient: float
    inlet_viscosity: float
    pressure_viscosity: float
    viscosity_pressure_index: float
    temperature_viscosity: float
    density: float
    load_exponent: float = 0.0651
