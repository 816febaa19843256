"""A case of an assessment of a train: the train, what the standards need to know, and what is recorded."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import Field

from tribodyn.cases import cost
from tribodyn.cases.assessment_part import WholeDrive
from tribodyn.gears.rating.settings import AtLeastOne
from tribodyn.input.quantity import Text
from tribodyn.numerics.parameter import Variable
from tribodyn.record.schema import Layout
from tribodyn.studies.assessment.settings import AssessedTable
from tribodyn.studies.protocol.load import Loaded
from tribodyn.studies.protocol.study import CaseHead

SPEED = Variable(("input_speed",), "rad/s", "speed of the input, increasing; that of the duty is one of them")

_ALONG = ("input_speed",)
SAMPLES: dict[str, Variable] = {
    "dynamic_factor": Variable(_ALONG, "1", "largest dynamic factor of all meshes"),
    "mesh_load_factor": Variable(_ALONG, "1", "largest mesh load factor K_gamma of all planetary stages"),
    "contact_loss_fraction": Variable(_ALONG, "1", "largest share of the time without contact of all meshes"),
    "efficiency": Variable(_ALONG, "1", "mean power out over mean power in"),
    "power_friction_mean": Variable(_ALONG, "W", "mean power of tooth friction in all meshes"),
    "hertz_pressure_max": Variable(_ALONG, "Pa", "largest Hertz pressure of all meshes"),
    "film_parameter_min": Variable(_ALONG, "1", "smallest film over roughness of all meshes"),
}

LAYOUT = Layout(SPEED, SAMPLES)


def of_mesh(name: str, mesh: str) -> bool:
    """Whether a name is that of a mesh, or of several: theirs go on after a hyphen."""
    return mesh == name or mesh.startswith(f"{name}-")


class TrainRatingTable(AssessedTable):
    """What is asked beyond the duty, and what the standards need to know of every mesh."""

    face_load_factors: dict[Text, AtLeastOne] = Field({})

    def face_of(self, mesh: str) -> float | None:
        """K_Hβ of a mesh: by the longest name that it has or begins with, else that of all, where given."""
        matching = [name for name in self.face_load_factors if of_mesh(name, mesh)]
        return self.face_load_factors[max(matching, key=len)] if matching else self.face_load_factor


@dataclass(frozen=True, kw_only=True)
class TrainAssessmentCase(CaseHead):
    """One assessment, complete."""

    subject: Loaded  # the train's scenario
    settings: TrainRatingTable
    limits: Mapping[str, Any]  # name of a limit -> its value, SI units

    @property
    def whole(self) -> WholeDrive:
        """What the train's study says of its meshes."""
        whole = self.subject.study.whole()
        assert whole is not None, "refused by the rules"
        return whole


def estimate(case: TrainAssessmentCase) -> cost.Estimate:
    """What a run of a case takes: that of the train by every friction law, and steady states."""
    settings = case.settings
    runs = 1 + len(settings.friction_laws)
    one = case.subject.study.estimate(case.subject.case)
    meshes = len(case.whole.meshes(case.subject.case))
    steady = cost.steady_states(float(meshes * settings.speeds), 0.0, float(meshes * settings.samples))
    drivers = (
        cost.CostKey("assessment.speeds", settings.speeds, 46),
        cost.CostKey("assessment.samples", settings.samples, 16),
    )
    return one._replace(
        memory=one.memory + steady.memory,
        record=runs * one.record,
        seconds=runs * one.seconds + steady.seconds,
        drivers=(*one.drivers, *drivers),
    )
