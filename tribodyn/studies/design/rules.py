"""Rules that tie several keys of a search together."""

from collections.abc import Iterator
from typing import Any

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.scenario.quantity import Table
from tribodyn.studies import STUDIES, study_of
from tribodyn.studies.design.candidates.sources import BASE, Source
from tribodyn.studies.design.parts import parts_of_design
from tribodyn.studies.protocol.evaluated import evaluated_quantities


def broken_rules(scenario: Any) -> Iterator[InputError]:
    """Go through the rules that such a scenario breaks, those of the scenarios within it included."""
    given = scenario.design.part
    if isinstance(given, dict):
        for name in given:
            rule, remedy = "not a name for a part", "write letters, digits and hyphens, such as efficiency"
            yield InputError("design.part", quoted(name), rule, remedy)
        return
    parts = {name: getattr(given, name) for name in type(given).model_fields} if given is not None else {}
    sources: dict[str, Source] = {}
    clear = True
    for name, place, source in [
        (BASE, "scenario", scenario.scenario),
        *((name, f"design.part.{name}", part) for name, part in parts.items()),
    ]:
        errors = list(_of_scenario(place, source))
        yield from errors
        clear = clear and not any(error.key == f"{place}.kind" for error in errors)
        if clear:
            sources[name] = Source(study_of({"kind": source.kind}), type(source))
    fields = type(scenario.scenario).model_fields if isinstance(scenario.scenario, Table) else {}
    for name in parts:
        if name in fields:
            rule = f"the scenario has a table [{name}]"
            yield InputError("design.part", quoted(name), rule, "choose another name for the part")
    if clear:
        yield from parts_of_design(scenario.design, sources).errors


def _of_scenario(place: str, scenario: Any) -> Iterator[InputError]:
    """Rules of a scenario that is to be evaluated."""
    kind = scenario.get("kind") if isinstance(scenario, dict) else scenario.kind
    if not isinstance(scenario, Table):
        if isinstance(kind, str) and kind not in STUDIES:
            yield unknown_name(f"{place}.kind", kind, STUDIES, STUDIES.what)
            return
        rule = "a search through a search" if kind == "design" else "not a scenario"
        yield InputError(f"{place}.kind", quoted(kind), rule, "name a scenario of another kind")
        return
    study = study_of({"kind": kind})
    if not evaluated_quantities(study):
        rule = f"a {kind} study names no figures that could be sought"
        yield InputError(f"{place}.kind", quoted(kind), rule, "name a scenario of another kind")
        return
    for error in study.broken_rules(scenario):
        yield InputError(f"{place}.{error.key}", error.value, error.rule, error.remedy, error.file)
