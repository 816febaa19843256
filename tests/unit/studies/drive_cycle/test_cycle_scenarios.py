"""Scenarios of drive cycles: the reducer that is shipped, CSV files, and what is refused."""

from typing import Any

import numpy as np
import pytest

from tribodyn.errors import InputError, InputErrors
from tribodyn.interface.scenario import scenario
from tribodyn.studies.drive_cycle.march import march
from tribodyn.studies.motion.heat.settled import in_balance
from tribodyn.studies.protocol.load import load_scenario

WARM = {"model": "gearbox", "sump": "free", "housing": {"area": "0.7 m**2"}}


def table(time: Any = (0, 100), speed: Any = (1480, 1480), load: Any = (1, 1)) -> dict[str, Any]:
    columns = {"time": ("s", time), "speed": ("rpm", speed), "load": ("1", load)}
    return {name: {"unit": unit, "values": list(values)} for name, (unit, values) in columns.items()}


def data(temperature: Any = WARM, like: str = "two-stage-reducer", **cycle: Any) -> dict[str, Any]:
    inner = {"like": like, "friction": {"law": "schlenk"}, "temperature": temperature}
    return {"title": "warm", "kind": "drive-cycle", "scenario": inner, "cycle": cycle or {"table": table()}}


def test_a_reducer_that_runs_long_is_in_the_balance_of_its_check():
    case = scenario(data(table=table((0, 6e4)), step="20000 s"))
    steady = in_balance(case.subject.case).heat.settled
    history = march(case)
    names = case.heat.network.nodes
    assert history.heat.temperatures[-1] == pytest.approx([steady.parts[name] for name in names], abs=0.01)
    assert history.power[-1].sum() == pytest.approx(steady.heat, rel=1e-4)
    assert history.heat.balance < 1e-6
    film = history.losses.meshes["film_min"]
    assert film.shape == (4, 2)
    assert np.all(film[0] > film[-1])  # cold oil is thick


def test_torques_are_multiples_of_the_scenarios_own():
    torques = table()
    torques["torque"] = {"unit": "N*m", "values": [1770, -885]}
    del torques["load"]
    rows = scenario(data(torque_table=torques, step="1 h")).rows
    assert rows.load == pytest.approx([1.0, -0.5])


def test_without_a_load_a_torque_is_no_multiple():
    torques = table()
    torques["torque"] = torques.pop("load") | {"unit": "N*m"}
    changes = {"scenario.operating.output_torque": "0 N*m", "scenario.mesh.backlash": "40 um"}
    changes["scenario.friction"] = {"law": "coulomb", "coefficient": 0.05}
    case = scenario(data(torque_table=torques), changes)
    with pytest.raises(InputError, match=r"cycle\.torque_table: the scenario has no load"):
        _ = case.rows


def test_a_file_stands_beside_the_scenario(tmp_path):
    (tmp_path / "duty.csv").write_text("time [min],speed [rpm],load [1]\n0,0,1\n2,1480,0.5\n", "utf-8")
    (tmp_path / "cycle.toml").write_text(
        'title = "duty"\nkind = "drive-cycle"\n[scenario]\nlike = "two-stage-reducer"\n'
        '[scenario.temperature]\nmodel = "gearbox"\nhousing = { area = "0.7 m**2" }\n'
        '[cycle]\ntable = "duty.csv"\nrepeat = 2\nstep = "1 h"\n',
        encoding="utf-8",
    )
    rows = load_scenario(tmp_path / "cycle.toml").rows
    assert rows.time == pytest.approx([0.0, 120.0, 120.0, 240.0])
    assert rows.speed == pytest.approx(np.array([0.0, 1480.0, 0.0, 1480.0]) * np.pi / 30.0)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            data(table=table((0, 50, 40), (1, 1, 1), (1, 1, 1))),
            "time does not increase at point 3",
        ),
        (data(repeat=2), "cycle.table: missing: the duty over time"),
        (data(table=table(), torque_table=table()), "torque"),
        (data(table=table(), start_temperature="-80 degC"), "cycle.start_temperature"),
        (data(temperature={"model": "iso"}), "scenario.temperature.model: missing"),
        (data(temperature={"model": "gearbox", "housing": {"height": "1 m"}}), "housing.area: missing"),
        (data(like="irefc"), "scenario"),
    ],
)
def test_mistakes_are_named(changes, message):
    with pytest.raises((InputError, InputErrors)) as caught:
        scenario(changes)
    assert message in str(caught.value)


def test_oil_that_leaves_its_range_is_refused():
    case = scenario(data(temperature={**WARM, "housing": {"area": "0.05 m**2"}}, table=table((0, 9e4))))
    with pytest.raises(InputError, match="would reach"):
        march(case)
