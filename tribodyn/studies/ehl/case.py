"""A case of the solved contact study: everything one run needs to know, in SI units."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tribodyn.studies.ehl.layout import PLACES, layout_of
from tribodyn.studies.gears.case import LubricatedCase
from tribodyn.studies.protocol.cost import recorded, solved_contacts, total
from tribodyn.studies.protocol.estimate import Driver, Estimate
from tribodyn.tribology.ehl.grid import STEP


@dataclass(frozen=True, kw_only=True)
class EhlCase(LubricatedCase):
    """One study of the solved contact, complete.

    It has no laws of its own: every law of the registries is evaluated beside the solution.
    """

    positions: int  # positions of the pair at which its contact is solved
    transient: bool  # whether the way is also solved with squeeze
    #: (array, array); roll angles from the pitch point, rad, and normal loads there, N; None: quasi-static
    loads: tuple[NDArray[np.float64], NDArray[np.float64]] | None
    step: float  # of the contact's grid, over the distance from inlet and end of the film


#: Contacts of the traction curve, and laws beside the solution.
_TRACTION, _LAWS = 9, 12


def estimate(case: EhlCase) -> Estimate:
    """What a run of a case takes."""
    sizes = {"phase": case.positions, "place": PLACES, "slide_to_roll": _TRACTION}
    sizes |= {"film_law": _LAWS, "friction_law": _LAWS}
    return total(
        (Driver("output.positions", float(case.positions), 40),),
        recorded(layout_of(case.transient), sizes, copies=4.0),
        solved_contacts(
            case.positions,
            case.positions + _TRACTION,
            squeeze=case.transient,
            coarseness=case.step / STEP,
        ),
    )
