"""What an assessment says in words: what is assumed, and what is extrapolated."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from tribodyn.cases.assessment_part import Task, TaskResult
from tribodyn.gears.case import GearCase
from tribodyn.gears.rating.bearings import bearing_remarks
from tribodyn.gears.rating.rating_text import factors_said, life_said, ring_said
from tribodyn.gears.rating.strength import metal_remarks
from tribodyn.post.report import EXCEEDED
from tribodyn.record.reader import Record
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.protocol.study import Study
from tribodyn.tribology.closure import laws_of
from tribodyn.tribology.oil import oil_values

#: Words by which a study says that a law is used outside its range.
_BEYOND = "extrapolated"
#: How the origin of a number begins that nobody has measured.
_ASSUMPTION = "assumption"


def assumed(case: AssessmentCase, meshes: Mapping[str, Mapping[str, Any]], varied: str) -> Iterator[str]:
    """What is chosen here, or stands in for what the scenario does not say.

    `meshes` are the summaries of all, `varied` what samples vary: "" without samples.
    """
    settings, own, oil = case.settings, case.own, case.oil
    of_gearbox = [] if own else [mesh.pair for mesh in case.whole.meshes(case.gearbox.case)]
    pairs = [own] if own else of_gearbox
    chosen = {
        f"{law.table.capitalize()} law {law.name}: {data.chosen}."
        for laws in ([own.with_laws()] if own else of_gearbox)
        for law, data in zip(laws_of(laws), (laws.film, laws.friction), strict=True)
        if data.chosen
    }
    yield from sorted(chosen)
    tables = tomllib.loads(own.toml if own else case.gearbox.case.toml)
    if own and None not in (own.supports.pinion, own.supports.gear):
        tables.pop("bearings", None)  # shafts as drawn hold both gears
    for name, table in tables.items():
        yield from (f"{name.capitalize()}: {text}" for text in dict.fromkeys(_of_models(table)))
    for name, value in oil_values(oil).items():
        if value.origin.startswith(_ASSUMPTION) or value.spread is not None:
            spread = f", published {value.spread[0]:g} to {value.spread[1]:g}" if value.spread else ""
            yield f"Oil: {name.replace('_', ' ')} {value.value:.3g} ({value.origin}{spread})."
    if missing := [name for name in ("scuffing", "micropitting") if not getattr(oil.fzg, name)]:
        yield f"The oil has no FZG load stage of {' and '.join(missing)}: no margin can be given."
    factors = factors_said(settings)
    yield (
        f"{factors} Damping of the mesh {own.settings.damping_ratio:g}."
        if own
        else f"In every mesh {factors}"
    )
    planetary = any("alike" in mesh for mesh in meshes.values())
    if settings.mesh_load_factor is None and planetary:
        yield "K_γ of each planetary stage is that of the simulation."
    rated = [name for name, mesh in meshes.items() if "iso" in mesh]
    duties = max((len(mesh.rated.spectrum) for mesh in case.meshes.values()), default=0)
    if rated:
        yield from dict.fromkeys(remark for pair in pairs for remark in metal_remarks(pair))
        yield life_said(settings, duties)
        rings = {text: name for name in reversed(rated) for text in ring_said(meshes[name]["iso"])}
        yield from (f"Mesh {name}: {text}" for text, name in reversed(rings.items()))
    if duties > 1:
        yield (
            f"The simulation runs the duty that is assessed alone, one of {duties}: at the others its "
            "stresses part from the standard's as there. Its own safeties and lives hang on which duty that "
            "is; those by the standard do not."
        )
    yield from bearing_remarks(case.shafts, oil)
    if not own:
        yield (
            "The efficiency is that of tooth friction alone: bearings, seals and churning are not in it. The "
            "motion runs without K_A; stresses, film, temperatures and safeties, simulated too, count with "
            "it and with K_γ of planetary stages."
        )
    scatter = f"; its scatter is over {settings.samples} samples of {varied}" if varied else ""
    besides = "modifications and misalignment of the scenario and its shafts"
    yield (
        f"The simulation has accurate teeth but for {besides}{', and pin errors' * planetary}"
        f"{scatter}. Its K_Hα is that of one tooth with the base pitch deviation of the standard."
    )
    if own and not rated:
        yield "The standards' formulas are for involutes: this drive has none beside the simulation."
    elif len(rated) < len(meshes):
        others = dict.fromkeys(
            str(mesh.get("alike") or name) for name, mesh in meshes.items() if name not in rated
        )
        yield (
            "The standards' formulas are for involutes of a tolerance class: the simulation alone rates "
            f"{', '.join(others)}."
        )
    if rated:
        grades = [pair.quality for pair in pairs if pair.quality is not None]
        classes = "; ".join(
            dict.fromkeys(f"class {one.grade:g} by ISO 1328-1:{one.edition}" for one in grades)
        )
        every = "" if own else "each mesh as a pair of its own, "
        ring = "; no integral temperature of a ring" * any(_has_ring(pair) for pair in pairs)
        yield (
            f"Standards: {every}deviations of {classes}, K_v and K_Hα by method B, flanks without credited "
            f"tip relief, case-hardened running-in, new oil{ring}."
        )


def _has_ring(pair: GearCase) -> bool:
    return min(float(pair.drive.pinion.teeth), float(pair.drive.gear.teeth)) < 0.0


def _of_models(table: Any) -> Iterator[str]:
    """Assumptions that model files state."""
    inner = table.values() if isinstance(table, Mapping) else table if isinstance(table, list) else ()
    if isinstance(table, Mapping) and table.get("assumptions"):
        yield str(table["assumptions"])
    for each in inner:
        yield from _of_models(each)


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
