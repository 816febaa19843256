"""What an assessment assumes, and what in it is extrapolated, in sentences."""

import tomllib
from collections.abc import Mapping
from typing import Any

from tribodyn.post.report import EXCEEDED
from tribodyn.record.reader import open_record
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.parts import Part, TaskResult
from tribodyn.tribology.lubricant import oil_values

#: Words by which a study says that a law is used outside its range.
_BEYOND = "extrapolated"
#: How the origin of a number begins that nobody has measured.
_ASSUMPTION = "assumption"


def assumed(case: AssessmentCase, by_standard: bool) -> list[str]:
    """What is chosen here, or stands in for what the scenario does not say."""
    settings, said = case.settings, []
    said += [f"{name}: {text}" for name, text in _models(tomllib.loads(case.toml))]
    for name, one in oil_values(case.lubricant).items():
        if one.origin.startswith(_ASSUMPTION) or one.spread is not None:
            spread = f", published {one.spread[0]:g} to {one.spread[1]:g}" if one.spread else ""
            said.append(f"Oil: {name.replace('_', ' ')} {one.value:.3g} ({one.origin}{spread}).")
    stages = case.lubricant.fzg
    if stages.scuffing is None or stages.micropitting is None:
        missing = [
            name
            for name, one in (("scuffing", stages.scuffing), ("micropitting", stages.micropitting))
            if not one
        ]
        said.append(f"The oil has no FZG load stage of {' and '.join(missing)}: no margin can be given.")
    said.append(
        f"K_A = {settings.application_factor:g}; damping of the mesh {settings.damping_ratio:g}; K_Hβ by the "
        "contact analysis."
    )
    scatter = ""
    if settings.samples:
        scatter = f"; its scatter is over {settings.samples} samples of deviations within the tolerances"
    said.append(
        f"The simulation has accurate teeth but for modifications and misalignment of the scenario{scatter}. "
        "Its K_Hα is that of one tooth with the base pitch deviation of the standard."
    )
    if by_standard:
        said.append(
            f"Standards: deviations of class {case.quality.grade:g} by ISO 1328-1, K_v and K_Hα by method B, "
            "flanks without credited tip relief, case-hardened running-in, new oil."
        )
    else:
        said.append("The standards' formulas are for involutes: this drive has none beside the simulation.")
    return said


def _models(tables: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Assumptions that model files state, by table."""
    found = []
    for name, table in tables.items():
        if isinstance(table, Mapping):
            if table.get("assumptions"):
                found.append((name.capitalize(), str(table["assumptions"])))
            found += [(name.capitalize(), text) for _, text in _models(table)]
    return found


def extrapolated(taking_part: tuple[Part, ...], done: Mapping[str, TaskResult]) -> list[str]:
    """Where laws are used outside their range, and what could not be computed."""
    said, beside = [], []
    for part in taking_part:
        for task in part.tasks:
            one = done[task.name]
            said += one.failures
            if not one.summary:
                continue
            if not task.needed:
                inside = one.summary.get("friction_in_range_fraction")
                beside += [task.about] if inside is not None and inside < 1.0 else []
                continue
            with open_record(one.path) as record:
                sentences = part.study.sentences(record)
            exceeded = [sentence for sentence in sentences if sentence.startswith(EXCEEDED)]
            found = exceeded or [sentence for sentence in sentences if _BEYOND in sentence]
            said += [f"{task.about.capitalize()}: {sentence}" for sentence in found]
    if beside:
        said.append(f"For comparison only, outside the range of the law in part or all: {'; '.join(beside)}.")
    return list(dict.fromkeys(said))
