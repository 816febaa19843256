"""Scenarios of trains, read as `load_scenario` reads them: references, schema, rules, case."""

import hashlib
import json
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import tomli_w
from pydantic import ValidationError

from tribodyn.errors import InputErrors
from tribodyn.input.messages import explain
from tribodyn.input.resolve import resolve, resolve_table, unresolved_keys
from tribodyn.input.sources import find_scenario
from tribodyn.studies.motion import TRAIN as STUDY
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import loaded_from, table_of


def train_case(path: Path, overrides: Mapping[str, Any] | None = None) -> Gearbox:
    """The case of a train's scenario; InputErrors with every mistake."""
    data, origins, errors = resolve(path, overrides or {}, STUDY.table)
    data.setdefault("name", path.stem)
    table = STUDY.table(data)
    try:
        scenario = table.model_validate(data)
    except ValidationError as error:
        known = unresolved_keys(errors)
        found = [one for one in explain(error, table) if one.key not in known]
        raise InputErrors([origins.locate(one) for one in (*errors, *found)]) from None
    if errors := errors or [*STUDY.broken_rules(scenario)]:
        raise InputErrors([origins.locate(one) for one in errors])
    toml = tomli_w.dumps(data)
    return STUDY.case(scenario, toml, hashlib.sha256(toml.encode()).hexdigest())


def case_of_table(written: Mapping[str, Any], overrides: Mapping[str, Any] | None = None) -> Gearbox:
    """The case of a scenario that is written here; what it names is looked for among the shipped."""
    path = Path("train.toml")
    return loaded_from(resolve_table(dict(written), path, overrides or {}, table_of), path).case


@lru_cache(maxsize=32)
def _prepared(name: str, overrides: str) -> PreparedGearbox:
    return prepare(train_case(find_scenario(name), json.loads(overrides)))


def prepared_train(name: str, **overrides: Any) -> PreparedGearbox:
    """A shipped train with overrides made ready, once for all that ask for it."""
    return _prepared(name, json.dumps(overrides, sort_keys=True))


def _gear(teeth: int, width: str, shift: float) -> dict[str, Any]:
    return {"teeth": teeth, "face_width": width, "profile_shift": shift}


def _stage(one: str, two: str, module: str, azimuth: str) -> dict[str, Any]:
    return {"gears": [one, two], "module": module, "pressure_angle": "20 deg", "azimuth": azimuth}


#: A two-stage reducer as TOML has it.
REDUCER: dict[str, Any] = {
    "title": "A reducer",
    "kind": "gear-train",
    "lubricant": "iso-vg-220-mineral",
    "material": "18CrNiMo7-6",
    "mean_roughness": "0.6 um",
    "gear": {
        "pinion-1": _gear(23, "42 mm", 0.25),
        "wheel-1": _gear(69, "40 mm", -0.1),
        "pinion-2": _gear(23, "62 mm", 0.25),
        "wheel-2": _gear(57, "60 mm", 0.1),
    },
    "stage": [
        _stage("pinion-1", "wheel-1", "3 mm", "0 deg"),
        _stage("pinion-2", "wheel-2", "4 mm", "30 deg"),
    ],
    "shaft": [{"name": "middle", "gears": ["wheel-1", "pinion-2"]}],
    "operating": {
        "input": "pinion-1",
        "output": "wheel-2",
        "input_speed": "1480 rpm",
        "output_torque": "1800 N*m",
        "oil_temperature": "70 degC",
    },
    "mesh": {"compliance": "energy", "damping_ratio": 0.05},
    "friction": {"law": "none"},
}
