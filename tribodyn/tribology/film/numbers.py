"""What film laws by formula read of a contact, whatever its load and speed."""

from collections.abc import Callable
from importlib import import_module
from typing import Any, NamedTuple

from tribodyn.numerics.elementary import exp, law, log, log1p
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


# From the film between smooth flanks to the mean gap between rough ones: one quantity for all film laws.
#
# Fitted to 380 contacts of gears, each solved with and without roughness (`tools/law_ranges.py`): seven
# oils, surfaces of Ra 0.05 to 0.8 µm, h/σ from 0.01 to 30, asperities and limiting stress of drawn
# constants. In nine of ten the factor is 0.92 to 1.06 times the solved one, with the asperities' usual
# constants 0.97 to 1.06.


#: A and B of h/h_s = (1 + A (σ/h_s)²)^B: mean gap h on the line of centres over the central film h_s of
#: smooth flanks.
ROUGHENING_FACTOR, ROUGHENING_POWER = 1.25, 0.2


@law
def roughening(log_smooth, log_roughness):
    """Factor by which roughness raises a film, from the logarithms of the smooth film and of σ, m."""
    return exp(ROUGHENING_POWER * log1p(ROUGHENING_FACTOR * exp(2.0 * (log_roughness - log_smooth))))
