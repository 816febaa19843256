"""A case of the quasi-static efficiency study: everything one run needs to know, in SI units."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from tribodyn.studies.gears.case import LubricatedCase

if TYPE_CHECKING:  # the study's array code, and SciPy with it, is for the run
    from tribodyn.studies.efficiency.places import Sharing


@dataclass(frozen=True, kw_only=True)
class EfficiencyCase(LubricatedCase):
    """One efficiency study, complete; its mesh compliance is that of the elastic load sharing.

    Parameters
    ----------
    load_sharing : {"elastic", "uniform", "single-pair"}
        That of the samples recorded; the summary has all three.
    samples_per_cycle : samples over the one mesh cycle recorded
    spectrum : tuple of (float, EfficiencyCase)
        Share of time and case of every duty of a load spectrum; empty: there is none.
    """

    load_sharing: "Sharing" = "elastic"
    samples_per_cycle: int = 200
    spectrum: tuple[tuple[float, "EfficiencyCase"], ...] = ()
