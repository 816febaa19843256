"""Tables of the solved contact: polynomials, error, cache, the duty of a mesh, and laws that read them."""

import math
import sys
from dataclasses import replace

import numpy as np
import pytest

from tests.support.closures import LIU_NI, under
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tribodyn.errors import InputError, SimulationError
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.tribology.closure import closure, duty_range
from tribodyn.tribology.contact import DutyRange, local_contact
from tribodyn.tribology.ehl import table as tables
from tribodyn.tribology.ehl.coupled import solve_coupled
from tribodyn.tribology.ehl.lookup import TERMS, mixed_friction
from tribodyn.tribology.ehl.lookup import clipped as clipped_at
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.film.solved import solved_film
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.friction.solved import solved_friction
from tribodyn.tribology.surface_state import surface_state

DUTY = DutyRange((1e5, 6e5), (0.1, 0.2), (100.0, 130.0), (0.02, 0.8))


def film_of(load, speed, curvature):
    return 2e-6 * speed**0.7 * load**-0.13 * curvature**-0.3


def power_laws(contact, duties):
    """A film and a film's friction of powers, and a constant share, in place of solved contacts."""
    load, speed, curvature, ratio = np.exp(duties).T
    friction = 0.25 * contact.roughness.friction + 0.03 * ratio**0.2
    return np.array([np.log(film_of(load, speed, curvature)), np.log(friction), 0.25 + 0.0 * load]).T


@pytest.fixture
def by_powers(monkeypatch, tmp_path):
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path))
    monkeypatch.setattr(tables, "solve_all", power_laws)
    tables.table_over.cache_clear()
    yield
    tables.table_over.cache_clear()


def test_laws_read_what_the_table_was_made_of(by_powers):
    given = LIU_NI._replace(duty=lambda: DUTY)
    laws = closure(given, FILM_LAWS["solved"], FRICTION_LAWS["solved"])
    assert laws.film.parameters.film_error < 1e-3
    assert laws.friction.parameters.friction_error < 1e-3
    state = surface_state(local_contact(3e5, 110.0, 0.15, -0.06, 0.12, 0.18), laws)
    assert state.central_film_thickness == pytest.approx(film_of(3e5, 0.15, 110.0), rel=1e-3)
    rubbing = tables.contact_of(LIU_NI).roughness.friction
    assert state.friction_coefficient == pytest.approx(0.25 * rubbing + 0.03 * 0.4**0.2, rel=1e-3)
    assert state.asperity_load_ratio == pytest.approx(0.25, abs=1e-3)
    # beyond its range a table is held at its end
    beyond = surface_state(local_contact(6e6, 110.0, 0.15, 0.06, 0.18, 0.12), laws)
    assert beyond.central_film_thickness == pytest.approx(film_of(6e5, 0.15, 110.0), rel=1e-3)


def test_contacts_crowd_along_the_path():
    """Curvature and slide-to-roll ratio of a place belong together, at every load and speed of the range."""
    place = np.linspace(-1.0, 1.0, 41)
    places = [(0.15 + 0.02 * at, 200.0 * math.exp(at), 0.7 * abs(at)) for at in place]
    duty = DutyRange((1e5, 6e5), (0.13 * 0.8, 0.17 * 1.2), (73.0, 550.0), (0.02, 0.8), tuple(places))
    found, along = tables.spread(duty, 120)
    assert np.mean(along) == pytest.approx(1 - 1 / tables.BOXED, abs=0.01)
    load, speed, curvature, ratio = np.exp(found).T
    for values, (low, high) in zip((load, speed, curvature, ratio), duty[:4], strict=True):
        assert low * (1 - 1e-12) <= values.min() < 1.1 * low
        assert 0.95 * high < values.max() <= high * (1 + 1e-12)
    # vibrations change the curvature by 2 % and the ratio by a tenth
    belongs = 0.7 * np.abs(np.log(curvature / 200.0))
    near = np.abs(ratio - belongs) < 0.03 + 0.13 * belongs
    assert np.all(near[along])
    assert np.mean(near[~along]) < 0.5
    # 0.8 to 1.2 times the entrainment of the place
    speeds = (speed / (0.15 + 0.02 * np.log(curvature / 200.0)))[along]
    assert 0.79 < speeds.min() < 0.83
    assert 1.17 < speeds.max() < 1.21
    # load, speed and place each go their own way
    ways = np.corrcoef(np.log([load[along], speeds, curvature[along]]))
    assert np.max(np.abs(ways - np.eye(3))) < 0.12
    many, along = tables.spread(duty, 512)
    assert np.all(np.diff(np.sort(many[along, 2])) < 0.1)
    # a path of three places is covered to both ends, and 2 % beside them
    coarse = tables.spread(duty._replace(places=tuple(places[::20])), 512)[0][along, 2]
    assert np.ptp(coarse) == pytest.approx(2.02, abs=0.02)
    assert tables.spread(duty, 65)[0].shape == (65, 4)
    assert tables.spread(duty, 1)[0].shape == (1, 4)
    box, all_of_it = tables.spread(duty._replace(places=()), 64)
    assert box.shape == (64, 4)
    assert np.all(all_of_it)
    # denser towards the ends, by half a cosine: a third in either outer quarter of every variable
    middle, half = box_of(duty)
    wide = (tables.spread(duty._replace(places=()), 512)[0] - middle) / half
    np.testing.assert_allclose(np.mean(wide < -0.5, axis=0), 1 / 3, atol=0.01)
    np.testing.assert_allclose(np.mean(wide > 0.5, axis=0), 1 / 3, atol=0.01)
    np.testing.assert_allclose(np.mean(wide < 0.0, axis=0), 1 / 2, atol=0.01)


def test_processes_solve_what_one_solves(monkeypatch):
    contact, (duties, _) = tables.contact_of(LIU_NI), tables.spread(DUTY, 4)
    monkeypatch.setattr(tables, "usable_cores", lambda: 2)
    monkeypatch.setattr(tables, "_WORTH", 2)
    found = tables.solve_all(contact, duties)
    np.testing.assert_array_equal(found, [tables.solve_one(contact, duty) for duty in duties])
    monkeypatch.setattr(sys, "executable", "no such program")
    np.testing.assert_array_equal(tables.solve_all(contact, duties), found)


def test_a_table_is_kept(by_powers, monkeypatch, tmp_path):
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path))
    contact = tables.contact_of(LIU_NI)
    first = tables.table_over(contact, DUTY)

    def again():
        tables.table_over.cache_clear()
        found = tables.table_over(contact, DUTY)
        for before, other in zip(first, found, strict=True):
            np.testing.assert_array_equal(before, other)

    (file,) = (tmp_path / "ehl").iterdir()
    file.write_bytes(file.read_bytes()[:-1000])
    again()
    monkeypatch.setattr(tables, "solve_all", None)
    again()


def test_without_a_mesh_there_is_no_table():
    with pytest.raises(InputError, match="duty of a mesh"):
        under("solved")


def test_duty_of_a_drive():
    """Liu & Ni: 10 rad/s, 500 N m on the gear; at P u = ω r_p sin α, R = 8.98 mm, no sliding."""
    duty = duty_range(load_scenario("crc-23-47").pair)
    whole = 500.0 / (70.5e-3 * math.cos(math.radians(25.4))) / 0.02
    assert duty.line_load[0] < whole < duty.line_load[1]
    at_pitch_point = 10.0 * 34.5e-3 * math.sin(math.radians(22.81))
    assert duty.entrainment[0] < at_pitch_point < duty.entrainment[1]
    assert duty.curvature[0] < 1 / 8.98e-3 < duty.curvature[1]
    assert 0.3 < duty.slide_to_roll[1] < 1.5


@pytest.mark.soak
def test_the_laws_run_in_every_compiler(by_powers, rng):
    case = load_scenario("crc-23-47").under_laws(film="solved", friction="solved")
    assert_right_hand_sides_agree(at_several_conditions(prepare(case).model), rng, 1e-12)


@pytest.mark.soak
def test_error_of_a_table_of_solved_contacts():
    found = tables.table_over(tables.contact_of(LIU_NI), DUTY)
    assert found.film_error < 0.01
    assert found.friction_error < 0.01
    contact = tables.contact_of(LIU_NI)
    state = tables.solve_one(contact, np.log([3e5, 0.15, 112.0, 0.3]))
    laws = closure(LIU_NI._replace(duty=lambda: DUTY), FILM_LAWS["solved"], FRICTION_LAWS["solved"])
    known = surface_state(local_contact(3e5, 112.0, 0.15, 0.045, 0.1725, 0.1275), laws)
    assert math.log(known.central_film_thickness) == pytest.approx(state[0], abs=0.01)
    assert math.log(known.friction_coefficient) == pytest.approx(state[1], abs=0.01)


def box_of(duty):
    """Middle and half length of the logarithms."""
    ends = np.log(np.array(duty[:4]))
    return ends.mean(axis=1), 0.5 * np.diff(ends, axis=1)[:, 0]


def film_and_friction(contact, duties):
    """Ln film, saturation and share as polynomials of a few powers of ln duty, and ln friction of them."""
    middle, half = box_of(DUTY)
    x, y, z, s = ((duties - middle) / half).T
    film = -15.0 - 0.1 * x + 0.3 * y - 0.05 * z + 0.02 * x * x + 0.01 * s**3 - 0.02 * x * y
    saturation = 0.4 - 0.8 * x + 0.7 * s + 0.2 * x * s - 0.1 * y + 0.15 * z
    share = 0.3 + 0.1 * x - 0.15 * y + 0.02 * s
    load, curvature = np.exp(duties[:, 0]), np.exp(duties[:, 2])
    limit, floor = contact.rheology.limiting_coefficient, contact.rheology.limiting_floor
    half_width = np.sqrt(8.0 * load / (np.pi * contact.effective_modulus * curvature))
    most = 1.15 * limit + 3.0 * floor * half_width / load
    friction = (1.0 - share) * most / (1.0 + np.exp(-saturation)) + contact.roughness.friction * share
    return film, share, friction


def box_filled(rng, count):
    middle, half = box_of(DUTY)
    return middle + half * rng.uniform(-1.0, 1.0, (count, 4))


def test_terms_are_all_powers_of_up_to_six():
    """Of load and sliding alone up to the sixth, where speed and curvature count twice."""
    grid = np.stack(np.meshgrid(*[range(7)] * 4, indexing="ij"), axis=-1).reshape(-1, 4)
    weight = grid @ [1, 2, 2, 1]
    assert sorted(TERMS) == sorted(map(tuple, grid[weight <= 6].tolist()))
    assert sorted(TERMS) == TERMS


def test_a_fit_gives_back_what_it_was_made_of(rng):
    """And what is compared counts as the error, not in the fit; contacts without a solution are left out."""
    contact = tables.contact_of(LIU_NI)
    duties, along = box_filled(rng, 400), np.arange(400) % 5 != 0
    film, share, friction = film_and_friction(contact, duties)
    values = np.stack([np.log(np.exp(film)), np.log(friction), share], axis=1)
    exact = tables._fitted(contact, box_of(DUTY), duties, values, along)
    assert exact.film_error < 2e-3
    assert exact.friction_error < 2e-3
    assert exact.solved == 400
    assert exact[:8] == pytest.approx([number for pair in zip(*box_of(DUTY), strict=True) for number in pair])
    assert (exact.limit, exact.floor, exact.rubbing) == (0.091, 2e6, 0.11)
    # laws read it: inside, and held at the ends of every variable
    laws = solved_film, solved_friction
    for load, speed, curvature, ratio in (
        (3e5, 0.13, 117.0, 0.1),
        (1e7, 0.7, 90.0, 1.4),
        (2e4, 0.01, 200.0, 1e-3),
    ):
        clipped = [
            np.clip(variable, *ends)
            for variable, ends in zip((load, speed, curvature, ratio), DUTY[:4], strict=True)
        ]
        wanted = [value[0] for value in film_and_friction(contact, np.log([clipped]))]
        for sign in (1.0, -1.0):
            v = sign * ratio * speed
            seen = local_contact(load, curvature, speed, v, speed + v / 2, speed - v / 2)
            log_film, rough, carried = laws[0](seen, LIU_NI.surfaces, exact)
            assert log_film == pytest.approx(wanted[0], abs=3e-3)
            assert rough == 1.0
            assert carried == pytest.approx(wanted[1], abs=3e-3)
            if (load, curvature) == (clipped[0], clipped[2]):
                mu = laws[1](seen, None, LIU_NI.surfaces, exact)
                assert mu == pytest.approx(wanted[2], rel=3e-3)
    compared = (np.arange(400) % 6 == 5) & along
    off = values + np.outer(compared, [0.03, -0.02, 0.0])
    off[np.arange(400) % 7 == 3] = np.nan
    again = tables._fitted(contact, box_of(DUTY), duties, off, along)
    assert again.film_error == pytest.approx(1 - np.exp(-0.03), abs=1e-3)
    assert again.friction_error == pytest.approx(np.exp(0.02) - 1, abs=1e-3)
    assert again.solved == 400 - 57
    np.testing.assert_allclose(again.film[:3], exact.film[:3], atol=0.02)
    off[np.arange(400) % 8 > 1] = np.nan
    with pytest.raises(SimulationError, match=r"at 86 of 400 duties only"):
        tables._fitted(contact, box_of(DUTY), duties, off, along)


def test_coefficients_are_the_weighted_least_squares(rng):
    """A deviation of the saturation counts by what it makes of the friction, at least a fiftieth of it.

    Each coefficient is held towards zero by 3e-5 of its powers' sum.
    """
    contact, count = tables.contact_of(LIU_NI), 300
    duties = box_filled(rng, count)
    film, share, friction = film_and_friction(contact, duties)
    friction = friction * np.exp(0.05 * rng.standard_normal(count))
    values = np.stack([film + 0.05 * rng.standard_normal(count), np.log(friction), share], axis=1)
    # none along a path: all are fitted
    found = tables._fitted(contact, box_of(DUTY), duties, values, np.arange(count) == 5)
    used = np.arange(count) != 5
    middle, half = box_of(DUTY)
    powers = np.prod(((duties - middle) / half)[:, None, :] ** np.array(TERMS), axis=2)
    load, curvature = np.exp(duties[:, 0]), np.exp(duties[:, 2])
    width = np.sqrt(8.0 * load / (np.pi * contact.effective_modulus * curvature))
    most = 1.15 * 0.091 + 3.0 * 2e6 * width / load
    part = (friction - 0.11 * share) / ((1.0 - share) * most)
    part = np.clip(part, 1e-6, 1.0 - 1e-6)
    saturation = np.log(part / (1.0 - part))
    by = 1e-5
    above, below = (mixed_friction(saturation + step, share, most, 0.11) for step in (by, -by))
    weight = np.clip((above - below) / (2 * by) / friction, 0.02, 1.0)
    stiff = 3e-5**2 * np.count_nonzero(used) * np.diag([sum(term) ** 2 for term in TERMS])
    cases = (found.film, values[:, 0], 0 * share + 1), (found.friction, saturation, weight)
    for coefficients, known, counts in cases:
        a = (powers * counts[:, None])[used]
        wanted = np.linalg.solve(a.T @ a + stiff, a.T @ (known * counts)[used])
        np.testing.assert_allclose(powers @ coefficients, powers @ wanted, atol=1e-4)


def test_asperities_carry_neither_less_than_nothing_nor_more_than_all():
    numbers = (0.0, 1.0) * 4
    zero = np.zeros(len(TERMS))
    for share, clipped in ((-0.4, 0.0), (0.3, 0.3), (1.7, 1.0)):
        constant = zero + share * (np.arange(len(TERMS)) == TERMS.index((0, 0, 0, 0)))
        table = tables.ContactTable(*numbers, zero, zero, constant, 0.05, 2e6, 0.11, 0.0, 0.0, 0.0)
        seen = local_contact(3e5, 110.0, 0.15, 0.06, 0.18, 0.12)
        assert solved_film(seen, LIU_NI.surfaces, table)[2] == clipped
        mu = solved_friction(seen, None, LIU_NI.surfaces, table)
        width = math.sqrt(8 * 3e5 / (math.pi * LIU_NI.surfaces.effective_modulus * 110.0))
        most = 1.15 * 0.05 + 3 * 2e6 * width / 3e5
        assert mu == pytest.approx((1 - clipped) * 0.5 * most + 0.11 * clipped)
    # where the film is saturated or slides hardly nothing overflows
    assert mixed_friction(900.0, 0.2, 0.05, 0.1) == pytest.approx(0.8 * 0.05 + 0.02)
    assert mixed_friction(-900.0, 0.2, 0.05, 0.1) == pytest.approx(0.02)
    assert [clipped_at(value, 2.0, 0.5) for value in (1.0, 1.75, 2.0, 2.5, 9.0)] == [
        -1.0,
        -0.5,
        0.0,
        1.0,
        1.0,
    ]


def test_a_contact_of_a_table_is_that_of_the_case():
    oil = LIU_NI.lubricant
    surfaces = LIU_NI.surfaces._replace(
        pinion_conductivity=51.0, gear_conductivity=37.0, pinion_heat_capacity=3.4e6, gear_heat_capacity=2.9e6
    )
    found = tables.contact_of(LIU_NI._replace(surfaces=surfaces))
    assert found.fluid[:4] == (
        oil.inlet_viscosity,
        oil.pressure_viscosity,
        oil.viscosity_pressure_index,
        True,
    )
    assert found.effective_modulus == surfaces.effective_modulus
    assert (found.roughness.height, found.roughness.friction) == (3e-7, oil.asperity_friction)
    assert found.rheology.law == "limiting"
    assert found.rheology.limiting_coefficient == oil.limiting_shear_coefficient
    assert found.thermal == (0.045, 0.14, 1.7e6, (51.0, 37.0), (3.4e6, 2.9e6))
    polished = surfaces._replace(roughness=0.0)
    given = LIU_NI._replace(surfaces=polished, lubricant=replace(oil, viscosity_pressure_index=1.2))
    assert tables.contact_of(given).roughness.height == 1e-9
    assert tables.contact_of(given).fluid.viscosity_pressure_index == 1.0


def stopped(*_, **__):
    raise SimulationError("no solution")


def test_a_solution_of_a_table_is_that_of_its_duty(monkeypatch):
    """Mean gap on the line of centres, friction over load, the asperities' share; NaN where there is none."""
    assert tables.STEP == 0.12
    contact = tables.contact_of(LIU_NI)
    found = tables.solve_one(contact, np.log([2.7e5, 0.21, 93.0, 0.35]), 0.5)
    problem = LineContact(
        2.7e5, 1 / 93.0, 0.21, contact.fluid, contact.effective_modulus, 0.35 * 0.21, contact.roughness
    )
    own = solve_coupled(problem, contact.rheology, contact.thermal, step=0.5)
    gap = np.interp(0.0, own.solution.place, own.solution.mean_gap)
    expected = [math.log(gap), math.log(own.friction / 2.7e5), own.solution.asperity_load_ratio]
    np.testing.assert_allclose(found, expected, rtol=1e-6)
    wanted = np.log([2.7e5, 0.21, 93.0, 0.35])
    monkeypatch.setattr(tables, "solve_coupled", stopped)
    assert np.all(np.isnan(tables.solve_one(contact, wanted)))
