import numpy as np
import pytest

from tests.support.states import random_place, random_state
from tribodyn.dynamics.contact_forces import contact_forces
from tribodyn.dynamics.equations import locate
from tribodyn.dynamics.extremes import (
    BACK,
    DRIVING,
    ERROR_DOWN,
    ERROR_UP,
    EXTREMES,
    FILM,
    FORCE,
    LOAD,
    LOWEST,
    NEWEST_DOWN,
    NEWEST_UP,
    OF_MESH,
    OF_PAIR,
    PRESSURE,
    TEMPERATURE,
    extreme_of,
    measure,
    measures_of,
    no_extremes,
    take_in,
    vertex,
)
from tribodyn.dynamics.outputs import outputs, outputs_with_extremes
from tribodyn.dynamics.parameters import STATES, XI

OVERRIDES = [
    {},
    {"friction.sliding": "dynamic"},
    {"friction.law": "coulomb", "friction.coefficient": 0.08},
    {"mesh.backlash": "12 um"},
]


@pytest.mark.parametrize("overrides", OVERRIDES)
def test_measures_are_what_is_recorded(overrides, prepared, rng):
    """So that where a measure is largest the recorded quantity is extreme."""
    model = prepared("crc-23-47", **overrides).model
    slots = {side: np.flatnonzero(model.table.side * sign > 0) for side, sign in ((DRIVING, 1), (BACK, -1))}
    for _ in range(20):
        y = random_state(rng)
        phase, segment = random_place(rng, model.table.boundary)
        work, found = {}, {}
        contact_forces(segment, *locate(phase, segment, model.table), y, model, work)
        measure(phase, segment, y, model, work, found)
        recorded = {name: values[0] for name, values in outputs(np.array([phase]), y[None], model).items()}
        assert found[ERROR_UP] == -found[ERROR_DOWN] == recorded["transmission_error_rotational"]
        along = recorded["normal_load"] * np.cos(np.nan_to_num(recorded["pressure_angle"]))
        for side, mine in slots.items():
            np.testing.assert_allclose(found[side + FORCE], np.sum(along[mine]), rtol=1e-12)
            if mine.size:
                newest = recorded["transmission_error"][mine[-1]]
                both = [found[side + NEWEST_UP], -found[side + NEWEST_DOWN]]
                np.testing.assert_allclose(both, newest, rtol=1e-12)
        for pair in np.flatnonzero(recorded["normal_load"] > 0.0):
            first = OF_MESH + OF_PAIR * int(pair)
            for row, sign, name in (
                (LOAD, 1, "normal_load"),
                (FILM, -1, "central_film_thickness"),
                (PRESSURE, 1, "hertz_pressure"),
                (TEMPERATURE, 1, "flash_temperature_rise"),
            ):
                np.testing.assert_allclose(sign * found[first + row], recorded[name][pair], rtol=1e-12)


def test_every_measure_has_its_extreme():
    of = [extreme_of(row) for row in range(measures_of(3))]
    assert of == [*range(OF_MESH), *(3 * list(range(OF_MESH, EXTREMES)))]


def test_vertex_of_a_parabola_is_exact(rng):
    for top, height, bend in rng.uniform([0.05, -3.0, 0.1], [0.95, 3.0, 9.0], (50, 3)):
        start, middle, end = (height - bend * (share - top) ** 2 for share in (0.0, 0.5, 1.0))
        assert vertex(start, middle, end) == (pytest.approx(top), pytest.approx(height))


@pytest.mark.parametrize(
    "values", [(0.0, 1.0, 2.0), (2.0, 1.0, 0.0), (1.0, 0.0, 1.0), (1.0, 1.0, 1.0), (LOWEST,) * 3]
)
def test_no_vertex_where_the_parabola_is_not_highest_inside(values):
    assert vertex(*values) == (0.0, values[0])


def test_each_side_of_a_boundary_is_recorded_as_its_segment_has_it(prepared, rng):
    """Also at the end of a mesh cycle, whose phase is 0 in the next one."""
    model = prepared("crc-23-47").model
    boundary = np.asarray(model.table.boundary)
    last = len(boundary) - 2
    for _ in range(5):
        y = random_state(rng)
        extremes = no_extremes()
        for row, (cycles, segment) in enumerate([(4.0, last), (4.0, 0), (3.0 + boundary[1], 0)]):
            extremes.measure[row], extremes.cycles[row], extremes.segment[row] = 0.0, cycles, segment
            extremes.state[row] = y
        near = 1e-9
        beside = np.array([4.0 - near, 4.0 + near, 3.0 + boundary[1] - near])
        expected = outputs(beside, np.tile(y, (3, 1)), model)
        _, found, at = outputs_with_extremes(np.array([2.5]), y[None], extremes, model)
        assert at.tolist() == [4.0, 4.0, 3.0 + boundary[1]]
        for name in ("normal_load", "central_film_thickness", "pressure_angle", "time"):
            np.testing.assert_allclose(found[name], expected[name], rtol=1e-4, err_msg=name)


def test_the_more_extreme_is_taken():
    ours, theirs = no_extremes(), no_extremes()
    ours.measure[:2], theirs.measure[:2] = [1.0, 4.0], [2.0, 3.0]
    theirs.state[:, XI] = 7.0
    take_in(ours, theirs)
    assert ours.measure[:3].tolist() == [2.0, 4.0, LOWEST]
    assert ours.state[:3, XI].tolist() == [7.0, 0.0, 0.0]
    assert ours.state.shape == (EXTREMES, STATES)
