"""What a case says of film and friction between the flanks, in SI units."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from tribodyn.tribology.law import FilmLaw, FrictionLaw


@dataclass(frozen=True)
class FilmData:
    """Which film law holds between the flanks.

    Parameters
    ----------
    law : its name in `tribodyn.tribology.film.FILM_LAWS`, or the law itself; None: the one that goes with the
        friction law
    values : values of the law's own keys, by name, in SI units
    """

    law: str | FilmLaw | None = None
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class FrictionData:
    """Which friction law acts between the flanks.

    Parameters
    ----------
    law : its name in `tribodyn.tribology.friction.FRICTION_LAWS`, or the law itself
    values : values of the law's own keys, by name, in SI units
    sliding : sliding speed from the nominal rotation, or from the bodies as they move, vibration included
    reversal_width : distance along the path of contact over which friction changes sign at the pitch point, m
    """

    law: str | FrictionLaw
    values: Mapping[str, Any] = field(default_factory=dict)
    sliding: Literal["kinematic", "dynamic"] = "dynamic"
    reversal_width: float = 2e-5
