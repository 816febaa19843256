"""The scenario of an assessment: of a pair of gears in its own file, or of the gearbox of a scenario."""

import tomllib
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Annotated, Any, Literal

from pydantic import Field, create_model

from tribodyn.cases.assessment_part import MeshAtDuty
from tribodyn.errors import InputError, quoted
from tribodyn.gears.rating.american import not_by_agma
from tribodyn.gears.rating.capacity import required
from tribodyn.gears.rating.fracture import broken_fracture
from tribodyn.input.fields import ScenarioHead, head_of
from tribodyn.input.quantity import Positive, Table, scenario_file, written
from tribodyn.studies import study_of
from tribodyn.studies.assessment import OF_SCENARIO, STUDY
from tribodyn.studies.assessment.case import AssessmentCase, RatedMesh
from tribodyn.studies.assessment.meshes import meshes_of
from tribodyn.studies.assessment.pair_file import (
    AssessmentLimits,
    AssessmentScenario,
    broken_pair_rules,
    rated_pair,
)
from tribodyn.studies.assessment.settings import (
    TrainRatingTable,
    broken_settings,
    of_mesh,
    without_data_sheet,
)
from tribodyn.studies.assessment.unknowns import OF_PAIR
from tribodyn.studies.protocol.load import broken_rules as rules_broken_by
from tribodyn.studies.protocol.load import load_data, schema_inside


class TrainLimits(AssessmentLimits):
    """What must hold in every mesh: red on the first page where it does not. Judged where given."""

    mesh_load_factor: Positive | None = None


class TrainAssessmentScenario(ScenarioHead):
    """A scenario file of an assessment of the gearbox of a scenario."""

    kind: Literal["train-assessment"]
    scenario: Annotated[dict[str, Any], scenario_file()]
    assessment: TrainRatingTable = written({})
    limits: TrainLimits = written({})


def table_for(data: Mapping[str, Any]) -> type[Table]:
    """Return the schema for data: of a gearbox, where it is opened, by its kind."""
    if data.get("kind") == STUDY.kind and "scenario" not in data:
        return AssessmentScenario
    inside = schema_inside(data.get("scenario"), OF_SCENARIO.kind)
    return _around(inside, data.get("kind") == STUDY.kind)


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


def case_of(scenario: Any, toml: str, sha256: str) -> AssessmentCase:
    """Return the case of a scenario that has passed schema and rules."""
    head: dict[str, Any] = head_of(scenario, toml, sha256)
    settings = scenario.assessment
    limits = scenario.limits.model_dump() | required(settings)
    if isinstance(scenario, AssessmentScenario):
        pair = rated_pair(scenario, toml, sha256)
        return AssessmentCase(**head, settings=settings, limits=limits, own=pair, rated=_own_mesh)
    train = tomllib.loads(toml)["scenario"]
    subject = load_data(train, str(train.get("name") or "train"))
    head["kind"] = OF_SCENARIO.kind
    case = AssessmentCase(**head, settings=settings, limits=limits, subject=subject, rated=meshes_of)
    names = [mesh.name for mesh in case.whole.meshes(subject.case)] if subject.study.whole() else []
    for name, factor in settings.face_load_factors.items():
        if not any(of_mesh(name, mesh) for mesh in names):
            key, rule = (
                f"assessment.face_load_factors.{name}",
                "is no mesh, and no mesh's name begins with it",
            )
            raise InputError(key, factor, rule, f"the meshes: {', '.join(names)}")
    if scenario.limits.flank_fracture is not None:
        least, rated = limits["flank_fracture"], [mesh.rated for mesh in case.meshes.values()]
        lacking = [
            list(broken_fracture(least, pair.materials, ring=pair.drive.gear.teeth < 0.0)) for pair in rated
        ]
        if lacking and all(lacking):
            raise lacking[0][0]
    if settings.standard == "agma":
        refused = [not_by_agma(mesh.rated) for mesh in case.meshes.values()]
        if refused and all(refused):
            raise refused[0][0]
    return case


def _own_mesh(case: AssessmentCase) -> dict[str, RatedMesh]:
    """The only mesh of a pair of gears."""
    pair = case.pair
    return {"": RatedMesh(MeshAtDuty("", pair, distance=OF_PAIR), pair, pair)}


def broken_rules(scenario: Any) -> Iterator[InputError]:
    """Go through the rules that the scenario breaks."""
    if isinstance(scenario, AssessmentScenario):
        yield from broken_pair_rules(scenario)
        return
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
