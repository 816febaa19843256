"""Figures of a study by name, and of its cases without a record."""

from collections.abc import Sequence
from typing import Any

from tribodyn.errors import InputError, SimulationError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.limits import LIMITS, plain_distances
from tribodyn.scenario.vary import base_units
from tribodyn.studies.protocol.study import Study

CONTACT_RATIO = "contact_ratio"


def figure_units(study: Study) -> dict[str, str]:
    """SI units of a study's figures by name: those that a sweep keeps, and of single cases the summary's.

    Of gear pairs the contact ratio and the distances from the limits of existence too.
    """
    units = {name: one.units for name, one in study.swept().items()}
    if not units:
        return units
    if study.has_gears:
        units |= {CONTACT_RATIO: "1"} | {name: one.unit for name, one in LIMITS.items()}
    if study.batch():
        return units
    for heading, lines in study.lines().items():
        for line in () if heading == "Solver" else lines:
            base = base_units(f"1 {line.unit}") if line.unit not in ("", "%") else None
            units.setdefault(line.name, base[1] if base else "1")
    return units


def evaluated(study: Study, cases: Sequence[Any], workers: int | None = None) -> list[dict[str, Any] | str]:
    """Work out the figures of cases without a record; a text instead where one fails: why.

    Cases of a study with a `batch` are steady states.

    Parameters
    ----------
    study : Study
    cases : sequence of cases or str
        A text where the case could not even be made.
    workers : int, optional
        Threads of a study that evaluates cases together; default: one per core.
    """
    batch = study.batch()
    if batch:
        from tribodyn.studies.sweeping.batch import batched

        found = batched(batch, cases, study.swept(), workers)
    else:
        found = [_figures(study, case) for case in cases]
    if not study.has_gears:
        return found
    return [
        one if isinstance(one, str) else _of_teeth(case) | one for case, one in zip(cases, found, strict=True)
    ]


def _figures(study: Study, case: Any) -> dict[str, Any] | str:
    try:
        return case if isinstance(case, str) else study.figures(case)
    except (InputError, SimulationError) as error:
        return str(error)


def _of_teeth(case: Any) -> dict[str, float]:
    gears = assemble(family(case.family), case.drive)
    return {CONTACT_RATIO: float(gears.contact_ratio), **plain_distances(gears)}
