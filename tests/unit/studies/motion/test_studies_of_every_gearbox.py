"""Sweeps, branches, bulk temperatures, data sets, identification and measured curves of every gearbox.

A pair, a reducer of two stages and a planetary set; and a pair that is written either way.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w

import tribodyn as td
from tests.support.soak_parameters import all_in_soak
from tests.support.three_gearboxes import GEARBOXES, NETWORK, PLACES, SPALL, heard
from tribodyn.grid.data_set import drives_of
from tribodyn.grid.engines import LocalEngine
from tribodyn.grid.grid import Grid
from tribodyn.grid.run import run, settings_of
from tribodyn.input.sources import find_scenario, read_toml
from tribodyn.post.compare import compare
from tribodyn.record.reader import Record, mesh_views
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.studies.measured import beside, read_measured
from tribodyn.studies.pages import study_of_record
from tribodyn.studies.protocol.load import load_scenario

SHORT = {"solver": {"cycles": 4}, "output": {"samples_per_cycle": 16}}
OIL = 343.15  # K
#: A gear of each, by its key.
GEAR = {"pair": "drive.gear", "reducer": "gear.wheel-1", "planetary": "gear.sun"}
ERROR = "transmission_error_rotational"
#: Other tests have pairs; planetary sets take long.
REDUCERS = all_in_soak(GEARBOXES, ("reducer",))


def written(folder: Path, gearbox: str, **tables: Any) -> Path:
    """A short scenario of a gearbox, as a file."""
    file = folder / f"{gearbox}.toml"
    file.write_text(tomli_w.dumps(GEARBOXES[gearbox] | SHORT | tables), encoding="utf-8")
    return file


def speeds(gearbox: str) -> dict[str, list[str]]:
    return {f"operating.{'pinion' if gearbox == 'pair' else 'input'}_speed": ["1480 rpm", "1500 rpm"]}


@pytest.mark.parametrize("gearbox", REDUCERS)
def test_steady_states_at_the_temperature_of_their_losses(gearbox: str, tmp_path: Path):
    """Every case repeats; its quantities are the worst of its meshes; the loss heats each of them."""
    file = written(tmp_path, gearbox, temperature={"model": "network", **NETWORK})
    found = td.sweep(file, speeds(gearbox), output=tmp_path / "swept.h5")
    assert found.status.values.tolist() == [1, 1]
    assert found.solution.values.tolist() == ["period-1"] * 2
    assert np.all(found.stable == 1)
    rise = found.bulk_temperature.values - OIL
    assert 0.0 < rise[0] < rise[1]  # a faster gearbox loses more
    ran = td.run(file, {next(iter(speeds(gearbox))): "1480 rpm"}).summary
    assert ran["bulk_temperature"] - OIL == pytest.approx(rise[0], rel=0.15)  # in its first four cycles
    for name in ("transmission_error_mean", "friction_coefficient_mean", "bulk_temperature"):
        assert np.all(np.isfinite(found[name])), name
        if gearbox != "pair":
            np.testing.assert_array_equal(found[name], found[f"{name}_of_mesh"].max("mesh"), err_msg=name)


@pytest.mark.parametrize("gearbox", REDUCERS)
def test_branches_are_followed_either_way(gearbox: str, tmp_path: Path):
    """No end lies between, and so both ways come to the same motions."""
    found = td.sweep(
        written(tmp_path, gearbox), speeds(gearbox), direction="both", output=tmp_path / "both.h5"
    )
    assert np.all(found.status == 1)
    assert not np.any(found.end_kind)
    up, down = (found.sel(direction=way) for way in ("up", "down"))
    for name in ("dynamic_factor", "transmission_error_mean", "efficiency"):
        np.testing.assert_allclose(up[name], down[name], rtol=1e-6, err_msg=name)


def up_with_what_lies_beyond(file: Path, speed: str) -> SweepRecord:
    """A sweep up over a speed, with the unstable branches behind the ends of stable ones."""
    grid, path = Grid(str(file), [f"operating.{speed}"], {}), file.with_suffix(".h5")
    run(grid, settings_of(grid), LocalEngine(), path, directions=("up",), unstable=True)
    return SweepRecord(path)


@pytest.mark.soak
def test_a_fold_is_that_of_the_pair_written_as_a_train(tmp_path: Path):
    """Contact is lost: the branch ends, and goes on unstably behind its end."""
    data = read_toml(find_scenario("jump-involute-23-47"))
    train = data | {"kind": "gear-train"}
    train["operating"] = {
        "input_speed": data["operating"]["pinion_speed"],
        "output_torque": data["operating"]["gear_torque"],
    }
    records = []
    for kind, table in (("pinion", data), ("input", train)):
        file = tmp_path / f"{kind}.toml"
        file.write_text(tomli_w.dumps(table | {"output": {"samples_per_cycle": 20}}), encoding="utf-8")
        records.append(up_with_what_lies_beyond(file, f"{kind}_speed=440:490:25rad/s"))
    one, other = records
    assert np.sum(one["end_kind"] > 0) == 1
    assert np.sum(np.isfinite(one["unstable_value"])) > 10
    for name in one:
        if one[name].dtype.kind in "fi" and name != "state":
            np.testing.assert_allclose(other[name], one[name], rtol=1e-4, atol=1e-9, err_msg=name)


@pytest.mark.soak
def test_a_reducer_whose_teeth_part_has_an_unstable_motion_too(tmp_path: Path):
    """At its lowest resonance the branch turns back, where the multiplier is 1."""
    mesh = GEARBOXES["reducer"]["mesh"] | {"damping_ratio": 0.03}
    file = written(tmp_path, "reducer", mesh=mesh, friction={"law": "none"})
    found = up_with_what_lies_beyond(file, "input_speed=2000,2100rpm")
    ((case, direction, end),) = np.argwhere(found["end_kind"] > 0)
    assert found.meanings("end_kind")[int(found["end_kind"][case, direction, end])] == "fold"
    values, error, modulus = (
        found[f"unstable_{name}"][case, direction, end]
        for name in ("value", "transmission_error_rms", "multiplier_modulus")
    )
    there = np.isfinite(values)
    assert values[0] == pytest.approx(found["end_value"][case, direction, end], rel=1e-4)
    assert np.all(np.diff(values[there]) < 0.0)  # back to lower speeds
    assert np.all(modulus[there] > 1.0)
    assert np.argmin(modulus[there]) == 0
    assert np.all(np.diff(error[there]) > 0.0)
    assert np.all(error[there] > found["transmission_error_rms"][0, direction])


@pytest.mark.soak
def test_planets_have_two_motions_at_one_speed(tmp_path: Path):
    """About a resonance, where teeth part: up they keep to the small one, down to the large one."""
    planetary = GEARBOXES["planetary"]
    file = written(
        tmp_path,
        "planetary",
        gear={name: gear | {"thickness_allowance": "-60 um"} for name, gear in planetary["gear"].items()},
        mesh=planetary["mesh"] | {"damping_ratio": 0.02},
        operating=planetary["operating"] | {"output_torque": "200 N*m"},
        friction={"law": "none"},
    )
    speeds = {"operating.input_speed": ["4500 rpm", "5000 rpm", "5500 rpm"]}
    found = td.sweep(file, speeds, direction="both", output=tmp_path / "both.h5")
    ends = np.any(found.end_kind.values > 0, axis=-1)  # (speed, direction)
    assert ends.tolist() == [[False, True], [False, False], [True, False]]
    up, down = found.dynamic_factor.values.T
    assert up[0] == pytest.approx(down[0], rel=1e-4)
    assert down[1] > 1.5 * up[1]


@pytest.mark.parametrize("gearbox", REDUCERS)
def test_data_sets_hold_sound_and_damaged_gears(gearbox: str, tmp_path: Path):
    damage = [{"gear": PLACES[gearbox][1], "tooth": 2, "kind": "spall", **SPALL}]
    file = written(tmp_path, gearbox, sensor=heard(gearbox)[:2], damage=damage)
    data = td.sweep(file, {"damage": ["none", "1"]}, signals="10 ms", run_in=0.1, output=tmp_path / "set.h5")
    assert data.status.values.tolist() == [1, 1]
    assert data.label.values.tolist() == ["none", "spall"]
    for sensor in heard(gearbox)[:2]:
        sound, spalled = data[sensor["name"]].values
        assert np.ptp(sound) > 0.0
        assert not np.array_equal(sound, spalled)


@pytest.mark.parametrize(
    ("gearbox", "varied"),
    [
        ("pair", "drive.gear.profile_shift=0,0.1"),
        ("reducer", "stage.1.azimuth=30,40deg"),
        ("planetary", "stage.0.support_damping_ratio=0.04,0.05"),
    ],
)
def test_drives_of_a_data_set_differ_by_what_they_are_made_of(gearbox: str, varied: str, tmp_path: Path):
    load = f"operating.{PLACES[gearbox][-1]}=100,150N*m"
    grid = Grid(str(written(tmp_path, gearbox)), [load, varied], {})
    places = [np.ravel(axis) for axis in np.indices(grid.shape)]
    assert drives_of(grid, places).tolist() == [0, 1, 0, 1]


@pytest.mark.parametrize("gearbox", REDUCERS)
def test_what_a_sensor_hears_gives_the_damping(gearbox: str, tmp_path: Path):
    sensor = next(each for each in heard(gearbox) if each["kind"] == "transmission-error")
    file = written(
        tmp_path, gearbox, sensor=[sensor], solver={"revolutions": 1}, output={"samples_per_cycle": 80}
    )
    record = td.run(file, {"mesh.damping_ratio": 0.06}, output=tmp_path / "rig.h5").path
    found = td.identify(file, record, {"mesh.damping_ratio": (0.03, 0.09)}, run_in=0.1)
    assert found.values["mesh.damping_ratio"] == pytest.approx(0.06, rel=0.01)


@pytest.mark.parametrize("gearbox", GEARBOXES)
def test_measured_curves_lie_over_the_angle_of_each_mesh(gearbox: str, tmp_path: Path):
    """A cycle of the last mesh's record as it would be measured, over its driver's angle and its phase."""
    ran = td.run(written(tmp_path, gearbox, solver={"cycles": 6}), output=tmp_path / "run.h5")
    with Record(ran.path) as record:
        mesh, view = list(mesh_views(record).items())[-1]
        of = f" of {mesh}" if "mesh" in record else ""
        pitch, angle = 2 * np.pi / view.mesh_cycle["pinion_teeth"], view["pinion_angle"]
        turned = np.linspace(0.05, 0.95, 31) * pitch
        last = np.floor(angle[-1] / pitch - 0.95 + 1e-9)
        error = np.interp(turned + last * pitch, angle, view[ERROR])
        for head, values in (
            ("pinion_angle{} [deg]", np.degrees(turned)),
            ("mesh_phase{} [1]", turned / pitch),
        ):
            columns = {head.format(of): values, f"{ERROR}{of} [um]": 1e6 * error}
            assert beside(record, read_measured(columns), ERROR + of).difference < 1e-6
        for column, said in ((ERROR, "of MESH"), (f"{ERROR} of nobody", "no such quantity")):
            if of:
                wrong = read_measured({f"mesh_phase{of} [1]": turned, f"{column} [um]": error})
                with pytest.raises(td.InputError, match=said):
                    beside(record, wrong, column)
        wrong = read_measured({"mesh_phase of nobody [1]": turned, "drive_torque [N*m]": error})
        with pytest.raises(td.InputError, match=f"no such mesh of this record.*{mesh}"):
            beside(record, wrong, "drive_torque")


@pytest.mark.parametrize("gearbox", GEARBOXES)
def test_measured_flanks_of_a_gear_are_read(gearbox: str, tmp_path: Path):
    """One tooth lacks 5 µm: it differs in the meshes of its gear, and in no other."""
    rows = [f"3, {height}, {face}, 5" for height in (0, 1) for face in (-10, 10)]
    (tmp_path / "flanks.csv").write_text("\n".join(["tooth [1], height [1], face [mm], error [um]", *rows]))
    errors = {f"{GEAR[gearbox]}.modification.tooth_errors": "flanks.csv"}
    case = load_scenario(str(written(tmp_path, gearbox)), errors)
    differ = [any(pair.teeth) for pair in case.pairs]
    assert (
        differ == {"pair": [True], "reducer": [True, False], "planetary": [True] * 3 + [False] * 3}[gearbox]
    )


@pytest.mark.parametrize("gearbox", REDUCERS)
def test_a_comparison_names_what_the_flanks_of_a_gear_differ_by(gearbox: str, tmp_path: Path):
    file = written(tmp_path, gearbox, solver={"cycles": 1})
    key = f"{GEAR[gearbox]}.modification.tooth_formula"
    errors = "3 * h", "5 * h"
    paths = [td.run(file, {key: error}, output=tmp_path / f"{error[0]}.h5").path for error in errors]
    with Record(paths[0]) as one, Record(paths[1]) as other:
        found = compare([one, other], study_of_record(one).reported())
    assert found.conditions[key] == errors
