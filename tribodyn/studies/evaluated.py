"""Figures of a study by name, and of its cases without a record."""

from collections.abc import Sequence
from typing import Any

from tribodyn.errors import InputError, SimulationError
from tribodyn.scenario.vary import base_units
from tribodyn.studies.study import Study


def figure_units(study: Study) -> dict[str, str]:
    """SI units of a study's figures by name: those that a sweep keeps, and of single cases the summary's."""
    units = {name: one.units for name, one in study.swept().items()}
    if not units or study.batch():
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
        from tribodyn.studies.batch import batched

        return batched(batch, cases, study.swept(), workers)
    found: list[dict[str, Any] | str] = []
    for case in cases:
        try:
            found.append(case if isinstance(case, str) else study.figures(case))
        except (InputError, SimulationError) as error:
            found.append(str(error))
    return found
