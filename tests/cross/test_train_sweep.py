"""Sweeps of trains: what they keep of every case is what a long run of it has, by mesh and of the worst."""

from importlib import import_module

import numpy as np
import pytest
import tomli_w

import tribodyn as td
from tests.support.planet_sets import planet_set
from tribodyn.errors import InputError
from tribodyn.grid.grid import Grid
from tribodyn.post.figures.sweep_branch import branches
from tribodyn.post.figures.sweep_spectra import order_amplitudes
from tribodyn.record.sweep_reader import SweepRecord, sweeps_of_meshes
from tribodyn.record.sweep_schema import DONE, FAILED
from tribodyn.studies.motion.batch import BATCH
from tribodyn.studies.motion.batch.gearboxes import KEPT, OF_MESH
from tribodyn.studies.motion.batch.sweep_figures import SWEEP_DRAWINGS
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.report import SWEPT
from tribodyn.studies.protocol.batch import Chunk
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

KEYS = {"friction.law": "coulomb", "friction.coefficient": 0.06, "output.samples_per_cycle": 60}


#: The gears of the middle shaft against each other.
TURNED = {"gear.pinion-2.tooth_angle": "7 deg"}


def case_at(speed: int, **keys):
    return load_scenario("two-stage-reducer", {**KEYS, "operating.input_speed": f"{speed} rpm", **keys})


def evaluated(cases, transient=None, **settings):
    chosen = BATCH.settings(cases, transient, "native")._replace(**settings)
    return BATCH.evaluate(Chunk(np.arange(len(cases)), tuple(cases)), chosen, 1)


def test_steady_states_are_those_of_long_runs(tmp_path):
    cases = [case_at(1480), case_at(1950)]
    rows = evaluated(cases)
    assert rows["status"].tolist() == [DONE, DONE]
    assert rows["period"].tolist() == [1, 1]
    assert np.all(rows["residual"] < 1e-7)
    assert np.all(rows["multiplier_max"] < 1.0)
    for i, speed in enumerate((1480, 1950)):
        long = run(case_at(speed, **{"solver.cycles": 240, "solver.rtol": 1e-8}), tmp_path / f"{speed}.h5")
        for name in (quantity.name for quantity in SWEPT):
            if long.summary.get(name) is not None:
                assert rows[name][i] == pytest.approx(long.summary[name], rel=2e-4, abs=1e-9), name
        for name in KEPT:
            of_meshes = [mesh.get(name, np.nan) for mesh in long.summary["meshes"].values()]
            np.testing.assert_allclose(rows[name + OF_MESH][i], of_meshes, rtol=2e-4, atol=1e-9)
        swing = np.ptp(rows["transmission_error_rotational"][i], axis=-1)
        np.testing.assert_allclose(swing, rows["transmission_error_peak_to_peak_of_mesh"][i], rtol=0.02)


def test_a_marched_case_goes_on_from_its_neighbours_state():
    """Twice twelve cycles are twenty-four."""
    (case,) = cases = [case_at(1480)]
    chunk = Chunk(np.arange(1), (case,), evaluated(cases, 12)["state"])
    again = BATCH.evaluate(chunk, BATCH.settings(cases, 12, "native"), 1)
    np.testing.assert_allclose(again["state"], evaluated(cases, 24)["state"], rtol=1e-5, atol=1e-12)


def test_a_sweep_up_and_down_goes_on_from_neighbours(tmp_path):
    speeds = ["1450 rpm", "1475 rpm", "1500 rpm"]
    swept = td.sweep(
        "two-stage-reducer",
        {"operating.input_speed": speeds},
        KEYS,
        direction="both",
        output=tmp_path / "both.h5",
    )
    expected = evaluated([case_at(speed) for speed in (1450, 1475, 1500)])
    for direction in ("up", "down"):
        found = swept.dynamic_factor_of_mesh.sel(direction=direction)
        np.testing.assert_allclose(found, expected["dynamic_factor_of_mesh"], rtol=1e-4)
    assert not np.any(swept.cycles % 3)  # whole common periods
    with SweepRecord(tmp_path / "both.h5") as record:
        for drawing in SWEEP_DRAWINGS.values():
            drawing.draw([record], {})
        for m, views in enumerate(sweeps_of_meshes([record]).values()):
            branch = branches(views)[0]
            found = order_amplitudes(branch, 3)
            np.testing.assert_array_equal(
                branch.values("mesh_frequency"), swept.mesh_frequency_of_mesh[:, 0, m]
            )
            error = swept.transmission_error_rotational.sel(direction="up")[:, m].to_numpy()
            phase = (1.0, 1 / 3)[m] * np.arange(error.shape[-1]) / 60  # the wheel of 69 on the pinion of 23
            for order in (1, 2, 3):
                line = 2.0 * np.abs(np.mean(error * np.exp(-2j * np.pi * order * phase), axis=-1))
                np.testing.assert_allclose(found[:, order - 1], line, rtol=1e-9)


def test_one_law_for_all_cases():
    slow_one, fast = (
        load_scenario("two-stage-reducer", {"operating.input_speed": speed})
        for speed in ("500 rpm", "1480 rpm")
    )
    assert slow_one.chosen() != fast.chosen()
    grid = Grid("two-stage-reducer", ["operating.input_speed=500,1480rpm"], {})
    cases = [grid.case((i,)) for i in (0, 1)]
    laws = {(mesh.pair.film.law, mesh.pair.friction.law) for case in cases for mesh in case.meshes}
    assert len(laws) == 1


def same_as_alone(rows, cases, transient=None):
    """Whether the rows of cases have what each has in a sweep of its own, and NaN for meshes it has not."""
    names = [mesh.name for mesh in max((case.meshes for case in cases), key=len)]
    for i, case in enumerate(cases):
        alone = evaluated([case], transient)
        for name in ("dynamic_factor", "transmission_error_rms", "efficiency"):
            assert rows[name][i] == pytest.approx(alone[name][0], rel=1e-9), name
        places = [names.index(mesh.name) for mesh in case.meshes]
        found = rows["dynamic_factor_of_mesh"][i]
        np.testing.assert_allclose(found[places], alone["dynamic_factor_of_mesh"][0], rtol=1e-9)
        assert np.all(np.isnan(np.delete(found, places)))


def test_cases_of_other_common_periods():
    """Three and two cycles of the first mesh: wheels of 69 and 46 teeth on the shaft of a pinion of 23."""
    cases = [case_at(1480), case_at(1480, **{"gear.wheel-1.teeth": 46})]
    rows = evaluated(cases)
    assert rows["status"].tolist() == [DONE, DONE]
    assert rows["common_period"].tolist() == [3, 2]
    same_as_alone(rows, cases)


def test_sets_of_other_numbers_of_planets(tmp_path):
    """Three and four planets in one record; the second does not begin where the first has no states."""
    file = tmp_path / "set.toml"
    table = planet_set() | {"output": {"samples_per_cycle": 24}}
    file.write_text(tomli_w.dumps(table), encoding="utf-8")
    swept = td.sweep(
        file, {"stage.0.planets": [3, 4]}, transient=8, direction="up", output=tmp_path / "planets.h5"
    )
    rows = {name: np.asarray(values).reshape(2, *values.shape[2:]) for name, values in swept.items()}
    same_as_alone(rows, [load_scenario(file, {"stage.0.planets": number}) for number in (3, 4)], 8)


def test_a_long_common_period_and_another_structure_are_refused():
    long = load_scenario("two-stage-reducer-hunting", {**KEYS, "solver.max_period": 60})
    with pytest.raises(InputError, match="again after 61 cycles"):
        BATCH.settings([long], None, "native")
    motor = {"operating.source": "torque", "operating.shaft_stiffness": "1e5 N*m/rad"}
    motor |= {"operating.drive_inertia": "0.1 kg*m**2"}
    cases = [case_at(1480), case_at(1480, **motor)]
    rows = BATCH.evaluate(Chunk(np.arange(2), tuple(cases)), BATCH.settings(cases[:1], 4, "native"), 1)
    assert rows["status"].tolist() == [DONE, FAILED]
    assert "has states that none of the cases has" in rows["message"][1]


def held(**keys):
    """The reducer with helical teeth, whose bodies move along their axes and tilt."""
    return {"stage.0.helix_angle": "20 deg", "mesh.slices": 5, **keys}


@pytest.mark.parametrize(
    "different",
    [
        ({}, {"stage.1.azimuth": "90 deg"}, TURNED),
        (
            held(),
            held(**{"gear.pinion-1.hand": "left", "gear.wheel-1.hand": "right"}),
            held(**{"bearings.default.stiffness_axial": "3e7 N/m"}),
        ),
    ],
    ids=["places", "in-space"],
)
def test_a_case_does_not_start_from_where_another_stands(different):
    """Trains that differ in the place of an axis, in how gears of a shaft are turned, in hand or bearings."""
    evaluate = import_module("tribodyn.studies.motion.batch.evaluate")
    cases = [case_at(1480, **keys) for keys in different]
    settings = BATCH.settings(cases, None, "native")
    ready = [prepare(case) for case in cases]

    def starts(order):
        evaluate._equilibria.cache_clear()
        return {i: evaluate._start(ready[i], settings).tobytes() for i in order}

    together = starts([0, 1, 2])
    assert together == starts([2, 1, 0]) == {**starts([0]), **starts([1]), **starts([2])}
    assert len(set(together.values())) == 3
