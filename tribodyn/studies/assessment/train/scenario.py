"""The tables of a scenario of ``kind = "train-assessment"``."""

import tomllib
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Annotated, Any, Literal

from pydantic import Field, create_model

from tribodyn.errors import InputError, quoted
from tribodyn.gears.rating.capacity import required
from tribodyn.gears.rating.limits import OilLimits
from tribodyn.input.fields import ScenarioHead, head_of
from tribodyn.input.quantity import Positive, Table, scenario_file, written
from tribodyn.studies import study_of
from tribodyn.studies.assessment.settings import broken_settings, without_data_sheet
from tribodyn.studies.assessment.train.case import TrainAssessmentCase, TrainRatingTable, of_mesh
from tribodyn.studies.protocol.load import broken_rules as rules_broken_by
from tribodyn.studies.protocol.load import load_data, schema_inside

#: The kind, and what a file may write for it.
KIND, SHORT = "train-assessment", "assessment"


class TrainLimits(OilLimits):
    """What must hold in every mesh: red on the first page where it does not. Judged where given."""

    mesh_load_factor: Positive | None = None


class TrainAssessmentScenario(ScenarioHead):
    """A scenario file of an assessment of a train."""

    kind: Literal["train-assessment"]
    scenario: Annotated[dict[str, Any], scenario_file()]
    assessment: TrainRatingTable = written({})
    limits: TrainLimits = written({})


Scenario = TrainAssessmentScenario


def table_for(data: Mapping[str, Any]) -> type[Table]:
    """Return the schema for data whose train, where it is opened, is of a known kind."""
    return _around(schema_inside(data.get("scenario"), KIND), data.get("kind") == SHORT)


@lru_cache(maxsize=16)
def _around(base: type[Table] | None, short: bool) -> type[Table]:
    if short:
        kind: Any = (Literal["assessment"], Field())
        named = create_model("TrainAssessmentScenario", __base__=_around(base, False), kind=kind)
        named.__doc__ = TrainAssessmentScenario.__doc__
        return named
    if base is None:
        return TrainAssessmentScenario
    field: Any = (Annotated[base, scenario_file()], ...)
    return create_model(
        "TrainAssessmentScenario",
        __base__=TrainAssessmentScenario,
        __doc__=TrainAssessmentScenario.__doc__,
        scenario=field,
    )


def case_of(scenario: Scenario, toml: str, sha256: str) -> TrainAssessmentCase:
    """Return the case of a scenario that has passed schema and rules."""
    train = tomllib.loads(toml)["scenario"]
    subject = load_data(train, str(train.get("name") or "train"))
    whole = subject.study.whole()
    names = [mesh.name for mesh in whole.meshes(subject.case)] if whole else []
    for name, factor in scenario.assessment.face_load_factors.items():
        if not any(of_mesh(name, mesh) for mesh in names):
            key, rule = (
                f"assessment.face_load_factors.{name}",
                "is no mesh, and no mesh's name begins with it",
            )
            raise InputError(key, factor, rule, f"the meshes: {', '.join(names)}")
    return TrainAssessmentCase(
        **{**head_of(scenario, toml, sha256), "kind": KIND},
        subject=subject,
        settings=scenario.assessment,
        limits=scenario.limits.model_dump() | required(scenario.assessment),
    )


def broken_rules(scenario: Any) -> Iterator[InputError]:
    """Go through the rules that the scenario breaks."""
    inner, settings = scenario.scenario, scenario.assessment
    yield from _of_subject(inner)
    damping = getattr(getattr(inner, "mesh", None), "damping_ratio", None)
    yield from broken_settings(settings, damping, "scenario.mesh.damping_ratio")


def _of_subject(inner: Any) -> Iterator[InputError]:
    opened = isinstance(inner, Table)
    kind = inner.kind if opened else inner.get("kind")  # pyright: ignore[reportAttributeAccessIssue]
    study = study_of({"kind": kind})
    if not opened or study.whole() is None:
        rule = "is no train: it has no meshes that could be assessed one by one"
        remedy = 'name a scenario of a train; of a pair of gears write kind = "assessment"'
        yield InputError("scenario.kind", quoted(kind), rule, remedy)
        return
    for error in rules_broken_by(study, inner):
        yield InputError(f"scenario.{error.key}", error.value, error.rule, error.remedy, error.file)
    train: Any = inner
    if train.lubricant.viscosity_40 is None:
        yield without_data_sheet("scenario.lubricant")
    elif train.operating.oil_temperature is None:
        rule = "missing: margins are those of an oil that enters at a temperature"
        yield InputError(
            "scenario.operating.oil_temperature", rule=rule, remedy='add oil_temperature = "60 degC"'
        )
