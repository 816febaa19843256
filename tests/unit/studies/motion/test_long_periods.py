"""Trains whose meshes repeat together after millions of cycles: runs lay out no more than they pass."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tests.support.train_scenarios import case_of_table
from tribodyn.cases.cost import GIB, refuse_large
from tribodyn.errors import InputError
from tribodyn.studies.motion.batch import BATCH
from tribodyn.studies.motion.estimate import estimate
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.schedule import schedule_of

#: Pinion and wheel of every stage; no two on a shaft have a divisor.
STAGES = ((23, 67), (29, 71), (31, 73), (37, 79), (41, 83))


def hunting_train(stages: int, **solver: int):
    gears, table = {}, []
    for number, pair in enumerate(STAGES[:stages]):
        for name, teeth in zip("ab", pair, strict=True):
            gears[f"{name}{number}"] = {"teeth": teeth, "face_width": "25 mm"}
        ends = [f"a{number}", f"b{number}"]
        table.append({"gears": ends, "module": "3 mm", "pressure_angle": "20 deg"})
    return case_of_table(
        {
            "title": "Hunting teeth",
            "kind": "gear-train",
            "lubricant": "iso-vg-220-mineral",
            "material": "18CrNiMo7-6",
            "mean_roughness": "0.5 um",
            "bearings": "rigid-1e9",
            "gear": gears,
            "stage": table,
            "shaft": [{"name": f"s{n}", "gears": [f"b{n - 1}", f"a{n}"]} for n in range(1, stages)],
            "operating": {
                "input": "a0",
                "output": f"b{stages - 1}",
                "input_speed": "1500 rpm",
                "output_torque": "900 N*m",
                "oil_temperature": "70 degC",
            },
            "mesh": {"compliance": "constant", "stiffness": "4e8 N/m", "damping_ratio": 0.05},
            "friction": {"law": "none"},
            "solver": {"cycles": 1, **solver},
        }
    )


@pytest.mark.parametrize("stages", [4, 5])
def test_a_run_lays_out_its_own_cycles(stages: int):
    case = hunting_train(stages)
    period = np.prod([wheel for _, wheel in STAGES[: stages - 1]])
    assert case.period == period
    taken = estimate(case)
    assert taken.memory < GIB
    assert taken.seconds < 10.0
    refuse_large(taken, allow_large=False)
    schedule = prepare(case).model.schedule
    assert schedule.period == 2  # the run and the cycle that begins at its end
    assert len(schedule.start) < 5 * stages


def test_a_steady_state_names_the_period_before_it_begins():
    case = hunting_train(4)
    with pytest.raises(InputError, match=r"max_period = 200: .* after 347261 cycles of the mesh a0-b0"):
        BATCH.settings([case], None, "native")
    allowed = hunting_train(4, max_period=400_000)
    taken = BATCH.estimate(allowed, BATCH.settings([allowed], None, "native"), 1, 1)
    with pytest.raises(InputError, match=r"347261 cycles.* teeth with a divisor") as caught:
        refuse_large(taken, allow_large=False)
    assert caught.value.key == "solver.max_period"


def test_a_part_of_a_schedule_is_that_part_of_the_whole():
    rates = [Fraction(1), Fraction(29, 67), Fraction(29 * 31, 67 * 71)]
    boundaries = [np.array([0.0, 0.63, 1.0]), np.array([0.0, 0.7, 1.0]), np.array([0.0, 0.71, 1.0])]
    phases = [0.0, 0.2, 0.9]
    part = schedule_of(boundaries, rates, phases, 9)
    cycles = np.repeat(np.arange(9), np.diff(part.first).astype(int))
    expected = sorted(
        (turn + at - phase) / float(rate)
        for boundary, rate, phase in zip(boundaries, rates, phases, strict=True)
        for turn in range(20)
        for at in boundary[:-1].tolist()
        if 0.0 <= (turn + at - phase) / float(rate) < 9.0
    )
    np.testing.assert_allclose(cycles + part.start, expected, atol=1e-12)
    assert part.end[-1] == 1.0
    middle = cycles + 0.5 * (part.start + part.end)
    for m, (rate, phase) in enumerate(zip(rates, phases, strict=True)):
        own = (phase + float(rate) * middle) % 1.0
        np.testing.assert_allclose(float(rate) * (middle - cycles) + part.offset[:, m], own, atol=1e-12)
        np.testing.assert_array_equal(part.segment[:, m], own >= boundaries[m][1])


def test_a_run_is_the_same_whether_the_period_is_laid_out(tmp_path):
    """Three cycles of the reducer's first mesh, or one of them and that behind."""
    keys: dict[str, Any] = {"solver.cycles": 1, "output.samples_per_cycle": 60}
    keys |= {"friction.law": "coulomb", "friction.coefficient": 0.06}
    whole, part = (
        td.run("two-stage-reducer", {**keys, "solver.max_period": most}, output=tmp_path / f"{most}.h5")
        for most in (200, 1)
    )
    np.testing.assert_array_equal(whole.data.transmission_error_normal, part.data.transmission_error_normal)
    assert whole.summary["energy_residual"] == part.summary["energy_residual"]
