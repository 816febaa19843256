"""From a case of an assessment to its record: the other studies' parts, then the standards beside them."""

import tomllib
from collections.abc import Collection, Mapping
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.cases.assessment_part import TaskResult
from tribodyn.cases.results import TextTable
from tribodyn.gears.check import sheet_tables, with_oil
from tribodyn.gears.plausibility import checks_gears
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.american import agma_part
from tribodyn.gears.rating.bearings import bearing_part, shafts_of_pair
from tribodyn.gears.rating.capacity import Capacity, required
from tribodyn.gears.rating.limits import not_judged
from tribodyn.gears.rating.rating_text import numbered
from tribodyn.gears.rating.sheet import COLUMNS, rating_rows
from tribodyn.gears.rating.spectrum import spectrum_part, spectrum_tables
from tribodyn.gears.rating.standard import Standard
from tribodyn.gears.rating.strength import metal_remarks
from tribodyn.geometry.body import geometry_arrays
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.record.trust import EXTRAPOLATED, INSIDE, OUTSIDE, REASONS, TRUST
from tribodyn.standards.contact_path import POINTS
from tribodyn.studies.assessment.pair import parts
from tribodyn.studies.assessment.pair.assessment_text import assumed, extrapolated
from tribodyn.studies.assessment.pair.case import LAYOUT, AssessmentCase
from tribodyn.studies.assessment.pair.conclusion import by_standard, concluded
from tribodyn.studies.assessment.pair.margins import LocalValues
from tribodyn.studies.assessment.scatter import Conclusion, put_in, samples_of
from tribodyn.studies.assessment.unknowns import Draw
from tribodyn.studies.drive_file import sheet_of
from tribodyn.studies.protocol import tasks
from tribodyn.studies.protocol.evaluated import scratch
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult

#: What is no number, or has the unit of what is compared; what ends the name of a scatter.
WITHOUT_UNIT, SPREAD_OF = ("limits", "limit_values", "samples"), "_spread"
#: Keys of a table that has values of one quantity.
_PARTS = {"worst", "median", "pinion"}


@checks_gears
def check(case: AssessmentCase) -> CheckResult:
    """Check a case and what it asks of the other studies; say what gears and oil it describes."""
    assembly = assembled(case)
    sheet = sheet_of(tomllib.loads(case.toml)["drive"], assembly)
    request = parts.request_of(case)
    every = parts.tasks_of(parts.parts(request))
    tasks.require_cases(every)
    data: dict[str, Any] = {"geometry": sheet, "tasks": [task.name for _, task in every]}
    result = with_oil(CheckResult(data, sheet_tables(sheet)), case.lubricant)
    if not assembly.family.involute:
        return result
    iso, standard, capacity = by_standard(case, assembly, face=1.0)
    american = _by_agma(case, standard, capacity)
    face = "given" if case.settings.face_load_factor else "1, until the contact is analysed"
    table = TextTable(f"ISO 6336, K_Hβ {face}", COLUMNS, rating_rows(iso))
    duties = _duties(case, capacity)
    american_tables = (
        [TextTable(f"AGMA 2101, K_H {face}", COLUMNS, rating_rows(american))] if american else []
    )
    tables = (*result.tables, table, *american_tables, *spectrum_tables(duties.get("spectrum", {})))
    remarks = (*result.remarks, *metal_remarks(case), *_outside(capacity))
    return result._replace(
        data={**result.data, "iso": iso, **({"agma": american} if american else {}), **duties},
        tables=tables,
        remarks=remarks,
    )


def _duties(case: AssessmentCase, capacity: Capacity | None) -> dict[str, Any]:
    """Miner's sum duty by duty, where there is a load spectrum."""
    return spectrum_part(capacity, required(case.settings))


def _by_agma(case: AssessmentCase, standard: Standard | None, capacity: Capacity | None) -> dict[str, Any]:
    """The rating by AGMA 2101 where it is asked for."""
    if case.settings.standard != "agma" or standard is None or capacity is None:
        return {}
    return agma_part(case, assembled(case), standard.factors, capacity)


def run(
    case: AssessmentCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`.

    The parts lie in a folder beside the record and are run again only if their scenarios or the code changed.
    """
    groups = {"geometry": geometry_arrays(assembled(case))}

    def along(folder: Path, progress: Progress | None, force: bool) -> tuple[dict[str, Any], dict[str, Any]]:
        local, summary = assessed(case, folder, progress, force)
        return _arrays(local), summary

    return tasks.recorded(case, output, LAYOUT, along, force=force, progress=progress, groups=groups)


def quantities_of(case: AssessmentCase) -> dict[str, Any]:
    """Quantities of a case without a record; see `scratch` for its parts."""
    with scratch() as folder:
        _, summary = assessed(case, folder)
    return summary


def assessed(
    case: AssessmentCase, folder: Path, progress: Progress | None = None, force: bool = False
) -> tuple[LocalValues, dict[str, Any]]:
    """Run the parts into a folder and put them together: values along the path, and the summary.

    Raises InputError or SimulationError if a part that is needed cannot be run; see also `parts.results`.
    """
    begun = perf_counter()
    request = parts.request_of(case)
    taking_part = parts.parts(request)
    every = parts.tasks_of(taking_part)
    done = tasks.results(every, folder, progress, force=force)
    quantities: dict[str, Any] = {}
    along: dict[str, Any] = {}
    motion: dict[str, Any] = {}
    rows: dict[str, np.ndarray] = {}
    for answer in parts.answers(taking_part, done):
        quantities |= answer.quantities
        along |= answer.along
        motion |= answer.motion
        rows |= answer.spread
    outcome = concluded(case, along, quantities, motion)
    local, standard = outcome.local, outcome.by_standard
    summary: dict[str, Any] = {
        "duty": {
            "pinion_speed": case.operating.pinion_speed,
            "gear_torque": case.operating.gear_torque,
            "oil_temperature": case.oil_temperature,
        },
        **quantities,
        "contact_temperature_max": float(local.films.bulk_temperature + np.nanmax(local.films.flash_rise)),
        "specific_film_min": outcome.simulated["lambda_GF"]["worst"],
        **({"transverse_load_factor_method_b": standard.factors.transverse_b} if standard else {}),
        **outcome.least(),
        "iso": outcome.iso,
        "agma": _by_agma(case, standard, outcome.capacity),
        "simulated": outcome.simulated,
        "rests_on": outcome.rests,
        "not_judged": not_judged(case.limits, case.lubricant.fzg),
        "reasons": numbered(outcome.parted),
        **_duties(case, outcome.capacity),
        **bearing_part(shafts_of_pair(case), case.lubricant),
        "point_angles": dict(zip(POINTS, map(float, local.points), strict=True)),
        **outcome.judged,
    }
    if rows:

        def like(draw: Draw, path: Mapping[str, Any], found: Mapping[str, Any]) -> Conclusion:
            return concluded(draw.of(case), path, found, accurate=outcome)

        samples = samples_of(parts.draws_of(case), rows, (along, quantities), like)
        summary = put_in(summary, samples)
    summary |= {
        "assumed": numbered(assumed(case, standard is not None)),
        "extrapolated": numbered([*extrapolated(every, done), *_outside(outcome.capacity)]),
        **_trust(done, {task.name for _, task in every if task.needed}),
        "wall_time": perf_counter() - begun,
    }
    summary = {name: value for name, value in summary.items() if value not in ({}, [], "")}
    return local, summary | {"units": units_of(summary)}


def _outside(capacity: Capacity | None) -> tuple[str, ...]:
    return capacity.remarks if capacity else ()


def units_of(summary: Mapping[str, Any]) -> dict[str, str]:
    """SI unit of every number of a summary by its name, for programs that read them.

    A value by points, a scatter and a table of values have the unit of the name that they stand under.
    """
    units: dict[str, str] = {}
    for name, value in summary.items():
        quantity = QUANTITIES.get(name.removesuffix(SPREAD_OF))
        if name in WITHOUT_UNIT:
            continue
        if quantity is None and isinstance(value, Mapping):
            units |= units_of(value) if not _PARTS & set(value) else {name: "1"}
        elif not isinstance(value, str | bool):
            units[name] = quantity.si if quantity else "1"
    return dict(sorted(units.items()))


def _arrays(local: LocalValues) -> dict[str, Any]:
    films = local.films
    return {
        "roll_angle": local.roll_angle,
        "normal_load": local.normal_load,
        "hertz_pressure": films.pressure,
        "equivalent_radius": local.radius,
        "sliding_speed": local.sliding,
        "flash_temperature_rise": films.flash_rise,
        "contact_temperature": films.bulk_temperature + films.flash_rise,
        "film_thickness": films.film_thickness,
        "specific_film": films.specific_film,
    }


def _trust(done: dict[str, TaskResult], needed: Collection[str]) -> dict[str, Any]:
    """Outside the model where any part is; laws extrapolated where those of a `needed` one are."""
    judged = {name: result.summary for name, result in done.items() if TRUST in result.summary}
    for verdict, parts_of in ((OUTSIDE, judged), (EXTRAPOLATED, needed)):
        reasons: dict[str, Any] = {}
        judged_so = [part for name, part in judged.items() if part[TRUST] == verdict and name in parts_of]
        for part in judged_so:
            reasons |= part[REASONS]
        if judged_so:
            return {TRUST: verdict, REASONS: reasons}
    return {TRUST: INSIDE} if judged else {}
