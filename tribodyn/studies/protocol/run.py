"""Runs a case of any kind, also under laws that are handed over from Python."""

import hashlib
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import replace
from inspect import isfunction
from pathlib import Path
from typing import Any, cast

import tomli_w

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.input.specific_keys import in_toml
from tribodyn.numerics.registry import FROM_PYTHON
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.study import CaseHead, Progress, RunResult
from tribodyn.train.links.law import LinkLaw
from tribodyn.tribology.closure import with_laws
from tribodyn.tribology.law import FilmData, FilmLaw, FrictionData, FrictionLaw, KeyedLaw
from tribodyn.tribology.wear.law import WearData, WearLaw


def run(
    case: CaseHead,
    output: str | Path | None = None,
    *,
    film: FilmLaw | Callable[..., Any] | None = None,
    friction: FrictionLaw | Callable[..., Any] | None = None,
    wear: WearLaw | Callable[..., Any] | None = None,
    links: Mapping[str, LinkLaw | Callable[..., Any]] | None = None,
    force: bool = False,
    progress: Progress | None = None,
    allow_large: bool = False,
    resume: bool = False,
    client: Any = None,
) -> RunResult:
    """Run a case and write its record.

    Parameters
    ----------
    case
        From `load_scenario`.
    output : path, optional
        Name of the record; default ``<case name>.h5`` in the current folder.
    film : FilmLaw or function, optional
        Takes the place of the scenario's film law.
    friction : FrictionLaw or function, optional
        Takes the place of the scenario's friction law; keys of its own have the values of
        `FrictionLaw.with_values`. The keys ``sliding`` and ``reversal_width`` of the scenario stay.
    wear : WearLaw or function, optional
        Takes the place of the scenario's wear law, in the same way.
    links : LinkLaw or function by name, optional
        Take the places of the laws of a train's links and compliant shafts of these names.
    force : replace an existing record
    progress : callable, optional
        Called with the share done, 0 … 1.
    allow_large : allow runs above `cases.cost.LIMITS`
    resume : go on from what an unfinished run left, where the study can
    client : distributed.Client, optional
        Whose workers evaluate the candidates of a search; default: the cores of this machine.

    Returns
    -------
    RunResult
        `status` is "failed" where the simulation could not go on: the path then is the partial record's.

    Raises
    ------
    InputError
        Before anything is written; also for a law that the case has no place for.
    """
    for due, law in ((FilmLaw, film), (FrictionLaw, friction), (WearLaw, wear)):
        if law is not None:
            case = with_law(case, due, law)
    for name, link_law in (links or {}).items():
        case = with_link_law(case, name, link_law)
    how: dict[str, Any] = {"force": force, "allow_large": allow_large, "resume": resume, "client": client}
    return STUDIES[case.kind].run(case, output, progress=progress, **how)


def with_law(
    case: CaseHead,
    due: type[FilmLaw | FrictionLaw | WearLaw],
    law: FilmLaw | FrictionLaw | WearLaw | Callable[..., Any],
) -> CaseHead:
    """Return the case under a law from Python in place of its own of that type.

    Its scenario, which the record of a run holds, names the law as one from Python: it cannot be loaded
    again. Raises InputError if the case has no such law, or what is given is none.
    """
    table = due.table
    given_law = _from_python(table, law, due)
    old: Any = getattr(case, table, None)
    if not isinstance(old, FilmData | FrictionData | WearData):
        rule = f'a case of kind "{case.kind}" has no {table} law'
        raise InputError(table, quoted(given_law.name.removeprefix(FROM_PYTHON)), rule, "omit it")
    data = tomllib.loads(case.toml)
    data[table] = _naming(data.get(table, {}), given_law, old.values)
    if due is WearLaw:
        return replace(_written(case, data), wear=WearData(given_law))  # pyright: ignore[reportCallIssue]
    laws: dict[str, Any] = {table: given_law}
    changed = cast(Any, _written(case, data))
    return changed.under_laws(**laws) if hasattr(changed, "under_laws") else with_laws(changed, **laws)


def with_link_law(case: CaseHead, name: str, law: LinkLaw | Callable[..., Any]) -> CaseHead:
    """Return the case under a law from Python for the link or compliant shaft of a name; see `with_law`.

    Raises InputError if the case has no such link, or it no torsional stiffness, or what is given is no law.
    """
    given_law = _from_python("links", law, LinkLaw)
    links: tuple[Any, ...] = getattr(case, "links", ())
    place_of = {link.name: place for place, link in enumerate(links) if link.stiffness[-1] > 0.0}
    if name not in place_of:
        if not place_of:
            rule = "this case has no link and no compliant shaft with a torsional stiffness"
            raise InputError(f"links.{name}", None, rule, "omit it, or give one a stiffness")
        raise unknown_name("links", name, place_of, "link or compliant shaft")
    link, data = links[place_of[name]], tomllib.loads(case.toml)
    table, _, number = link.key.partition(".")
    data[table][int(number)] = _naming(data[table][int(number)], given_law, link.values)
    changed = list(links)
    changed[place_of[name]] = replace(link, law=given_law, values={})
    return replace(_written(case, data), links=tuple(changed))  # pyright: ignore[reportCallIssue]


def _from_python(table: str, law: Any, due: type[Any]) -> Any:
    """A law as it was given, or of a function, under a name that no scenario can give."""
    if isfunction(law):
        name = law.__name__.strip("<>").replace("_", "-")
        law = due(name, next(iter((law.__doc__ or "from Python").strip().splitlines())), law)
    if not isinstance(law, due):
        rule, law_name = f"expected a {due.__name__}, got {type(law).__name__}", getattr(law, "name", law)
        raise InputError(table, quoted(law_name), rule, f"give a tribodyn.{due.__name__}, or a function")
    return law if law.name.startswith(FROM_PYTHON) else replace(law, name=FROM_PYTHON + law.name)


def _naming(table: dict[str, Any], law: KeyedLaw, old: Mapping[str, Any]) -> dict[str, Any]:
    """A scenario's table that names a law, without the values of the old one's keys."""
    kept = {key: value for key, value in table.items() if key not in ("law", *old)}
    defaults = {key.name: in_toml(key, key.default) for key in law.keys if key.default is not None}
    return {**kept, "law": law.name, **defaults}


def _written(case: CaseHead, data: dict[str, Any]) -> CaseHead:
    """The case with another text of its scenario."""
    toml = tomli_w.dumps(data)
    return replace(case, toml=toml, sha256=hashlib.sha256(toml.encode()).hexdigest())
