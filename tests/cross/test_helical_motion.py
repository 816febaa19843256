"""Motions of helical pairs: every compiler and solver, limits, energy, steady states."""

from dataclasses import replace

import numpy as np
import pytest

import tribodyn as td
from tests.support.helical_motion import EVEN, HELICAL
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tests.support.soak_parameters import all_in_soak
from tests.support.states import altered, recorded, sampled
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.orbit.periodic import steady_states
from tribodyn.solve.transient import TransientSettings
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.train.layout import displacements, velocities
from tribodyn.train.structure import (
    place_in_space,
    turn_of,
)

COULOMB = {
    "friction.law": "coulomb",
    "film.law": "masjedi-khonsari",
    "friction.coefficient": 0.06,
    "operating.pinion_speed": "300 rad/s",
}


def pair(**more):
    keys = {**HELICAL, **COULOMB, **more}
    if keys["friction.law"] == "none":
        del keys["friction.coefficient"]
    return prepare(load_scenario("involute-23-47", keys))


def marched(model, method="dopri5", rtol=1e-10, cycles=3, start=None):
    return sampled(model, TransientSettings(method, rtol, cycles, 10**6, 40), start)[1]


@pytest.mark.slow
def test_right_hand_sides_agree_over_random_states(rng):
    keys = {"mesh.backlash": "12 um", "friction.sliding": "dynamic", "mesh.formulation": "energy-consistent"}
    assert_right_hand_sides_agree(at_several_conditions(pair(**keys).model), rng, 1e-11)


@pytest.mark.parametrize(
    "method", all_in_soak(["rodas4", "switching", "radau", "tsit5"], ["rodas4", "radau"])
)
def test_solvers_agree(method):
    model = pair().model
    exact, ours = marched(model, "dop853", 1e-11), marched(model, method, 1e-8)
    free = displacements(model.layout)
    assert np.max(np.abs(ours - exact)[:, free] / np.ptp(exact[:, free], axis=0)) < 3e-5


def test_slices_of_a_spur_pair_move_as_the_pair():
    """And friction of slices that reverse in step stops no step."""
    case = load_scenario("involute-23-47", {**EVEN, **COULOMB})
    spur, cut = prepare(case).model, prepare(case.with_pair(mesh=replace(case.pair.mesh, slices=7))).model
    one, many = marched(spur), marched(cut)
    free = displacements(spur.layout)
    assert np.max(np.abs(many[:, free] - one[:, free]) / np.ptp(one, axis=0)[free]) < 1e-7


def test_small_helix_angles_approach_the_spur_pair():
    """With the square of the angle: how high every harmonic is, for the middle of the face is late."""
    case = load_scenario("involute-23-47", {**EVEN, **COULOMB})
    angles = [{"drive.helix_angle": f"{angle} rad", "mesh.slices": 7} for angle in (0.02, 0.01)]
    models = [prepare(case).model, *(pair(**angle).model for angle in angles)]
    free = displacements(models[0].layout)
    states = [steady_states([model], samples=400)[0].samples[:, free] for model in models]
    spur, *found = (np.abs(np.fft.rfft(samples, axis=0))[:60] for samples in states)
    motion = [np.linalg.norm((high - spur)[1:], axis=0) / np.linalg.norm(spur[1:], axis=0) for high in found]
    mean = [np.abs(high[0] / spur[0] - 1.0) for high in found]
    assert np.all(motion[1] < 0.3 * motion[0])
    assert np.all(mean[1] < 0.3 * mean[0])
    assert np.max(motion[1]) < 0.03
    assert np.max(mean[1]) < 1e-3


@pytest.mark.parametrize(
    "keys",
    [
        {},
        {"mesh.formulation": "energy-consistent", "operating.source": "torque"},
        {"solver.initial": "unloaded"},
    ],
    ids=["speed", "consistent", "unloaded"],
)
def test_energy_is_balanced_and_the_axial_force_is_statics(tmp_path, keys):
    long = {"solver.cycles": 12, "solver.rtol": 1e-9, "output.samples_per_cycle": 40}
    made = run(load_scenario("involute-23-47", {**HELICAL, **long, **keys}), tmp_path / "x.h5")
    assert abs(made.summary["energy_residual"]) < 1e-7
    case = pair()
    radius = float(case.model.meshes[0].driven_radius)
    force = float(case.model.bodies.load[1]) / radius * np.tan(np.radians(20.0))
    assert made.summary["axial_force_mean"] == pytest.approx(-force, rel=0.03)


def test_axial_force_is_the_normal_loads_share(prepared):
    model = prepared("involute-23-47", **HELICAL).model
    found = recorded(model, TransientSettings("dopri5", 1e-8, 2, 10**6, 30))
    base = np.arcsin(np.sin(np.radians(20.0)) * np.cos(np.radians(20.0)))
    loads = np.sum(found["normal_load"], axis=1)
    np.testing.assert_allclose(found["axial_force"], -np.sin(base) * loads, rtol=1e-9)


def test_even_slices_and_a_whole_overlap_make_no_transmission_error():
    """On bearings that hardly give: tilting shafts would feel the lines of contact wander along the face."""
    width = {
        f"drive.{side}.face_width": f"{np.pi * 3 / np.sin(np.radians(20.0))} mm"
        for side in ("pinion", "gear")
    }
    errors = []
    for slices in (5, 10):
        model = pair(
            **width, **{"friction.law": "none", "film.law": "masjedi-khonsari", "mesh.slices": slices}
        ).model
        model = altered(model, links={"stiffness_in_space": 1e7 * model.links.stiffness_in_space})
        turn = turn_of(1, model.layout)
        turned = [static_equilibrium(model, phase)[turn] for phase in np.linspace(0.01, 0.93, 13)]
        errors.append(np.ptp(turned) / np.abs(np.mean(turned)))
    assert max(errors) < 1e-7


def test_mean_error_converges_with_the_square_of_the_slices_width():
    found = []
    for slices in (12, 24, 48):  # with 6 errors of either sign still cancel
        model = pair(**{"mesh.slices": slices, "friction.law": "none", "film.law": "masjedi-khonsari"}).model
        turn, tilt = turn_of(1, model.layout), place_in_space(0, 4, model.layout)
        last = marched(model, cycles=10)[-40:]
        found.append([np.mean(last[:, turn]), np.mean(last[:, tilt])])
    first, second = np.abs(np.diff(found, axis=0))
    assert np.all(first / second > 3.0)


def test_a_steady_state_is_that_of_a_long_run():
    models = [pair(**{"operating.pinion_speed": f"{speed} rad/s"}).model for speed in (150, 400)]
    free = [*displacements(models[0].layout), *velocities(models[0].layout)]
    for model, steady in zip(models, steady_states(models, samples=40), strict=True):
        assert steady.kind == "period-1"
        last = marched(model, rtol=1e-9, cycles=200)[-41:-1]
        scale = np.max(np.abs(last), axis=0)[free]
        assert np.max(np.abs(steady.samples - last)[:, free] / scale) < 2e-5


@pytest.mark.parametrize("speed", ["200 rpm", pytest.param("6000 rpm", marks=pytest.mark.soak)])
def test_motion_and_friction_are_those_of_three_times_as_many_slices(speed):
    """Of the number that is chosen; with a law whose friction follows the speed."""
    keys = {"operating.pinion_speed": speed, "friction.law": "xu", "solver.cycles": 16}
    chosen, many = (
        td.run("helical-23-47", keys | {"mesh.slices": slices}).summary for slices in ("auto", 39)
    )
    assert chosen["slices"] == 13
    for name in ("transmission_error_peak_to_peak", "power_friction_mean", "friction_coefficient_mean"):
        assert chosen[name] == pytest.approx(many[name], rel=0.02)
    orders, exact = (np.array(s["transmission_error_harmonics"]) for s in (chosen, many))
    np.testing.assert_allclose(orders, exact, rtol=0.05, atol=0.005 * exact.max())
