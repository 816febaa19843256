"""The mesh of an internal pair: the same from either gear, a rack in the limit, its loss by integration."""

import math
from pathlib import Path
from typing import Any

import jax
import numpy as np
import pytest
from scipy.integrate import quad

import tribodyn as td
from tribodyn.compliance.iso6336 import pair_of, theoretical_stiffness
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.path import kinematics
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate
from tribodyn.studies.drive_file import DriveModel, load_drive
from tribodyn.studies.efficiency.along_path import cycle_efficiency, engage
from tribodyn.studies.efficiency.mesh_positions import places
from tribodyn.studies.efficiency.run import prepare
from tribodyn.studies.protocol.load import load_scenario

jax.config.update("jax_enable_x64", True)

CONSTANT = MeshData("constant", 0.05, stiffness=7.5e9, backlash=40e-6)
#: Of the published pair: planet's base radius and its and the ring's tangent points from the pitch point, m.
BASE, TANGENT, RING_TANGENT = 0.355204, 0.0993719, 0.2567108
TORQUE, SPEED = 600e3, 2.0943951023931953


@pytest.fixture(scope="module")
def model() -> DriveModel:
    return load_drive("ring-36-93")


@pytest.fixture(scope="module")
def ring(model: DriveModel) -> Assembly:
    return check(family("involute"), model.drive)


def _cycle(model: DriveModel, pair: Assembly, back: bool = False) -> MeshCycle:
    return tabulate(pair, model.materials, CONSTANT, pair_slots(pair), back)


def test_every_node_lies_on_the_path(model: DriveModel, ring: Assembly):
    """The pitch point lies before the path: all slide as in recess, and no pair passes it."""
    cycle = _cycle(model, ring)
    inside = np.broadcast_to(cycle.in_contact[:, None, :] > 0, cycle.signed_distance.shape)
    r = cycle.signed_distance[inside]
    assert 0.0 < ring.r_start == pytest.approx(r.min(), abs=1e-15)
    assert r.max() == pytest.approx(ring.r_end, abs=1e-15)
    assert cycle.pitch_point_phase == pytest.approx(-ring.r_start / (2 * math.pi * BASE / 36), rel=1e-5)
    np.testing.assert_allclose(cycle.pinion_speed[inside], TANGENT + r, atol=2e-6)
    np.testing.assert_allclose(cycle.gear_speed[inside], (RING_TANGENT + r) * 36 / 93, atol=2e-6)
    radius = 1.0 / (1.0 / (TANGENT + r) - 1.0 / (RING_TANGENT + r))
    np.testing.assert_allclose(cycle.equivalent_radius[inside], radius, rtol=4e-5)


def test_the_mesh_is_the_same_when_the_ring_drives(model: DriveModel, ring: Assembly):
    """Seen from the ring, time runs backwards: the same contacts, curvatures and speeds."""
    drive = model.drive
    other = check(family("involute"), drive._replace(pinion=drive.gear, gear=drive.pinion))
    assert other.limits == pytest.approx((-ring.r_end, -ring.r_start), rel=1e-12)
    assert other.contact_ratio == pytest.approx(ring.contact_ratio, rel=1e-12)
    for back in (False, True):
        first, second = _cycle(model, ring, back), _cycle(model, other, back)
        rows = []
        for cycle, way, per_turn in ((first, 1.0, 1.0), (second, -1.0, -93 / 36)):
            inside = np.broadcast_to(cycle.in_contact[:, None, :] > 0, cycle.signed_distance.shape)
            r = way * cycle.signed_distance[inside]
            order = np.argsort(r)
            speeds = (cycle.pinion_speed, cycle.gear_speed)[:: int(way)]
            numbers = (cycle.equivalent_radius, *(speed / per_turn for speed in speeds))
            rows.append((r[order], *(number[inside][order] for number in numbers)))
        if not back:  # nodes of back flanks stand where the front pairs' boundaries are
            assert rows[0][0].size == rows[1][0].size
        for number in (1, 2, 3):
            np.testing.assert_allclose(
                np.interp(rows[0][0], rows[1][0], rows[1][number]), rows[0][number], rtol=2e-5
            )


@pytest.mark.parametrize("pins", [None, 0.0])
def test_traced_rims_are_as_compliant_as_those_of_plain_numbers(model: DriveModel, pins: float | None):
    def compliance(dedendum: Any) -> Any:
        body = model.drive.gear._replace(dedendum=dedendum, pins=pins)
        pair = Assembly(family("involute"), model.drive._replace(gear=body))
        cycle = tabulate(pair, model.materials, MeshData("energy", 0.05), 2)
        return cycle.compliance, cycle.coupling

    traced = jax.jit(compliance)(1.25)
    for one, other in zip(traced, compliance(1.25), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-20)


def _mate(teeth: float) -> Drive:
    """A pinion of 24 teeth with a mate of so many, internal where they are negative."""
    pinion = GearBody(24.0, 0.3, 1.0, 1.25, 0.25, 0.03, 0.01)
    mate = GearBody(
        teeth, 0.0, 1.0, 1.25, 0.25, 0.03, 0.0 if teeth > 0 else -1.0, -1.0 if teeth < 0 else None
    )
    mate = mate._replace(tip_radius=None, bore_radius=0.1 if teeth > 0 else 2e-3 * (teeth - 20))
    if teeth < 0:
        mate = mate._replace(cutter_teeth=20.0)
    return Drive(3e-3, math.radians(20.0), pinion, mate)


def test_large_mates_of_either_kind_become_a_rack():
    """External and internal mates stand on either side of the rack, at distances that fall like 1/N."""

    def numbers(teeth: float) -> np.ndarray:
        pair = Assembly(family("involute"), _mate(teeth))
        at = kinematics(pair.path, np.array([-3e-3, 2e-3]))
        angle = pair.path.pressure_angle(0.0)
        return np.array([pair.contact_ratio, *pair.limits, angle, *at.relative_curvature, *at.gear_speed])

    distances, means = [], []
    for count in (1000.0, 2000.0, 4000.0):
        outside, inside = numbers(count), numbers(-count)
        distances.append(outside - inside)
        means.append((outside + inside) / 2.0)
    np.testing.assert_allclose(distances[0] / distances[1], 2.0, rtol=2e-2)
    np.testing.assert_allclose(distances[1] / distances[2], 2.0, rtol=1e-2)
    # the rack of 20° and a gear of 24 teeth, by hand; x1 shifts its pitch line, not its angle
    base, sine = 36e-3 * math.cos(math.radians(20.0)), math.sin(math.radians(20.0))
    tip = 36e-3 + 3e-3 * 1.3
    r_end = math.sqrt(tip**2 - base**2) - 36e-3 * sine
    r_start = -3e-3 * (1.0 - 0.3) / sine
    curvature = [1.0 / (r + 36e-3 * sine) for r in (-3e-3, 2e-3)]
    ratio = (r_end - r_start) / (3e-3 * math.pi * math.cos(math.radians(20.0)))
    rack = [ratio, r_start, r_end, math.radians(20.0), *curvature, *2 * [36e-3 * sine]]
    rack[-2:] = [36e-3 * sine, 36e-3 * sine]
    np.testing.assert_allclose(means[-1], rack, rtol=2e-5)


LOSSES = """
title = "losses of a planet and its ring"
kind = "efficiency"
drive = "ring-36-93"
lubricant = "iso-vg-320-mineral"
operating = { pinion_speed = "20 rpm", gear_torque = "600 kN*m", oil_temperature = "60 degC" }
mesh = { compliance = "constant", stiffness = "7.5e9 N/m" }
friction = { law = "coulomb", coefficient = 0.06 }
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Any:
    path = tmp_path_factory.mktemp("ring") / "losses.toml"
    path.write_text(LOSSES, encoding="utf-8")
    return prepare(load_scenario(path))


CYCLOIDS = LOSSES.replace("ring-36-93", "cycloidal-ring-24-72").replace("20 rpm", "600 rpm")


def test_one_pair_of_cycloids_loses_what_the_torque_ratio_says(tmp_path: Path):
    """Veciana et al. with the ring's negative diameter, i = d2/d1 = −3, generating circles c = 1/3."""
    path = tmp_path / "losses.toml"
    path.write_text(CYCLOIDS.replace("600 kN*m", "600 N*m"), encoding="utf-8")
    mu, i, c = 0.06, -3.0, 1.0 / 3.0

    def ratio(psi: float) -> float:
        way = math.copysign(1.0, psi)
        a = abs(psi) / (2 * c)
        gear = i * math.cos(a) + way * mu * (i - way * 2 * c) * math.sin(a)
        return gear / (math.cos(a) + way * mu * (1 + way * 2 * c) * math.sin(a)) / i

    half = math.pi / 24
    mean = sum(quad(ratio, *ends, epsabs=1e-13)[0] for ends in ((-half, 0.0), (0.0, half))) / (2 * half)
    found = td.run(path).summary["efficiency_torque_ratio"]
    assert found == pytest.approx(mean, rel=1e-9)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_forces_at_the_contacts_balance_the_torques_by_vectors(study: Any, way: float):
    """Loads and friction as vectors at the points of contact, about both axes below the pitch point."""
    duty = study.duty._replace(gear_torque=way * TORQUE)
    phase = np.array([0.01, 0.2, 0.5, 0.7, 0.95])
    mesh = places(study.cycle, study.path, phase, "elastic")
    state = engage(mesh, duty)
    angle = math.radians(15.62948932077594)
    along, across = (
        np.array([math.cos(angle), math.sin(angle)]),
        np.array([-math.sin(angle), math.cos(angle)]),
    )
    axes = np.array([0.0, -0.368842105]), np.array([0.0, -0.952842105])
    for k in range(len(phase)):
        torques, lost = np.zeros(2), 0.0
        for q in range(2):
            r = float(mesh.cycle.signed_distance[k, 0, q])
            force = state.normal_load[k, q] * along - state.friction_force[k, q] * across  # on the ring
            for number, (axis, sign) in enumerate(zip(axes, (-1.0, 1.0), strict=True)):
                arm = r * along - axis
                # clockwise: the sense in which both turn
                torques[number] += sign * -(arm[0] * force[1] - arm[1] * force[0])
            planet, own = (
                -speed * np.array([-(r * along - axis)[1], (r * along - axis)[0]])
                for axis, speed in zip(axes, (SPEED, SPEED * 36 / 93), strict=True)
            )
            lost += abs(0.06 * state.normal_load[k, q] * float((planet - own) @ across))
        # the planet's is against its motion, for which the drive makes up; where the ring drives both turn
        assert way * -torques[0] == pytest.approx(state.pinion_torque[k], rel=1e-6)
        assert way * torques[1] == pytest.approx(state.gear_torque[k], rel=1e-6)
        assert state.gear_torque[k] == pytest.approx(way * TORQUE, rel=1e-9)
        assert state.power_friction[k] == pytest.approx(lost, rel=1e-6)
        assert state.power_in[k] == pytest.approx(state.power_out[k] + lost, rel=1e-6)


def test_the_loss_of_a_mesh_cycle_is_the_integral_over_the_path(study: Any):
    """Equal loads of all pairs in contact, which friction lowers: integrated over the line of action."""
    mu, pitch = 0.06, 2 * math.pi * BASE / 36
    start, end = 0.0007354127, 0.1010197956
    ring_base = 0.9176112

    def loss(first: float) -> float:
        """Friction power over the planet's speed of all pairs when one stands at `first`."""
        at = [r for r in (first, first + pitch) if start <= r < end]
        # the planet's flank slides towards its root, which is the way that the ring moves: friction helps
        arms = [ring_base + mu * (RING_TANGENT + r) for r in at]
        load = TORQUE / sum(arms)
        return sum(mu * load * (1 - 36 / 93) * r for r in at)

    leaving = end - pitch
    total = sum(quad(loss, *ends, epsabs=0.0)[0] for ends in ((start, leaving), (leaving, start + pitch)))
    found = cycle_efficiency(study.cycle, study.path, study.duty)
    assert found.power_friction == pytest.approx(total / pitch * SPEED, rel=2e-5)
    assert found.efficiency == pytest.approx(1.0 - found.power_friction / found.power_in, rel=1e-12)


def test_an_internal_mate_counts_as_a_rack_in_the_standard(model: DriveModel, ring: Assembly):
    shifts = 0.5039, 0.1171
    found = theoretical_stiffness((36.0, -93.0), shifts)
    assert found == pytest.approx(theoretical_stiffness((36.0, 1e12), shifts), rel=1e-9)
    # printed in a design report: c' 15.416 of z 17/-56, x 0.8021/-0.5013, h_fP 1.25; without x_2 it is 15.857
    stage = 0.8 * 0.975 * theoretical_stiffness((17.0, -56.0), (0.8021, -0.5013))
    assert stage == pytest.approx(15.416e9, rel=5e-4)
    pair = pair_of(ring, model.materials, 654e3)
    assert pair.teeth == (36.0, -93.0)
    assert pair.line_load == pytest.approx(654e3 * 0.9176112 / 0.9765 / 0.55, rel=1e-5)
