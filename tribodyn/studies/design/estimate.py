"""What a search takes, before any work."""

from tribodyn.cases.cost import CostKey, Estimate, record_bytes
from tribodyn.studies.design.candidates.archive import FACTORS, resolutions
from tribodyn.studies.design.candidates.candidates import cases_of, chosen, shapes_gears, start_of
from tribodyn.studies.design.candidates.converged import counts
from tribodyn.studies.design.candidates.evaluation import loaded_source
from tribodyn.studies.design.case import DesignCase
from tribodyn.studies.design.layout import layout_of, names_of, scales_of
from tribodyn.studies.design.methods import method_of

#: Evaluations that are usual.
USUAL = 300


def estimate(case: DesignCase) -> Estimate:
    """What a run of a case takes: that of its base scenario, so many times, on every resolution."""
    method, _ = method_of(case)
    count, several, seconds = float(case.search.evaluations), [], 0.0
    for factor, candidates in counts(case, method).items():
        more = resolutions(case, factor)
        if factor > 1 and not more:
            break
        cases = cases_of(case, chosen(case, start_of(case)), more)
        for name in case.scenarios:
            loaded = loaded_source(case.scenarios, name, cases[0])
            several.append(loaded.study.estimate(loaded.case))
            # what cases share, such as finite elements, is made anew for gears of another shape
            preparation = several[-1].shared if shapes_gears(case) else 0.0
            seconds += candidates * len(cases) * (several[-1].seconds + preparation)
    largest = max(several, key=lambda estimate: estimate.memory)
    sizes = {name: len(scale) for name, scale in scales_of(case, names_of(case, [])).items()}
    sizes["evaluation"] = len(FACTORS) * case.search.evaluations
    return Estimate(
        largest.memory,
        record_bytes(layout_of(case), sizes),
        seconds,
        (CostKey("design.evaluations", count, USUAL), *largest.drivers),
        largest.shared,
    )
