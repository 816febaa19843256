"""The dynamic run at creeping speed carries the loads of the load contact model, corners included."""

import dataclasses

import numpy as np
import pytest

from tests.support.closures import known
from tests.support.pair_outputs import outputs
from tests.support.states import recorded, sampled
from tribodyn.compliance.sharing.flank_gap import flank_gap
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import face_positions
from tribodyn.geometry.modification import (
    UNMODIFIED,
    FlankModification,
    Misalignment,
    Modifications,
    Relief,
)
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import TransientSettings
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.schedule import interval_of
from tribodyn.tribology.law import FrictionData

SAMPLES = 100
TIP = FlankModification(tip=Relief(12e-6, 3e-3))


@pytest.mark.parametrize(
    ("modified", "slices"), [(UNMODIFIED, 1), (Modifications(TIP, TIP, Misalignment(5e-4)), 11)]
)
def test_creeping_run_is_the_load_contact_model(prepared, modified, slices):
    slow = {"operating.pinion_speed": "0.01 rad/s", "friction.coefficient": 0.0}
    case = prepared("involute-18-36-fem", **slow).case
    mesh = dataclasses.replace(case.pair.mesh, modifications=modified, slices=slices)
    run = prepare(case.with_pair(mesh=mesh))
    found = recorded(run.model, TransientSettings("radau", 1e-8, 1, 100000, SAMPLES))["normal_load"]

    case, cycle = run.warm_pairs[0], run.cycle
    flexible = flexibility(
        assemble(family(case.family), case.drive), case.materials, lead=slices > 1, held=case.mesh.held
    )
    pitch = cycle.pitch_angle
    phase = np.arange(SAMPLES) / SAMPLES
    roll = cycle.roll_start + pitch * (phase[:, None] + np.array([1.0, 0.0]))
    gap = flank_gap(
        flexible.assembly,
        modified,
        pair_geometry(flexible.assembly, roll),
        face_positions(flexible.width, slices),
    )
    shared = LoadedFlanks(flexible, slices=slices).share(roll, case.operating.gear_torque, 0.0, gap)
    expected = shared.normal_load
    np.testing.assert_allclose(found[:SAMPLES], expected, atol=0.01 * expected.max())
    # early and late contact: some load outside the theoretical path, unless the tips are relieved
    outside = (roll < -0.2954 - 1e-3) | ((roll > 0.2670 + 1e-3) & (roll < cycle.roll_end))
    touches = np.any(found[:SAMPLES][outside] > 0.01 * expected.max())
    assert touches or modified != UNMODIFIED


def test_friction_power_in_slow_rotation_is_that_of_the_slices(prepared):
    """Misaligned: one friction per pair in the right-hand side, against the sum over the slices.

    At rest but for creep; oil thick enough for the mixed regime, in which friction depends on the line load.
    """
    slow = {
        "operating.pinion_speed": "0.01 rad/s",
        "lubricant.inlet_viscosity": "100 Pa*s",
        "mesh.misalignment.in_plane": "2 arcmin",
        "mesh.slices": 11,
    }
    case = prepared("involute-18-36-fem", **slow).case
    run = prepare(case.with_pair(friction=FrictionData("masjedi-khonsari")))
    model, cycle = run.model, run.cycle
    phase = (np.arange(24) + 0.5) / 24
    _, _, interval = interval_of(phase, model.schedule)
    states = np.stack(
        [static_equilibrium(model, at, number) for at, number in zip(phase, interval.tolist(), strict=True)]
    )
    found = outputs(phase, states, model)
    # the creep's own flow has no share in the friction: nominal sliding
    power = np.abs(found["friction_force"] * np.nan_to_num(found["sliding_speed"]))

    case = run.warm_pairs[0]
    flexible = flexibility(
        assemble(family(case.family), case.drive), case.materials, lead=True, held=case.mesh.held
    )
    flanks = LoadedFlanks(flexible, case.mesh.modifications, 11)
    roll = cycle.roll_start + cycle.pitch_angle * (phase[:, None] + np.arange(cycle.slots - 1.0, -1.0, -1.0))
    shared = flanks.share(roll, case.operating.gear_torque, np.nan_to_num(found["friction_coefficient"]))
    np.testing.assert_allclose(found["normal_load"], shared.normal_load, atol=0.01 * shared.normal_load.max())
    radius = found["equivalent_radius"][..., None]
    entrainment, sliding = found["entrainment_speed"][..., None], found["sliding_speed"][..., None]
    with np.errstate(under="ignore", over="ignore", invalid="ignore"):
        surface = known(
            model.closure(0),
            np.maximum(shared.slice_load, 1e-3) * 11 / flexible.width,
            1.0 / radius,
            entrainment,
            sliding,
            entrainment + sliding / 2.0,
            entrainment - sliding / 2.0,
        )
    exact = np.sum(np.nan_to_num(surface[0]) * shared.slice_load, axis=-1)
    exact = exact * np.abs(np.nan_to_num(found["sliding_speed"]))
    assert np.sum(power) == pytest.approx(np.sum(exact), rel=0.015)
    touching = shared.slice_load > 0.0
    heaviest = np.nanmax(np.where(touching, surface[4], np.nan))
    assert np.nanmax(found["hertz_pressure"]) == pytest.approx(heaviest, rel=0.01)
    thinnest = np.nanmin(np.where(touching, surface[2], np.nan))
    assert np.nanmin(found["central_film_thickness"]) == pytest.approx(thinnest, rel=0.01)


def test_relieved_tips_quieten_the_running_pair(prepared):
    """Peak to peak of the dynamic transmission error at the relief's design torque, after 12 mesh cycles."""
    swings = []
    for name in ("involute-18-36-fem", "involute-18-36-tip-relief"):
        model = prepared(name).model
        settings = TransientSettings("dopri5", 1e-6, 16, 100000, SAMPLES)
        cycles, states = sampled(model, settings)
        found = outputs(cycles, states, model)
        swings.append(np.ptp(found["transmission_error_rotational"][cycles > 12]))
    assert swings[1] < 0.2 * swings[0]
