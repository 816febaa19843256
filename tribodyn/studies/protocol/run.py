"""Runs a case of any kind, also under laws that are handed over from Python."""

import hashlib
import tomllib
from collections.abc import Callable
from dataclasses import replace
from inspect import isfunction
from pathlib import Path
from typing import Any, cast

import tomli_w

from tribodyn.errors import InputError, quoted
from tribodyn.numerics.registry import FROM_PYTHON
from tribodyn.scenario.own_keys import in_toml
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.study import CaseHead, Progress, RunResult
from tribodyn.tribology.closure import with_laws
from tribodyn.tribology.law import FilmData, FilmLaw, FrictionData, FrictionLaw


def run(
    case: CaseHead,
    output: str | Path | None = None,
    *,
    film: FilmLaw | Callable[..., Any] | None = None,
    friction: FrictionLaw | Callable[..., Any] | None = None,
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
    force : replace an existing record
    progress : callable, optional
        Called with the share done, 0 … 1.
    allow_large : allow runs above `protocol.cost.LIMITS`
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
    for table, law in (("film", film), ("friction", friction)):
        if law is not None:
            case = with_law(case, table, law)
    how: dict[str, Any] = {"force": force, "allow_large": allow_large, "resume": resume, "client": client}
    return STUDIES[case.kind].run(case, output, progress=progress, **how)


def with_law(case: CaseHead, table: str, law: FilmLaw | FrictionLaw | Callable[..., Any]) -> CaseHead:
    """Return the case under a law from Python in place of its law in `table`, "film" or "friction".

    Its scenario, which the record of a run holds, names the law as one from Python: it cannot be loaded
    again. Raises InputError if the case has no such law, or what is given is none.
    """
    due = FilmLaw if table == "film" else FrictionLaw
    if isfunction(law):
        name = law.__name__.strip("<>").replace("_", "-")
        law = due(name, next(iter((law.__doc__ or "from Python").strip().splitlines())), law)
    if not isinstance(law, due):
        rule = f"expected a {due.__name__}, got {type(law).__name__}"
        raise InputError(
            table, quoted(getattr(law, "name", law)), rule, f"give a tribodyn.{due.__name__}, or a function"
        )
    old: Any = getattr(case, table, None)
    if not isinstance(old, FilmData | FrictionData):
        rule = f'a case of kind "{case.kind}" has no {table} law'
        raise InputError(table, quoted(law.name), rule, "omit it")
    if not law.name.startswith(FROM_PYTHON):
        law = replace(law, name=FROM_PYTHON + law.name)
    data = tomllib.loads(case.toml)
    kept = {key: value for key, value in data.get(table, {}).items() if key not in ("law", *old.values)}
    own = {key.name: in_toml(key, key.default) for key in law.keys if key.default is not None}
    data[table] = {**kept, "law": law.name, **own}
    toml = tomli_w.dumps(data)
    named = replace(case, toml=toml, sha256=hashlib.sha256(toml.encode()).hexdigest())
    laws: dict[str, Any] = {table: law}
    return with_laws(cast(Any, named), **laws)
