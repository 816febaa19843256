"""A drive cycle of gearboxes whose losses are closed forms: temperatures, energies, and what is refused."""

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.cases.heat_part import GearboxHeat, settle
from tribodyn.cases.loss_part import GearboxLosses, LossesOver, LossSource, NominalPoint, OperatingPoints
from tribodyn.input.messages import Origins
from tribodyn.record.reader import Record
from tribodyn.studies.drive_cycle.case import CycleData, DriveCycleCase
from tribodyn.studies.drive_cycle.march import march
from tribodyn.studies.drive_cycle.run import arrays_of, run, summary_of
from tribodyn.studies.protocol.load import Loaded
from tribodyn.studies.protocol.study import Study
from tribodyn.tribology.heat.network import HeatNetwork, HeatPath

AMBIENT, SPEED, TORQUE, RATIO = 293.15, 150.0, 200.0, -0.25
SOURCES = (
    LossSource("P_VZP", "one", "mesh", "closed form"),
    LossSource("P_VZ0", "wheel", "gear", "closed form"),
)
CAPACITIES = {"gear a": 800.0, "gear b": 3000.0, "oil": 4000.0, "housing": 9000.0}
PATHS = (
    HeatPath("gear a", "oil", 20.0),
    HeatPath("gear b", "oil", 60.0),
    HeatPath("oil", "housing", 30.0),
    HeatPath("housing", "ambient", 12.0),
)


class Box(SimpleNamespace):
    """A gearbox: how fast the losses of mesh and oil fall with their temperature, K."""

    mesh_falls: float
    oil_falls: float


def _at(box: Any, points: OperatingPoints) -> LossesOver:
    assert points.bulk_temperature is not None
    mesh = 1.2 * np.abs(points.load) * np.exp(-(points.bulk_temperature[:, 0] - AMBIENT) / box.mesh_falls)
    churned = 1e-5 * np.square(points.speed) * np.exp(-(points.oil_temperature - AMBIENT) / box.oil_falls)
    film = {"film_min": np.full((len(mesh), 1), 1e-6), "film_parameter_min": np.ones((len(mesh), 1))}
    return LossesOver(SOURCES, np.stack([mesh, churned], axis=1), ((), ()), film)


LOSSES = GearboxLosses(
    lambda case: ["one"],
    _at,
    lambda case: NominalPoint(TORQUE, TORQUE * abs(RATIO), SPEED, AMBIENT, RATIO, 0.1),
    lambda case, loads: None,  # pyright: ignore[reportArgumentType]
)
NETWORK = HeatNetwork(CAPACITIES, {"ambient": AMBIENT}, PATHS)
HEAT = lambda case: GearboxHeat(NETWORK, (("gear a", "gear b"),), {})  # noqa: E731
STUDY = Study("closed-form", "losses in closed form", __name__, "losses")


def case_of(time: Any, speed: Any, load: Any, box: Box, **more: Any) -> DriveCycleCase:
    more.setdefault("step", math.inf)
    cycle = CycleData(tuple(time), tuple(speed), tuple(load), None, **more)
    subject = Loaded(box, STUDY, Path("closed.toml"), Origins("closed.toml"))
    return DriveCycleCase(
        title="closed", name="closed", kind="drive-cycle", toml="", sha256="0", subject=subject, cycle=cycle
    )


CONSTANT = Box(mesh_falls=math.inf, oil_falls=math.inf)
FALLING = Box(mesh_falls=60.0, oil_falls=25.0)


def test_constant_losses_warm_the_network_as_its_eigenvalues_say():
    times = [0.0, 100.0, 1000.0, 5000.0]
    history = march(case_of(times, [SPEED] * 4, [1.0] * 4, CONSTANT))
    mesh, churned = 1.2 * SPEED, 1e-5 * SPEED**3
    order = list(CAPACITIES)
    laplacian = np.zeros((4, 4))
    for path in PATHS:
        one = order.index(path.one)
        laplacian[one, one] += path.conductance
        if path.two in order:
            two = order.index(path.two)
            laplacian[two, two] += path.conductance
            laplacian[one, two] -= path.conductance
            laplacian[two, one] -= path.conductance
    steady = np.linalg.solve(laplacian, [0.5 * mesh, 0.5 * mesh, churned, 0.0])
    root = np.sqrt(list(CAPACITIES.values()))
    rates, vectors = np.linalg.eigh(laplacian / np.outer(root, root))
    modal = vectors.T @ (root * steady)
    left = (np.exp(-np.outer(times, rates)) * modal) @ vectors.T / root
    assert history.heat.temperatures - AMBIENT == pytest.approx(steady - left, abs=2e-4)
    assert history.error == pytest.approx(0.0, abs=1e-9)


def test_a_constant_cycle_tends_to_the_steady_network():
    case = case_of([0.0, 1e3, 4e4], [SPEED] * 3, [1.0] * 3, FALLING)
    history = march(case)
    steady = settle(case.heat, lambda points: _at(FALLING, points), ["one"], 1.0, SPEED)
    assert history.heat.temperatures[-1] == pytest.approx(list(steady.steady.temperatures.values()), abs=1e-3)
    assert history.power[-1] == pytest.approx(steady.power, rel=1e-4)


def test_energy_is_put_out_lost_stored_or_given_off():
    time = np.array([0.0, 60.0, 90.0, 300.0, 330.0, 600.0])
    speed, load = np.array([0.0, 150.0, 150.0, 60.0, 200.0, 0.0]), np.array([1.0, 1.0, -0.5, -0.5, 1.4, 0.2])
    case = case_of(time, speed, load, FALLING, repeat=3, start_temperature=280.0)
    history = march(case)
    arrays, summary = arrays_of(case, history), summary_of(case, history)
    stored = (history.heat.temperatures[-1] - 280.0) @ list(CAPACITIES.values())
    assert arrays["heat_stored"][-1] == pytest.approx(stored, rel=1e-12)
    taken, out = arrays["energy_in"][-1], arrays["energy_out"][-1]
    assert taken == pytest.approx(out + stored + arrays["heat_gone"][-1], rel=1e-6)
    assert summary["cycle_heat_balance"] < 1e-6
    # by a fine quadrature of the duty, linear between the rows
    fine = np.linspace(0.0, 600.0, 600_001)
    power = TORQUE * abs(RATIO) * np.interp(fine, time, load) * np.interp(fine, time, speed)
    assert out == pytest.approx(3.0 * np.trapezoid(power, fine), rel=1e-6)
    assert sum(summary["energy_by_term"].values()) == pytest.approx(arrays["energy_lost"][-1])


def test_rows_are_added_until_the_step_is_short_enough():
    rows = case_of([0.0, 10.0, 100.0], [0.0, 150.0, 150.0], [1.0, 1.0, 0.1], FALLING, step=30.0).rows
    assert rows.time == pytest.approx([0.0, 10.0, 40.0, 70.0, 100.0])
    assert rows.load == pytest.approx([1.0, 1.0, 0.7, 0.4, 0.1])
    coarse, fine = (
        march(case_of([0.0, 10.0, 4000.0], [0.0, 150.0, 150.0], [1.0] * 3, FALLING, step=step))
        for step in (math.inf, 40.0)
    )
    assert coarse.heat.temperatures[-1] == pytest.approx(fine.heat.temperatures[-1], abs=0.2)


def test_losses_that_are_integrated_are_those_evaluated_at_the_temperatures_that_come_out():
    case = case_of([0.0, 200.0, 4000.0], [SPEED] * 3, [1.0, 1.0, 0.3], FALLING)
    history = march(case)
    assert history.error < 1e-4
    power = _at(FALLING, OperatingPoints(case.rows.load, case.rows.speed, history.oil, history.bulk))
    assert history.power == pytest.approx(power.power(case.rows.speed))


def test_a_record_holds_the_cycle(tmp_path):
    case = case_of([0.0, 100.0, 900.0], [SPEED] * 3, [1.0] * 3, FALLING)
    result = run(case, tmp_path / "cycle.h5")
    with Record(result.path) as record:
        assert list(record["node"]) == list(CAPACITIES)
        assert record["term_power"].sum(axis=1) == pytest.approx(record["power_loss"])
        assert record["power_in"] - record["power_out"] == pytest.approx(record["power_loss"])
        assert record["node_temperature"].shape == (3, 4)
