"""Studies of a pair of gears take a mesh of a train, with the duty that the train gives it."""

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w

import tribodyn as td
from tests.support.verbs import complaint, ended, invoke
from tribodyn.errors import InputError
from tribodyn.input.sources import find_scenario
from tribodyn.interface.scenario import resolved
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import every_from, load, load_data, load_scenario
from tribodyn.studies.protocol.run import run

SCENARIOS = Path(td.__file__).parents[1] / "scenarios"
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
    found = load_data(data, "x").case.pair
    mesh = next(mesh for mesh in load_scenario("two-stage-reducer").meshes if mesh.name == "second")
    assert found.drive == mesh.pair.drive
    assert found.operating.pinion_speed == pytest.approx(mesh.pair.operating.pinion_speed, rel=1e-12)
    assert found.operating.gear_torque == pytest.approx(mesh.pair.operating.gear_torque, rel=1e-12)
    again = load_data(tomllib.loads(found.toml), "again").case.pair
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
    law = {"friction": {"law": "masjedi-khonsari"}}
    alone = load_data({"title": "x", "kind": "efficiency", "gearbox": SECOND, **law}, "x").case
    slow = run(alone, tmp_path / "slow.h5").summary
    train = load_scenario("two-stage-reducer", {**law, "solver.cycles": 12, "output.samples_per_cycle": 60})
    moving = run(train, tmp_path / "moving.h5").summary["meshes"]["second"]
    assert slow["power_friction_mean"] == pytest.approx(moving["power_friction_mean"], rel=0.02)
    assert slow["contact_ratio"] == pytest.approx(moving["contact_ratio"], rel=1e-9)


def test_a_ring_that_drives_is_the_gear_of_its_pair(tmp_path: Path):
    """The carrier drives the sun: power goes from the ring to the planets. Losses are the motion's."""
    law = {"friction": {"law": "masjedi-khonsari"}}
    reversed_set = {
        "operating": {
            "input": "carrier",
            "output": "sun",
            "input_speed": "300 rpm",
            "output_torque": "150 N*m",
            "oil_temperature": "60 degC",
        },
        "solver": {"cycles": 5},
        "output": {"samples_per_cycle": 40},
    }
    text = SCENARIOS / "planetary-24-84.toml"
    train: dict[str, Any] = tomllib.loads(text.read_text(encoding="utf-8")) | reversed_set | law
    train["stage"][0] |= {"tangential_pin_errors": ["0 um", "0 um", "0 um"]}
    (tmp_path / "up.toml").write_text(tomli_w.dumps(train))
    gearbox = {"scenario": str(tmp_path / "up.toml"), "mesh": "set-ring"}
    found = load_data({"title": "x", "kind": "efficiency", "gearbox": gearbox, **law}, "x").case
    assert (found.drive.pinion.teeth, found.drive.gear.teeth) == (30, -84)
    assert found.operating.pinion_speed == pytest.approx(300 * math.pi / 30 * 84 / 30, rel=1e-9)
    assert found.operating.gear_torque == pytest.approx(-150 * 84 / 24 / 3, rel=1e-9)
    slow = run(found, tmp_path / "slow.h5").summary
    moving = run(load(tmp_path / "up.toml").case, tmp_path / "moving.h5").summary["meshes"]
    losses = [moving[f"set-ring-{number}"]["power_friction_mean"] for number in (1, 2, 3)]
    assert slow["power_friction_mean"] == pytest.approx(sum(losses) / 3, rel=0.02)


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
    text = SCENARIOS / "two-stage-reducer.toml"
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
        ({"scenario": "two-stage-reducer"}, r"gearbox\.mesh: missing: .* 2 meshes; .*first, second; all of"),
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


def test_gears_by_their_own_names(tmp_path: Path):
    """Own lines are the same in every mesh and as typed; what the mate decides is that of the pair."""
    planet, ring = (td.gear("planetary-24-84", name) for name in ("planet", "ring"))
    assert list(planet.pairs) == ["set-sun", "set-ring"]
    assert planet.sides == {"set-sun": "gear", "set-ring": "pinion"}
    for mesh, sheet in planet.sheet.items():
        pair = td.drive("planetary-24-84", mesh=mesh).sheet[planet.sides[mesh]]
        assert sheet == {name: sheet[name] for name in sheet if "rack" in name or name == "module"} | pair
        assert sheet["module"] == (3e-3, "m")
        assert sheet["teeth"][0] == 30
        assert sheet["tip diameter"][0] == pytest.approx(96e-3, rel=1e-12)  # m (z + 2)
    assert td.gear("planetary-24-84", "planet-2").sheet == planet.sheet
    assert np.hypot(*planet.outline.T).max() == pytest.approx(48e-3, rel=1e-9)
    assert (list(ring.pairs), ring.sheet["set-ring"]["teeth"][0]) == (["set-ring"], -84)
    by_mesh = [pair.constraints for pair in planet.pairs.values()]
    assert planet.constraints["clearance"] == min(
        by_mesh[0]["clearance_gear"], by_mesh[1]["clearance_pinion"]
    )
    assert "clearance_pinion" in td.constraints("planetary-24-84", mesh="set-ring")
    assert td.gear("spur-25-51", "pinion").sheet[""]["teeth"][0] == 25
    with pytest.raises(InputError, match=r"no such gear.*planet, ring, sun, planet-1"):
        td.gear("planetary-24-84", "moon")


def test_a_gear_from_the_terminal(tmp_path: Path):
    printed = invoke("gear", "planetary-24-84", "--gear", "planet", "-o", tmp_path, "--points", 20)
    assert "in set-sun" in printed
    assert "in set-ring" in printed
    files = {file.name for file in tmp_path.iterdir()}
    assert files == {f"planetary-24-84-planet{end}" for end in (".dxf", "-rack.dxf", ".csv")}
    data = json.loads(invoke("gear", "planetary-24-84", "--gear", "ring", "--json"))
    assert data["geometry"]["set-ring"]["teeth"][0] == -84
    assert "contradicts --mesh" in complaint("gear", "planetary-24-84", "--gear", "sun", "--mesh", "set-sun")


def test_the_sheet_of_a_mesh():
    """Gears of either stage of a reducer, and a ring, as objects and from the terminal."""
    second = td.drive("two-stage-reducer", mesh="second")
    assert second.sheet["gear"]["teeth"][0] == 57
    assert td.drive("planetary-24-84", mesh="set-ring-1").sheet["gear"]["teeth"][0] == -84
    with pytest.raises(InputError, match="first, second"):
        td.drive("two-stage-reducer")
    with pytest.raises(InputError, match="a pair of gears has one mesh"):
        td.drive("spur-25-51", mesh="second")


ALL = {"title": "Losses", "kind": "efficiency", "gearbox": {"scenario": "two-stage-reducer"}}


def test_every_mesh_runs_where_none_is_named(tmp_path: Path):
    """A record each, named after the mesh, with the numbers of the mesh when it is named; one table."""
    (tmp_path / "all.toml").write_text(tomli_w.dumps(ALL))
    printed = invoke("run", "all.toml", "--no-plot", folder=tmp_path)
    heading = next(line for line in printed.splitlines() if "against" in line)
    assert heading.split()[:2] == ["all-first", "all-second"]
    data = json.loads(invoke("run", "all.toml", "--no-plot", "--json", folder=tmp_path))["meshes"]
    runs = td.run_meshes(tmp_path / "all.toml")
    assert list(data) == list(runs) == ["first", "second"]
    for mesh in data:
        named = td.run(ALL | {"gearbox": {"scenario": "two-stage-reducer", "mesh": mesh}})
        for summary in (data[mesh]["summary"], runs[mesh].summary):
            assert summary["efficiency"] == pytest.approx(named.summary["efficiency"], rel=1e-12)
        assert (tmp_path / f"all-{mesh}.h5").is_file()
    checked = json.loads(invoke("check", "all.toml", "--json", folder=tmp_path))["meshes"]
    assert [checked[mesh]["geometry"]["gear"]["teeth"][0] for mesh in checked] == [69, 57]


def test_equal_meshes_of_planets_count_once(tmp_path: Path):
    (tmp_path / "set.toml").write_text(tomli_w.dumps(ALL | {"gearbox": {"scenario": "planetary-24-84"}}))
    runs = td.run_meshes(tmp_path / "set.toml", output=tmp_path)
    assert list(runs) == ["set-sun", "set-ring"]
    assert sorted(file.name for file in tmp_path.glob("*.h5")) == ["set-set-ring.h5", "set-set-sun.h5"]
    one, other = (
        load(tmp_path / "set.toml", {"gearbox.mesh": mesh}).case for mesh in ("set-ring", "set-ring-1")
    )
    assert one.toml == other.toml


def test_a_kind_without_rings_leaves_them_out():
    data = {"title": "x", "kind": "ehl", "gearbox": {"scenario": "planetary-24-84"}}
    every = every_from(resolved(data, None)[0], Path("x.toml"))
    assert list(every.cases) == ["set-sun"]
    assert every.remarks() == ["mesh set-ring is left out: this kind of study takes no such ring"]


def test_the_exit_status_is_the_worst_of_all_meshes(tmp_path: Path):
    """A record of another scenario is in the way of the second mesh's."""
    (tmp_path / "all.toml").write_text(tomli_w.dumps(ALL))
    (tmp_path / "all-second.h5").write_text("something else")
    found = ended("run", "all.toml", "--no-plot", folder=tmp_path)
    assert found.exit_code == 2
    assert "mesh second" in found.stderr
    assert (tmp_path / "all-first.h5").is_file()


def test_what_is_wrong_with_a_mesh_is_said_with_its_name():
    """Of every mesh before any is run: a stiffness that belongs to another compliance."""
    data = ALL | {"mesh": {"compliance": "energy", "stiffness": "3e8 N/m"}}
    with pytest.raises(InputError, match=r"scenario, mesh first: mesh\.stiffness"):
        td.run_meshes(data)
