"""Lines and sentences of the summary of a search."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.numerics.variable import Variable
from tribodyn.post.report import Line, Lines, shown
from tribodyn.record.reader import Record
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.sources import split
from tribodyn.studies.gears.shared import WALL_TIME

LINES: Lines = {
    "Search": (
        Line("objective_name", "Objective", definition="Figure, or sum of figures, that was sought."),
        Line("method", "Method", definition="Method of the search, see method_reason in the summary."),
        Line("evaluations", "Evaluations", form=",d", definition="Candidates that were evaluated."),
        Line(
            "evaluations_feasible",
            "of these feasible",
            form=",d",
            definition="Candidates that satisfy all constraints.",
        ),
        Line(
            "evaluations_without_figures",
            "of these without figures",
            form=",d",
            definition="Candidates that cannot be made, or for which no state was found; `message` says why.",
        ),
    ),
    "Solver": (WALL_TIME,),
}

SWEPT: dict[str, Variable] = {
    "objective": Variable((), "1", "objective at the best, in SI units of its own"),
    "objective_start": Variable((), "1", "objective at the start, in SI units of its own"),
    "evaluations": Variable((), "1", "candidates that were evaluated"),
    "evaluations_feasible": Variable((), "1", "candidates that satisfy all constraints"),
    "evaluations_without_figures": Variable((), "1", "candidates without figures"),
}
SWEEP_LINES = (
    Line("objective", "Objective at the best"),
    Line("objective_start", "Objective at the start"),
    Line("evaluations", "Evaluations", form=",d"),
)

PANELS = ("objective",)
#: Figures that stand at the top of what `run --json` prints.
TOP = ("objective_start", "objective", "best", "evaluations")


def sentences(record: Record) -> list[str]:
    """Say what changed from the start to the best, and how the best was confirmed."""
    summary = record.summary
    if "objective" not in summary:
        return []
    search = record.scenario
    names = str(summary["objective_name"]).split(" and ")
    start, best = (np.atleast_1d(summary.get(f"objective{end}", np.nan)) for end in ("_start", ""))
    said = []
    for place, name in enumerate(names):
        before = start[place] if place < len(start) and start[place] is not None else np.nan
        said.append(f"{_named(search, name)}: {_change(search, name, before, best[place])}.")
    said += [
        f"{key}: {summary.get('start', {}).get(key, 'not set')} at the start, {value} at the best."
        for key, value in summary.get("best", {}).items()
    ]
    before, after = summary.get("constraints_start", {}), summary.get("constraints_best", {})
    known = summary.get("figures_best", {})
    for text, value in after.items():
        if name := _figure_in(text, known):
            said.append(f"{text}: at its worst {_change(search, name, before.get(text), value)}.")
    if "resolution" in summary:
        said.append(_resolution(search, names, summary))
    if "objective_confirmed" in summary:
        ends = (summary[f"objective_{end}confirmed"] for end in ("start_", ""))
        change = _change(search, names[0], *ends)
        said.append(f"Evaluated once more as design.confirm says: {change}.")
    if "without_figures_message" in summary:
        count = summary["evaluations_without_figures"]
        said.append(f"{count} candidates have no figures, most because: {summary['without_figures_message']}")
    return said


def _resolution(search: Mapping[str, Any], names: Sequence[str], summary: Mapping[str, Any]) -> str:
    """Say on which resolution the figures stand, and what the best is on the one that was searched on."""
    lines = [line_of(search, name) or Line(name, name) for name in names]
    fine, coarse = (
        ", ".join(f"{key} = {value}" for key, value in summary[name].items())
        for name in ("resolution", "resolution_searched")
    )
    stands = "do not change there" if summary["figure_stands"] else "still change there"
    before = " and ".join(
        f"{shown(line, float(value))} {line.unit}".rstrip()
        for line, value in zip(lines, np.atleast_1d(summary["objective_searched"]), strict=True)
    )
    return f"Figures are those of {fine}, and {stands}; searched with {coarse}, where the best has {before}."


def _figure_in(text: str, figures: Mapping[str, Any]) -> str:
    name = text.split()[0].split("<")[0].split(">")[0]
    return name if name in figures else ""


def line_of(search: Mapping[str, Any], name: str) -> Line | None:
    """The line for a figure of the summary of the search's scenario, or of a part of it.

    Parameters
    ----------
    search : the search as its record holds it
    name : of the figure
    """
    parts = search.get("design", {}).get("part") or {}
    part, figure = split(name, parts)
    data = parts[part] if part else search.get("scenario", {})
    lines = (line for some in study_of(data).lines().values() for line in some)
    found = next((line for line in lines if line.name == figure), None)
    return found._replace(label=f"{found.label} ({part})") if found and part else found


def _named(search: Mapping[str, Any], name: str) -> str:
    line = line_of(search, name)
    return line.label if line else name


def _change(search: Mapping[str, Any], name: str, before: Any, after: Any) -> str:
    line = line_of(search, name) or Line(name, name)
    first = "no figure"
    if before is not None and not np.isnan(before):
        first = f"{shown(line, float(before))} {line.unit}".rstrip()
    return f"{first} at the start, {shown(line, float(after))} {line.unit}".rstrip() + " at the best"
