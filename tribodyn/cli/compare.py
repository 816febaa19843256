"""`tribodyn compare`: several runs in one table and in the same pictures."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tribodyn.cli.options import JsonOption, LargeOption, SetOption, overrides, scenarios_and_records
from tribodyn.cli.records import Format
from tribodyn.numerics.files.output_files import make_folder

if TYPE_CHECKING:
    from tribodyn.studies.protocol.load import Loaded
    from tribodyn.studies.protocol.study import Study

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn compare crc-23-47 involute-23-47\n"
    '  tribodyn compare crc-23-47 involute-23-47 --set operating.gear_torque="300 N*m" -o comparison\n'
    "  tribodyn compare before.h5 after.h5 --json\n"
    "\b\nScenarios are run, records are read; with -o the records of what was run\n"
    "and one picture per quantity, all runs in it, are kept."
)


def compare(
    what: Annotated[
        list[str],
        typer.Argument(
            metavar="A B...",
            help="Records, scenario files, names of scenarios.",
            autocompletion=scenarios_and_records,
        ),
    ],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Folder of the records and pictures.")
    ] = None,
    settings: SetOption = None,
    force: Annotated[
        bool, typer.Option("--force", help="Replace records and pictures of that name.")
    ] = False,
    allow_large: LargeOption = False,
    format: Annotated[Format, typer.Option(help="File format of the pictures.")] = Format.png,
    json: JsonOption = False,
) -> None:
    """Compare runs: one table, shared pictures."""
    from contextlib import ExitStack
    from tempfile import TemporaryDirectory

    from tribodyn.cli.pictures import draw
    from tribodyn.cli.printing import print_files, print_json, print_rich
    from tribodyn.post import compare as comparing
    from tribodyn.record.reader import Record
    from tribodyn.studies.pages import compare as compare_records
    from tribodyn.studies.pages import names

    scenarios = _scenarios(what, overrides(settings))
    pictures: list[Path] = []
    with ExitStack() as stack:
        if output is None:
            folder = Path(stack.enter_context(TemporaryDirectory(prefix="tribodyn-")))
        else:
            folder = output
            make_folder(folder)
        paths = [
            _run(scenarios[word], folder, force, allow_large) if word in scenarios else Path(word)
            for word in what
        ]
        records = [stack.enter_context(Record(path)) for path in paths]
        compared = compare_records(records)
        if output is not None:
            pictures = draw(records, names(records), folder / f"compare.{format.value}", force=force)
    ran = [path for word, path in zip(what, paths, strict=True) if word in scenarios and output is not None]
    if json:
        files = {"kept": [str(path) for path in ran], "pictures": [str(path) for path in pictures]}
        print_json({**comparing.as_json(compared), **files})
        return
    print_rich(comparing.comparison_table(compared))
    print_files("record", ran)
    print_files("picture", pictures)


def _scenarios(what: list[str], settings: Mapping[str, str]) -> dict[str, "Loaded"]:
    """Load what is to be run, and refuse before anything runs what cannot be compared afterwards."""
    from tribodyn.errors import InputError
    from tribodyn.input.sources import is_file
    from tribodyn.record.reader import Record
    from tribodyn.studies.pages import study_of_record
    from tribodyn.studies.protocol.load import load

    if len(what) < 2:
        rule = "there is nothing to compare it with"
        raise InputError("compare", f'"{what[0]}"', rule, "name at least two")
    again = next((word for number, word in enumerate(what) if word in what[:number]), None)
    if again is not None:
        raise InputError("compare", f'"{again}"', "given twice", "name each once")
    # whatever it is called, a file that is no TOML is a record
    scenarios = {
        word: load(word, settings)
        for word in what
        if not word.endswith((".h5", ".hdf5")) and (word.endswith(".toml") or not is_file(Path(word)))
    }
    if settings and not scenarios:
        rule = "nothing is run: records are as they are"
        raise InputError("--set", None, rule, "name scenarios, or omit it")
    studies: dict[str, Study] = {}
    cases: dict[str, str] = {}
    for word in what:
        if word not in scenarios:
            with Record(word) as record:
                studies[word] = study_of_record(record)
            continue
        studies[word], name = scenarios[word].study, scenarios[word].case.name
        if name in cases:
            rule = f'its record would have the name of that of "{cases[name]}", {name}.h5'
            raise InputError("compare", f'"{word}"', rule, "give it another name: name = ... in the file")
        cases[name] = word
    first = studies[what[0]]
    other = next((word for word in what if studies[word].quantities != first.quantities), None)
    if other is not None:
        rule = f'kind "{studies[other].kind}" and kind "{first.kind}" share no quantities to compare'
        raise InputError("compare", f'"{other}"', rule, "compare runs of one kind")
    return scenarios


def _run(loaded: "Loaded", folder: Path, force: bool, allow_large: bool) -> Path:
    """Run a scenario into a folder; return its record."""
    from tribodyn.cli.outcome import SIMULATION_FAILED, complain, end
    from tribodyn.post.progress import progress_bar
    from tribodyn.record.withheld_efficiency import warnings
    from tribodyn.studies.protocol.run import run as run_case

    case, record = loaded.case, folder / f"{loaded.case.name}.h5"
    with loaded.naming(), progress_bar(case.name) as progress:
        result = run_case(case, record, force=force, progress=progress, allow_large=allow_large)
    for warning in warnings(result.summary):
        complain(f"{loaded.path}: warning: {warning}")
    if result.status != "complete":
        end(SIMULATION_FAILED, f"{loaded.path}: the simulation failed: {result.message}")
    return result.path
