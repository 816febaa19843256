"""Arguments and options that several commands take alike, and what the shell completes in them."""

from collections.abc import Iterable
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from tribodyn.errors import InputError, quoted

RECORDS = ("*.h5", "*.hdf5")


def scenarios(incomplete: str) -> list[str]:
    """Scenario files here, names of shipped scenarios."""
    from tribodyn.input.sources import names, shipped

    return _beginning([*_files(incomplete, "*.toml"), *names(shipped("scenarios"))], incomplete)


def drives(incomplete: str) -> list[str]:
    """Files here, names of shipped drives and scenarios."""
    from tribodyn.input.sources import names, shipped

    return _beginning([*names(shipped("models") / "drives"), *scenarios(incomplete)], incomplete)


def scenarios_and_records(incomplete: str) -> list[str]:
    """Records and scenario files here, names of shipped scenarios."""
    return _beginning([*_files(incomplete, *RECORDS), *scenarios(incomplete)], incomplete)


def kinds(incomplete: str) -> list[str]:
    """Kinds of study."""
    from tribodyn.studies import STUDIES

    return _beginning(STUDIES, incomplete)


def keys(context: typer.Context, incomplete: str) -> list[str]:
    """Keys of the scenario that is on the line already, or of a gear pair; a table's after its dot."""
    import tomllib

    from tribodyn.input.messages import keys_in
    from tribodyn.input.sources import find_scenario
    from tribodyn.studies.protocol.load import table_of

    data = {}
    # words that click could not sort while an option waits for its value
    words = [context.params.get("scenario"), *(word for word in context.args if not word.startswith("-"))]
    if scenario := next(filter(None, words), None):
        try:
            data = tomllib.loads(find_scenario(scenario).read_text(encoding="utf-8"))
        except (InputError, OSError, ValueError):  # there is no such file yet
            data = {}
    above = incomplete.split(".")[:-1]
    candidates = keys_in(table_of(data), above)
    return _beginning([key if key.endswith(".") else f"{key}=" for key in candidates], incomplete)


def papers(incomplete: str) -> list[str]:
    """Papers that there is a validation for."""
    from tribodyn.validation import PAPERS

    return _beginning(PAPERS, incomplete)


def records_and_plots(incomplete: str) -> list[str]:
    """Records here, figures of all kinds of study and of sweeps."""
    from tribodyn.studies import STUDIES

    plots = [name for _, figures in STUDIES.each(lambda study: study.drawings()) for name in figures]
    swept = STUDIES.each(lambda study: study.sweep_drawings() if study.swept() else {})
    of_sweeps = [name for _, figures in swept for name in figures]
    return _beginning([*_files(incomplete, *RECORDS), "all", *plots, *of_sweeps], incomplete)


def written_formats(incomplete: str) -> list[str]:
    """Formats of other programs that can be written."""
    from tribodyn.studies.handed_over import writers

    return _beginning(writers(), incomplete)


def read_formats(incomplete: str) -> list[str]:
    """Formats of other programs that can be read."""
    from tribodyn.studies.handed_over import readers

    return _beginning(readers(), incomplete)


def _files(incomplete: str, *patterns: str) -> list[str]:
    """Files in the folder that is written so far, or here."""
    folder = Path(incomplete[: incomplete.rfind("/") + 1])
    return sorted(str(path) for pattern in patterns for path in folder.glob(pattern))


def _beginning(names: Iterable[str], incomplete: str) -> list[str]:
    """Names that begin with what is written, each once; where there are none the shell offers any file."""
    return [name for name in dict.fromkeys(names) if name.startswith(incomplete)]


ScenarioArgument = Annotated[
    str, typer.Argument(help="A scenario file, or the name of a shipped scenario.", autocompletion=scenarios)
]

SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help='Set a key of the scenario, also inside what it refers to: operating.gear_torque="600 N*m".',
        autocompletion=keys,
    ),
]

LargeOption = Annotated[bool, typer.Option("--allow-large", help="Allow runs above the resource limits.")]

ForceOption = Annotated[
    bool,
    typer.Option("--force", help="Replace a record of that name, and what stands in place of its pictures."),
]

ReplaceOption = Annotated[
    bool, typer.Option("--force", help="Replace also files that tribodyn did not make, and links.")
]

FullOption = Annotated[
    bool, typer.Option("--full", help="Print also the solver's numbers, and how far to trust the result.")
]

JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON.")]
#: Characters of a key; above that it is none of a scenario's.
LONGEST_KEY = 200


def overrides(settings: list[str] | None) -> dict[str, str]:
    """Return key and value of each ``KEY=VALUE``; the last of a key wins."""
    parsed: dict[str, str] = {}
    for setting in settings or []:
        key, equals, value = setting.partition("=")
        key = key.strip()
        if not equals or len(key) > LONGEST_KEY or not all(key.split(".")):
            remedy = "write it like --set solver.cycles=40"
            raise InputError("--set", quoted(setting), "not KEY=VALUE", remedy)
        parsed[key] = value.strip()
    return parsed


def require_one_way(*, resume: bool, force: bool) -> None:
    """Refuse to continue a record and to replace it at once."""
    if resume and force:
        raise InputError("--resume", None, "contradicts --force", "give one of them")


class Align(StrEnum):
    """How a simulation is laid beside what was measured."""

    given = "given"
    mean = "mean"
    fit = "fit"


MeasuredOption = Annotated[
    Path | None,
    typer.Option(
        "--measured", metavar="FILE", help="Measured curves (CSV) to draw beside the record: name [unit],…"
    ),
]
AlignOption = Annotated[
    Align,
    typer.Option(
        help="With --measured: as given; mean: moved to the measured mean; fit: along the abscissa too."
    ),
]
