"""Scenarios of trains, read as `load_scenario` reads them: references, schema, rules, case."""

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import tomli_w
from pydantic import ValidationError

from tribodyn.errors import InputErrors
from tribodyn.scenario.messages import explain
from tribodyn.scenario.resolve import resolve
from tribodyn.studies.gear_train import STUDY
from tribodyn.studies.gear_train.case import Case


def train_case(path: Path, overrides: Mapping[str, Any] | None = None) -> Case:
    """The case of a train's scenario; InputErrors with every mistake."""
    data, origins, errors = resolve(path, overrides or {}, STUDY.table)
    data.setdefault("name", path.stem)
    table = STUDY.table(data)
    try:
        scenario = table.model_validate(data)
    except ValidationError as error:
        raise InputErrors([origins.locate(one) for one in (*errors, *explain(error, table))]) from None
    if errors := [*errors, *STUDY.broken_rules(scenario)]:
        raise InputErrors([origins.locate(one) for one in errors])
    toml = tomli_w.dumps(data)
    return STUDY.case(scenario, toml, hashlib.sha256(toml.encode()).hexdigest())
