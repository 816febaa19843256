"""A linear pair under a known gap: its motion in time beside the transfer function of its matrices."""

from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import jv

import tribodyn as td
from tests.support.linear_mesh import STIFFNESS, matrices
from tests.support.own_teeth import errors
from tribodyn.solve.initial import initial_state
from tribodyn.solve.transient import Stop, TransientSettings, transient
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.layout import displacements

#: Always two pairs in contact, of one stiffness.
CONTACT_RATIO = 2.0
TEETH = 31, 43
ECCENTRICITY = 5e-6


def drive(addendum: float, more: dict[str, Any]) -> dict[str, Any]:
    gear = {
        "face_width": "20 mm",
        "bore_radius": "20 mm",
        "addendum": addendum,
        "dedendum": 1.6,
        "fillet_radius": 0.1,
    }
    return {
        "drive.family": "involute",
        "drive.pinion.teeth": TEETH[0],
        "drive.gear.teeth": TEETH[1],
        **{f"drive.{side}.{key}": value for side in ("pinion", "gear") for key, value in gear.items()},
        "mesh.compliance": "constant",
        "mesh.stiffness": f"{STIFFNESS} N/m",
        "friction.law": "none",
        "film.law": "masjedi-khonsari",
        "operating.gear_torque": "300 N*m",
        **more,
    }


def prepared(more: dict[str, Any]) -> PreparedGearbox:
    """A pair whose contact ratio is two within rounding."""
    own = {"solver.cycles": 10 * TEETH[0] * 3} | more

    def ratio(addendum: float) -> float:
        return float(prepare(td.scenario("involute-23-47", drive(addendum, own))).assembly.contact_ratio)

    addendum = brentq(lambda a: ratio(a) - CONTACT_RATIO, 1.0, 1.5, xtol=1e-14)
    return prepare(td.scenario("involute-23-47", drive(addendum, own)))


@pytest.mark.parametrize("speed", [100.0, 700.0])
def test_run_out_at_speed_is_its_gap_by_the_transfer_function(speed: float):
    """(K − ω² M + i ω C) u = h (k + i ω c) g, at the order of the shaft, on either side of resonances."""
    case = prepared(
        {"drive.pinion.eccentricity": f"{1e6 * ECCENTRICITY} um", "operating.pinion_speed": f"{speed} rad/s"}
    )
    assert float(case.assembly.contact_ratio) == pytest.approx(CONTACT_RATIO, abs=1e-9)
    model, cycles = case.model, case.case.solver.cycles
    state = initial_state(model, "static")
    parts = [
        part.states
        for part in transient(model, state, TransientSettings("dopri5", 1e-9, cycles, 10**6, 4))
        if not isinstance(part, Stop)
    ]
    states = np.concatenate(parts)[:-1][-TEETH[0] * 4 :]  # the last revolution
    order = np.fft.rfft(states[:, displacements(model.layout)], axis=0)[1] / len(states) * 2.0

    mass, damping, stiffness, _ = matrices(case, 2)
    alpha = float(case.cycle.pressure_angle[0, 0, 0])
    lever = model.meshes[0].driven_radius * np.cos(alpha)
    h = np.array([np.cos(alpha), np.sin(alpha), -np.cos(alpha), -np.sin(alpha), -lever])
    k, c = 2.0 * STIFFNESS, 2.0 * model.meshes[0].damping * np.sqrt(STIFFNESS)
    matrix = stiffness - speed**2 * mass + 1j * speed * damping
    expected = np.linalg.solve(matrix, h * (k + 1j * speed * c) * ECCENTRICITY)
    np.testing.assert_allclose(np.abs(order), np.abs(expected), rtol=2e-3)


def test_sidebands_have_the_bessel_amplitudes_of_the_modulation():
    """Of an order of the mesh, over the angle of a gear that runs out, as an encoder on it has it.

    The error A cos(z_2 θ + …) of the mesh is one over θ = θ_1 z_1/z_2, and the gear itself stands at
    θ_2 = θ − ε sin(θ + …), ε = e/(r_2 cos α): Kepler's equation. Over θ_2 the order m = z_2 + n has the
    amplitude z_2/m J_n(m ε) A/cos α, the index of modulation m ε changing from line to line.
    """
    amplitude, eccentricity, per_cycle = 2e-6, 200e-6, 6
    changes = {
        "drive.gear.eccentricity": f"{1e6 * eccentricity} um",
        "mesh.transmission_error.harmonics": [{"order": 1, "amplitude": f"{1e6 * amplitude} um"}],
    }
    case = prepared(changes)
    model, plain = case.model, prepared({"drive.gear.eccentricity": changes["drive.gear.eccentricity"]}).model
    at = np.arange(TEETH[1] * per_cycle) / per_cycle
    error, without = errors(model, at), errors(plain, at)
    radius = float(model.meshes[0].driven_radius)
    angle = 2.0 * np.pi * at / TEETH[1] - (error - error.mean()) / radius
    # the integral over θ_2 as one over θ: a mean of even samples is exact up to as many orders
    orders = np.fft.rfft(error)
    slope = np.fft.irfft(1j * np.arange(len(orders)) * orders, len(at))
    weight = (error - without) * (1.0 - slope / radius)
    cosine = np.cos(float(case.cycle.pressure_angle[0, 0, 0]))
    index = eccentricity / (radius * cosine)
    for n in (-2, -1, 0, 1, 2):
        line = TEETH[1] + n
        expected = TEETH[1] / line * amplitude / cosine * abs(jv(n, line * index))
        found = 2.0 * abs(np.mean(weight * np.exp(-1j * line * angle)))
        assert found == pytest.approx(expected, rel=0.005, abs=1e-5 * amplitude)
