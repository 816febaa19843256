"""The report of an assessment of a train: a first page for whoever asks, the details on those behind it."""

import math
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tribodyn.gears.rating.capacity import shorter_life
from tribodyn.gears.rating.limits import LIMITS, SAFETIES, least, worst
from tribodyn.gears.rating.rating_text import numbered
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import as_written
from tribodyn.input.names import under_one_name
from tribodyn.post.style import inline
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.record.reader import MESHES, Record
from tribodyn.studies.assessment import first_page
from tribodyn.studies.assessment.first_page import (
    Judged,
    holds_table,
    judged_cell,
    listed,
    numbers_table,
    range_over,
)
from tribodyn.studies.assessment.train.case import TrainAssessmentCase
from tribodyn.studies.assessment.train.report import (
    groups_of,
    heading,
    mesh_rows,
    spectrum_tables_of,
    stage_rows,
    verdict,
)
from tribodyn.studies.assessment.train.run import DUTY, tasks_of
from tribodyn.studies.pages import loaded_again, overview
from tribodyn.studies.protocol import tasks

_RPM = 30.0 / math.pi
#: How a scenario gives the load of a train at its ends.
_LOADS = ("power", "input_torque", "output_torque")


def page(record: Record) -> str:
    """Write the page of a record; where its runs lie beside it, that of the duty is on it."""
    summary = record.summary
    case: TrainAssessmentCase = loaded_again(record).case
    done = tasks.kept(tasks_of(case), tasks.folder_of(Path(record.path)))
    study = case.subject.study
    picture = inline(overview(record), "factors, efficiency, losses, safeties")
    asked, stages = _asked(case, summary), _stages(summary)
    front = first_page.Front(verdict(record), _holds(summary), asked, _tiles(summary), stages)
    body = [
        f'<div class="pictures"><p>{picture}</p></div>',
        _meshes(summary, "simulated"),
        _meshes(summary, "iso"),
        _reasons(summary),
        first_page.folded_sums(spectrum_tables_of(summary)),
        first_page.bearings_table(summary),
        first_page.part_section(study, "Motion at the duty", [done[DUTY]] if done else []),
    ]
    sheets = study.check(case.subject.case, allow_large=True).every
    return first_page.written(record, "Assessment of a train", front, body, sheets)


def _reasons(summary: Mapping[str, Any]) -> str:
    """Why simulation and standard part, of every kind of mesh the one with the largest dynamic factor."""
    found = []
    for group, names in groups_of(summary[MESHES]).items():
        every = [summary[MESHES][name] for name in names]
        mesh = max(every, key=lambda mesh: mesh["simulated"].get("dynamic_factor", 0.0))
        found += [f"Mesh {group}: {text}" for text in mesh.get("reasons", {}).values()]
    heading = "Where standard and simulation part by more than 5 %"
    return listed(heading, numbered(found)) if found else ""


def _asked(case: TrainAssessmentCase, summary: Mapping[str, Any]) -> str:
    study, train = case.subject.study, case.subject.case
    whole = study.whole()
    assert whole is not None, "refused by the rules"
    meshes, gears = {mesh.name: mesh.pair for mesh in whole.meshes(train)}, []
    for group, names in groups_of(summary[MESHES]).items():
        pair = meshes[names[0]]
        drive = as_written(family(pair.family), pair.drive)
        teeth = "/".join(f"{float(gear.teeth):.0f}" for gear in (drive.pinion, drive.gear))
        helix = f", β {abs(math.degrees(drive.helix_angle)):.4g}°" if drive.helix_angle else ""
        times = f", {len(names)} times" if len(names) > 1 else ""
        gears.append(f"{group} {teeth}, module {drive.module * 1e3:.4g} mm{helix}{times}")
    pair = next(iter(meshes.values()))
    oil = first_page.oil_line(pair.lubricant, float(pair.lubricant.temperature), case.settings.lubrication)
    typed = under_one_name(tomllib.loads(train.toml).get("operating", {}))
    loads = [f"{name.replace('_', ' ')} {typed[name]}" for name in _LOADS if typed.get(name) is not None]
    power = f"{summary['power_in_mean'] * 1e-3:.5g} kW"
    duty = (
        f"{', '.join([*loads, ''])}input at {summary['input_speed'] * _RPM:.5g} rpm, ratio "
        f"{summary['train_ratio']:.5g}; with the losses simulated {power} go in"
    )
    return first_page.asked({"Gears": "; ".join(gears), "Oil": oil, "Duty": duty})


def _tiles(summary: Mapping[str, Any]) -> str:
    lost, samples = summary.get("contact_loss_speed_from"), summary.get("by_sample", {})
    highest = ""
    if "dynamic_factor_max" in summary:
        at = summary["dynamic_factor_max_speed"] * _RPM
        highest = f"; up to {summary['dynamic_factor_max']:.2f} at {at:.4g} rpm"
    spread = ""
    if "efficiency_lowest" in summary:
        ends = (f"{100.0 * summary[f'efficiency_{end}']:.2f}" for end in ("lowest", "highest"))
        spread = f"; {' to '.join(ends)} % by other laws"
    shown: list[tuple[str, ...]] = [
        (f"{100.0 * summary['efficiency']:.2f} %", f"efficiency by tooth friction alone{spread}"),
        (f"{summary['power_friction_mean'] * 1e-3:.4g} kW", "lost to tooth friction"),
        (
            f"{summary['dynamic_factor']:.2f}",
            f"largest dynamic factor{highest}",
            range_over(samples.get("dynamic_factor"), ".2f"),
        ),
    ]
    if "mesh_load_factor" in summary:
        shown.append((f"{summary['mesh_load_factor']:.3f}", "K_γ, load of the planet with most"))
    for name, text in (
        ("S_H", "pitting"),
        ("S_F", "tooth bending"),
        ("S_B", "scuffing, flash temperature"),
        ("S_intS", "scuffing, integral temperature"),
        ("S_lambda", "micropitting"),
    ):
        if name in summary:
            where = summary.get("worst_of", {}).get(name, "")
            said = f"{QUANTITIES[name].symbol}, {text}, in {where}"
            shown.append((f"{summary[name]:.2f}", said, range_over(samples.get(name), ".2f")))
    if "hertz_pressure_max" in summary:
        shown.append(
            (
                f"{summary['hertz_pressure_max'] * 1e-9:.2f} GPa",
                "maximum Hertz pressure in motion, without K_A",
            )
        )
    shown.append(
        ("none", "loss of contact at these speeds")
        if lost is None
        else (f"{lost * _RPM:.4g} rpm", "contact is lost from this input speed")
    )
    return first_page.tiles(shown)


#: Limit -> what of a mesh it bounds.
_HOLDS = SAFETIES | {"life": "life"}


def _holds(summary: Mapping[str, Any]) -> str:
    """The worst of the standard and the simulation of every mesh, green or red against the required."""
    limits, meshes = summary.get("limits", {}), summary[MESHES]
    columns = [name for name in _HOLDS if any(_worst(mesh, name) is not None for mesh in meshes.values())]
    heads = [Judged(""), *(Judged(_short(name)) for name in columns)]
    rows = [
        [Judged(group), *(_cell([meshes[mesh] for mesh in names], name, limits) for name in columns)]
        for group, names in sorted(
            groups_of(meshes).items(), key=lambda one: _room([meshes[mesh] for mesh in one[1]], limits)
        )
    ]
    bounds = (limits.get(name, {}).get("limit") for name in columns)
    required = [
        "" if bound is None else f"≥ {LIMITS[name].quantity.written(bound)}"
        for name, bound in zip(columns, bounds, strict=True)
    ]
    rows.append([Judged("required"), *map(Judged, required)])
    return holds_table("Does it hold, and how long?", (heads,), rows)


def _cell(meshes: Sequence[Mapping[str, Any]], limit: str, limits: Mapping[str, Any]) -> Judged:
    """The worst of some meshes."""
    parts = [mesh.get(part, {}) for mesh in meshes for part in ("iso", "simulated")]
    life = shorter_life(*parts) if limit == "life" else {}
    values = [value for mesh in meshes if (value := _worst(mesh, limit)) is not None]
    return judged_cell(min(values, default=None), limit, limits, unlimited=bool(life.get("life_unlimited")))


def _room(meshes: Sequence[Mapping[str, Any]], limits: Mapping[str, Any]) -> float:
    """The smallest value over what is required of it: the worst mesh stands first."""
    over = [
        value / float(limits[limit]["limit"])
        for mesh in meshes
        for limit in _HOLDS
        if limit in limits and (value := _worst(mesh, limit)) is not None
    ]
    return min(over, default=math.inf)


def _worst(mesh: Mapping[str, Any], limit: str) -> float | None:
    smallest = worst(*(least(mesh.get(part, {}).get(_HOLDS[limit])) for part in ("iso", "simulated")))
    return smallest if math.isfinite(smallest) else None


def _short(limit: str) -> str:
    quantity = LIMITS[limit].quantity
    return f"{quantity.label.rstrip(',')} {quantity.symbol or quantity.unit}"


def _stages(summary: Mapping[str, Any]) -> str:
    columns, rows = stage_rows(summary)
    return numbers_table("Each planetary stage", columns, rows, " meshes") if rows else ""


def _meshes(summary: Mapping[str, Any], part: str) -> str:
    columns, rows = mesh_rows(summary, part)
    return numbers_table(heading(part, summary), columns, rows, " meshes") if rows else ""
