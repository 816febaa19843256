"""Runs a case and says what became of it."""

import logging
import traceback
import warnings
from collections.abc import Iterator
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any, NamedTuple

from rich.console import Console

from tools.by_schema.effects import limited
from tools.soak.cases import KEYS, SoakCase, case, written
from tools.soak.gear_records import ENERGY, RESIDUAL, train_faults
from tools.soak.gear_records import faults as gear_faults
from tools.soak.keyed import changes, unread
from tools.soak.other_records import FAULTS, any_faults, sweep_against_run, sweep_faults
from tools.soak.refusals import untrue
from tribodyn.errors import InputError, SimulationError
from tribodyn.grid.engines import LocalEngine
from tribodyn.grid.grid import Grid
from tribodyn.grid.run import run as run_sweep
from tribodyn.grid.run import settings_of
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.studies.pages import summary_table, sweep_table
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

_log = logging.getLogger(__name__)

#: Seconds of processor time after which a case counts as hanging; machine code may have to be compiled first.
LONGEST = 240
#: Mesh cycles after which the search for a steady state in a sweep is given up.
MOST_CYCLES = 100
COMPLETE, REFUSED, STOPPED, FAULTY = "complete", "refused", "stopped", "faulty"


class Outcome(NamedTuple):
    """What became of a case."""

    seed: int
    case: int
    sort: str  # as in `cases.SORTS`
    family: str  # of its teeth; empty where it has none
    status: str  # "complete", "refused" or "stopped", or "faulty" with what is wrong
    reason: str  # why it was refused or stopped
    faults: tuple[str, ...]  # what must not be
    drives_refused: int  # drives drawn before one that can be made
    residual: float  # energy residual over the relative tolerance, of a complete run; else NaN
    seconds: float  # of processor time
    compared: str = ""  # key whose values were compared
    idle: bool = False  # whether they gave the same results


def outcome(seed: int, number: int, folder: Path, short: bool = False) -> Outcome:
    """Make and run a case; its scenario and records stay in the folder."""
    begun = process_time()
    made = case(seed, number, folder, short)
    wrong = [fault for refused in made.refused for fault in untrue(refused, folder)]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        status, reason, faults, residual = _tried(made, folder)
        compared = ("", False)
        if made.sort == KEYS and status == COMPLETE:
            try:
                compared = changes(seed, number)
            except Exception as error:
                faults.append(f"another value ended in {error!r}")
    wrong += faults
    searched = made.scenario.get("scenario", made.scenario)
    family = searched.get("drive", {}).get("family", "")
    status = FAULTY if wrong else status
    seconds = round(process_time() - begun, 3)
    refused, faults = len(made.refused), tuple(wrong)
    return Outcome(
        seed, number, made.sort, family, status, reason, faults, refused, residual, seconds, *compared
    )


def run_one(seed: int, number: int, short: bool = False) -> Outcome:
    """Make and run a case in a folder of its own, which goes."""
    with TemporaryDirectory() as folder:
        return outcome(seed, number, Path(folder), short)


def _tried(made: SoakCase, folder: Path) -> tuple[str, str, list[str], float]:
    try:
        with limited(LONGEST):
            return _run(made, folder)
    except InputError as error:
        return REFUSED, str(error), _unclear(error), float("nan")
    except SimulationError as error:
        return STOPPED, str(error), [], float("nan")
    except Exception:
        _log.debug("the case ended in an error", exc_info=True)
        last = traceback.format_exc().strip().splitlines()
        place = next((line.strip() for line in reversed(last) if line.lstrip().startswith("File")), "")
        return FAULTY, "", [f"{last[-1]} ({place})"], float("nan")


def _run(made: SoakCase, folder: Path) -> tuple[str, str, list[str], float]:
    path, record = written(made.scenario, folder / "case.toml"), folder / "case.h5"
    if made.sort.startswith("sweep"):
        return _swept(made, path, record)
    result = run(load_scenario(path), record, force=True)
    with Record(result.path) as written_record:
        faults = list(_faults(made, written_record))
        faults += _printed(summary_table(written_record, full=True))
    if any(fault.startswith(ENERGY) for fault in faults) and _within_at_a_tenth(made, path, record):
        faults = [fault for fault in faults if not fault.startswith(ENERGY)]
    if made.sort == KEYS:
        faults += unread(result.path)
    if result.status == "complete":
        residual = result.summary.get("energy_residual", float("nan"))
        return COMPLETE, "", faults, abs(residual) / _rtol(made)
    faults += _doubtful(made, result.summary, result.message)
    return STOPPED, result.message, faults, float("nan")


def _within_at_a_tenth(made: SoakCase, path: Path, record: Path) -> bool:
    """Whether the energy residual, which may fall with the square of the tolerance, fits at a tenth of it."""
    rtol = 0.1 * _rtol(made)
    again = run(load_scenario(path, {"solver.rtol": rtol}), record.with_name("finer.h5"), force=True)
    return again.status == "complete" and abs(again.summary["energy_residual"]) <= RESIDUAL * rtol


def _faults(made: SoakCase, record: Record) -> Iterator[str]:
    kind = str(made.scenario.get("kind", "gear-pair"))
    if kind == "gear-pair":
        yield from gear_faults(record, _rtol(made))
    elif kind == "gear-train":
        yield from train_faults(record, _rtol(made))
    elif record.status == "complete":
        yield from FAULTS.get(kind, any_faults)(record)


def _swept(made: SoakCase, path: Path, target: Path) -> tuple[str, str, list[str], float]:
    speed, unit = str(made.scenario["operating"]["pinion_speed"]).split()
    values = ",".join(f"{float(speed) * factor:.6g}" for factor in (1.0, 1.1, 1.25))
    grid = Grid(str(path), [f"operating.pinion_speed={values}{unit}"], {})
    transient = 8 if made.sort == "sweep, transient" else None
    directions = () if transient else ("up", "down")
    settings = settings_of(grid, transient)
    if not transient:  # undamped bearings never settle
        settings = settings._replace(cycles=MOST_CYCLES)
    result = run_sweep(grid, settings, LocalEngine(1), target, directions=directions, force=True)
    with SweepRecord(result.path) as record:
        faults = list(sweep_faults(record)) + _printed(sweep_table(record))
        reasons = sorted({why for _, why in record.failures()})
        if transient:
            alone = run(load_scenario(path), target.with_name("alone.h5"), force=True)
            if alone.status == "complete":
                finer = load_scenario(path, {"solver.rtol": max(0.1 * _rtol(made), 1e-12)})
                again = run(finer, target.with_name("finer.h5"), force=True)
                faults += sweep_against_run(record, alone.summary, again.summary, _rtol(made))
    status = COMPLETE if result.status == "complete" else STOPPED
    return status, "; ".join(reasons), faults, float("nan")


def _rtol(made: SoakCase) -> float:
    return float(made.scenario.get("solver", {}).get("rtol", 1e-6))


def _printed(table: Any) -> list[str]:
    """What is wrong with a summary as it is printed."""
    page = StringIO()
    Console(file=page, width=200).print(table)
    words = page.getvalue().lower().split()
    return [f'the summary prints "{word}"' for word in ("nan", "inf", "-inf") if word in words]


def _unclear(error: InputError) -> list[str]:
    """What is wrong with a refusal as such: key, rule and remedy belong to it."""
    parts = getattr(error, "errors", (error,))
    pairs = ((part, name) for part in parts for name in ("key", "rule"))
    return [f"the refusal lacks {name}: {part}" for part, name in pairs if not getattr(part, name)]


def _doubtful(made: SoakCase, summary: dict[str, Any], message: str) -> list[str]:
    """What speaks against the reason that a run was stopped for."""
    limit = made.scenario.get("solver", {}).get("max_steps")
    if "limit of steps" in message and "steps" in summary and not summary["steps"] >= limit:
        return [f"stopped at the limit of {limit} steps after {summary['steps']}"]
    if "stopped being finite" in message or "solver gave up" in message or "step size fell" in message:
        return [message]
    return []
