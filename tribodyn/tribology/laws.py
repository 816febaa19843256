"""What the names of friction laws in TOML stand for."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from tribodyn.errors import unknown_name
from tribodyn.tribology.friction import BENEDICT_KELLEY, COULOMB, MASJEDI_KHONSARI, NONE, XU
from tribodyn.tribology.mean_friction import MeanConditions, iso_14179_1, niemann


class FrictionLaw(NamedTuple):
    """What a friction law's name in TOML stands for.

    Parameters
    ----------
    code : int
        The law's code in `tribodyn.tribology.friction`.
    about : str
        What it is, in a line.
    coefficient : bool
        Whether the scenario gives a friction coefficient.
    asperity_log_factor : float
        Factor inside the logarithm of the asperity load ratio; 4470 in Masjedi & Khonsari (2012).
    limiting_share : float
        1: the limiting shear stress follows the pressure carried by the fluid; 0: the whole mean pressure.
    heat_capacity : bool
        Whether the Péclet numbers contain ρ_s c_p of the solids, as they must to be numbers.
    lubricant_heat : bool
        Whether the density in them is the lubricant's.
    peclet_sliding : float
        1: the speed in them is the sliding speed; 0: each surface's own.
    viscosity_pressure_factor : float
        Pressure in Roelands' law over the mean pressure of the contact.
    mean : callable, optional
        Gives the friction coefficient of the whole mesh, which then is a Coulomb contact.
    """

    code: int
    about: str
    coefficient: bool = False
    asperity_log_factor: float = 4470.0
    limiting_share: float = 1.0
    heat_capacity: bool = True
    lubricant_heat: bool = False
    peclet_sliding: float = 0.0
    viscosity_pressure_factor: float = 1.0
    mean: Callable[[MeanConditions], Any] | None = None


FRICTION_LAWS = {
    "none": FrictionLaw(NONE, "frictionless flanks; the film is still reported"),
    "coulomb": FrictionLaw(COULOMB, "a constant coefficient, friction.coefficient", coefficient=True),
    "masjedi-khonsari": FrictionLaw(
        MASJEDI_KHONSARI, "mixed elastohydrodynamic line contact, Masjedi & Khonsari (2012, 2015)"
    ),
    "masjedi-khonsari-mean-pressure": FrictionLaw(
        MASJEDI_KHONSARI,
        "the same, limiting shear stress from the whole mean pressure instead of the fluid's share",
        limiting_share=0.0,
    ),
    "masjedi-khonsari-as-printed": FrictionLaw(
        MASJEDI_KHONSARI,
        "the same with Liu & Ni's misprints: 447 for 4470, Péclet numbers without ρ c_p",
        asperity_log_factor=447.0,
        heat_capacity=False,
    ),
    "masjedi-khonsari-veciana": FrictionLaw(
        MASJEDI_KHONSARI,
        "the same as Veciana et al. print it: Péclet numbers of sliding speed and lubricant density",
        lubricant_heat=True,
        peclet_sliding=1.0,
    ),
    "masjedi-khonsari-veciana-peak": FrictionLaw(
        MASJEDI_KHONSARI,
        "the reading that meets Veciana's crossover: Roelands' law at the greatest pressure, "
        "each surface's own speed and the lubricant's density in the Péclet numbers",
        lubricant_heat=True,
        viscosity_pressure_factor=4.0 / math.pi,
    ),
    "xu": FrictionLaw(XU, "regression over thermal EHL solutions for oil 75W90, Xu (2005)"),
    "benedict-kelley": FrictionLaw(
        BENEDICT_KELLEY, "disc tests in mixed lubrication, Benedict & Kelley (1961)"
    ),
    "niemann": FrictionLaw(
        COULOMB, "mean coefficient of the mesh by Niemann, as in ISO/TR 14179-2", mean=niemann
    ),
    "iso-14179-1": FrictionLaw(COULOMB, "mean coefficient of the mesh by ISO/TR 14179-1", mean=iso_14179_1),
}


def friction_law(name: str) -> FrictionLaw:
    """Return what a friction law's name stands for."""
    if name not in FRICTION_LAWS:
        raise unknown_name("friction.law", name, FRICTION_LAWS, "friction law")
    return FRICTION_LAWS[name]
