"""What a case says of its lubricant and of the friction between the flanks, in SI units."""

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class LubricantData:
    """What the mixed-EHL friction law needs to know of the lubricant and of its asperities.

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


@dataclass(frozen=True)
class FrictionData:
    """Which friction law acts between the flanks.

    Parameters
    ----------
    law : str
        Its name in scenario files; `tribodyn.studies.load.friction_law` maps it to the law's code.
    coefficient : float or None
        μ of Coulomb's law.
    sliding : {"kinematic", "dynamic"}
        Sliding speed from the nominal rotation, or from the vibrating bodies.
    reversal_width : float
        Distance along the path of contact over which friction changes sign at the pitch point, m.
    """

    law: str
    coefficient: float | None = None
    sliding: Literal["kinematic", "dynamic"] = "kinematic"
    reversal_width: float = 2e-5
