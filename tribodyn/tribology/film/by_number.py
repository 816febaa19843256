"""All film laws by formula in one function, for machine code that scenarios of other laws share."""

from tribodyn.numerics.elementary import law, where
from tribodyn.tribology.film.dowson_higginson import dowson_higginson
from tribodyn.tribology.film.masjedi_khonsari import rough_film
from tribodyn.tribology.film.moes import moes
from tribodyn.tribology.film.numbers import MASJEDI_KHONSARI, MOES


@law
def film_by_number(contact, surfaces, parameters):
    """Ln of the smooth film (m), roughness factor, asperity load share, by the law of the parameters."""
    log_rough, rough, share = rough_film(contact, surfaces, parameters)
    log_moes, by_moes, none = moes(contact, surfaces, parameters)
    log_dowson, by_dowson, none = dowson_higginson(contact, surfaces, parameters)
    is_moes = parameters.number == MOES
    log_film, factor = where(is_moes, log_moes, log_dowson), where(is_moes, by_moes, by_dowson)
    is_rough = parameters.number == MASJEDI_KHONSARI
    return where(is_rough, log_rough, log_film), where(is_rough, rough, factor), where(is_rough, share, none)
