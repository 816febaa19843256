"""Trains of every sort: with a loop, as a drive file, bare, with bodies and loads beside the gears."""

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w

from tests.support.train_scenarios import REDUCER, train_case
from tests.support.turning_outlines import assert_teeth_touch
from tribodyn.errors import InputError
from tribodyn.gears.prepare import assembled
from tribodyn.geometry.body import body_masses
from tribodyn.studies.motion.assembly import assemblies, body_inertias, table_numbers
from tribodyn.studies.protocol.load import load_scenario


def split(angle: str | None = None) -> dict[str, Any]:
    """One pinion, two compound shafts above and below, one bull gear."""
    gear = {"face_width": "30 mm"}
    turned = {} if angle is None else {"tooth_angle": angle}
    stage = {"module": "3 mm", "pressure_angle": "20 deg"}
    inward = float(np.arcsin(90.0 * np.sin(np.radians(100.0)) / 166.5))  # half sums of teeth, mm
    return {
        "gear": {
            "pinion": {"teeth": 20, **gear},
            "up-1": {"teeth": 40, **gear},
            "up-2": {"teeth": 21, **gear},
            "down-1": {"teeth": 40, **gear},
            "down-2": {"teeth": 21, **gear, **turned},
            "bull": {"teeth": 90, **gear},
        },
        "stage": [
            {"gears": ["pinion", "up-1"], "azimuth": "100 deg", **stage},
            {"gears": ["pinion", "down-1"], "azimuth": "-100 deg", **stage},
            {"gears": ["up-2", "bull"], "azimuth": f"{-inward!r} rad", **stage},
            {"gears": ["down-2", "bull"], **stage},
        ],
        "shaft": [
            {"name": "up", "gears": ["up-1", "up-2"]},
            {"name": "down", "gears": ["down-1", "down-2"]},
        ],
        "operating": REDUCER["operating"] | {"input": "pinion", "output": "bull"},
    }


def test_a_train_of_two_ways_goes_together_with_the_angle_that_is_said(reduced):
    with pytest.raises(InputError) as caught:
        reduced(**split())
    (error,) = caught.value.errors  # pyright: ignore[reportAttributeAccessIssue]
    assert error.key == "stage.3"
    assert "do not meet" in error.rule
    said = error.remedy.partition('tooth_angle = "')[2].partition('"')[0]
    case = reduced(**split(said))
    assert_teeth_touch(case)
    assert [mesh.driven for mesh in case.meshes] == [1, 2, 3, 3]
    torques = [mesh.pair.operating.gear_torque for mesh in case.meshes]
    assert torques == pytest.approx([1800 * 21 / 90 / 2] * 2 + [900] * 2)
    # both ways are the same pairs, each with one table
    assert table_numbers(case) == (0, 0, 1, 1)


def test_a_drive_is_a_train_of_one_stage(tmp_path: Path):
    """The same pair, oil, bearings and duty as of a gear pair, in the same axes."""
    written = load_scenario("spur-25-51")
    pair, table = written.pair, tomllib.loads(written.toml)
    operating = {
        "input_speed": table["operating"]["pinion_speed"],
        "output_torque": table["operating"]["gear_torque"],
        "oil_temperature": table["operating"]["oil_temperature"],
    }
    kept = {
        name: table[name]
        for name in ("title", "lubricant", "bearings", "drive", "mesh", "friction", "solver")
    }
    path = tmp_path / "train.toml"
    path.write_text(tomli_w.dumps({"kind": "gear-train", **kept, "operating": operating}), encoding="utf-8")
    case = train_case(path)
    (mesh,) = case.meshes
    for name in ("family", "drive", "materials", "masses", "roughness", "mean_roughness", "mesh", "quality"):
        assert getattr(mesh.pair, name) == getattr(pair, name), name
    for name in ("lubricant", "film", "friction"):
        assert getattr(mesh.pair, name) == getattr(pair, name), name
    assert mesh.pair.operating.gear_torque == pytest.approx(pair.operating.gear_torque)
    assert case.solver == written.solver
    assert [body.sense for body in case.bodies] == [-1, 1]
    assert case.bodies[1].centre[0] == pytest.approx(0.0, abs=1e-15)
    assert case.bodies[1].centre[1] > 0.0
    assert [link.stiffness for link in case.links] == [link.stiffness for link in written.links]
    wanted = body_masses(
        assembled(pair), [(one.mass, one.inertia) for one in pair.masses], [m.density for m in pair.materials]
    )
    assert tuple(body[:2] for body in body_inertias(case, assemblies(case))) == wanted


BARE = {
    "gear": {},
    "stage": [],
    "shaft": [],
    "body": [
        {"name": "motor", "mass": "30 kg", "inertia": "0.1 kg*m**2"},
        {"name": "a", "mass": "2 kg", "inertia": "2e-3 kg*m**2"},
        {"name": "b", "mass": "4 kg", "inertia": "8e-3 kg*m**2"},
        {"name": "c", "mass": "3 kg", "inertia": "4e-3 kg*m**2"},
    ],
    "link": [{"ends": ["motor", "a"], "stiffness": "1e4 N*m/rad", "damping": "2 N*m*s/rad"}],
    "mesh": [
        {
            "bodies": bodies,
            "teeth": teeth,
            "module": "3 mm",
            "pressure_angle": "20 deg",
            "face_width": "20 mm",
            "stiffness": "2e8 N/m",
            "damping_ratio": 0.05,
        }
        for bodies, teeth in ((["a", "b"], [20, 40]), (["c", "b"], [30, 40]))
    ],
    "operating": REDUCER["operating"] | {"input": "motor", "output": "c", "output_torque": "90 N*m"},
}


def test_a_bare_model_of_bodies_links_and_meshes(reduced):
    case = reduced(**BARE)
    assert [body.name for body in case.bodies] == ["a", "motor", "b", "c"]
    assert case.source.body == 1
    assert case.source.torque == pytest.approx(60.0)
    assert [(mesh.driver, mesh.driven) for mesh in case.meshes] == [(0, 2), (2, 3)]
    # the teeth of b are one gear, an idler
    assert [gear.name for gear in case.gears] == ["a", "b", "c"]
    assert [mesh.pair.mesh.compliance for mesh in case.meshes] == ["constant"] * 2
    assert [mesh.pair.operating.gear_torque for mesh in case.meshes] == pytest.approx([120.0, 90.0])
    found = body_inertias(case, assemblies(case))
    assert [body[:2] for body in found] == [(2.0, 2e-3), (30.0, 0.1), (4.0, 8e-3), (3.0, 4e-3)]
    spring = case.links[-1]
    assert (spring.ends, spring.stiffness, spring.damping) == ((1, 0), (0.0, 0.0, 1e4), (0.0, 0.0, 2.0))
    assert_teeth_touch(case)


def test_a_flywheel_and_loads_of_several_bodies(reduced):
    body = [{"name": "flywheel", "mass": "20 kg", "inertia": "0.3 kg*m**2"}]
    link = [{"ends": ["flywheel", "wheel-2"], "stiffness": "1e5 N*m/rad"}]
    load = [{"at": "middle", "torque": "30 N*m", "damping": "0.1 N*m*s/rad"}]
    case = reduced(body=body, link=link, load=load)
    assert case.bodies[3].centre == case.bodies[2].centre
    assert [(one.body, one.torque) for one in case.loads] == [(2, 1800.0), (1, 30.0)]
    assert case.source.torque == pytest.approx(1800 * 23 / 171 + 30 / 3)


def test_loads_without_an_output(reduced):
    operating = {key: value for key, value in REDUCER["operating"].items() if "output" not in key}
    load = [{"at": "wheel-2", "torque": "1800 N*m", "inertia": "2 kg*m**2"}]
    case = reduced(operating=operating, load=load)
    assert case.loads == reduced().loads
    assert case.source == reduced().source
    assert case.bodies[2].inertia == 2.0
    motor = {"source": "torque", "drive_inertia": "0.1 kg*m**2", "input_torque": "300 N*m"}
    assert reduced(operating=operating | motor, load=load).source.torque == 300.0
