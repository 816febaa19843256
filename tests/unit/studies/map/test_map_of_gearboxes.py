"""Maps of gearboxes with teeth: at every node what the gearbox itself loses, however it is written."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tribodyn.cases.loss_part import OperatingPoints
from tribodyn.record.loss_map import loss_map
from tribodyn.record.reader import Record
from tribodyn.studies.map.looked_up import loaded_map, looked_up
from tribodyn.studies.map.report import sentences
from tribodyn.studies.pages import compare
from tribodyn.studies.protocol.run import run

COULOMB = {"friction.law": "coulomb", "friction.coefficient": 0.05}


def mapped(folder: Path, source: Any, overrides: Any = None, **table: Any) -> Record:
    case = loaded_map(source, {"accuracy": 0.0, **table}, overrides or {}).case
    return Record(run(case, folder / "map.h5", force=True).path)


@pytest.fixture(scope="module")
def reducer(tmp_path_factory: pytest.TempPathFactory):
    """In both directions of power and of motion, with a standstill."""
    with mapped(
        tmp_path_factory.mktemp("map"),
        "two-stage-reducer",
        torque=["0 N*m", "590 N*m", "1770 N*m"],
        speed=["-300 rpm", "0 rpm", "1480 rpm"],
        oil_temperature=["40 degC", "70 degC"],
        directions="both",
    ) as record:
        yield record


def test_at_its_nodes_it_is_what_the_gearbox_loses_at_each_by_itself(reducer: Record):
    loaded = loaded_map("two-stage-reducer", {}, {}).case.subject
    losses = loaded.study.losses()
    assert losses is not None
    for i, oil in enumerate(reducer["oil_temperature"]):
        for j, torque in enumerate(reducer["torque"]):
            for k, speed in enumerate(reducer["speed"]):
                point = OperatingPoints(*(np.array([value]) for value in (torque / 1770.0, speed, oil)))
                alone = losses.at(loaded.case, point).drag[0]
                np.testing.assert_allclose(reducer["drag"][:, i, j, k], alone, rtol=1e-9)


def test_it_says_by_which_laws_it_is_where_the_duty_chose_them(reducer: Record):
    laws = reducer.summary["chosen"]
    (said,) = (line for line in sentences(reducer) if "chosen" in line)
    assert all(f'{key} = "{name}"' in said for key, name in laws.items())
    duty = {"operating.output_torque": "590 N*m", "operating.oil_temperature": "70 degC"}
    there = td.check("two-stage-reducer", duty | laws)["losses"]["power_lost"]
    found = reducer["drag"][:, 1, 3, 2].sum() * reducer["speed"][2]
    assert reducer["torque"][3] == 590.0
    assert found == pytest.approx(there, rel=1e-6)


def test_it_has_both_directions_and_a_standstill(reducer: Record):
    still, loaded = reducer["speed"] == 0.0, reducer["torque"] != 0.0
    assert reducer["torque"].tolist() == [-1770.0, -590.0, 0.0, 590.0, 1770.0]
    assert list(reducer["mesh"]) == ["first", "second"]
    assert (reducer["drag"] >= 0.0).all()
    assert (reducer["power_loss"][..., still] == 0.0).all()
    assert (reducer["drag"][:, :, loaded][..., still] > 0.0).all()
    own = looked_up(loss_map(reducer), 1770.0, 1480.0 * np.pi / 30.0, 343.15)
    assert own["power_loss"] == pytest.approx(reducer.summary["own_power_loss"], rel=1e-9)
    assert own["efficiency"] == pytest.approx(reducer.summary["efficiency_own"], rel=1e-12)
    back = looked_up(loss_map(reducer), -1770.0, 1480.0 * np.pi / 30.0, 343.15)["efficiency"]
    assert back == pytest.approx(
        2.0 - 1.0 / own["efficiency"], abs=1e-3
    )  # nearly: loads differ by the losses


def test_errors_of_the_meshes_reach_the_output_by_the_ratio_behind_them(reducer: Record):
    """23/69 teeth of 3 mm, then 23/57 of 4 mm: the working pitch circles follow from the shifts' sum."""
    amplitude, at_output = reducer["transmission_error_harmonic"], reducer["transmission_error_output"]
    turned = at_output[:, -1, 0] / amplitude[:, -1, 0]
    assert turned[0] / turned[1] == pytest.approx(23.0 / 57.0 * (57 * 4.0) / (69 * 3.0), rel=0.02)
    assert turned[1] == pytest.approx(1.0 / (0.5 * 57 * 4.0e-3), rel=0.02)
    assert reducer["mesh_order"].tolist() == pytest.approx([23.0, 23.0 * 23.0 / 69.0])
    np.testing.assert_allclose(reducer["stiffness_total"], reducer["stiffness_total"][::-1], rtol=1e-6)
    assert (reducer["stiffness_mean"] > 1e8).all()


def test_a_pair_and_the_same_pair_as_a_train_have_one_map(tmp_path: Path):
    keys = {"torque": ["100 N*m", "500 N*m"], "speed": ["0 rpm", "1500 rpm"]}
    names = ("drag", "efficiency", "film_min", "stiffness_mean", "stiffness_total", "backlash")
    with mapped(tmp_path, "spur-25-51", COULOMB, **keys) as record:
        pair = {name: record[name] for name in names} | {"ratio": record.attrs["ratio"]}
        scenario = dict(record.scenario["scenario"])
    operating = dict(scenario["operating"])
    operating |= {"input": "pinion", "output": "gear"}
    train = {**scenario, "kind": "gear-train", "operating": operating}
    with mapped(tmp_path, train, **keys) as record:
        for name in names:
            np.testing.assert_allclose(np.squeeze(record[name]), np.squeeze(pair[name]), rtol=1e-9)
        assert record.attrs["ratio"] == pytest.approx(pair["ratio"])


def test_a_planetary_set_has_a_map(tmp_path: Path):
    """Its sun drives, its carrier is loaded: ratio 1 + 84/24; losses of all meshes."""
    with mapped(
        tmp_path, "planetary-24-84", COULOMB, speed=["0 rpm", "1000 rpm"], directions="both"
    ) as record:
        assert abs(record.attrs["ratio"]) == pytest.approx(1.0 / (1.0 + 84.0 / 24.0))
        assert len(record["mesh"]) == 6
        assert (record["drag"].sum(axis=0)[:, -1] > 0.0).all()


def test_a_drive_cycle_loses_by_the_map_what_it_loses_point_by_point(tmp_path: Path):
    """Energy over 400 s of torques, speeds and oil that warms up, within the error that the map states."""
    keys = {"torque": ["0 N*m", "1800 N*m"], "speed": ["0 rpm", "1600 rpm"], "directions": "both"}
    oil = ["50 degC", "80 degC"]
    with mapped(tmp_path, "two-stage-reducer", oil_temperature=oil, accuracy=0.03, **keys) as record:
        time = np.arange(400.0)
        torque = 900.0 * np.sin(time / 13.0) + 800.0 * np.sin(time / 5.0)
        speed = 80.0 + 80.0 * np.sin(time / 31.0)
        warm = 325.0 + 25.0 * (1.0 - np.exp(-time / 120.0))
        by_map = looked_up(loss_map(record), torque, speed, warm)["power_loss"].sum()
        error_max, error_mean = record.summary["map_error_max"], record.summary["map_error_mean"]
    loaded = loaded_map("two-stage-reducer", {}, {}).case.subject
    losses = loaded.study.losses()
    assert losses is not None
    found = losses.at(loaded.case, OperatingPoints(torque / 1770.0, speed, warm))
    assert error_max <= 0.03
    assert by_map == pytest.approx(found.power(speed).sum(), rel=2.0 * error_mean)


def test_reversal_is_continuous_and_its_flanks_are_alike(tmp_path: Path):
    """Towards a standstill from either side: symmetric teeth lose the same on both flanks."""
    speeds = ["-1 rpm", "-1e-6 rpm", "0 rpm", "1e-6 rpm", "1 rpm"]
    with mapped(
        tmp_path, "spur-25-51", COULOMB, torque=["-300 N*m", "300 N*m"], speed=speeds, directions="both"
    ) as record:
        drag = record["drag"][0, 0]
        np.testing.assert_allclose(drag[:, :3], drag[:, :1:-1], rtol=1e-6)
        np.testing.assert_allclose(drag[:, 1], drag[:, 2], rtol=1e-6)


def test_a_comparison_names_what_differs_in_the_gearboxes(tmp_path: Path):
    keys = {"torque": ["500 N*m"], "speed": ["1500 rpm"]}
    (tmp_path / "one").mkdir()
    with (
        mapped(tmp_path, "spur-25-51", COULOMB, **keys) as first,
        mapped(tmp_path / "one", "spur-25-51", {**COULOMB, "friction.coefficient": 0.06}, **keys) as second,
    ):
        found = compare([first, second])
        assert found.conditions == {"friction.coefficient": ("0.05", "0.06")}
        rows = {row.quantity.name: row.values for rows in found.groups.values() for row in rows}
        assert rows["own_power_loss"][1] / rows["own_power_loss"][0] == pytest.approx(1.2, rel=0.01)


def test_a_node_has_what_check_says_of_the_gearbox_by_term_and_element(tmp_path: Path):
    """Of the shipped reducer: meshes, bearings with and without load, seals, churning, windage."""
    own: dict[str, Any] = {"torque": ["1770 N*m"], "speed": ["1480 rpm"], "oil_temperature": ["70 degC"]}
    with mapped(tmp_path, "map-two-stage-reducer", **own, directions="forward") as record:
        power = record["drag"][:, 0, 0, 0] * record["speed"][0]
        by_term = record.summary["own_losses"]
        gearbox = dict(record.scenario["scenario"])
        texts = (record[f"source_{part}"] for part in ("term", "element", "method"))
        elements = [tuple(map(str, names)) for names in zip(*texts, strict=True)]
        said = td.check(gearbox)["losses"]
    assert sum(power) == pytest.approx(said["power_lost"], rel=1e-9)
    for term, watts in said["terms"].items():
        assert by_term[term] == pytest.approx(watts, rel=1e-9), term
    found = dict(zip(elements, power, strict=True))
    assert len(found) > 10
    for element in said["elements"]:
        key = element["term"], element["element"], element["method"]
        assert found[key] == pytest.approx(element["power"], rel=1e-9), key
