"""A case of the solved contact study: everything one run needs to know, in SI units."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tribodyn.studies.gears.case import LubricatedCase


@dataclass(frozen=True, kw_only=True)
class EhlCase(LubricatedCase):
    """One study of the solved contact, complete.

    It has no laws of its own: every law of the registries is evaluated beside the solution.

    Parameters
    ----------
    positions : int
        Positions of the pair at which its contact is solved.
    transient : bool
        Whether the way is also solved with squeeze.
    loads : (array, array) or None
        Roll angles from the pitch point, rad, and normal loads there, N; None: quasi-static.
    step : float
        Of the contact's grid, over the distance from inlet and end of the film.
    """

    positions: int
    transient: bool
    loads: tuple[NDArray[np.float64], NDArray[np.float64]] | None
    step: float
