"""Runs from Python: a scenario in, a `Run` out; and the functions that studies offer beside these."""

import inspect
import shutil
import tempfile
from collections.abc import Callable, Mapping
from functools import cache, wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tribodyn.input.sources import find_scenario
from tribodyn.interface.result import Run
from tribodyn.interface.scenario import Source, in_toml, public, resolved, scenario
from tribodyn.post.progress import progress_of
from tribodyn.record.reader import Record
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import every_from
from tribodyn.studies.protocol.run import run as run_case
from tribodyn.studies.protocol.study import CaseHead, Progress

if TYPE_CHECKING:
    from tribodyn.studies.protocol.verb import Finding, Verb
    from tribodyn.train.links.law import LinkLaw
    from tribodyn.tribology.law import FilmLaw, FrictionLaw
    from tribodyn.tribology.wear.law import WearLaw


@public
def run(
    source: Source,
    overrides: Mapping[str, Any] | None = None,
    *,
    output: str | Path | None = None,
    force: bool = False,
    film: "FilmLaw | Callable[..., Any] | None" = None,
    friction: "FrictionLaw | Callable[..., Any] | None" = None,
    wear: "WearLaw | Callable[..., Any] | None" = None,
    links: "Mapping[str, LinkLaw | Callable[..., Any]] | None" = None,
    progress: Progress | bool | None = None,
    allow_large: bool = False,
    resume: bool = False,
) -> Run:
    """Run a scenario.

    Parameters
    ----------
    source, overrides
        As `scenario` takes them.
    output : path, optional
        Keep the record in this file; default: in a temporary folder, as long as the result is in use.
    force : bool
        Replace a record of that name.
    film, friction, wear : FilmLaw, FrictionLaw, WearLaw or function, optional
        Take the place of the scenario's laws.
    links : LinkLaw or function by name, optional
        Take the places of the laws of a train's links and compliant shafts of these names.
    progress : callable or bool, optional
        Called with the share done, 0 … 1; default: a bar on a terminal or in a notebook; False: none.
    allow_large : bool
        Allow runs above the resource limits (memory, disk, time).
    resume : bool
        Go on from what an earlier run left in `output`, where the kind of study can.

    Returns
    -------
    Run
        Its `status` is "failed", and `message` says why, where the simulation could not go on; what was
        computed until then is there.

    Raises
    ------
    InputError
        Before anything is computed.
    OutputError
        If the record cannot be written.
    """
    return recorded(
        scenario(source, overrides),
        output,
        progress,
        film=film,
        friction=friction,
        wear=wear,
        links=links,
        force=force,
        allow_large=allow_large,
        resume=resume,
    )


@public
def run_meshes(
    source: Source,
    overrides: Mapping[str, Any] | None = None,
    *,
    output: str | Path | None = None,
    force: bool = False,
    progress: Progress | bool | None = None,
    allow_large: bool = False,
) -> dict[str, Run]:
    """Run a study of a pair of gears for every mesh of a gearbox: of ``[gearbox]`` without ``mesh``.

    Parameters
    ----------
    source, overrides
        As `scenario` takes them.
    output : path, optional
        Folder of the records, each named after the scenario and its mesh; default: temporary ones.
    force, progress, allow_large
        As of `run`.

    Returns
    -------
    dict
        A `Run` by the name of the mesh. Meshes that differ by their planet alone are there once, by the name
        that they share (``"set-sun"``); those with a ring only where the kind of study knows internal gears.
        Of any other scenario its only run, by its name.

    Raises
    ------
    InputError
        Before anything is computed, for what is wrong with the case of any mesh.
    OutputError
        If a record cannot be written.
    """
    how: dict[str, Any] = {"force": force, "progress": progress, "allow_large": allow_large}
    found: dict[str, Run] = {}
    for mesh, loaded in every_from(*resolved(source, overrides)).cases.items():
        name = loaded.case.name
        record = None if output is None else Path(output) / f"{name}.h5"
        found[mesh or name] = recorded(loaded.case, record, **how)
    return found


def recorded(
    case: CaseHead, output: str | Path | None, progress: Progress | bool | None = None, **how: Any
) -> Run:
    """Run a case into a file, or into a temporary folder that is removed with the result."""
    with progress_of(progress, case.name) as report:
        how["progress"] = report
        if output is not None:
            return open_run(run_case(case, output, **how).path)
        folder = tempfile.mkdtemp(prefix="tribodyn-")
        try:
            return open_run(run_case(case, Path(folder) / f"{case.name}.h5", **how).path, folder)
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise


def open_run(path: Path, folder: str | None = None) -> Run:
    """Open a record as a `Run`, with the properties that its study gives its runs."""
    with Record(path) as record:
        return run_class(record.kind)(path, folder)


@cache
def run_class(kind: str) -> type[Run]:
    """The class of the runs of a kind of study."""
    base = STUDIES[kind].run_properties() if kind in STUDIES else None
    if base is None:
        return Run
    return type(base.__name__, (base, Run), {"__doc__": base.__doc__, "__module__": base.__module__})


@public
def check(source: Source, overrides: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Check a scenario and compute what needs no run: the data of ``tribodyn check --json``.

    Parameters
    ----------
    source : str, Path, mapping or case
        As `td.run` takes it.
    overrides : mapping, optional
        Dotted key to value: ``{"operating.gear_torque": "600 N*m"}``.

    Returns
    -------
    dict
        ``scenario``, its file or, of what comes from none, its name; ``title``; by the kind of study
        ``geometry``, ``lubricant``, ``laws``, of an assessment ``iso``, every factor of ISO 6336. All numbers
        are in SI units and angles in rad; a number with a unit is a pair of both.

    Raises
    ------
    InputError
        Anything that is wrong with the scenario, or for which its case cannot be run.
    """
    case = scenario(source, overrides)
    where = str(find_scenario(str(source))) if isinstance(source, (str, Path)) else case.name
    return {"scenario": where, **STUDIES[case.kind].check(case, allow_large=True).data}


@cache
def offered(name: str) -> Any:
    """The function of a study's verb, or the class of a study's runs, by its name; None: there is none."""
    for kind, verbs in STUDIES.each(lambda study: study.verbs()):
        for verb_name, verb in verbs.items():
            if name in (verb_name.replace("-", "_"), verb.alias):
                return _function(verb)
        if verbs and run_class(kind).__name__ == name:
            return run_class(kind)
    return None


def _function(verb: "Verb") -> Callable[..., Any]:
    """The verb's function, which takes a scenario as `run` does, and gives a run or an answer."""

    def run(
        *values: Any,
        output: str | Path | None = None,
        force: bool = False,
        resume: bool = False,
        progress: Progress | bool | None = None,
        allow_large: bool = False,
        client: Any = None,
        **keys: Any,
    ) -> Run:
        loaded = verb.function(*map(in_toml, values), **{key: in_toml(value) for key, value in keys.items()})
        how = {"force": force, "resume": resume, "allow_large": allow_large}
        return recorded(loaded.case, output, progress=progress, client=client, **how)

    def answer(
        source: Source,
        overrides: Mapping[str, Any] | None = None,
        *,
        progress: Progress | bool | None = None,
        **options: Any,
    ) -> "Finding":
        case = scenario(source, overrides)
        with progress_of(progress, case.name) as report:
            return verb.function(case, progress=report, **options)

    function = wraps(verb.function)(answer if verb.answers else run)
    parameters = list(inspect.signature(verb.function).parameters.values())
    for place, parameter in enumerate(parameters):
        if hasattr(parameter.annotation, "__metadata__"):  # what the command line reads is left out
            parameters[place] = parameter.replace(annotation=parameter.annotation.__origin__)
    any_number = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    mine = inspect.signature(function, follow_wrapped=False).parameters.values()
    added = [parameter for parameter in mine if parameter.kind not in any_number]
    names = {parameter.name for parameter in added}
    rest = [parameter for parameter in parameters[1:] if parameter.name not in names]
    shown = [*added, *rest] if verb.answers else [*parameters, *added]
    vars(function)["__signature__"] = inspect.Signature(sorted(shown, key=lambda parameter: parameter.kind))
    return public(function)
