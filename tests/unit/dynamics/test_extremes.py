import numpy as np
import pytest

from tests.support.closures import LIU_NI, VECIANA, under
from tests.support.states import random_place, random_state
from tribodyn.dynamics.contact_forces import (
    GEAR_SPEED,
    NORMAL_LOAD,
    PEAK,
    PINION_SPEED,
    RADIUS,
    RELATIVE_VELOCITY,
    SLIDING,
    contact_forces,
)
from tribodyn.dynamics.equations import locate
from tribodyn.dynamics.extremes import (
    BACK,
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
    ROOM,
    ROWS,
    SEEN,
    SEEN_LOAD,
    SEEN_SLIDING,
    START,
    TEMPERATURE,
    THICK,
    THINNER,
    alike,
    extreme_of,
    highest_loaded,
    measure,
    measure_end,
    measure_inside,
    measures_of,
    no_extremes,
    see_surfaces,
    take_in,
    vertex,
)
from tribodyn.dynamics.outputs import outputs, outputs_with_extremes
from tribodyn.dynamics.parameters import STATES, XI
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.march.extreme_search import UNKNOWN, begin_rates, promising, rate_of
from tribodyn.solve.right_hand_side import work_array
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.film import FILM_LAWS, film_law
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import FARTHEST, MOST_SLIDING, Worse, steepness_not_stated
from tribodyn.tribology.surface_state import film_and_temperature

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
                (TEMPERATURE, 1, "flash_temperature_rise"),
            ):
                np.testing.assert_allclose(sign * found[first + row], recorded[name][pair], rtol=1e-12)
            squared = found[first + PRESSURE] * model.surfaces.effective_modulus / (2.0 * np.pi)
            np.testing.assert_allclose(np.sqrt(squared), recorded["hertz_pressure"][pair], rtol=1e-12)


@pytest.mark.parametrize("sliding", ["kinematic", "dynamic"])
def test_surfaces_are_those_of_the_highest_line_load(sliding, prepared, rng):
    """Of a face on which the highest line load is 1.3 times the mean."""
    even = prepared("crc-23-47", **{"friction.sliding": sliding}).model
    channel = np.array(even.table.channel)
    channel[..., PEAK, :] = [1.3, 0.0, 0.0, 0.0]
    model = even._replace(table=even.table._replace(channel=channel))
    loaded = 0
    for _ in range(3):
        y = random_state(rng)
        phase, segment = random_place(rng, model.table.boundary)
        place = locate(phase, segment, model.table)
        work: dict = {}
        contact_forces(segment, *place, y, model, work)
        recorded = {name: values[0] for name, values in outputs(np.array([phase]), y[None], model).items()}
        for i in np.flatnonzero(recorded["normal_load"] > 0.0):
            contact = highest_loaded(i, segment, *place[:2], model, work)
            line_load = 1.3 * recorded["normal_load"][i] / model.table.face_width
            assert contact.line_load == pytest.approx(line_load, rel=1e-12)
            assert 1.0 / contact.curvature == pytest.approx(work[RADIUS, i], rel=1e-12)
            speeds = work[PINION_SPEED, i], work[GEAR_SPEED, i]
            assert contact.entrainment == pytest.approx(np.mean(speeds), rel=1e-12)
            assert (contact.pinion_speed, contact.gear_speed) == speeds
            assert contact.sliding == work[RELATIVE_VELOCITY if sliding == "dynamic" else SLIDING, i]
            pressure = np.sqrt(line_load * model.surfaces.effective_modulus / (2 * np.pi * work[RADIUS, i]))
            assert recorded["hertz_pressure"][i] == pytest.approx(pressure, rel=1e-12)
            loaded += 1
    assert loaded > 1


def test_every_measure_has_its_extreme():
    of = [extreme_of(row) for row in range(measures_of(3))]
    assert of == [*range(OF_MESH), *(3 * list(range(OF_MESH, EXTREMES)))]
    for row, its_own in enumerate(of):
        assert list(alike(row, len(of))) == [other for other in range(len(of)) if of[other] == its_own]


def test_vertex_of_a_parabola_is_exact(rng):
    for top, height, bend in rng.uniform([0.05, -3.0, 0.1], [0.95, 3.0, 9.0], (50, 3)):
        start, middle, end = (height - bend * (share - top) ** 2 for share in (0.0, 0.5, 1.0))
        assert vertex(start, middle, end) == (pytest.approx(top), pytest.approx(height))


@pytest.mark.parametrize(
    "values", [(0.0, 1.0, 2.0), (2.0, 1.0, 0.0), (1.0, 0.0, 1.0), (1.0, 1.0, 1.0), (LOWEST,) * 3]
)
def test_no_vertex_where_the_parabola_is_not_highest_inside(values):
    assert vertex(*values) == (0.0, values[0])


def test_surfaces_that_are_left_out_are_not_extreme(prepared, rng):
    """From random states to others near by, with extremes that both have not reached, or only just."""
    model = prepared("crc-23-47").model
    pairs = model.table.side.shape[0]
    surfaces = [OF_MESH + OF_PAIR * i + j for i in range(pairs) for j in (FILM, TEMPERATURE)]
    left_out = 0
    for above in np.geomspace(1e-3, 1.0, 40):
        measures, work, full = np.full((ROWS, measures_of(pairs)), LOWEST), work_array(model), {}
        y, (phase, segment) = random_state(rng), random_place(rng, model.table.boundary)
        contact_forces(segment, *locate(phase, segment, model.table), y, model, work)
        measure(phase, segment, y, model, work, measures[START])
        measures[EXTREME] = measures[START] + above * np.abs(measures[START])
        see_surfaces(phase, segment, model, work, measures)
        near = y * (1.0 + rng.uniform(-0.1, 0.1))
        contact_forces(segment, *locate(phase, segment, model.table), near, model, work)
        measure_end(False, phase, segment, near, model, work, measures)
        measure(phase, segment, near, model, work, full)
        for j in set(surfaces) & full.keys():
            known = measures[END, j] > LOWEST
            left_out += not known
            assert full[j] == measures[END, j] if known else full[j] <= measures[EXTREME, j]
    assert left_out > 20


STATED = [
    *((film, "coulomb") for film in FILM_LAWS if film_law(film).steepness is not steepness_not_stated),
    *(("masjedi-khonsari", friction) for friction in FRICTION_LAWS if friction.startswith("masjedi")),
    ("masjedi-khonsari", "xu"),
    ("masjedi-khonsari", "benedict-kelley"),
]


@pytest.mark.parametrize(("film", "friction"), STATED)
@pytest.mark.parametrize("given", [LIU_NI, VECIANA], ids=["liu-ni", "veciana"])
def test_no_law_is_steeper_than_it_says(film, friction, given, rng):
    """From contacts of gears to others that are worse in some respects and better in others."""
    count = 4000
    values: dict[str, float] = {"coefficient": 0.05} if friction == "coulomb" else {}
    laws = under(friction, given, film, **values)

    def contact_of(load, curvature, entrainment, sliding):
        speeds = entrainment + 0.5 * sliding, entrainment - 0.5 * sliding
        return local_contact(load, curvature, entrainment, sliding, *speeds)

    low, high = np.log([1e3, 10.0, 0.05, 1e-6]), np.log([2e6, 400.0, 20.0, MOST_SLIDING])
    load, curvature, entrainment, ratio = np.exp(rng.uniform(low, high, (count, 4)).T)
    sliding = ratio * entrainment
    # shares by which load, curvature and entrainment are worse; sliding by any
    worse = rng.dirichlet(np.full(3, 0.5), count).T * rng.uniform(0.0, FARTHEST, count)
    faster = np.exp(rng.uniform(0.0, np.log(MOST_SLIDING / ratio))) - 1.0
    up_or_down = rng.choice([-1.0, 1.0], (3, count))
    up_or_down[0] = 1.0
    factors = np.append(1.0 + up_or_down * worse, [1.0 + faster], axis=0)
    better = np.exp(-rng.exponential(0.5, (4, count)))
    is_better = rng.random((4, count)) < 0.3
    is_better[1:3] = False  # more or less curvature or entrainment: either is worse
    factors = np.where(is_better, better, factors)
    worse, faster = np.where(is_better[:3], 0.0, worse), np.where(is_better[3], 0.0, faster)
    after = np.array([load, curvature, entrainment, sliding]) * factors
    holds = after[3] <= MOST_SLIDING * after[2]
    assert np.mean(holds) > 0.5
    contact_before, contact = contact_of(load, curvature, entrainment, sliding), contact_of(*after)
    thickness, temperature = film_and_temperature(contact_before, *laws)
    thin, warm = film_and_temperature(contact, *laws)
    no = np.zeros(count)
    for before, now, of in ((-thickness, -thin, laws.film), (temperature, warm, laws.friction)):
        steepness, unchanged = of.functions.steepness, Worse(no, no, no, no)
        most = steepness(Worse(*worse, faster), contact, laws.surfaces, of.parameters)
        stated = steepness(unchanged, contact_before, laws.surfaces, of.parameters) < np.inf
        known = holds & stated & np.isfinite(most)
        change = ((now - before)[known]) / np.abs(before[known])
        assert np.all(change <= most[known] + 1e-9)
        assert np.max(change) > 0.1
        assert np.mean(known) > 0.1


def test_a_law_that_says_no_steepness_is_evaluated_at_every_step(prepared):
    model, measures, work, y, place = loaded_search(prepared)
    friction = model.options.friction._replace(steepness=steepness_not_stated)
    model = model._replace(options=model.options._replace(friction=friction))
    measure_end(False, *place, y, model, work, measures)
    assert np.all(measures[END] == measures[START])


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
    y, place = static_equilibrium(model), (0.3 * float(model.table.boundary[1]), 0)
    contact_forces(place[1], *locate(*place, model.table), y, model, work)
    measure(*place, y, model, work, measures[START])
    measures[EXTREME] = 1e100
    see_surfaces(*place, model, work, measures)
    return model, measures, work, y, place


def of_both(measures, row, column):
    """What a row has in a column of both pairs, as a view."""
    return measures[row, OF_MESH:].reshape(2, OF_PAIR)[:, column]


def test_a_contact_is_worse_by_load_curvature_entrainment_and_sliding(prepared):
    """By what has changed for the worse, over what it was; the better counts nothing."""
    model, measures, work, y, place = loaded_search(prepared)

    def steepness(worse, contact, surfaces, parameters):
        return np.array([3.0, 0.5, 0.7, 0.1]) @ worse

    film = model.options.film._replace(steepness=steepness)
    model = model._replace(options=model.options._replace(film=film))
    carrying = np.flatnonzero(work[NORMAL_LOAD] > 0.0)
    before = measures.copy()
    for factors, thinner in (
        ([1.1, 1.0, 1.0, 1.0], 0.3),
        ([1.0, 1.05, 1.0, 1.0], 0.025),
        ([1.0, 0.95, 1.0, 1.0], 0.025),
        ([1.0, 1.0, 0.8, 1.0], 0.14),
        ([1.0, 1.0, 1.2, 1.0], 0.14),
        ([1.0, 1.0, 1.0, 4.0], 0.3),
        ([1.1, 1.1, 1.1, 1.1], 0.43),
        ([0.5, 1.0, 1.0, 0.5], 0.0),
        ([1.6, 1.0, 1.0, 1.0], None),
        ([1.0, 1.6, 1.0, 1.0], None),
        ([1.0, 1.0, 0.4, 1.0], None),
        ([1.2, 1.2, 0.8, 1.0], None),
    ):
        measures[:] = before
        measures[SEEN, OF_MESH:] *= np.tile(factors, 2)
        measure_end(False, *place, y, model, work, measures)
        left_out = measures[END, OF_MESH + FILM] == LOWEST
        assert left_out == (thinner is not None), factors
        if left_out:
            assert of_both(measures, ROOM, THINNER)[carrying] == pytest.approx(thinner, abs=1e-12)


def test_a_contact_that_slides_far_is_evaluated(prepared):
    """There no law is bound by its steepness."""
    model, measures, work, y, place = loaded_search(prepared)
    for most, left_out in ((0.999, True), (1.001, False)):
        speed = work[PINION_SPEED] + work[GEAR_SPEED]
        work[SLIDING] = work[RELATIVE_VELOCITY] = most * MOST_SLIDING * 0.5 * np.abs(speed)
        measures[SEEN, OF_MESH + SEEN_SLIDING :: OF_PAIR] = 1e-3
        measure_end(False, *place, y, model, work, measures)
        assert (measures[END, OF_MESH + FILM] == LOWEST) == left_out


def test_another_change_as_large_as_the_last_is_allowed_for(prepared):
    model, measures, work, y, place = loaded_search(prepared)
    seen, room = of_both(measures, SEEN, SEEN_LOAD), of_both(measures, ROOM, THICK)
    seen *= 1.2
    no = np.zeros(3)
    change = model.options.film.steepness(Worse(0.2, *no), None, model.surfaces, model.film)
    room[:] = 1.5 * change
    before = measures.copy()
    for thinner, left_out in ((change, True), (0.6 * change, True), (0.4 * change, False), (0.0, False)):
        measures[:] = before
        of_both(measures, ROOM, THINNER)[:] = thinner
        measure_end(False, *place, y, model, work, measures)
        assert (measures[END, OF_MESH + FILM] == LOWEST) == left_out
    assert of_both(measures, ROOM, THINNER)[0] == 0.0  # it has been evaluated
    assert 1.2 * seen[0] == pytest.approx(before[SEEN, OF_MESH + SEEN_LOAD])


@pytest.mark.parametrize("near", [0, 1])
def test_each_pair_is_measured_where_its_own_surfaces_are_near(near, prepared):
    model, measures, work, y, place = loaded_search(prepared)
    surfaces = [[OF_MESH + OF_PAIR * i + j for j in (FILM, TEMPERATURE)] for i in range(2)]
    measures[EXTREME, surfaces[near]] = measures[START, surfaces[near]]
    see_surfaces(*place, model, work, measures)
    of_both(measures, SEEN, SEEN_LOAD)[:] *= 1.01
    measure_end(False, *place, y, model, work, measures)
    assert np.all(measures[END, surfaces[near]] == measures[START, surfaces[near]])
    assert np.all(measures[END, surfaces[1 - near]] == LOWEST)


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
    begin_rates(measures, extreme, measures.shape[1])
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
