"""Rules that tie several keys of a search together."""

from collections.abc import Iterator
from typing import Any

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.scenario.quantity import Table
from tribodyn.studies import STUDIES, study_of
from tribodyn.studies.design.parts import parts_of_design
from tribodyn.studies.evaluated import figure_units


def broken_rules(scenario: Any) -> Iterator[InputError]:
    """Go through the rules that such a scenario breaks, those of its base scenario included."""
    base = scenario.scenario
    kind = base.get("kind") if isinstance(base, dict) else base.kind
    if not isinstance(base, Table):
        if isinstance(kind, str) and kind not in STUDIES:
            yield unknown_name("scenario.kind", kind, STUDIES, STUDIES.what)
            return
        rule = "a search through a search" if kind == "design" else "not a scenario"
        yield InputError("scenario.kind", quoted(kind), rule, "name a scenario of another kind")
        return
    study = study_of({"kind": kind})
    if not figure_units(study):
        rule = f"a {kind} study names no figures that could be sought"
        yield InputError("scenario.kind", quoted(kind), rule, "name a scenario of another kind")
        return
    for error in study.broken_rules(base):
        yield InputError(f"scenario.{error.key}", error.value, error.rule, error.remedy, error.file)
    yield from parts_of_design(scenario.design, type(base), {"kind": kind}).errors
