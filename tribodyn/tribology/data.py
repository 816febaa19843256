"""What a case says of film and friction between the flanks, in SI units."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from tribodyn.tribology.law import FilmLaw, FrictionLaw


@dataclass(frozen=True)
class FilmData:
    """Which film law holds between the flanks."""

    #: its name in `tribodyn.tribology.film.FILM_LAWS`, or the law itself; None: the one that goes with the
    #: friction law
    law: str | FilmLaw | None = None
    #: values of the law's own keys, by name, in SI units
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class FrictionData:
    """Which friction law acts between the flanks."""

    law: str | FrictionLaw  # its name in `tribodyn.tribology.friction.FRICTION_LAWS`, or the law itself
    #: values of the law's own keys, by name, in SI units
    values: Mapping[str, Any] = field(default_factory=dict)
    #: sliding speed from the nominal rotation, or from the bodies as they move, vibration included
    sliding: Literal["kinematic", "dynamic"] = "dynamic"
    #: distance along the path of contact over which friction changes sign at the pitch point, m
    reversal_width: float = 2e-5
