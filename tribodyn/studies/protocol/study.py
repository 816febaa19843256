"""What a kind of study is: everything that the rest of the package needs of it."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module, resources
from inspect import ismodule
from itertools import chain
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

from tribodyn.cases import cost
from tribodyn.cases.results import CaseHead as CaseHead
from tribodyn.cases.results import CheckResult as CheckResult
from tribodyn.cases.results import Progress as Progress
from tribodyn.cases.results import RunResult as RunResult
from tribodyn.cases.results import TextTable as TextTable
from tribodyn.errors import InputError
from tribodyn.numerics.registry import cannot_be_loaded

if TYPE_CHECKING:
    from tribodyn.cases.assessment_part import Contribution, WholeDrive
    from tribodyn.cases.heat_part import GearboxHeat
    from tribodyn.cases.loss_part import GearboxLosses
    from tribodyn.exchange.format import GearboxInTime
    from tribodyn.input.quantity import Table
    from tribodyn.post.figures.drawing import Drawing, SweepDrawing
    from tribodyn.quantities.quantity import Quantity, Reported
    from tribodyn.record.reader import Record
    from tribodyn.studies.protocol.batch import Batch
    from tribodyn.studies.protocol.verb import Verb

#: Part -> the modules in which what it holds may stand, too.
_ALSO_IN = {
    "rules": ("scenario",),
    "check": ("run",),
    "estimate": ("case", "scenario"),
    "losses": ("losses.part",),
    "heat": ("heat.part",),
    "placed_parts": ("drivetrain.placed_parts",),
    "in_time": ("drivetrain.in_time",),
    "sweep_figures": ("figures",),
    "page": ("figures",),
}


@dataclass(frozen=True)
class Study:
    """A kind of study: what it is, and where its parts are.

    The parts are modules of its package, or attributes of the package itself, imported on first use. What a
    part holds may also stand in the module in brackets.

    ============= =================================================================================
    part          what it holds
    ============= =================================================================================
    scenario      ``Scenario``, the schema of a file; ``table_for(data)``, that of a file with these data
                  (optional); ``case_of(scenario, toml, sha256)``, its case, a `CaseHead` and more
    rules         ``broken_rules(scenario)``, errors for the rules that tie keys together (optional; scenario)
    check         ``check(case) -> CheckResult``; raises InputError where the case cannot be run (run)
    run           ``run(case, output, *, force, progress) -> RunResult``, see `run`; ``quantities_of(case)
                  -> dict``, those of a case without a record (optional: to be swept)
    report        ``REPORTED``, heading -> quantities of the summary; ``sentences(record)``, how far it is
                  to be trusted; optional ``verdict(record)``, what a reader asks first (else that of gears);
                  ``SWEPT``, quantities that a sweep keeps; ``SWEEP_TABLE``, those that it prints; ``SHORT``,
                  short names of quantities; ``PANELS``, datasets that a page shows at first; ``TOP``, what
                  stands at the top of JSON; of a record ``tables`` of its parts, ``maps`` over the face,
                  ``profiles`` at the cursor, ``mechanism``, bodies in motion, ``solid``, bodies in space
    figures       ``DRAWINGS``, its pictures by name; the one called overview is drawn after a run
    sweep_figures ``SWEEP_DRAWINGS``, pictures of its sweeps (optional; figures)
    batch         ``BATCH``, how many cases are evaluated together (optional), see `protocol.batch.Batch`
    estimate      ``estimate(case) -> Estimate``, what a run takes (optional; case or scenario)
    assess        ``ROLE``, its part in an assessment of a drive (optional): `cases.assessment_part`
    assessable    ``WHOLE``, its meshes as pairs, to be assessed (optional): `cases.assessment_part`
    losses        ``LOSSES``, losses at any point of operation (optional; losses.part): `cases.loss_part`
    heat          ``HEAT``, case -> its thermal network, or None (optional; heat.part): `cases.heat_part`
    derivatives   ``DIFFERENTIABLE``, called as `derivatives.differentiable.Differentiable` (its default)
    placed_parts  ``placed_parts(case, tolerance)``, as `drawing.shapes` (optional; drivetrain.placed_parts)
    mounted_gears ``mounted_gears(case)``, by name, to be set beside a measurement (optional)
    in_time       ``in_time(case, drive, load)``, an `exchange.format.GearboxInTime` whose ends have a torque
                  or a speed as input (optional; drivetrain.in_time)
    page          ``page(record) -> str``, the HTML of a page of its own for a record (optional; figures)
    verbs         ``VERBS``, verbs and Python functions (optional), see `protocol.verb`; ``RUN_PROPERTIES``,
                  a class, of ``tribodyn`` too, of what its runs have beside those of a `Run` (optional)
    template      ``template.toml``, or the kind's name, a commented scenario as `protocol.load.filled` takes
                  it; of a study in a single module its attribute ``TEMPLATE``
    ============= =================================================================================

    Parameters
    ----------
    kind : as scenarios name it
    about : what it is, in a line
    package, apart : where its parts are; name of the package in it with those that no other kind shares
    instead : a key, and the kind that a file with this key is of
    quantities : what its records are about; those of studies with the same are compared and drawn together
    compared : headings of its summary that a comparison shows; none: it is not compared in a table
    has_gears, resumes : whether its cases have a pair's `family`, `drive`, `materials`; runs can be resumed
    verb, resolution : verb that runs its scenarios; key of the points of a cycle, as its cases have it
    """

    kind: str
    about: str
    package: str
    quantities: str
    apart: str = ""
    instead: tuple[str, str] = ("", "")
    compared: tuple[str, ...] = ()
    has_gears: bool = False
    resumes: bool = False
    verb: str = "run"
    resolution: str = ""

    def table(self, data: Mapping[str, Any] = MappingProxyType({})) -> "type[Table]":
        """The schema of a scenario file, of one with these data where it depends on them."""
        of_data = self._part("scenario", "table_for", optional=True)
        return of_data({"kind": self.kind, **data}) if of_data else self._part("scenario", "Scenario")

    def broken_rules(self, scenario: Any) -> Iterable[InputError]:
        """Go through the rules that tie keys of a scenario together and that this one breaks."""
        rules = self._part("rules", "broken_rules", optional=True)
        return rules(scenario) if rules else ()

    def case(self, scenario: Any, toml: str, sha256: str) -> Any:
        """Make the case of a scenario that has passed schema and rules."""
        return self._part("scenario", "case_of")(scenario, toml, sha256)

    def template(self) -> str:
        """A commented scenario to begin with, in which TITLE stands for its title."""
        package = import_module(self._packages[0])
        if not hasattr(package, "__path__"):  # one module, which has no folder of its own
            return package.TEMPLATE
        files = resources.files(package)
        own = files.joinpath(f"{self.kind}.toml")
        return (own if own.is_file() else files.joinpath("template.toml")).read_text(encoding="utf-8")

    def estimate(self, case: Any) -> cost.Estimate:
        """What a run of a case takes; nothing, where the study does not say."""
        estimate = self._part("estimate", "estimate", optional=True)
        return estimate(case) if estimate else cost.Estimate()

    def check(self, case: Any, *, allow_large: bool = False) -> CheckResult:
        """Check a case and say what it describes, and what a run takes where that is much, without a run.

        Its data are in SI units, angles in rad. Raises InputError where it cannot be run, or takes more than
        `allow_large` permits.
        """
        estimate = self.estimate(case)
        cost.refuse_large(estimate, allow_large)
        checked = self._part("check", "check")(case)
        from tribodyn.quantities.quantity import in_si

        title = {"title": case.title}
        data = {**title, **in_si(checked.data), **title, "estimate": cost.as_data(estimate)}
        much = cost.share_of_limits(estimate) >= cost.WORTH_SAYING
        said = (f"A run takes about {cost.described(estimate)}.",) if much else ()
        return checked._replace(data=data, remarks=(*checked.remarks, *said))

    def run(
        self,
        case: Any,
        output: str | Path | None = None,
        *,
        force: bool = False,
        progress: Progress | None = None,
        allow_large: bool = False,
        resume: bool = False,
        client: Any = None,
    ) -> RunResult:
        """Run a case, as `protocol.run.run` does; an efficiency that cannot be is withheld."""
        if resume and not self.resumes:
            raise InputError("--resume", None, f"{self.about}: such a run cannot go on", "omit it")
        estimate = self.estimate(case)
        cost.refuse_large(estimate, allow_large)
        cost.say_beforehand(estimate)
        how = {"resume": resume, "client": client} if self.resumes else {}
        try:
            result = self._part("run", "run")(case, output, force=force, progress=progress, **how)
        except KeyboardInterrupt as error:
            if not getattr(error, "__notes__", ()):  # nobody below has anything to keep, or said so before
                nothing = ["nothing is recorded yet, the same call begins anew"]
                for note in getattr(error.__context__, "__notes__", nothing):
                    error.add_note(note)
            raise
        from tribodyn.record.withheld_efficiency import withheld

        return result._replace(summary=withheld(result.summary))

    def quantities_of(self, case: Any) -> dict[str, Any]:
        """Quantities of a case without a record, `swept` among them, as of `run`; raises as a run does."""
        from tribodyn.record.withheld_efficiency import withheld

        return withheld(self._part("run", "quantities_of")(case))

    def drawings(self) -> "Mapping[str, Drawing]":
        """Its pictures by name, in the order `tribodyn plot` draws them."""
        return self._part("figures", "DRAWINGS")

    def reported(self) -> "Reported":
        """Heading -> quantities of the summary's table, in order."""
        return self._part("report", "REPORTED")

    def sentences(self, record: "Record") -> list[str]:
        """Say how far a record is to be trusted, and what its numbers are not."""
        return self._part("report", "sentences")(record)

    def verdict(self, record: "Record") -> list[str]:
        """Say in at most `verdict.LINES` sentences what a record shows, whether it holds, and what to do."""
        from tribodyn.post import verdict

        written = self._part("report", "verdict", optional=True)
        lines = [*verdict.first(record), *(written or verdict.of_gears)(record)]
        return [*lines[: verdict.LINES - 1], *lines[verdict.LINES - 1 :][-1:]]  # what to do is last

    def swept(self) -> "Mapping[str, Quantity]":
        """Quantities that a sweep keeps of every case, by name; none: such a study cannot be swept."""
        return {quantity.name: quantity for quantity in self._part("report", "SWEPT", optional=True) or ()}

    def quantity(self, name: str) -> "Quantity | None":
        """A quantity that its summary or its sweeps have, by name."""
        every = chain(self.swept().values(), *self.reported().values())
        return next((quantity for quantity in every if quantity.name == name), None)

    def short_names(self) -> "Mapping[str, str]":
        """Short names of quantities to their full ones."""
        return self._part("report", "SHORT", optional=True) or {}

    def sweep_table(self) -> "Sequence[Quantity]":
        """Quantities that a sweep prints: the study's own choice, or those of the summary that it keeps."""
        chosen = self._part("report", "SWEEP_TABLE", optional=True)
        reported = {quantity.name for some in self.reported().values() for quantity in some}
        return chosen or [quantity for name, quantity in self.swept().items() if name in reported]

    def sweep_drawings(self) -> "Mapping[str, SweepDrawing]":
        """Pictures of its sweeps by name; the first is drawn where none is named."""
        from tribodyn.post.figures.sweep_response import response_drawings

        drawings = self._part("sweep_figures", "SWEEP_DRAWINGS", optional=True)
        return drawings or response_drawings(self.sweep_table())

    def top(self) -> tuple[str, ...]:
        """Quantities of its summary that stand at the top of what `run --json` prints, too."""
        return self._part("report", "TOP", optional=True) or ()

    def panels(self) -> tuple[str, ...]:
        """Datasets that a page shows at first; none: the first ones."""
        return self._part("report", "PANELS", optional=True) or ()

    def besides(
        self, what: Literal["tables", "maps", "profiles", "mechanism", "solid"], record: "Record"
    ) -> Any:
        """What is shown of a record besides, such as `TextTable`s or a `Mechanism`; or None."""
        part = self._part("report", what, optional=True)
        return part(record) if part else None

    def batch(self) -> "Batch | None":
        """How many cases are evaluated together; None: one after the other, by `quantities_of`."""
        return self._part("batch", "BATCH", optional=True)

    def role(self) -> "Contribution | None":
        """The part that it plays in an assessment of a drive; None: it plays none."""
        return self._part("assess", "ROLE", optional=True)

    def whole(self) -> "WholeDrive | None":
        """Its meshes as pairs of gears at their duty; None: it is not assessed mesh by mesh."""
        return self._part("assessable", "WHOLE", optional=True)

    def losses(self) -> "GearboxLosses | None":
        """What its gearboxes lose at any point of operation; None: its cases are no gearboxes."""
        return self._part("losses", "LOSSES", optional=True)

    def heat(self) -> "Callable[[Any], GearboxHeat | None] | None":
        """What makes the thermal network of one of its cases, or None where that asks for none."""
        return self._part("heat", "HEAT", optional=True)

    def placed_parts(self) -> "Callable[[Any, float], list[Any]] | None":
        """(case, tolerance) -> its gears and shafts in space; None: those of its pair, if it has one."""
        return self._part("placed_parts", "placed_parts", optional=True)

    def mounted_gears(self) -> "Callable[[Any], Mapping[str, Any]] | None":
        """Case -> its gears as a measurement is set beside them; None: their teeth are all alike."""
        return self._part("mounted_gears", "mounted_gears", optional=True)

    def in_time(self) -> "Callable[[Any, str, str], GearboxInTime] | None":
        """(case, what drives, what loads) -> a model to be moved on in time; None: its cases are none."""
        return self._part("in_time", "in_time", optional=True)

    def differentiable(self, case: Any, of: Sequence[str], wrt: Sequence[str]) -> Any:
        """Quantities of a case as a function of its numbers: a `Differentiable`, or what serves as one."""
        from tribodyn.derivatives.differentiable import Differentiable

        differentiable = self._part("derivatives", "DIFFERENTIABLE", optional=True)
        return (differentiable or Differentiable)(case, self.table(), of, wrt)

    def verbs(self) -> "Mapping[str, Verb]":
        """Verbs of the command line that it offers, by name."""
        return self._part("verbs", "VERBS", optional=True) or {}

    def run_properties(self) -> type | None:
        """A class of properties that its runs have in Python beside those of a `Run`; None: no others."""
        return self._part("verbs", "RUN_PROPERTIES", optional=True)

    def own_page(self) -> "Callable[[Record], str] | None":
        """What writes a page of its own for a record; None: it has the page that all studies share."""
        return self._part("page", "page", optional=True)

    def _part(self, part: str, name: str, optional: bool = False) -> Any:
        """What a part of the study holds; None where it is optional and not there.

        Raises InputError if the study is of another package, and that lacks the part or cannot be imported.
        """
        try:
            return self._imported(part, name, optional)
        except Exception as error:
            if self.package.startswith("tribodyn."):
                raise
            package = self.package.partition(".")[0]
            raise cannot_be_loaded("kind", self.kind, package, error) from error

    @property
    def _packages(self) -> tuple[str, ...]:
        """Where its parts are looked for."""
        return (f"{self.package}.{self.apart}", self.package) if self.apart else (self.package,)

    def _imported(self, part: str, name: str, optional: bool) -> Any:
        package = import_module(self.package)
        attribute = getattr(package, name, None)
        if attribute is not None and not ismodule(attribute):  # a part may have the name of what it holds
            return attribute
        places = [f"{of}.{place}" for of in self._packages for place in (part, *_ALSO_IN.get(part, ()))]
        for module in places:
            needed = not optional and module == places[-1]
            try:
                return getattr(import_module(module), name)
            except ModuleNotFoundError as error:
                if needed or not f"{module}.".startswith(f"{error.name}."):
                    raise
            except AttributeError as error:
                if needed or error.name != name:
                    raise
        return None
