"""`tribodyn list`: what is shipped, and which names a scenario may use."""

import builtins
from enum import StrEnum
from typing import Annotated, Any

import typer

EXAMPLES = "\b\nExamples:\n  tribodyn list\n  tribodyn list laws\n  tribodyn list models --json"


class What(StrEnum):
    """What can be listed."""

    scenarios = "scenarios"
    models = "models"
    kinds = "kinds"
    laws = "laws"
    film_laws = "film-laws"
    families = "families"
    solvers = "solvers"
    plots = "plots"
    sweep_plots = "sweep-plots"


def list(
    what: Annotated[What | None, typer.Argument(help="What to list; everything if left out.")] = None,
    json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """List scenarios, models, kinds of study, laws, solvers, plots."""
    from tribodyn.cli.printing import print_json, print_table

    listed: dict[str, dict[str, Any]] = {one.value: _about(one) for one in ([what] if what else What)}
    if json:
        print_json(listed)
        return
    for title, entries in listed.items():
        print_table(title, ("name", "what it is"), entries.items())


def _about(what: What) -> dict[str, str]:
    """Return name and description of everything of one sort."""
    from tribodyn.scenario.sources import shipped

    match what:
        case What.scenarios:
            return _titles(shipped("scenarios"))
        case What.models:
            folders = sorted(path for path in shipped("models").iterdir() if path.is_dir())
            return {
                f"{folder.name}/{name}": title
                for folder in folders
                for name, title in _titles(folder).items()
            }
        case What.kinds:
            from tribodyn.studies import STUDIES

            return _described(STUDIES)
        case What.laws:
            from tribodyn.tribology.friction import FRICTION_LAWS

            return _described(FRICTION_LAWS)
        case What.film_laws:
            from tribodyn.tribology.film import FILM_LAWS

            return _described(FILM_LAWS)
        case What.families:
            from tribodyn.geometry.families import FAMILIES

            return _described(FAMILIES)
        case What.solvers:
            from tribodyn.solve.methods import SOLVERS

            return dict(SOLVERS)
        case What.sweep_plots:
            from tribodyn.studies import STUDIES

            return _drawn(dict(STUDIES.each(lambda study: study.sweep_drawings() if study.swept() else {})))
        case What.plots:
            from tribodyn.studies import STUDIES

            return _drawn(dict(STUDIES.each(lambda study: study.drawings())))


def _described(registry: Any) -> dict[str, str]:
    return {name: one.about for name, one in registry.items()}


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
    from tribodyn.scenario.sources import names, read_toml

    return {name: str(read_toml(folder / f"{name}.toml").get("title", "")) for name in names(folder)}
