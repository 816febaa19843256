"""Runs a case of any kind."""

from collections.abc import Callable
from pathlib import Path

from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase
from tribodyn.studies.efficiency.case import EfficiencyCase
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.load_contact.case import LoadContactCase
from tribodyn.studies.rolling.case import RollingCase
from tribodyn.studies.study import RunResult


def run(
    case: Case | RollingCase | EfficiencyCase | LoadContactCase | BacklashOscillatorCase,
    output: str | Path | None = None,
    force: bool = False,
    progress: Callable[[float], None] | None = None,
) -> RunResult:
    """Run a case and write its record.

    Parameters
    ----------
    case : Case, RollingCase of a gear with rolling elements, EfficiencyCase or LoadContactCase of a study
        without dynamics, or BacklashOscillatorCase
    output : path, optional
        Name of the record; default ``<case name>.h5`` in the current folder.
    force : bool
        Replace an existing record.
    progress : callable, optional
        Called with the share done, 0 … 1.

    Returns
    -------
    RunResult
        `status` is "failed" where the simulation could not go on: the path then is the partial record's.

    Raises
    ------
    InputError
        Before anything is written.
    """
    if isinstance(case, RollingCase):
        from tribodyn.studies.rolling import run as simulate_rolling

        path, summary = simulate_rolling.run(case, output, force, progress)
        return RunResult(path, "complete", "", summary)
    if isinstance(case, EfficiencyCase):
        from tribodyn.studies.efficiency import run as simulate_efficiency

        path, summary = simulate_efficiency.run(case, output, force, progress)
        return RunResult(path, "complete", "", summary)
    if isinstance(case, LoadContactCase):
        from tribodyn.studies.load_contact import run as simulate_load_contact

        ended = simulate_load_contact.run(case, output, force, progress)
        status = "failed" if ended.message else "complete"
        return RunResult(ended.path, status, ended.message, ended.summary)
    if isinstance(case, BacklashOscillatorCase):
        from tribodyn.studies.backlash_oscillator import run as simulate_backlash_oscillator

        path, message, summary = simulate_backlash_oscillator.run(case, output, force, progress)
        return RunResult(path, "failed" if message else "complete", message, summary)
    from tribodyn.studies.gear_pair.run import run as run_gear_pair

    return run_gear_pair(case, output, force, progress)
