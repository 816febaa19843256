"""`tribodyn list`: what is shipped, and which names a scenario may use."""

from enum import StrEnum
from typing import Annotated, Any

import typer

EXAMPLES = "\b\nExamples:\n  tribodyn list\n  tribodyn list laws\n  tribodyn list models --json"


class What(StrEnum):
    """What can be listed."""

    scenarios = "scenarios"
    models = "models"
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
    """List scenarios, models, laws, solvers, plots."""
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
    from tribodyn.studies import load

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
        case What.laws:
            return {name: law.about for name, law in load.FRICTION_LAWS.items()}
        case What.film_laws:
            return {name: law.about for name, law in load.FILM_LAWS.items()}
        case What.families:
            return {name: one.about for name, one in load.FAMILIES.items()}
        case What.solvers:
            return dict(load.SOLVERS)
        case What.sweep_plots:
            from tribodyn.sweep.pictures import SWEEP_NAMES

            return dict(SWEEP_NAMES)
        case What.plots:
            return _plots()


def _plots() -> dict[str, str]:
    """Return the names of all figures, and the records that each is of."""
    from tribodyn.studies.pictures import (
        LOAD_CONTACT_NAMES,
        NAMES,
        OSCILLATOR_NAMES,
        ROLLING_NAMES,
        RUN_UP_NAMES,
    )

    also = {
        "rolling elements": ROLLING_NAMES,
        "load contact studies": LOAD_CONTACT_NAMES,
        "the oscillator with backlash": OSCILLATOR_NAMES,
    }
    listed: dict[str, str] = {}
    for name in dict.fromkeys((*NAMES, *(one for names in also.values() for one in names))):
        others = [kind for kind, names in also.items() if name in names]
        what = name.replace("-", " ")
        told = "; also of " if name in NAMES else ", of "
        listed[name] = what + (told + " and ".join(others) if others else "")
    for name in RUN_UP_NAMES:
        listed[name] = "orders of the mesh while the speed changes, such as run-up"
    return listed


def _titles(folder: Any) -> dict[str, str]:
    from tribodyn.scenario.sources import names, read_toml

    return {name: str(read_toml(folder / f"{name}.toml").get("title", "")) for name in names(folder)}
