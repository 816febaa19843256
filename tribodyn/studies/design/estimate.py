"""What a search takes, before any work."""

from tribodyn.studies import study_of
from tribodyn.studies.design.candidates import cases_of, chosen, start_of
from tribodyn.studies.design.case import DesignCase
from tribodyn.studies.design.evaluation import loaded_case
from tribodyn.studies.design.layout import layout_of, names_of, scales_of
from tribodyn.studies.estimate import Driver, Estimate, record_bytes

#: Evaluations that are usual.
USUAL = 300


def estimate(case: DesignCase) -> Estimate:
    """What a run of a case takes: that of its base scenario, so many times."""
    study = study_of({"kind": case.base_kind})
    asked = cases_of(case, chosen(case, start_of(case)))
    one = study.estimate(loaded_case(case.base, asked[0]).case)
    count = float(case.search.evaluations)
    names = names_of(case, [])
    scales = scales_of(case, names)
    sizes = {"evaluation": case.search.evaluations, **{name: len(one) for name, one in scales.items()}}
    return Estimate(
        one.memory,
        record_bytes(layout_of(case), sizes),
        count * len(asked) * one.seconds,
        (Driver("design.evaluations", count, USUAL), *one.drivers),
        one.shared,
    )
