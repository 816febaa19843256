"""Energy lost over a drive cycle by a map: beside the gearbox at every point, beside its motion in time."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from tests.support.three_gearboxes import GEARBOXES
from tribodyn.cases.loss_part import OperatingPoints
from tribodyn.record.loss_map import LossMap, loss_map
from tribodyn.record.reader import Record
from tribodyn.studies.map.looked_up import loaded_map
from tribodyn.studies.protocol.load import load_data, load_scenario
from tribodyn.studies.protocol.run import run

PAIR = GEARBOXES["pair"]
TORQUE, SPEED, OIL = 150.0, 1480.0 * np.pi / 30.0, 343.15


class Mapped(NamedTuple):
    """A map with what it says of its own error."""

    losses: LossMap
    maximum: float
    mean: float


@pytest.fixture(scope="module")
def mapped(tmp_path_factory: pytest.TempPathFactory) -> Mapped:
    axes = {"torque": ["0 N*m", "150 N*m"], "speed": ["0 rpm", "1480 rpm"], "oil_temperature": ["70 degC"]}
    file = tmp_path_factory.mktemp("map") / "map.h5"
    with Record(run(loaded_map(PAIR, {**axes, "directions": "both"}, {}).case, file).path) as record:
        losses = loss_map(record)
    return Mapped(losses, *losses.interpolation)


def cycle() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Seconds, torque at the output and speed of the input: pulling away, cruising, coasting, to a stop."""
    time = np.linspace(0.0, 60.0, 241)
    speed = SPEED * np.interp(time, [0.0, 12.0, 40.0, 55.0, 60.0], [0.0, 0.8, 0.9, 0.3, 0.0])
    torque = TORQUE * np.interp(
        time, [0.0, 1.0, 12.0, 15.0, 40.0, 42.0, 60.0], [0, 1, 0.9, 0.3, 0.3, -0.6, -0.5]
    )
    return time, torque, speed


def test_energy_is_that_of_the_gearbox_itself_within_the_stated_error(mapped: Mapped):
    time, torque, speed = cycle()
    loaded = load_data(PAIR, "pair")
    losses = loaded.study.losses()
    assert losses is not None
    points = OperatingPoints(torque / TORQUE, speed, np.full(len(time), OIL))
    exact = np.trapezoid(losses.at(loaded.case, points).total() * speed, time)
    by_map = np.trapezoid(mapped.losses.at(OIL, torque, speed) * speed, time)
    assert 0.0 < mapped.mean <= mapped.maximum < 0.02
    assert by_map == pytest.approx(exact, rel=mapped.maximum)


def test_energy_is_that_of_a_cycle_whose_oil_warms(mapped: Mapped, tmp_path: Path):
    """The thermal network over an hour; the map at the oil's temperatures as they came out."""
    heat = {
        "model": "gearbox",
        "sump": "free",
        "ambient_temperature": "50 degC",
        "housing": {"area": "0.05 m**2", "air_speed": "2 m/s"},
    }
    warm = PAIR | {"temperature": heat}
    table = {
        "time": {"unit": "s", "values": [0, 2400, 2460, 3600]},
        "speed": {"unit": "rpm", "values": [1480, 1480, 740, 740]},
        "load": {"unit": "1", "values": [1, 1, -0.5, -0.5]},
    }
    cycled = {"title": "cycle", "kind": "drive-cycle", "scenario": warm, "cycle": {"table": table}}
    axes = {"torque": ["0 N*m", "150 N*m"], "speed": ["700 rpm", "1480 rpm"]}
    axes["oil_temperature"] = [f"{degree} degC" for degree in (50, 80, 110)]
    case = loaded_map(warm, {**axes, "directions": "both"}, {}).case
    with Record(run(case, tmp_path / "map.h5").path) as record:
        losses = loss_map(record)
    with Record(run(load_data(cycled, "cycle").case, tmp_path / "cycle.h5").path) as record:
        time, oil, speed = (record[name] for name in ("time", "oil_temperature", "input_speed"))
        lost, load = float(record["energy_lost"][-1]), record["load"]
    assert oil[-1] > oil[0] + 5.0
    by_map = np.trapezoid(losses.at(oil, load * TORQUE, speed) * speed, time)
    assert by_map == pytest.approx(lost, rel=losses.interpolation[0])


def test_energy_is_that_of_the_motion_in_time(tmp_path: Path):
    """A cycle of three steady parts, each of which is run; vibration moves their losses by up to 1 %."""
    law, parts = {"friction.law": "schlenk"}, [(1.0, 1.0, 8.0), (0.5, 0.6, 20.0), (0.3, 1.0, 12.0)]
    axes = {"torque": ["0 N*m", "1770 N*m"], "speed": ["800 rpm", "1480 rpm"], "oil_temperature": ["70 degC"]}
    case = loaded_map("two-stage-reducer", axes, law).case
    with Record(run(case, tmp_path / "map.h5").path) as record:
        losses = loss_map(record)
    moving, by_map = 0.0, 0.0
    for number, (load, pace, seconds) in enumerate(parts):
        keys = {
            "operating.output_torque": f"{load * 1770.0} N*m",
            "operating.input_speed": f"{pace * SPEED} rad/s",
        }
        moved = load_scenario("two-stage-reducer", law | keys)
        summary = run(moved, tmp_path / f"{number}.h5").summary
        moving += summary["power_friction_mean"] * seconds
        by_map += float(losses.at(OIL, load * 1770.0, pace * SPEED)) * pace * SPEED * seconds
    assert by_map == pytest.approx(moving, rel=0.01 + losses.interpolation[0])
