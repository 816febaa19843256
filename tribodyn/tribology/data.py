"""What a case says of its lubricant, and of film and friction between the flanks, in SI units."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from tribodyn.tribology.law import FilmLaw, FrictionLaw


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


@dataclass(frozen=True)
class FilmData:
    """Which film law holds between the flanks.

    Parameters
    ----------
    law : str, FilmLaw or None
        Its name in `tribodyn.tribology.film.FILM_LAWS`, or the law itself; None: the one that goes with the
        friction law.
    values : mapping
        Values of the law's own keys, by name, in SI units.
    """

    law: "str | FilmLaw | None" = None
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class FrictionData:
    """Which friction law acts between the flanks.

    Parameters
    ----------
    law : str or FrictionLaw
        Its name in `tribodyn.tribology.friction.FRICTION_LAWS`, or the law itself.
    values : mapping
        Values of the law's own keys, by name, in SI units.
    sliding : {"kinematic", "dynamic"}
        Sliding speed from the nominal rotation, or from the vibrating bodies.
    reversal_width : float
        Distance along the path of contact over which friction changes sign at the pitch point, m.
    """

    law: "str | FrictionLaw"
    values: Mapping[str, Any] = field(default_factory=dict)
    sliding: Literal["kinematic", "dynamic"] = "kinematic"
    reversal_width: float = 2e-5
