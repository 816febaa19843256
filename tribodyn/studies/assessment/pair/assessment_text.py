"""What an assessment says in words: what is assumed, and what is extrapolated."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from tribodyn.cases.assessment_part import Task, TaskResult
from tribodyn.gears.rating.bearings import bearing_remarks, shafts_of_pair
from tribodyn.gears.rating.rating_text import factors_said, life_said
from tribodyn.gears.rating.strength import metal_remarks
from tribodyn.post.report import EXCEEDED
from tribodyn.record.reader import Record
from tribodyn.studies.assessment.pair.case import AssessmentCase
from tribodyn.studies.assessment.unknowns import described, ranges_of
from tribodyn.studies.protocol.study import Study
from tribodyn.tribology.closure import laws_of
from tribodyn.tribology.oil import oil_values

#: Words by which a study says that a law is used outside its range.
_BEYOND = "extrapolated"
#: How the origin of a number begins that nobody has measured.
_ASSUMPTION = "assumption"


def assumed(case: AssessmentCase, by_standard: bool) -> list[str]:
    """What is chosen here, or stands in for what the scenario does not say."""
    settings, stages = case.settings, case.lubricant.fzg
    tables = {name: table for name, table in tomllib.loads(case.toml).items() if isinstance(table, Mapping)}
    if None not in (case.supports.pinion, case.supports.gear):
        tables.pop("bearings", None)  # shafts as drawn hold both gears
    laws = case.with_laws()
    sentences = [
        f"{law.table.capitalize()} law {law.name}: {data.chosen}."
        for law, data in zip(laws_of(laws), (laws.film, laws.friction), strict=True)
        if data.chosen
    ]
    sentences += [
        f"{name.capitalize()}: {text}" for name, table in tables.items() for text in _of_models(table)
    ]
    for name, value in oil_values(case.lubricant).items():
        if value.origin.startswith(_ASSUMPTION) or value.spread is not None:
            spread = f", published {value.spread[0]:g} to {value.spread[1]:g}" if value.spread else ""
            sentences.append(f"Oil: {name.replace('_', ' ')} {value.value:.3g} ({value.origin}{spread}).")
    if missing := [name for name in ("scuffing", "micropitting") if not getattr(stages, name)]:
        names = " and ".join(missing)
        sentences.append(f"The oil has no FZG load stage of {names}: no margin can be given.")
    sentences.append(f"{factors_said(settings)} Damping of the mesh {settings.damping_ratio:g}.")
    if by_standard:
        sentences += metal_remarks(case)
        sentences.append(life_said(settings, len(case.spectrum)))
    if len(case.spectrum) > 1:
        sentences.append(
            "The simulation runs the duty that is assessed alone, one of "
            f"{len(case.spectrum)}: at the others its stresses part from the standard's as there. Its own "
            "safeties and lives hang on which duty that is; those by the standard do not."
        )
    sentences += bearing_remarks(shafts_of_pair(case), case.lubricant)
    scatter = ""
    if settings.samples:
        varied = described(ranges_of(case, settings.unknowns, settings.damping_ratio))
        scatter = f"; its scatter is over {settings.samples} samples of {varied}"
    sentences.append(
        "The simulation has accurate teeth but for modifications and misalignment of the scenario and its "
        f"shafts{scatter}. Its K_Hα is that of one tooth with the base pitch deviation of the standard."
    )
    of_standards = "The standards' formulas are for involutes: this drive has none beside the simulation."
    if by_standard and (quality := case.quality) is not None:
        of_standards = (
            f"Standards: deviations of class {quality.grade:g} by ISO 1328-1:{quality.edition}, "
            "K_v and K_Hα by method B, flanks without credited tip relief, case-hardened running-in, new oil."
        )
    return [*sentences, of_standards]


def _of_models(table: Mapping[str, Any]) -> Iterator[str]:
    """Assumptions that model files state."""
    if table.get("assumptions"):
        yield str(table["assumptions"])
    for inner in table.values():
        if isinstance(inner, Mapping):
            yield from _of_models(inner)


def extrapolated(every: Sequence[tuple[Study, Task]], done: Mapping[str, TaskResult]) -> list[str]:
    """Where laws are used outside their range, and what could not be computed, of all tasks."""
    remarks, compared = [], []
    # of a law that is needed the parts that need it say where it is used outside its range
    needed = [task.name for _, task in every if task.needed]
    laws = {done[name].summary.get("friction_law") for name in needed}
    for study, task in every:
        result = done[task.name]
        remarks += result.failures
        if result.summary and not task.needed:
            inside = result.summary.get("friction_in_range_fraction")
            differs = result.summary.get("friction_law") not in laws
            compared += [task.about] if differs and inside is not None and inside < 1.0 else []
        elif result.summary:
            with Record(result.path) as record:
                sentences = study.sentences(record)
            exceeded = [sentence for sentence in sentences if sentence.startswith(EXCEEDED)]
            statements = exceeded or [sentence for sentence in sentences if _BEYOND in sentence]
            remarks += [f"{task.about.capitalize()}: {sentence}" for sentence in statements]
    if compared:
        about = "; ".join(compared)
        remarks.append(f"For comparison only, outside the range of the law in part or all: {about}.")
    return list(dict.fromkeys(remarks))
