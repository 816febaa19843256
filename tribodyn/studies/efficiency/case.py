"""A case of the quasi-static efficiency study: everything one run needs to know, in SI units."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from tribodyn.studies.gears.case import LAYOUT, LubricatedCase
from tribodyn.studies.protocol.cost import (
    FINITE_ELEMENTS,
    PAIRS,
    load_sharing,
    quasi_static_cycle,
    recorded,
    total,
)
from tribodyn.studies.protocol.estimate import Driver, Estimate

if TYPE_CHECKING:  # the study's array code, and SciPy with it, is for the run
    from tribodyn.studies.efficiency.places import Sharing


@dataclass(frozen=True, kw_only=True)
class EfficiencyCase(LubricatedCase):
    """One efficiency study, complete; its mesh compliance is that of the elastic load sharing."""

    #: {"elastic", "uniform", "single-pair"} That of the samples recorded; the summary has all three.
    load_sharing: "Sharing" = "elastic"
    samples_per_cycle: int = 200  # samples over the one mesh cycle recorded
    #: (float, EfficiencyCase); share of time and case of every duty of a load spectrum; empty: there is none
    spectrum: tuple[tuple[float, "EfficiencyCase"], ...] = ()


#: Positions at which the cycle means share the load.
_POSITIONS = 3000.0


def estimate(case: EfficiencyCase) -> Estimate:
    """What a run of a case takes."""
    samples, slices = float(case.samples_per_cycle), case.mesh.slices
    sizes = {"time": case.samples_per_cycle + 1, "pair": PAIRS, "dof": 6}
    parts = [recorded(LAYOUT, sizes, outlines=True), quasi_static_cycle(samples)]
    if case.mesh.at_load:
        parts += [FINITE_ELEMENTS, load_sharing(samples + _POSITIONS, slices, samples)]
    drivers = Driver("output.samples_per_cycle", samples, 200), Driver("mesh.slices", slices, 21)
    return total(drivers, *parts)
