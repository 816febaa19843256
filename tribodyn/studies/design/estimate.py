"""What a search takes, before any work."""

from tribodyn.studies import study_of
from tribodyn.studies.design.candidates import Overrides, cases_of, chosen, start_of
from tribodyn.studies.design.case import DesignCase
from tribodyn.studies.design.evaluation import loaded_case
from tribodyn.studies.design.layout import layout_of, names_of, scales_of
from tribodyn.studies.design.sources import own
from tribodyn.studies.estimate import Driver, Estimate, record_bytes

#: Evaluations that are usual.
USUAL = 300


def estimate(case: DesignCase) -> Estimate:
    """What a run of a case takes: that of its base scenario, so many times."""
    asked = cases_of(case, chosen(case, start_of(case)))
    several = [_of_one(name, case, asked[0]) for name in case.scenarios]
    one = max(several, key=lambda some: some.memory)
    count = float(case.search.evaluations)
    names = names_of(case, [])
    scales = scales_of(case, names)
    sizes = {"evaluation": case.search.evaluations, **{name: len(one) for name, one in scales.items()}}
    return Estimate(
        one.memory,
        record_bytes(layout_of(case), sizes),
        count * len(asked) * sum(some.seconds for some in several),
        (Driver("design.evaluations", count, USUAL), *one.drivers),
        one.shared,
    )


def _of_one(name: str, case: DesignCase, overrides: Overrides) -> Estimate:
    """What one case of one of the scenarios takes."""
    data = case.scenarios[name]
    study = study_of(data)
    return study.estimate(loaded_case(data, own(name, study.table(data), overrides, case.parts)).case)
