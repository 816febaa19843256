"""A map of a gearbox whose losses are closed forms: record, reader, both directions, going on, pictures."""

from pathlib import Path

import h5py
import numpy as np
import pytest

import tribodyn as td
from tests.support.closed_form_losses import LOST, OIL, RATIO, SPEED, TORQUE, drag, map_case
from tribodyn.errors import InputError
from tribodyn.record.loss_map import loss_map
from tribodyn.record.reader import Record
from tribodyn.studies.map.case import estimate
from tribodyn.studies.map.looked_up import looked_up
from tribodyn.studies.map.run import check, quantities_of
from tribodyn.studies.pages import figure, names
from tribodyn.studies.protocol.run import run


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory):
    """Of a map in both directions, with a standstill, over three temperatures."""
    case = map_case(np.linspace(0, 120, 5), np.linspace(0, 300, 5), [300, 330, 360], directions="both")
    with Record(run(case, tmp_path_factory.mktemp("map") / "closed.h5").path) as opened:
        yield opened


def test_every_node_holds_the_losses_themselves(record: Record):
    oil, torque, speed = np.meshgrid(
        *(record[name] for name in ("oil_temperature", "torque", "speed")), indexing="ij"
    )
    exact = drag(torque, speed, oil)
    assert record.dims_of("drag") == ("source", "oil_temperature", "torque", "speed")
    np.testing.assert_allclose(record["drag"], exact, rtol=1e-14)
    np.testing.assert_allclose(record["power_loss"], exact.sum(axis=0) * np.abs(speed), rtol=1e-14)
    np.testing.assert_allclose(record["bulk_temperature"][0], oil)
    assert list(record["source_term"]) == ["P_VZP", "P_VL0"]
    assert list(record["source_element"]) == ["high", "bearing 1"]
    assert record["torque"][0] == -120.0
    assert {0.0} == set(record["torque"]) & {0.0} == set(record["speed"]) & {0.0}


def test_units_and_meanings_stand_at_every_dataset(record: Record):
    with h5py.File(record.path) as file:
        for name in file.attrs["datasets"].split():
            assert file[name].attrs["units"], name
            assert file[name].attrs["long_name"], name
        assert file["drag"].attrs["units"] == "N*m"
        assert file["stiffness_total"].attrs["units"] == "N*m/rad"
        assert (file.attrs["ratio"], file.attrs["nominal_torque"]) == (RATIO, TORQUE)
        assert file.attrs["inertia_output"] == pytest.approx(0.02 / RATIO**2)


def test_between_the_nodes_it_is_as_good_as_it_says(record: Record):
    assert record.summary["map_error_max"] <= 0.01
    assert record.summary["accuracy_held"]
    assert tuple(record["error_estimate"]) == (
        record.summary["map_error_max"],
        record.summary["map_error_mean"],
    )
    random = np.random.default_rng(3)
    torque, speed = random.uniform(-120, 120, 5000), random.uniform(0, 300, 5000)
    oil = random.uniform(300, 360, 5000)
    found, exact = looked_up(loss_map(record), torque, speed, oil), drag(torque, speed, oil).sum(axis=0)
    assert np.max(np.abs(found["drag"] / exact - 1.0)) < 0.015
    np.testing.assert_allclose(found["power_loss"], found["drag"] * speed)


def test_both_directions_of_power_close(record: Record):
    """Power in is power out and what is lost; backwards the efficiency is 2 − 1/η of the forward one."""
    table = loss_map(record)
    torque = 80.0 * np.array([1.0, -1.0])
    found = looked_up(table, torque, 100.0, 330.0)
    carried = abs(RATIO) * torque
    np.testing.assert_allclose(found["input_torque"] - carried, found["drag"])
    forward, back = found["efficiency"]
    assert forward == pytest.approx(carried[0] / found["input_torque"][0])
    assert back == pytest.approx(found["input_torque"][1] / carried[1])
    assert back == pytest.approx(2.0 - 1.0 / forward, rel=1e-12)


def test_a_load_that_cannot_turn_the_gearbox_has_no_efficiency(record: Record):
    """At 1 N m the bearings take more than the load brings: it locks; without a load nothing flows."""
    found = looked_up(loss_map(record), [-1.0, 0.0], 200.0, 300.0)
    assert found["efficiency"][0] < 0.0
    assert np.isnan(found["efficiency"][1])
    place = list(record["torque"]).index(0.0)
    assert np.isnan(record["efficiency"][:, place]).all()


def test_at_a_standstill_the_limit_is_there(record: Record):
    """Continuous towards 0, with the efficiency of the torques that a motion to come needs."""
    table = loss_map(record)
    still, slow = (looked_up(table, 100.0, speed, 300.0) for speed in (0.0, 1e-9))
    assert still["power_loss"] == 0.0
    assert still["drag"] == pytest.approx(slow["drag"], rel=1e-9)
    exact = drag(100.0, 0.0, 300.0).sum()
    assert still["efficiency"] == pytest.approx(20.0 / (20.0 + exact), rel=1e-3)
    assert record.summary["stall_drag_max"] == pytest.approx(LOST * 0.2 * 120.0 + 0.1, rel=1e-12)


@pytest.mark.parametrize(("torque", "speed"), [(121.0, 10.0), (0.0, -1.0), (10.0, 301.0)])
def test_beyond_its_axes_it_says_nothing(record: Record, torque: float, speed: float):
    with pytest.raises(InputError, match="outside the map, which reaches from"):
        looked_up(loss_map(record), torque, speed, 300.0)
    with pytest.raises(InputError, match="several temperatures"):
        looked_up(loss_map(record), 1.0, 1.0, None)


def test_axes_of_one_point_are_a_map(tmp_path: Path):
    """Also in one dimension; the curve over the other is drawn as a line."""
    for number, axes in enumerate([([50], [100], [330]), ([0, 100], [100], [330]), ([50], [0, 100], [330])]):
        result = run(map_case(*axes), tmp_path / f"{number}.h5")
        with Record(result.path) as record:
            assert looked_up(loss_map(record), 50.0, 100.0, None)["drag"] == pytest.approx(
                drag(50.0, 100.0, 330.0).sum(), rel=1e-12
            )
            for name in (*names([record]), "overview"):
                assert figure(name, [record]).axes


def test_without_axes_it_reaches_beyond_the_gearbox_own_point(tmp_path: Path):
    case = map_case(accuracy=0.0)
    assert [axis[-1] for axis in case.axes] == [1.2 * TORQUE, 1.2 * SPEED, OIL]
    assert case.axes[0][0] == case.axes[1][0] == 0.0
    assert len(map_case(directions="both").axes[0]) == 25
    assert map_case([10, 20], directions="both").axes[0].tolist() == [-20, -10, 0, 10, 20]
    assert map_case([10, 20], directions="back").axes[0].tolist() == [-20, -10]
    assert map_case(speed=[-5, 5]).axes[1].tolist() == [-5, 0, 5]


def test_the_own_point_is_that_of_the_formulas():
    found = quantities_of(map_case([TORQUE], [SPEED], [OIL]))
    exact = drag(TORQUE, SPEED, OIL)
    assert found["own_power_loss"] == pytest.approx(SPEED * exact.sum(), rel=1e-14)
    assert found["own_losses"]["P_VZP"] == pytest.approx(SPEED * exact[0], rel=1e-14)
    assert found["efficiency_own"] == pytest.approx(20.0 / (20.0 + exact.sum()), rel=1e-14)
    assert found["exceeded"] == {"P_VL0 bearing 1": "fast"}


def test_check_says_how_many_points_and_how_long():
    case = map_case([0, 50, 100], [0, 100], [300, 330])
    checked = check(case)
    assert checked.data["points"] == 12
    text = " ".join(cell for table in checked.tables for row in table.rows for cell in row)
    assert "12; further ones until interpolation misses by at most 1 %" in text
    assert "ms a point" in text
    assert estimate(case).seconds > 0.0


def test_a_call_that_was_stopped_goes_on_where_it_was(tmp_path: Path):
    """What it had evaluated is not evaluated again; the record is the same, and nothing stays beside it."""
    axes, path = (np.linspace(0, 100, 12), np.linspace(0, 300, 12), [300.0, 360.0]), tmp_path / "stopped.h5"
    whole = run(map_case(*axes), tmp_path / "whole.h5").summary
    calls = []

    def interrupt(share: float) -> None:
        calls.append(share)
        if len(calls) == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt) as stopped:
        run(map_case(*axes), path, progress=interrupt)
    assert "the same call goes on" in stopped.value.__notes__[0]
    kept = sorted((tmp_path / "stopped-parts").iterdir())
    assert kept
    assert not path.exists()
    (kept[-1]).write_text("damaged", encoding="utf-8")
    calls.clear()
    again = run(map_case(*axes), path, progress=calls.append)
    assert calls == sorted(calls)
    assert {name: value for name, value in again.summary.items() if name != "wall_time"} == {
        name: value for name, value in whole.items() if name != "wall_time"
    }
    assert sorted(found.name for found in tmp_path.iterdir()) == ["stopped.h5", "whole.h5"]
    with Record(path) as one, Record(tmp_path / "whole.h5") as other:
        np.testing.assert_array_equal(one["drag"], other["drag"])


def test_points_of_another_gearbox_are_not_taken_up(tmp_path: Path):
    folder = tmp_path / "mine-parts"
    folder.mkdir()
    (folder / "00000001.points").write_text('["other", [[50.0, 100.0, 330.0]], {}]', encoding="utf-8")
    (folder / "notes.txt").write_text("mine", encoding="utf-8")
    result = run(map_case([50], [100], [330]), tmp_path / "mine.h5")
    assert result.summary["map_points_evaluated"] == 1
    assert [found.name for found in folder.iterdir()] == ["notes.txt"]


def test_it_is_opened_in_python(record: Record):
    opened = td.open(record.path)
    assert type(opened).__name__ == "Map"
    found = opened.interpolate([50.0, -50.0], 100.0, 330.0)
    exact = drag([50.0, -50.0], 100.0, 330.0).sum(axis=0)
    np.testing.assert_allclose(found["drag"], exact, rtol=0.02)
    assert opened.losses.ratio == RATIO
    assert "98" in "".join(opened.verdict)
