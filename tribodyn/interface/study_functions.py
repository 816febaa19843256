"""Python functions that studies offer beside those of this package, found through the registry."""

import inspect
from collections.abc import Callable, Mapping
from functools import cache, wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tribodyn.interface.arguments import checked
from tribodyn.interface.result import Run
from tribodyn.interface.run import recorded, run_class
from tribodyn.interface.scenario import Source, in_python, in_toml, scenario
from tribodyn.post.progress import progress_of
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.study import Progress

if TYPE_CHECKING:
    from tribodyn.studies.protocol.verb import Finding, Verb


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
    return in_python()(checked(function))
