"""Pitting and bending of the simulation: under slow loads those of the load contact, and why both part."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

from tests.support.short_studies import short_case
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.compliance.sharing.loaded_contact import roll_through
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import capacity_of, life_bins
from tribodyn.gears.rating.standard import rated_duty, standard_of
from tribodyn.studies.assessment.results.rated_flank import NominalLoad, nominal_load, rated_flanks
from tribodyn.studies.assessment.results.reasons import bending_reasons, pitting_reasons, reasons, rests_on
from tribodyn.studies.assessment.results.simulated_strength import (
    GivenFactors,
    _in_motion,
    given_factors,
    loaded_teeth,
    root_bins,
    strength_beside,
)
from tribodyn.studies.protocol.load import load_scenario

SLICES = 7
#: As the simulation has them: without dynamics.
STATIC = {"dynamic_factor": 1.0, "face_load_factor": 1.0}


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    return short_case("assessment", tmp_path_factory.mktemp("beside"), drive__material="16MnCr5").pair


@pytest.fixture(scope="module")
def loaded(case):
    flexible = flexibility(assembled(case), case.materials, lead=True)
    return roll_through(LoadedFlanks(flexible, slices=SLICES), case.operating.gear_torque, 24)


def of_one_pair(values: np.ndarray) -> np.ndarray:
    """Values (position, pair, …) along the way of one pair, which is younger in the places behind."""
    return np.concatenate(list(np.moveaxis(values, 1, 0))[::-1])


@pytest.fixture(scope="module")
def along(loaded):
    names = {"roll_angle": "roll", "normal_load": "normal_load", "line_load": "line_load"}
    return {name: of_one_pair(getattr(loaded, field)) for name, field in names.items()}


def teeth_of(case, loaded, along, factor: float | np.ndarray = 1.0):
    motion = {"roll_angle": loaded.roll, "normal_load": factor * loaded.normal_load[None]}
    found = loaded_teeth(case, assembled(case), along, motion)
    assert found is not None
    return found


@pytest.fixture(scope="module")
def teeth(case, loaded, along):
    return teeth_of(case, loaded, along)


def rated_of(case, **changed: Any):
    settings = case.settings.model_copy(update=changed)
    case, assembly = dataclasses.replace(case, settings=settings), assembled(case)
    found = standard_of(case, assembly, rated_duty(settings, case.oil_temperature, face=1.1)).factors
    capacity = capacity_of(case, assembly, found, life_bins(case, assembly, found, case.spectrum), settings)
    assert capacity is not None
    return case, capacity, found


def test_slow_loads_have_the_stresses_of_the_load_contact(case, loaded, teeth):
    for found in (teeth.slow, teeth.moving):
        assert found.pressure_peak.value == pytest.approx(np.max(loaded.pressure), rel=1e-6)
        for peak, tension in zip(found.root_peak, loaded.root_tension, strict=True):
            assert peak.value == pytest.approx(np.max(tension), rel=1e-6)
    strength = strength_beside(case, teeth, None, STATIC)
    named = strength.by_name()
    assert set(named) == {"sigma_H", "sigma_F"}
    assert named["sigma_F"]["pinion"] == pytest.approx(np.max(loaded.root_tension[0]), rel=1e-6)
    assert strength.safeties() == {}
    assert loaded_teeth(case, assembled(case), {}, {}) is None


@pytest.mark.parametrize("helical", [False, True])
def test_loads_in_motion_add_up_to_those_of_the_pairs(loaded, along, rng, helical):
    """Of spur pairs each to its own, of helical ones those of an instant; none where nothing touches."""
    total = rng.uniform(0.5, 2.0, (2, 24, 1)) * loaded.normal_load
    total[1, 5] = 0.0
    motion = {"roll_angle": loaded.roll, "normal_load": total}
    found = _in_motion(motion, along["roll_angle"], along["line_load"], helical)
    assert found.shape == (*total.shape, SLICES)
    over = (2, 3) if helical else 3
    np.testing.assert_allclose(np.sum(found, axis=over), np.sum(total, axis=2) if helical else total)
    assert np.all(found >= 0.0)
    assert not np.any(found[1, 5])


def test_safeties_and_lives_are_of_the_standards_lines(case, teeth):
    case, capacity, _ = rated_of(case)
    strength = strength_beside(case, teeth, capacity, STATIC)
    for gear, rated in enumerate(capacity.gears):
        for failure, found in ((rated.pitting, strength.pitting), (rated.bending, strength.bending)):
            allowed = failure.curve.at(failure.cycles)
            assert found[gear].safety == pytest.approx(allowed / found[gear].stress)
    assert strength.safeties()["S_F"] == min(one.safety for one in strength.bending if one.safety)


def test_loads_raise_stresses_and_shorten_lives(case, loaded, along, teeth):
    case, capacity, _ = rated_of(case, required_safety_bending=2.5)
    slow = strength_beside(case, teeth, capacity, STATIC)
    fast = strength_beside(case, teeth_of(case, loaded, along, 2.0), capacity, STATIC)
    for gear in (0, 1):
        assert fast.bending[gear].stress == pytest.approx(2.0 * slow.bending[gear].stress)
        assert fast.pitting[gear].stress == pytest.approx(math.sqrt(2.0) * slow.pitting[gear].stress)
        for before, after in ((slow.bending, fast.bending), (slow.pitting, fast.pitting)):
            assert (after[gear].life or 0.0) < (before[gear].life or 0.0)
    # a factor that is given stands for twice the load, too
    given = dataclasses.replace(case, settings=case.settings.model_copy(update={"application_factor": 2.0}))
    doubled = strength_beside(given, teeth, capacity, STATIC)
    assert doubled.bending[0].stress == pytest.approx(fast.bending[0].stress)
    assert doubled.bending[0].life == pytest.approx(fast.bending[0].life)


def test_given_factors_replace_those_of_the_simulation(case):
    own = {"dynamic_factor": 1.25, "face_load_factor": 1.1}
    settings = case.settings.model_copy(
        update={"dynamic_factor": 1.5, "face_load_factor": 1.32, "mesh_load_factor": 1.1}
    )
    assert given_factors(settings, own) == pytest.approx(GivenFactors(1.1, 1.2, 1.2))
    assert given_factors(case.settings, own).load == 1.0


def test_a_root_that_only_pulsates_has_one_cycle_per_meshing():
    course = np.array([[0.0, 100.0, 300.0, 50.0, 0.0], [0.0, 200.0, 250.0, 50.0, 0.0]])
    found = root_bins(course, 0.5)
    shares = {size: sum(one.cycles for one in found if one.stress == size) for size in (250.0, 300.0)}
    assert shares == {250.0: 1.0, 300.0: 1.0}
    assert {one.stress for one in found} == set(shares)
    # the roots of running test gears are compressed by their neighbours too: σ_Flim contains it
    assert root_bins(course - 30.0 * (course == 0.0), 0.5) == found


def test_the_standard_and_hertz_agree_where_one_pair_carries_everything_in_slow_rotation(case, teeth):
    """At the pitch point σ_H0 √K is Hertz times Z_ε, so that S_H differs by the load factors alone."""
    case, capacity, factors = rated_of(case)
    strength = strength_beside(case, teeth, capacity, STATIC)
    ratio = (strength.pitting[1].safety or 0.0) / capacity.gears[1].pitting.safety
    along = teeth.flank_slow[1].along_face
    assert ratio == pytest.approx(
        math.sqrt(factors.flank / case.settings.application_factor) / along, rel=2e-3
    )
    # of the root the finite elements and the formula, over the largest of the face, of gears as tested
    for gear in (0, 1):
        *_, face, root = bending_reasons(gear, teeth, GivenFactors(1.0, 1.0, 1.0), capacity, factors)
        assert face.factor * root.factor / capacity.common["K_Fbeta"] == pytest.approx(1.0, abs=0.08)


@pytest.mark.parametrize("overlap", [0.0, 0.4, 1.0])
def test_a_flank_is_rated_between_its_inner_point_and_the_pitch_point(overlap):
    """Pressures that fall from 5 at the start of the path, with corners of 100: closed form at B, C and D."""
    roll = np.linspace(-1.0, 1.0, 41)
    course = np.where(np.abs(roll) > 0.9, 100.0, 4.0 - roll)
    nominal = NominalLoad(0.0, (-0.31, 0.42), overlap, 1.0, 0.9)
    cycles = np.array([1.0, 1.5])[:, None, None, None] * course[None, :, None, None] * np.array([0.5, 1.0])
    shares = 0.5 + 0.1 * roll[:, None]
    wide = np.broadcast_to(roll[:, None, None], (41, 1, 2))
    pinion, gear = rated_flanks(wide, cycles, nominal, shares)
    assert pinion.pressure == pytest.approx(np.array([1.0, 1.5]) * (4.0 + 0.31 * (1.0 - overlap)))
    assert gear.pressure == pytest.approx(np.array([4.0, 6.0]))
    assert pinion.carried == pytest.approx(0.5 - (0.031 if overlap < 1.0 else 0.0))
    assert pinion.along_face == pytest.approx(1.0 / math.sqrt((1.0 + 0.25) / 2.0))
    assert nominal.credit == 0.9


def test_a_helical_pair_counts_with_its_hertz_pressure_and_a_spur_pair_with_Z_epsilon(case):
    """ISO 6336-2, (28) to (30), over the share of the load that presses there."""
    spur = assembled(case)
    assert nominal_load(spur).credit == pytest.approx(math.sqrt((4.0 - float(spur.contact_ratio)) / 3.0))
    helical = assembled(load_scenario("assessment-helical-24-95").pair)
    assert nominal_load(helical).credit == pytest.approx(1.0)
    assert nominal_load(helical).carried == pytest.approx(1.0 / float(helical.contact_ratio))


@pytest.mark.parametrize("given", [GivenFactors(1.0, 1.0, 1.0), GivenFactors(1.4, 1.2, 1.3)])
def test_the_factors_of_a_reason_make_the_ratio(case, loaded, along, given):
    """They are σ of the standard over σ of the simulation, both under the same K_A."""
    pulse = 1.0 + 0.3 * np.sin(np.arange(24.0))[:, None]
    shaken = teeth_of(case, loaded, along, pulse)
    _, capacity, factors = rated_of(case, application_factor=given.application)
    for gear, rated in enumerate(capacity.gears):
        bent = given.load * shaken.moving.root_peak[gear].value
        parts = bending_reasons(gear, shaken, given, capacity, factors)
        assert math.prod(part.factor for part in parts) == pytest.approx(rated.bending.stress / bent)
        pressed = math.sqrt(given.load) * shaken.flank_moving[gear].largest * shaken.nominal.credit
        parts = pitting_reasons(gear, shaken, given, capacity, factors)
        assert math.prod(part.factor for part in parts) == pytest.approx(rated.pitting.stress / pressed)
        assert all(part.factor > 0.0 for part in parts)


def test_reasons_are_given_where_both_part(case, loaded, along):
    heavy = teeth_of(case, loaded, along, 3.0)
    case, capacity, factors = rated_of(case)
    given = GivenFactors(1.0, 1.0, 1.0)
    strength = strength_beside(case, heavy, capacity, STATIC)
    said = reasons(heavy, strength, given, capacity, factors)
    assert len([text for text in said if text.startswith("S_")]) == 4
    assert all(
        "mostly by" in text and "dynamic factor × " in text.lower() for text in said if text.startswith("S_")
    )
    # without any difference nothing is said
    alike = strength._replace(
        bending=tuple(
            one._replace(safety=gear.bending.safety)
            for one, gear in zip(strength.bending, capacity.gears, strict=True)
        )
    )
    assert [text[:3] for text in reasons(heavy, alike, given, capacity, factors)[:3]] == ["S_H", "S_H", "The"]
    # and what the verdict rests on is the smaller: at three times the load the simulation's
    rests = rests_on(heavy, strength, given, capacity, factors)
    for name, mode in (("S_H", "pitting"), ("S_F", "bending")):
        own = min(one.safety for one in getattr(strength, mode))
        rated = min(getattr(gear, mode).safety for gear in capacity.gears)
        assert own < rated
        assert f"{name} {own:.2f} simulated, {rated:.2f} by the standard (mostly dynamic factor)" in rests
