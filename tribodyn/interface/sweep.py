"""Sweeps from Python: a scenario over a grid of its keys, as an xarray dataset."""

import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from tribodyn.errors import InputError
from tribodyn.grid.data_set import LICENCE, TEST_SHARE, data_set_of
from tribodyn.grid.engines import engine_of
from tribodyn.grid.grid import Grid
from tribodyn.grid.refinement import refinement_of
from tribodyn.grid.run import cases_at_most, run, settings_of
from tribodyn.interface import shown
from tribodyn.interface.result import Run
from tribodyn.interface.run import open_run
from tribodyn.interface.scenario import Source, changes_of, in_toml, public, scenario
from tribodyn.numerics.files.output_files import write_output
from tribodyn.post.progress import Report, progress_of
from tribodyn.record import trust
from tribodyn.record.sweep_reader import SweepRecord, is_sweep
from tribodyn.record.sweep_schema import DIRECTIONS
from tribodyn.studies import study_of
from tribodyn.studies.protocol.batch import RUN_IN

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

Values = str | Sequence[Any] | np.ndarray | Any
"""Values of a varied key: "1000:6000:100rpm", a list of texts, a quantity of pint, plain numbers."""


class Sweep:
    """The record of a sweep, and what can be asked of it; `open` makes one.

    Attributes
    ----------
    path : Path
        The record.
    status, message : str
        As of a `Run`.
    summary : dict
        Cases, those that failed, wall time in s.
    scenario : dict
        The resolved scenario, without the varied keys' values.
    data : xarray.Dataset
        Quantities over the grid, with units; SI. NaN, with the reason in "message", where a case failed.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        with SweepRecord(self.path) as record:
            self.status, self.message = record.status, record.message
            self._counts = record.count()
            self.summary: dict[str, Any] = record.summary
            self.scenario: dict[str, Any] = record.scenario
            self.data: xarray.Dataset = shown.of_sweep(record)

    @property
    def plots(self) -> tuple[str, ...]:
        """Names that `plot` takes."""
        from tribodyn.studies.pages import sweep_names

        with SweepRecord(self.path) as record:
            return sweep_names([record])

    @public
    def plot(self, name: str = "overview", **at: float | str) -> "Figure":
        """Draw one figure.

        Parameters
        ----------
        name : str
            One of `plots`; "overview" is the first of them.
        **at : float or str
            Parameter to value in SI, for a figure of one case.

        Returns
        -------
        Figure
            Of matplotlib.

        Raises
        ------
        InputError
            For an unknown name, and a place that is not in the grid.
        """
        from tribodyn.studies.pages import sweep_figure

        with SweepRecord(self.path) as record:
            return sweep_figure(name, [record], at)

    def __repr__(self) -> str:
        return (
            f"<tribodyn sweep: {self.scenario.get('title', self.path.stem)} [{self._state()}], {self.path}>"
        )

    def _repr_html_(self) -> str:
        """Title, size, verdict, a small picture and the dataset, for notebooks."""
        from tribodyn.post.page.page import verdict_list
        from tribodyn.post.sweep_report import sweep_verdict

        study = study_of(self.scenario)
        with SweepRecord(self.path) as record:
            lines = sweep_verdict(record)
        return shown.block(
            shown.heading(str(self.scenario.get("title", self.path.stem)), self._state()),
            verdict_list(lines),
            shown.picture_of_sweep(self.data, study),
            self.data._repr_html_(),
        )

    def _state(self) -> str:
        """How many cases there are, and what became of them."""
        cases, failed = self._counts["cases"], self._counts["failed"]
        state = f"{self.status}, {cases} cases" + (f", {failed} failed" if failed else "")
        verdicts = self.data[trust.TRUST].values if trust.TRUST in self.data else ()
        for verdict in (trust.OUTSIDE, trust.EXTRAPOLATED):
            if count := int(np.sum(np.asarray(verdicts) == trust.VERDICTS[verdict])):
                state += f", {count} {verdict}"
        return state


@public
def sweep(
    source: Source,
    vary: Mapping[str, Values] | str | Sequence[str],
    overrides: Mapping[str, Any] | None = None,
    *,
    transient: int | None = None,
    direction: Literal["up", "down", "both"] | None = None,
    refine: int | None = None,
    refine_by: str | Sequence[str] = (),
    signals: Any = None,
    run_in: float = RUN_IN,
    seed: int = 0,
    test: float = TEST_SHARE,
    licence: str = LICENCE,
    engine: Literal["native", "jax", "dask"] = "native",
    workers: int | None = None,
    scheduler: str | None = None,
    output: str | Path | None = None,
    force: bool = False,
    resume: bool = False,
    progress: Report | bool | None = None,
    allow_large: bool = False,
) -> "xarray.Dataset":
    """Evaluate a scenario over a grid of its keys.

    Parameters
    ----------
    source, overrides
        As `scenario` takes them.
    vary : mapping, str or list of str
        Dotted key to its values, see `Values`; several keys span a grid, the last running fastest. Or as
        ``--vary`` takes them: ``"operating.gear_torque=100:300:50 N*m"``.
    transient : int, optional
        March so many mesh cycles; default: seek the periodic steady state of each case.
    direction : {"up", "down", "both"}, optional
        Follow the first key, each case from its neighbour's state: shows jumps.
    refine : int, optional
        Add at most so many further values of the first key where the response bends: shows peaks.
    refine_by : str or list of str, optional
        Quantities of the sweep that `refine` watches; default: the first that the command line prints.
    signals : str or quantity, optional
        Duration: the cases give the signals of the scenario's sensors, a labelled data set; see
        `docs/data-sets.md`.
    run_in, seed, test, licence : optional
        Of a data set: turns of the reference body before signals begin, seed of where they begin and of the
        sensors' noise, share of the drives that are left for the test, text that the set has as its licence.
    engine, workers, scheduler
        Where the cases are evaluated: compiled on all cores, by JAX on its device, by Dask.
    output, force, resume
        Keep the record in a file, replace one, go on with an unfinished one; default: nothing is kept.
    progress : callable or bool, optional
        Called with the share done, 0 … 1; default: a bar on a terminal or in a notebook; False: none.
    allow_large : bool
        Allow grids above the resource limits.

    Returns
    -------
    xarray.Dataset
        Quantities over the grid, SI; NaN, with the reason in "message", where a case failed.

    Raises
    ------
    InputError
        Before anything is computed.
    """
    if direction not in (None, *DIRECTIONS, "both"):
        raise InputError("direction", f'"{direction}"', "no such direction", 'one of "up", "down", "both"')
    chosen = DIRECTIONS if direction == "both" else (direction,) if direction else ()
    with tempfile.TemporaryDirectory(prefix="tribodyn-") as folder:
        grid = _grid(source, vary, overrides, Path(folder))
        watched = [refine_by] if isinstance(refine_by, str) else refine_by
        refinement = refinement_of(grid, refine, watched)
        asked = data_set_of(in_toml(signals), run_in, seed, test, licence)
        if asked:
            grid = grid.hearing(asked.signals)
        record = Path(output) if output is not None else Path(folder) / "sweep.h5"
        most = cases_at_most(grid, refinement, len(chosen))
        with (
            engine_of(engine, workers, scheduler) as evaluator,
            progress_of(progress, grid.name, most, "cases") as report,
        ):
            done = run(
                grid,
                settings_of(grid, transient, engine),
                evaluator,
                record,
                directions=chosen,
                refinement=refinement,
                force=force,
                resume=resume,
                follow=lambda count, total: report(1.0 - (total - count) / most),
                allow_large=allow_large,
                data_set=asked,
            )
        with SweepRecord(done.path) as written:
            return shown.of_sweep(written).load()


@public
def open_result(path: str | Path) -> Run | Sweep:
    """Open the record of a run or of a sweep.

    Parameters
    ----------
    path : path
        Of a record, complete or partial, that a run, a sweep or the command line wrote.

    Returns
    -------
    Run or Sweep

    Raises
    ------
    InputError
        If there is none, or it is damaged.
    """
    return Sweep(path) if is_sweep(path) else open_run(Path(path))


def _grid(
    source: Source,
    vary: Mapping[str, Values] | str | Sequence[str],
    overrides: Mapping[str, Any] | None,
    folder: Path,
) -> Grid:
    changes = changes_of(overrides)
    if isinstance(vary, Mapping):
        options = [f"{key}={_values(key, values)}" for key, values in vary.items()]
    else:
        options = [vary] if isinstance(vary, str) else [str(option) for option in vary]
    if isinstance(source, (str, Path)):
        return Grid(str(source), options, changes)
    case = scenario(source)  # with everything written out: no file of its own is needed
    file = folder / f"{case.name}.toml"
    write_output(file, case.toml)
    return Grid(str(file), options, changes)


def _values(key: str, values: Values) -> str:
    """Values as the command line takes them."""
    if isinstance(values, str):
        return values
    texts = in_toml(values)
    if not isinstance(texts, list) or not texts:
        rule = "expected a list, an array or a text of values"
        raise InputError(key, repr(values), rule, 'such as "1000:6000:100rpm" or ["1000 rpm", "2000 rpm"]')
    return ",".join(value if isinstance(value, str) else repr(value) for value in texts)
