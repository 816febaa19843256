"""A planetary set assessed: its meshes by both ways, other speeds at the same torque, limits, bad input."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.planet_sets import ASSESSED_SET
from tests.support.verbs import invoke, sets
from tribodyn.errors import InputError
from tribodyn.record.reader import MESHES, Record
from tribodyn.studies.assessment.train.run import name_at, tasks_of
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.tasks import case_of

SCENARIO = f"""{ASSESSED_SET}[limits]
dynamic_factor = 1.01
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = tmp_path_factory.mktemp("assessed")
    (found / "set.toml").write_text(SCENARIO, encoding="utf-8")
    return found


@pytest.fixture(scope="module")
def assessed(folder: Path) -> dict[str, Any]:
    ended = invoke("assess", "set.toml", "-o", "out", "--json", folder=folder)
    return json.loads(ended)


def test_every_mesh_stands_by_the_standards_and_simulated(assessed: dict[str, Any]):
    """Loss factors: ISO by its sharing, the simulation's by its own, of the same path of contact."""
    meshes = assessed[MESHES]
    assert len(meshes) == 6
    for mesh in meshes.values():
        iso, own = mesh["iso"], mesh["simulated"]
        loss_factor = own["power_friction_mean"] / own["power_in_mean"] / own["friction_coefficient_mean"]
        assert iso["H_v"] == pytest.approx(loss_factor, rel=0.15)
        assert iso["S_lambda"] == pytest.approx(own["S_lambda"], rel=0.35)
        assert ("S_intS" in iso) == ("sun" in mesh["alike"])
        assert mesh["load_factors"]["K_gamma"] == pytest.approx(assessed["mesh_load_factor"])
    for name in ("S_B", "S_lambda"):
        every = [mesh[part][name] for mesh in meshes.values() for part in ("iso", "simulated")]
        assert assessed[name] == pytest.approx(min(every))
        assert assessed["worst_of"][name] in meshes


def test_other_speeds_have_the_same_torques(folder: Path, assessed: dict[str, Any]):
    with Record(folder / "out" / "assessment.h5") as record:
        speeds = record["input_speed"]
    assert speeds == pytest.approx(np.array([0.5, 1.0]) * assessed["input_speed"])
    loads = []
    for name in ("duty", "speed-0.5"):
        with Record(folder / "out" / "assessment-parts" / f"{name}.h5") as run:
            loads.append(np.mean(run["driven_torque"][-60:], axis=0))
    assert loads[1] == pytest.approx(loads[0], rel=5e-3)


def test_a_power_is_held_as_a_torque():
    """At half the speed half the power, whatever the scenario gives."""
    case = load_scenario("wind-turbine-gearbox-assessment", {"assessment.speed_range": [0.5, 0.75]})
    train = case.subject.case
    for (_, task), factor in zip(tasks_of(case)[1:], (0.5, 0.75), strict=True):
        slower = case_of(task)
        assert slower.source.speed == pytest.approx(factor * train.source.speed)
        for own, at_duty in zip(slower.meshes, train.meshes, strict=True):
            assert own.pair.operating.gear_torque == pytest.approx(at_duty.pair.operating.gear_torque)


def test_what_exceeds_a_limit_is_named(assessed: dict[str, Any], folder: Path):
    assert not assessed["limits"]["dynamic_factor"]["kept"]
    assert assessed["limits"]["scuffing_flash"]["kept"]
    page = (folder / "out" / "report.html").read_text(encoding="utf-8")
    assert "Limits not kept: Dynamic factor K_v." in page
    assert "set-ring" in page


def test_application_factors_lower_the_standards_margins_alone(folder: Path, assessed: dict[str, Any]):
    """The runs lie there already; what is given takes the place of the simulation's K_γ."""
    more = sets({"assessment.application_factor": 1.5, "assessment.mesh_load_factor": 1.2})
    more += sets(
        {"assessment.face_load_factors.set-ring": 1.3, "assessment.face_load_factors.set-ring-2": 1.4}
    )
    parts = sorted((folder / "out" / "assessment-parts").glob("*.h5"))
    made = [path.stat().st_mtime_ns for path in parts]
    harder = json.loads(invoke("assess", "set.toml", "-o", "out", "--force", "--json", *more, folder=folder))
    assert made
    assert [path.stat().st_mtime_ns for path in parts] == made
    for name, mesh in assessed[MESHES].items():
        after = harder[MESHES][name]
        assert after["simulated"] == mesh["simulated"]
        assert after["load_factors"]["K_gamma"] == 1.2
        face = 1.3 if name.startswith("set-ring") else 1.0
        assert after["load_factors"]["K_Hbeta"] == (1.4 if name == "set-ring-2" else face)
        assert after["iso"]["S_B"] < mesh["iso"]["S_B"]


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"scenario": "crc-23-47"}, "scenario.kind"),
        ({"scenario": "no-such-gearbox"}, "scenario"),
        ({"scenario.operating.input_speed": "fast"}, "scenario.operating.input_speed"),
        ({"scenario.lubricant": "liu-ni-2022"}, "scenario.lubricant.viscosity_40"),
        ({"assessment.speed_range": [1.2, 0.5]}, "assessment.speed_range"),
        ({"assessment.friction_laws": ["glue"]}, "assessment.friction_laws"),
        ({"assessment.speeds": -1}, "assessment.speeds"),
        ({"assessment.face_load_factors": {"set-sum": 1.2}}, "assessment.face_load_factors.set-sum"),
    ],
)
def test_bad_input_is_one_message(changes: dict[str, Any], key: str, tmp_path: Path):
    (tmp_path / "set.toml").write_text(SCENARIO, encoding="utf-8")
    with pytest.raises(InputError) as error:
        load_scenario(tmp_path / "set.toml", changes)
    assert key in str(error.value)
    assert error.value.remedy


def test_runs_at_speeds_that_are_near_have_names_of_their_own():
    assert name_at(1.0015) != name_at(1.002)
    assert name_at(0.5) == "speed-0.5"
