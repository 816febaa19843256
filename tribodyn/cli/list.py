"""`tribodyn list`: what is shipped, and which names a scenario may use."""

import builtins
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer

from tribodyn.cli.options import JsonOption

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn list\n"
    "  tribodyn list laws\n"
    "  tribodyn list --full\n"
    "  tribodyn list plots crc-23-47.h5\n"
    "  tribodyn list models --json"
)


class What(StrEnum):
    """What can be listed."""

    scenarios = "scenarios"
    models = "models"
    kinds = "kinds"
    laws = "laws"
    film_laws = "film-laws"
    link_laws = "link-laws"
    wear_laws = "wear-laws"
    families = "families"
    solvers = "solvers"
    plots = "plots"
    sweep_plots = "sweep-plots"
    formats = "formats"
    papers = "papers"


def list(
    what: Annotated[What | None, typer.Argument(help="What to list; an overview if left out.")] = None,
    record: Annotated[
        Path | None,
        typer.Argument(help="With plots: the figures that this record, or sweep, holds enough for."),
    ] = None,
    full: Annotated[bool, typer.Option("--full", help="Everything of all sorts.")] = False,
    json: JsonOption = False,
) -> None:
    """List scenarios, models, kinds of study, laws, solvers, plots, formats, papers."""
    from tribodyn.cli.printing import print_json, print_prose, print_table
    from tribodyn.errors import InputError

    if record is not None and what is not What.plots:
        rule = f"{what.value if what else 'everything'} does not depend on a record"
        raise InputError("record", None, rule, "write: tribodyn list plots RECORD")
    if record is not None:
        from tribodyn.record.sweep_reader import SweepRecord, open_any
        from tribodyn.studies.pages import drawable, drawable_of_sweep

        with open_any(record) as opened:
            drawings = drawable_of_sweep([opened]) if isinstance(opened, SweepRecord) else drawable([opened])
            listed = {What.plots.value: {name: drawing.about for name, drawing in drawings.items()}}
    else:
        listed = {sort.value: _about(sort) for sort in ([what] if what else What)}
    if json:
        print_json(listed)
        return
    if what is None and not full:
        rows = [(sort, str(len(names)), _first(names)) for sort, names in listed.items()]
        print_table("What there is", ("sort", "number", "such as"), rows)
        print_prose("All names of a sort: tribodyn list SORT; all of all sorts: tribodyn list --full.")
        return
    for title, entries in listed.items():
        print_table(title, ("name", "what it is"), entries.items())


def _first(names: dict[str, str]) -> str:
    """The first names of a sort, as many as fit a line of a terminal."""
    chosen = builtins.list(names)[:3]
    return ", ".join(chosen) + (", …" if len(names) > len(chosen) else "")


def _about(what: What) -> dict[str, str]:
    """Return name and description of everything of one sort."""
    from tribodyn.exchange import FORMATS
    from tribodyn.geometry.families import FAMILIES
    from tribodyn.input.sources import shipped
    from tribodyn.solve.methods import SOLVERS
    from tribodyn.studies import STUDIES
    from tribodyn.train.links import LINK_LAWS
    from tribodyn.tribology.film import FILM_LAWS
    from tribodyn.tribology.friction import FRICTION_LAWS
    from tribodyn.tribology.wear import WEAR_LAWS
    from tribodyn.validation import PAPERS

    named: dict[What, Any] = {
        What.kinds: STUDIES,
        What.laws: FRICTION_LAWS,
        What.film_laws: FILM_LAWS,
        What.link_laws: LINK_LAWS,
        What.wear_laws: WEAR_LAWS,
        What.families: FAMILIES,
        What.formats: FORMATS,
        What.papers: PAPERS,
    }
    match what:
        case What.scenarios:
            return _titles(shipped("scenarios"))
        case What.models:
            folders = sorted(path for path in shipped("models").iterdir() if path.is_dir())
            titles = {folder.name: _titles(folder) for folder in folders}
            return {f"{folder}/{name}": title for folder in titles for name, title in titles[folder].items()}
        case What.solvers:
            return dict(SOLVERS)
        case What.plots:
            return _drawn(dict(STUDIES.each(lambda study: study.drawings())))
        case What.sweep_plots:
            return _drawn(dict(STUDIES.each(lambda study: study.sweep_drawings() if study.swept() else {})))
    return {name: thing.about for name, thing in named[what].items()}


def _drawn(of_kinds: dict[str, Any]) -> dict[str, str]:
    """Return the names of all figures, what they show, and of which kinds of study."""
    about: dict[str, dict[str, builtins.list[str]]] = {}
    for kind, drawings in of_kinds.items():
        for name, drawing in drawings.items():
            if name != "overview":
                about.setdefault(name, {}).setdefault(drawing.about, []).append(kind)
    return {
        name: "; ".join(f"{what} ({', '.join(kinds)})" for what, kinds in shown.items())
        for name, shown in about.items()
    }


def _titles(folder: Any) -> dict[str, str]:
    from tribodyn.input.sources import names, read_toml

    return {name: str(read_toml(folder / f"{name}.toml").get("title", "")) for name in names(folder)}
