"""Studies of a pair of gears take a mesh of a train, with the duty that the train gives it."""

import tomllib
from pathlib import Path
from typing import Any

import pytest
import tomli_w

import tribodyn as td
from tribodyn.errors import InputError
from tribodyn.input.sources import find_scenario
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import load, load_data, load_scenario
from tribodyn.studies.protocol.run import run

SECOND = {"scenario": "two-stage-reducer", "mesh": "second"}
#: What a kind needs besides.
FURTHER: dict[str, dict[str, Any]] = {
    "wear": {"wear": {"law": "archard", "revolutions": 1e5, "coefficient": "1e-18 m**2/N"}},
    "assessment": {"drive": {"quality": 6}},
}
WITH_GEARS = [
    kind for kind in STUDIES if STUDIES[kind].package.startswith("tribodyn") and STUDIES[kind].has_gears
]


@pytest.mark.parametrize("kind", WITH_GEARS)
def test_every_study_of_gears_takes_a_mesh(kind: str):
    """Gears, speed and torque are the mesh's."""
    data = {"title": "x", "kind": kind, "gearbox": SECOND} | FURTHER.get(kind, {})
    found = load_data(data, "x").case
    mesh = next(mesh for mesh in load_scenario("two-stage-reducer").meshes if mesh.name == "second")
    assert found.drive == mesh.pair.drive
    assert found.operating.pinion_speed == pytest.approx(mesh.pair.operating.pinion_speed, rel=1e-12)
    assert found.operating.gear_torque == pytest.approx(mesh.pair.operating.gear_torque, rel=1e-12)
    again = load_data(tomllib.loads(found.toml), "again").case
    assert again.drive == found.drive


def test_the_mesh_of_the_gearbox_comes_before_the_defaults_of_the_study(tmp_path: Path):
    """Stiffness, of the stage before the train's, and law of friction; what a study says itself holds."""
    table = tomllib.loads(find_scenario("two-stage-reducer").read_text(encoding="utf-8"))
    table["mesh"] = {"compliance": "constant", "stiffness": "4e8 N/m", "damping_ratio": 0.05}
    table["friction"] = {"law": "coulomb", "coefficient": 0.07}
    table["stage"][1]["stiffness"] = "5e8 N/m"
    file = tmp_path / "train.toml"
    file.write_text(tomli_w.dumps(table), encoding="utf-8")
    for mesh, stiffness in ("first", 4e8), ("second", 5e8):
        data = {"title": "x", "kind": "efficiency", "gearbox": {"scenario": str(file), "mesh": mesh}}
        found = load_data(data, "x").case
        assert (found.mesh.compliance, found.mesh.stiffness) == ("constant", stiffness)
        assert (found.friction.law, found.friction.values) == ("coulomb", {"coefficient": 0.07})
    own = {"mesh": {"compliance": "constant", "stiffness": "3e8 N/m"}}
    assert load_data({**data, **own}, "x").case.mesh.stiffness == 3e8


def test_losses_of_a_mesh_are_those_of_the_train_in_motion(tmp_path: Path):
    """Slow rotation of the pair alone against the mean of the motion of both stages."""
    law = {"friction": {"law": "xu"}}
    alone = load_data({"title": "x", "kind": "efficiency", "gearbox": SECOND, **law}, "x").case
    slow = run(alone, tmp_path / "slow.h5").summary
    train = load_scenario("two-stage-reducer", {**law, "solver.cycles": 12, "output.samples_per_cycle": 60})
    moving = run(train, tmp_path / "moving.h5").summary["meshes"]["second"]
    assert slow["power_friction_mean"] == pytest.approx(moving["power_friction_mean"], rel=0.02)
    assert slow["contact_ratio"] == pytest.approx(moving["contact_ratio"], rel=1e-9)


def test_planets_roll_against_their_carrier():
    """The ring is held: the sun turns against the carrier by n_s - n_c."""
    train = load_scenario("planetary-24-84")
    data = {
        "title": "x",
        "kind": "efficiency",
        "gearbox": {"scenario": "planetary-24-84", "mesh": "set-sun-2"},
    }
    found = load_data(data, "x").case
    sun, ratio = train.source.speed, 24 / (24 + 84)
    assert found.operating.pinion_speed == pytest.approx(sun * (1.0 - ratio), rel=1e-9)
    ring = load_data(data | {"gearbox": {"scenario": "planetary-24-84", "mesh": "set-ring-1"}}, "x").case
    assert ring.drive.gear.teeth == -84 or ring.drive.has_ring


def test_the_files_own_tables_hold(tmp_path: Path):
    text = Path(td.__file__).parents[1] / "scenarios" / "two-stage-reducer.toml"
    (tmp_path / "mine.toml").write_text(text.read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "loss.toml").write_text(
        'title = "x"\nkind = "efficiency"\ngearbox = { scenario = "mine.toml", mesh = "first" }\n'
        'operating.power = "10 kW"\nfriction.law = "niemann"\n',
        encoding="utf-8",
    )
    found = load(tmp_path / "loss.toml").case
    speed, torque = found.operating.pinion_speed, found.operating.gear_torque
    assert speed * 23 / 69 * torque == pytest.approx(10e3, rel=1e-9)
    assert str(found.friction.law) == "niemann"


@pytest.mark.parametrize(
    ("gearbox", "message"),
    [
        ({"scenario": "two-stage-reducer"}, r"gearbox\.mesh: missing: the gearbox has 2 meshes"),
        ({"scenario": "two-stage-reducer", "mesh": "secnd"}, 'did you mean "second"'),
        ({"scenario": "crc-23-47"}, r"gearbox\.scenario.*is no gearbox of several meshes"),
        ({"scenario": "nowhere"}, "no such scenario"),
        ({"mesh": "second"}, r"gearbox\.scenario"),
    ],
)
def test_what_is_no_mesh_is_said(gearbox: dict[str, str], message: str):
    with pytest.raises(InputError, match=message):
        load_data({"title": "x", "kind": "efficiency", "gearbox": gearbox}, "x")


@pytest.mark.parametrize("key", ["mesh", "scenario"])
def test_what_is_no_text_is_refused(key: str):
    with pytest.raises(InputError, match=rf"gearbox\.{key} = 5: not text"):
        load_data({"kind": "efficiency", "gearbox": SECOND | {key: 5}}, "x")
    with pytest.raises(InputError, match=r"gearbox\.further = 1: unknown key"):
        load_data({"kind": "efficiency", "gearbox": SECOND | {"further": 1}}, "x")


def test_a_file_that_names_itself_is_refused(tmp_path: Path):
    file = tmp_path / "itself.toml"
    file.write_text('title = "x"\nkind = "efficiency"\ngearbox = { scenario = "itself.toml" }\n')
    with pytest.raises(InputError, match="is no gearbox of several meshes"):
        load(file)


def test_a_drive_beside_it_contradicts():
    with pytest.raises(InputError, match="contradicts drive"):
        load_data({"title": "x", "kind": "efficiency", "gearbox": SECOND, "drive": "spur-25-51"}, "x")


def test_the_sheet_of_a_mesh():
    """Gears of either stage of a reducer, and a ring, as objects and from the terminal."""
    second = td.drive("two-stage-reducer", mesh="second")
    assert second.sheet["gear"]["teeth"][0] == 57
    assert td.drive("planetary-24-84", mesh="set-ring-1").sheet["gear"]["teeth"][0] == -84
    with pytest.raises(InputError, match="first, second"):
        td.drive("two-stage-reducer")
    with pytest.raises(InputError, match="a pair of gears has one mesh"):
        td.drive("spur-25-51", mesh="second")
