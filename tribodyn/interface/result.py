"""The record of a run as an object: its data, summary and pictures."""

import shutil
import weakref
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from tribodyn.interface import shown
from tribodyn.interface.scenario import public
from tribodyn.record import trust
from tribodyn.record.reader import Record

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from tribodyn.record.sensors import SensorSignal
    from tribodyn.studies.measured import Source as Measured


class Run:
    """A record of a run, and what can be asked of it; `run` and `open` make one.

    Attributes
    ----------
    path : Path
        The record.
    kind : str
        Kind of the study, as scenarios name it.
    status : str
        "complete"; "failed" where the simulation could not go on; "partial" of a run that was killed.
    message : str
        Why it is not complete.
    summary : dict
        Quantities of the run by name, SI units; None where one is withheld.
    scenario : dict
        The resolved scenario.
    trust : str
        "inside the model", "outside the model", "laws extrapolated", or "" where nothing was judged.
    reasons : list of str
        Why it is not inside, in words; the numbers are in ``summary["trust_reasons"]``.
    """

    def __init__(self, path: Path, folder: str | None = None) -> None:
        self.path = path
        if folder is not None:  # a temporary one, which goes with this object
            weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        with Record(path) as record:
            self.kind, self.status, self.message = record.kind, record.status, record.message
            self.summary, self.scenario = shown.Summary(record.summary), record.scenario
            self.trust, self.reasons = record.trust, trust.reasons(record.summary)

    @cached_property
    def data(self) -> "xarray.Dataset":
        """Everything that was sampled, with dimensions and units; SI."""
        with Record(self.path) as record:
            return shown.of_run(record)

    @cached_property
    def verdict(self) -> list[str]:
        """What it shows, whether it holds, and what to do: what `tribodyn run` prints first."""
        from tribodyn.studies.pages import study_of_record

        with Record(self.path) as record:
            return study_of_record(record).verdict(record)

    @cached_property
    def mesh_cycle(self) -> dict[str, Any]:
        """The table over a mesh cycle that the run was made from, by name; empty where there is none."""
        with Record(self.path) as record:
            return record.mesh_cycle if "mesh_cycle" in record.groups else {}

    @cached_property
    def sensors(self) -> "dict[str, SensorSignal]":
        """What its sensors gave, by name: `time`, `values`, `rate`, `turns` of the reference, and more."""
        from tribodyn.record.sensors import read_sensed

        with Record(self.path) as record:
            return {signal.name: signal for signal in read_sensed(record).signals}

    @property
    def plots(self) -> tuple[str, ...]:
        """Names that `plot` takes."""
        from tribodyn.studies.pages import OVERVIEW, names

        with Record(self.path) as record:
            return (OVERVIEW, *names([record]))

    @public
    def plot(
        self,
        name: str = "overview",
        *others: "Run",
        ax: "Axes | None" = None,
        cycles: int | Literal["auto"] | None = "auto",
        against: str = "phase",
        measured: "Measured | None" = None,
        align: str = "given",
    ) -> "Figure":
        """Draw one figure.

        Parameters
        ----------
        name : str
            One of `plots`.
        *others : Run
            Runs to compare with, of the same kind.
        ax : matplotlib axes, optional
            Draw where these stand, in place of them; default: a figure of its own.
        cycles : int, None or "auto"
            How many of the last mesh cycles to show; None: all; "auto": 2, of a transient all.
        against : {"phase", "time"}
            Mesh cycles, or milliseconds.
        measured : path or mapping, optional
            Draw these curves beside the runs' instead: a CSV file that begins with
            ``mesh_phase [1],transmission_error_rotational [um]``, or its columns by such names.
        align : {"given", "mean", "fit"}
            Runs as they are; moved to the measured mean; also along the abscissa, to the best correlation.

        Returns
        -------
        Figure
            Of matplotlib, or the part of one that took the place of `ax`.

        Raises
        ------
        InputError
            For an unknown name, runs that cannot be compared, and measured curves that cannot be used.
        """
        from tribodyn.post.style import in_place_of
        from tribodyn.studies.pages import figure

        with self._records(others) as records, in_place_of(ax):
            if measured is not None:
                from tribodyn.studies.measured import measured_figure

                return measured_figure(records, measured, align)
            return figure(name, records, cycles=cycles, against=against)

    @public
    def report(
        self,
        path: str | Path | None = None,
        *others: "Run",
        force: bool = False,
        measured: "Measured | None" = None,
        align: str = "given",
    ) -> Path:
        """Write a page for the browser: summary, figures, the teeth rolling through mesh.

        Parameters
        ----------
        path : path, optional
            Default: the record's name, in the current folder.
        *others : Run
            Runs of the same kind, side by side with this one.
        force : bool
            Replace also what is no page of ours.
        measured, align
            As of `plot`: a figure on the page.

        Returns
        -------
        Path
            Of one HTML file that needs no other.

        Raises
        ------
        InputError
            For runs of different kinds, and a file that is there and is no page of ours, or a link.
        OutputError
            If it cannot be written.
        """
        from tribodyn.studies.pages import write_report

        with self._records(others) as records:
            target = path or f"{self.path.stem}.html"
            return write_report(records, target, force=force, measured=measured, align=align)

    @public
    def animate(self, *others: "Run") -> shown.Animation:
        """Roll the teeth through mesh, with the path of contact and the loads of the pairs.

        Parameters
        ----------
        *others : Run
            Runs of the same kind, to choose from.

        Returns
        -------
        shown.Animation
            Shows itself in a notebook; `html` is its page.

        Raises
        ------
        InputError
            For a record without gears that turn.
        """
        from tribodyn.studies.pages import report

        with self._records(others) as records:
            shown.check_teeth(records)
            return shown.Animation(report(records, figures=False))

    @public
    def save(self, path: str | Path, *, force: bool = False) -> Path:
        """Copy the record to a file.

        Parameters
        ----------
        path : path
            The file.
        force : bool
            Replace a record of that name.

        Returns
        -------
        Path
            Of the copy.

        Raises
        ------
        InputError
            If there is one already, without `force`.
        """
        from tribodyn.record.writer import check_target

        target = Path(path)
        check_target(target, force)
        return Path(shutil.copyfile(self.path, target))

    @contextmanager
    def _records(self, others: "tuple[Run, ...]") -> Iterator[list[Record]]:
        """The records of this run and of others, open."""
        with ExitStack() as stack:
            yield [stack.enter_context(Record(run.path)) for run in (self, *others)]

    def __repr__(self) -> str:
        title = self.scenario.get("title", self.path.stem)
        state = ": ".join(filter(None, (self.status, self.message)))
        judged = ": ".join(filter(None, (self.trust, "; ".join(self.reasons))))
        return f"<tribodyn run: {title} [{', '.join(filter(None, (state, judged)))}], {self.path}>"

    def _repr_html_(self) -> str:
        """Title, verdict, a small picture, the summary and how far to trust it, for notebooks."""
        from tribodyn.post.page.page import summary_tables, verdict_list, warnings_of
        from tribodyn.studies.pages import study_of_record

        with Record(self.path) as record:
            study = study_of_record(record)
            return shown.block(
                shown.heading(str(self.scenario.get("title", self.path.stem)), self.status, self.trust),
                warnings_of(record, named=False),
                verdict_list(self.verdict),
                shown.picture_of_run(record, study),
                summary_tables([record], [study.reported()]),
                shown.folded("How far to trust it", [*self.reasons, *study.sentences(record)]),
            )
