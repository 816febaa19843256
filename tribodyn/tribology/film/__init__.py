"""The film laws: one per file, and their registry."""

from tribodyn.numerics.registry import Registry
from tribodyn.tribology.law import FilmLaw

FILM_LAWS: Registry[FilmLaw] = Registry(
    "film.law",
    "film law",
    {
        "masjedi-khonsari": "tribodyn.tribology.film.masjedi_khonsari:LAW",
        "masjedi-khonsari-as-printed": "tribodyn.tribology.film.masjedi_khonsari:AS_PRINTED",
        "dowson-higginson": "tribodyn.tribology.film.dowson_higginson:LAW",
        "moes": "tribodyn.tribology.film.moes:LAW",
        "solved": "tribodyn.tribology.film.solved:LAW",
    },
    "tribodyn.film_laws",
    FilmLaw,
)
