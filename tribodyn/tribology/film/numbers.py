"""What film laws by formula read of a contact, whatever its load and speed."""

from collections.abc import Callable
from importlib import import_module
from typing import Any, NamedTuple

from tribodyn.numerics.elementary import log
from tribodyn.tribology.law import LawInput

#: Numbers of the laws, by which `film_by_number` tells them apart.
MASJEDI_KHONSARI, DOWSON_HIGGINSON, MOES = range(3)


class FilmNumbers(NamedTuple):
    """Natural logarithms, so that none is taken twice, and the number of the law."""

    log_modulus: Any  # of E' in Pa
    log_material: Any  # of G = α_PV E'
    log_hardness: Any  # of V = H_v/E'
    log_roughness: Any  # of σ in m
    log_inlet_viscosity: Any  # of η0 in Pa·s
    log_asperity_factor: Any  # of the factor inside the logarithm of the asperity load ratio
    number: float


def film_numbers(inputs: LawInput, number: int, asperity_log_factor: float = 4470.0) -> FilmNumbers:
    """Return the parameters of a law; the factor of the asperity load ratio is the paper's."""
    surfaces = inputs.surfaces
    log_modulus = log(surfaces.effective_modulus)
    return FilmNumbers(
        log_modulus=log_modulus,
        log_material=log(surfaces.pressure_viscosity) + log_modulus,
        log_hardness=log(surfaces.hardness) - log_modulus,
        log_roughness=log(surfaces.roughness),
        log_inlet_viscosity=log(surfaces.inlet_viscosity),
        log_asperity_factor=log(asperity_log_factor),
        number=float(number),
    )


def film_by_number() -> Callable[..., Any]:
    """Return the function of all laws by formula; by name, so that no kernel without it depends on them."""
    return import_module("tribodyn.tribology.film.by_number").film_by_number
