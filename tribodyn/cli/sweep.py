"""`tribodyn sweep`: a scenario over a grid of its own keys, into one record."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from tribodyn.cli.options import (
    ForceOption,
    LargeOption,
    ScenarioArgument,
    SetOption,
    keys,
    overrides,
    require_one_way,
)

EXAMPLES = (
    "\b\nValues of --vary, the unit once at the end:\n"
    "  100:6000:200rpm    from 100 rpm to at most 6000 rpm in steps of 200 rpm\n"
    "  100:6000/60rpm     60 values from 100 rpm to 6000 rpm\n"
    "  100,200,500rpm     these; also names: friction.law=none,masjedi-khonsari\n"
    "  damage=none,1,2    of a list of tables none, or the one of that number\n"
    "\b\nExamples:\n"
    "  tribodyn sweep crc-23-47 --vary operating.pinion_speed=1000:6000:100rpm\n"
    "  tribodyn sweep crc-23-47 --vary operating.pinion_speed=100:6000/60rpm "
    "--vary operating.gear_torque=100,300N*m -o map.h5\n"
    "  tribodyn sweep jump-involute-23-47 --vary operating.pinion_speed=380:620:10rad/s --direction both\n"
    "  tribodyn sweep crc-23-47 --vary drive.pinion.profile_shift=0:0.4:0.1 --transient 40 --resume\n"
    "  tribodyn sweep crc-23-47-300 --vary operating.pinion_speed=500:6000:250rpm --refine 60\n"
    "  tribodyn sweep my-sensors.toml --signals 1s --vary mesh.tooth_sample=1:20:1 --vary damage=none,1,2 "
    "-o set.h5\n"
    "then: tribodyn plot map.h5 response waterfall"
)


class Direction(StrEnum):
    """Senses in which the first parameter is followed from case to case."""

    up = "up"
    down = "down"
    both = "both"


class EngineName(StrEnum):
    """Where the cases are evaluated."""

    native = "native"
    jax = "jax"
    dask = "dask"


def sweep(
    scenario: ScenarioArgument,
    *,
    vary: Annotated[
        list[str] | None,
        typer.Option(
            "--vary",
            metavar="KEY=VALUES",
            help="A key of the scenario and its values, see below; several span a grid.",
            autocompletion=keys,
        ),
    ] = None,
    steady: Annotated[
        bool, typer.Option("--steady", help="Seek the periodic steady state of each case (the default).")
    ] = False,
    transient: Annotated[
        int | None,
        typer.Option(
            "--transient",
            metavar="N",
            min=1,
            max=10**9,
            help="March N mesh cycles instead; quantities of the last ones.",
        ),
    ] = None,
    direction: Annotated[
        Direction | None,
        typer.Option(
            help="Follow the first key up, down or both, each case from its neighbour's state: shows jumps."
        ),
    ] = None,
    unstable: Annotated[
        bool,
        typer.Option(
            "--unstable", help="With --direction: continue branches beyond their ends, unstable, round folds."
        ),
    ] = False,
    refine: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            min=1,
            max=10**5,
            help="At most N further values of the first key, where the response bends: shows peaks.",
        ),
    ] = None,
    refine_by: Annotated[
        list[str] | None,
        typer.Option(
            metavar="QUANTITY",
            help="What --refine watches; several may be given. Default: the first quantity that is printed.",
        ),
    ] = None,
    signals: Annotated[
        str | None,
        typer.Option(
            metavar="TIME",
            help="A data set: signals of the scenario's sensors, so long (1s), in place of quantities.",
        ),
    ] = None,
    run_in: Annotated[
        float, typer.Option(metavar="TURNS", help="With --signals: turns of the first gear before them.")
    ] = 3.0,
    seed: Annotated[
        int, typer.Option(help="With --signals: of where they begin, of noise, and of the test's drives.")
    ] = 0,
    test: Annotated[
        float, typer.Option(metavar="SHARE", help="With --signals: share of the drives left for the test.")
    ] = 0.25,
    licence: Annotated[
        str | None, typer.Option(metavar="TEXT", help="With --signals: licence that the set states.")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Continue a stopped sweep of that name.")] = False,
    engine: Annotated[
        EngineName,
        typer.Option(help="native: compiled, all cores; jax: diffrax, on its device; dask: many machines."),
    ] = EngineName.native,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Dask's scheduler, tcp://host:8786; default: one of its own."),
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(min=1, max=1024, help="Threads, or Dask's worker processes; default: one per core."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The record; default: the scenario's name and the varied keys."),
    ] = None,
    settings: SetOption = None,
    force: ForceOption = False,
    allow_large: LargeOption = False,
    json: Annotated[bool, typer.Option("--json", help="Print axes and quantities as JSON.")] = False,
) -> None:
    """Vary keys of a scenario, one record of all cases."""
    from tribodyn.cli.outcome import SIMULATION_FAILED, complain, end
    from tribodyn.cli.printing import print_files, print_json, print_rich
    from tribodyn.errors import InputError
    from tribodyn.grid.data_set import LICENCE, data_set_of
    from tribodyn.grid.engines import engine_of
    from tribodyn.grid.grid import Grid, default_output
    from tribodyn.grid.refinement import refinement_of
    from tribodyn.grid.run import cases_at_most, run, settings_of
    from tribodyn.input.sources import file_name
    from tribodyn.post.progress import progress_bar
    from tribodyn.post.sweep_report import sweep_as_json, sweep_warnings
    from tribodyn.record.sweep_reader import SweepRecord
    from tribodyn.record.sweep_schema import DIRECTIONS
    from tribodyn.record.target import watched
    from tribodyn.studies.pages import sweep_table

    if steady and transient is not None:
        raise InputError("--steady", None, "contradicts --transient", "give one of them")
    require_one_way(resume=resume, force=force)
    asked = data_set_of(signals, run_in, seed, test, licence or LICENCE)
    grid = Grid(scenario, vary or [], overrides(settings))
    grid = grid.hearing(asked.signals) if asked else grid
    refinement = refinement_of(grid, refine, refine_by or ())
    record = output or default_output(grid)
    kept = watched(record)
    chosen = DIRECTIONS if direction is Direction.both else (direction.value,) if direction else ()
    most = cases_at_most(grid, refinement, len(chosen))
    with (
        engine_of(engine.value, workers, scheduler) as evaluator,
        progress_bar(grid.name, most, "cases") as progress,
    ):
        result = run(
            grid,
            settings_of(grid, transient, engine.value),
            evaluator,
            record,
            directions=chosen,
            unstable=unstable,
            refinement=refinement,
            force=force,
            resume=resume,
            follow=lambda done, total: progress(1.0 - (total - done) / most),
            allow_large=allow_large,
            data_set=asked,
            scenario_file="" if output else file_name(grid.path, record.parent),
        )
    with SweepRecord(result.path) as written:
        if json:
            print_json(sweep_as_json(written))
        else:
            print_rich(sweep_table(written))
        for warning in sweep_warnings(written):
            complain(f"{result.path}: warning: {warning}")
    if not json:
        print_files("record", [result.path])
        print_files("previous", kept())
    if result.status != "complete":
        reason = f"all {result.cases} cases failed; their reasons: {result.path}"
        end(SIMULATION_FAILED, f"{grid.path}: {reason}")
