import numpy as np
import pytest

from tests.support.pair_outputs import outputs
from tests.support.states import PAIR, TURN_G, altered, random_place, random_state
from tribodyn.dynamics.approach import DRIVEN_SPEED, DRIVER_SPEED, PEAK, RADIUS, RELATIVE_VELOCITY, SLIDING
from tribodyn.dynamics.contact_forces import contact_forces, reversals_per_velocity
from tribodyn.dynamics.mesh_motion import motion_of, place_in_mesh
from tribodyn.dynamics.recorded.extremes import (
    BACK,
    COUNT,
    DRIVING,
    END,
    ERROR_DOWN,
    ERROR_UP,
    EXTREME,
    EXTREMES,
    FILM,
    FORCE,
    LOAD,
    LOWEST,
    MIDDLE,
    NEWEST_DOWN,
    NEWEST_UP,
    OF_MESH,
    OF_PAIR,
    PRESSURE,
    RATE,
    ROWS,
    SEEN,
    START,
    TEMPERATURE,
    alike,
    begin_surfaces,
    extreme_of,
    highest_loaded,
    measure,
    measure_end,
    measure_inside,
    measures_of,
    no_extremes,
    take_in,
    vertex,
)
from tribodyn.dynamics.recorded.outputs import evaluated_with_extremes
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.march.extreme_search import UNKNOWN, begin_rates, promising, rate_of, worthwhile
from tribodyn.solve.right_hand_side import contacts_of, work_array
from tribodyn.studies.motion.record import recorded

OVERRIDES = [
    {},
    {"friction.sliding": "dynamic"},
    {"friction.law": "coulomb", "friction.coefficient": 0.08},
    {"mesh.backlash": "12 um"},
]


def fill(phase, interval, y, model, work):
    """Contacts of the only mesh."""
    mesh = model.meshes[0]
    place, motion = place_in_mesh(0, phase, interval, model), motion_of(0, y, model)
    contact_forces(place, motion, reversals_per_velocity(1.0, mesh, model), mesh, model, work[0])
    return place


@pytest.mark.parametrize("overrides", OVERRIDES)
def test_measures_are_what_is_recorded(overrides, prepared, rng):
    """So that where a measure is largest the recorded quantity is extreme."""
    model = prepared("crc-23-47", **overrides).model
    sides = model.meshes[0].table.side
    slots = {side: np.flatnonzero(sides * sign > 0) for side, sign in ((DRIVING, 1), (BACK, -1))}
    for _ in range(20):
        y = random_state(rng, model)
        phase, segment = random_place(rng, model.schedule)
        work, found = contacts_of(model), np.full(measures_of(len(sides)), LOWEST)
        fill(phase, segment, y, model, work)
        measure(phase, segment, y, model, work, found)
        recorded = {name: values[0] for name, values in outputs(np.array([phase]), y[None], model).items()}
        assert found[ERROR_UP] == -found[ERROR_DOWN] == recorded["transmission_error_rotational"]
        along = recorded["normal_load"] * np.cos(np.nan_to_num(recorded["pressure_angle"]))
        for side, mine in slots.items():
            np.testing.assert_allclose(found[side + FORCE], np.sum(along[mine]), rtol=1e-12)
            if mine.size:
                newest = recorded["transmission_error_normal"][mine[-1]]
                both = [found[side + NEWEST_UP], -found[side + NEWEST_DOWN]]
                np.testing.assert_allclose(both, newest, rtol=1e-12)
        for pair in np.flatnonzero(recorded["normal_load"] > 0.0):
            first = OF_MESH + OF_PAIR * int(pair)
            for row, sign, name in (
                (LOAD, 1, "normal_load"),
                (FILM, -1, "central_film_thickness"),
                (TEMPERATURE, 1, "flash_temperature_rise"),
            ):
                np.testing.assert_allclose(sign * found[first + row], recorded[name][pair], rtol=1e-12)
            squared = found[first + PRESSURE] * model.meshes[0].surfaces.effective_modulus / (2.0 * np.pi)
            np.testing.assert_allclose(np.sqrt(squared), recorded["hertz_pressure"][pair], rtol=1e-12)


@pytest.mark.parametrize("sliding", ["kinematic", "dynamic"])
def test_surfaces_are_those_of_the_highest_line_load(sliding, prepared, rng):
    """Of a face on which the highest line load is 1.3 times the mean."""
    even = prepared("crc-23-47", **{"friction.sliding": sliding}).model
    table = even.meshes[0].table
    channel = np.array(table.channel)
    channel[..., PEAK, :] = [1.3, 0.0, 0.0, 0.0]
    model = altered(even, mesh={"table": table._replace(channel=channel)})
    mesh = model.meshes[0]
    loaded = 0
    for _ in range(3):
        y = random_state(rng, model)
        phase, segment = random_place(rng, model.schedule)
        works = contacts_of(model)
        place, work = fill(phase, segment, y, model, works), works[0]
        recorded = {name: values[0] for name, values in outputs(np.array([phase]), y[None], model).items()}
        for i in np.flatnonzero(recorded["normal_load"] > 0.0):
            contact = highest_loaded(i, place, mesh, model, work)
            line_load = 1.3 * recorded["normal_load"][i] / table.slice_width
            assert contact.line_load == pytest.approx(line_load, rel=1e-12)
            assert 1.0 / contact.curvature == pytest.approx(work[RADIUS, i], rel=1e-12)
            speeds = work[DRIVER_SPEED, i], work[DRIVEN_SPEED, i]
            assert contact.entrainment == pytest.approx(np.mean(speeds), rel=1e-12)
            assert (contact.pinion_speed, contact.gear_speed) == speeds
            assert contact.sliding == work[RELATIVE_VELOCITY if sliding == "dynamic" else SLIDING, i]
            pressure = np.sqrt(line_load * mesh.surfaces.effective_modulus / (2 * np.pi * work[RADIUS, i]))
            assert recorded["hertz_pressure"][i] == pytest.approx(pressure, rel=1e-12)
            loaded += 1
    assert loaded > 1


def test_every_measure_has_its_extreme():
    """Of two meshes, those of the second behind those of the first."""
    of_mesh = measures_of(3)
    of = [extreme_of(row, of_mesh) for row in range(2 * of_mesh)]
    of_one = [*range(OF_MESH), *(3 * list(range(OF_MESH, EXTREMES)))]
    assert of == [*of_one, *(EXTREMES + which for which in of_one)]
    for row, its_own in enumerate(of):
        assert list(alike(row, of_mesh)) == [other for other in range(len(of)) if of[other] == its_own]


def test_vertex_of_a_parabola_is_exact(rng):
    for top, height, bend in rng.uniform([0.05, -3.0, 0.1], [0.95, 3.0, 9.0], (50, 3)):
        start, middle, end = (height - bend * (share - top) ** 2 for share in (0.0, 0.5, 1.0))
        assert vertex(start, middle, end) == (pytest.approx(top), pytest.approx(height))


@pytest.mark.parametrize(
    "values", [(0.0, 1.0, 2.0), (2.0, 1.0, 0.0), (1.0, 0.0, 1.0), (1.0, 1.0, 1.0), (LOWEST,) * 3]
)
def test_no_vertex_where_the_parabola_is_not_highest_inside(values):
    assert vertex(*values) == (0.0, values[0])


def test_a_step_is_looked_into_where_a_parabola_passes_the_extreme(rng):
    looked = 0
    for top, height, bend, short in rng.uniform([-2.0, -3.0, 0.1, 0.0], [3.0, 3.0, 9.0, 0.2], (500, 4)):
        before, start, end = (height - bend * (share - top) ** 2 for share in (-1.0, 0.0, 1.0))
        extreme = max(start, end) + short * bend
        passes = 0.0 < top < 1.0 and height > extreme + 1e-6 * abs(extreme)
        found = promising(start, end, start - before, extreme)
        assert found or not passes
        looked += found
        if not -0.5 < top < 1.5:
            assert not found
    assert looked > 20


def loaded_search(prepared, **overrides):
    """A model at rest in its static equilibrium, and a search that has just begun there; phase, segment."""
    model = prepared("crc-23-47", **overrides).model
    measures, work = np.full((ROWS, measures_of(2)), LOWEST), work_array(model)
    y, place = static_equilibrium(model), (0.3 * float(model.meshes[0].table.boundary[1]), 0)
    fill(*place, y, model, work)
    measure(*place, y, model, work, measures[START])
    measures[EXTREME], measures[SEEN, COUNT] = 1e100, 0.0
    begin_surfaces(*place, model, measures)
    return model, measures, work, y, place


def of_both(measures, row, column):
    """What a row has in a column of both pairs, as a view."""
    return measures[row, OF_MESH:].reshape(2, OF_PAIR)[:, column]


def evaluated(model, measures, work, y, place, steps, step=1e-3):
    """Which of so many steps evaluate the laws of both pairs, as columns; nothing moves."""
    phase, segment = place
    found = []
    for _ in range(steps):
        phase += step
        measure_end(False, phase, step, segment, y, model, work, measures)
        found.append(of_both(measures, END, FILM) > LOWEST)
    return np.array(found)


def test_far_from_extremes_laws_are_evaluated_at_every_fourth_step(prepared):
    search = loaded_search(prepared)
    assert np.flatnonzero(evaluated(*search, 13)[:, 0]).tolist() == [0, 3, 7, 11]


@pytest.mark.parametrize("near", [0, 1])
def test_a_pair_is_evaluated_where_its_own_surfaces_may_become_extreme(near, prepared):
    """At twice the faster of the last two rates, before the end of the next step."""
    model, measures, work, y, place = loaded_search(prepared)
    step, values = 1e-3, measures[START].copy()
    for short, steps in ((4.6, [0, 2, 3]), (2.6, [0, 1, 2, 3])):
        begin_surfaces(*place, model, measures)
        measures[SEEN, COUNT] = 0.0
        measures[EXTREME] = 1e100
        column = OF_MESH + OF_PAIR * near + TEMPERATURE
        rate = 0.01 * abs(values[column]) / step
        measures[EXTREME, column] = values[column] + short * rate * step
        measures[SEEN, column] = values[column] - rate * step
        found = evaluated(model, measures, work, y, place, 4, step)
        assert np.flatnonzero(found[:, near]).tolist() == steps
        assert np.flatnonzero(found[:, 1 - near]).tolist() == [0, 3]


def test_inside_a_step_surfaces_are_measured_where_both_ends_are(prepared):
    model, measures, work, y, place = loaded_search(prepared)
    surfaces = [OF_MESH + OF_PAIR * i + j for i in range(2) for j in (FILM, TEMPERATURE)]
    measures[END] = measures[START]
    measure_inside(False, MIDDLE, *place, y, model, work, measures)
    np.testing.assert_array_equal(measures[MIDDLE], measures[START])
    for row in (START, END):
        kept = measures.copy()
        measures[row, OF_MESH + OF_PAIR + FILM] = LOWEST
        measure_inside(False, MIDDLE, *place, y, model, work, measures)
        known = measures[MIDDLE, surfaces] > LOWEST
        np.testing.assert_array_equal(known, [True] * 2 + [False] * 2)
        measures[:] = kept


def test_a_parabola_of_twice_the_bend_decides(rng):
    """Its highest point from very many places in the step."""
    share = np.linspace(0.0, 1.0, 20001)
    for start, end, before in rng.uniform(-1.0, 1.0, (100, 3)):
        bend = 2.0 * abs((end - start) - before)
        highest = np.max(start + (end - start) * share + 0.5 * bend * share * (1.0 - share))
        if highest > max(start, end) + 1e-3:
            assert promising(start, end, before, highest - 1e-5)
        assert not promising(start, end, before, highest + 1e-5)


@pytest.mark.parametrize("size", [1e-7, 1.0, 1e9])
def test_a_value_is_worth_an_evaluation_by_its_share_above_the_extreme(size):
    """In any unit, of either sign: the film is measured by −h."""
    for extreme in (size, -size):
        assert worthwhile(extreme + 2e-7 * size, extreme)
        assert not worthwhile(extreme + 5e-8 * size, extreme)


def test_a_rate_is_known_where_both_ends_are():
    assert rate_of(1.0, 3.0, 10.0) == 20.0
    assert rate_of(LOWEST, 3.0, 10.0) == rate_of(1.0, LOWEST, 10.0) == UNKNOWN


def test_at_the_start_of_a_segment_measures_are_as_fast_as_any_alike_were():
    """Twice that, of the slots of pairs together; unknown where nothing has been found yet."""
    measures, extreme = np.zeros((ROWS, measures_of(2))), np.zeros(EXTREMES)
    first, second = OF_MESH + LOAD, OF_MESH + OF_PAIR + LOAD
    extreme[FORCE] = LOWEST
    measures[RATE, [ERROR_UP, FORCE, first, second]] = [-3.0, 5.0, UNKNOWN, -2.0]
    measures[RATE, [first + FILM, second + FILM]] = UNKNOWN
    begin_rates(measures, extreme, measures.shape[1], PAIR)
    assert measures[RATE, [ERROR_UP, ERROR_DOWN, FORCE]].tolist() == [6.0, 0.0, UNKNOWN]
    assert measures[RATE, [first, second]].tolist() == [4.0, 4.0]
    assert measures[RATE, [first + FILM, second + FILM]].tolist() == [UNKNOWN, UNKNOWN]


def test_nothing_is_looked_into_where_an_end_is_not_known():
    assert not promising(LOWEST, 1.0, 1e150, 0.5)
    assert not promising(1.0, LOWEST, 1e150, 0.5)
    assert promising(1.0, 1.0, 1e150, 2.0)


def test_each_side_of_a_boundary_is_recorded_as_its_segment_has_it(prepared, rng):
    """Also at the end of a mesh cycle, whose phase is 0 in the next one."""
    model = prepared("crc-23-47").model
    boundary = np.asarray(model.meshes[0].table.boundary)
    last = len(boundary) - 2
    for _ in range(5):
        y = random_state(rng, model)
        extremes = no_extremes(PAIR)
        for row, (cycles, segment) in enumerate([(4.0, last), (4.0, 0), (3.0 + boundary[1], 0)]):
            extremes.measure[row], extremes.cycles[row], extremes.interval[row] = 0.0, cycles, segment
            extremes.state[row] = y
        near = 1e-9
        beside = np.array([4.0 - near, 4.0 + near, 3.0 + boundary[1] - near])
        expected = outputs(beside, np.tile(y, (3, 1)), model)
        _, _, extreme = evaluated_with_extremes(np.array([2.5]), y[None], extremes, model)
        found = recorded(extreme)
        assert extreme.cycles.tolist() == [4.0, 4.0, 3.0 + boundary[1]]
        for name in ("normal_load", "central_film_thickness", "pressure_angle", "time"):
            np.testing.assert_allclose(found[name], expected[name], rtol=1e-4, err_msg=name)


def test_the_more_extreme_is_taken():
    ours, theirs = no_extremes(PAIR), no_extremes(PAIR)
    ours.measure[:2], theirs.measure[:2] = [1.0, 4.0], [2.0, 3.0]
    theirs.state[:, TURN_G] = 7.0
    take_in(ours, theirs)
    assert ours.measure[:3].tolist() == [2.0, 4.0, LOWEST]
    assert ours.state[:3, TURN_G].tolist() == [7.0, 0.0, 0.0]
    assert ours.state.shape == (EXTREMES, PAIR.states)
