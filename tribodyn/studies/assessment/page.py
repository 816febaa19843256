"""The report of an assessment: a first page for whoever asks, the details on those behind it."""

from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

from tribodyn.cases.assessment_part import ReportCurve, TaskResult
from tribodyn.gears.case import stage_table
from tribodyn.post.style import inline
from tribodyn.record.reader import MESHES, Record
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.figures import pictures
from tribodyn.studies.assessment.pages import first_page
from tribodyn.studies.assessment.pages.comparison import by_standard, factors, points, reasons, scatter
from tribodyn.studies.assessment.pages.first_page import numbers_table
from tribodyn.studies.assessment.pages.front import asked as asked_for
from tribodyn.studies.assessment.pages.front import tiles
from tribodyn.studies.assessment.pages.limit_table import holds, holds_of_mesh, room
from tribodyn.studies.assessment.parts import DUTY, Part, answers, assessment_parts
from tribodyn.studies.assessment.report import (
    face_table,
    groups_of,
    mesh_table,
    meshes_of,
    miner_tables,
    verdict,
)
from tribodyn.studies.assessment.run import check
from tribodyn.studies.pages import loaded_again
from tribodyn.studies.protocol import tasks


def page(record: Record) -> str:
    """Write the page of an assessment's record; parts that lie beside it have their pictures on it."""
    summary = record.summary
    case: AssessmentCase = loaded_again(record).case
    requested = assessment_parts(case)
    done = tasks.kept(requested.tasks, tasks.folder_of(Path(record.path)))
    motion = _curves(requested.motion, done)
    of_teeth = {group: _curves(parts, done) for group, parts in requested.teeth.items()}
    stages = stage_table(summary)
    below = numbers_table(*stages, " meshes") if stages.rows else scatter(summary)
    front = first_page.Front(verdict(record), holds(summary), asked_for(case, summary), tiles(summary), below)
    picture = _pictures(record, [*of_teeth.get("", ()), *motion])
    if MESHES not in summary:
        every = [face_table(summary)]
        body = [by_standard(summary), reasons(summary), picture, points(summary), factors(summary)]
        body += [numbers_table(*table) for table in every if table.rows]
    else:
        every = [*(mesh_table(summary, part) for part in ("simulated", "iso")), face_table(summary)]
        body = [picture, *(numbers_table(*table, " meshes") for table in every if table.rows)]
        body += [_of_mesh(record, name, of_teeth.get(group, ())) for group, name in _worst_first(summary)]
    body += [first_page.folded_sums(miner_tables(summary)), first_page.bearings_table(summary)]
    if done and requested.runs:
        body.append(first_page.part_section(case.gearbox.study, "Motion at the duty", [done[DUTY]]))
    elif done:
        parts = sorted([*requested.motion, *requested.teeth[""]], key=lambda part: part.role.order)
        found = [(part.study, part.role.title, [done[task.name] for task in part.tasks]) for part in parts]
        body += [first_page.part_section(*one) for one in found]
    what = "Assessment of a train" if MESHES in summary else "Assessment"
    subject = case.subject
    sheets = subject.study.check(subject.case, allow_large=True).every if subject else check(case).tables
    sheets = [sheet for sheet in sheets if sheet.title != "Bearings"]  # they have a section of their own
    return first_page.written(record, what, front, body, sheets)


def _curves(parts: Sequence[Part], done: Mapping[str, TaskResult] | None) -> list[ReportCurve]:
    """Curves of the studies for the report; without their results there are none."""
    return [curve for found in answers(parts, done) for curve in found.curves] if done else []


def _pictures(record: Record, curves: Sequence[ReportCurve], mesh: str = "") -> str:
    picture = inline(pictures(record, curves, mesh), "loaded error, vibration, film, losses, safeties")
    return f'<div class="pictures"><p>{picture}</p></div>'


def _worst_first(summary: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Groups of meshes, that with the least room first, and of each the mesh with the least."""
    meshes = meshes_of(summary)
    groups = {
        group: min(names, key=lambda name: room([meshes[name]])) for group, names in groups_of(meshes).items()
    }
    return sorted(groups.items(), key=lambda one: room([meshes[one[1]]]))


def _of_mesh(record: Record, name: str, curves: Sequence[ReportCurve]) -> str:
    """Everything of a mesh of several, folded; nothing where its teeth were not pressed together."""
    mesh = meshes_of(record.summary)[name]
    if "point_angles" not in mesh:
        return ""
    picture = _pictures(record, curves, name)
    inside = [holds_of_mesh(mesh, f"Mesh {name}"), by_standard(mesh), reasons(mesh), picture]
    inside += [points(mesh), factors(mesh)]
    return f"<details><summary>Mesh {escape(name)}, each gear</summary>{''.join(inside)}</details>"
