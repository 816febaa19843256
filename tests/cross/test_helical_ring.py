"""A helical planet and its ring: closed forms, the pair seen from either gear, forces along the axes."""

import math
from typing import Any

import numpy as np
import pytest

from tests.support.states import altered, random_state
from tribodyn.dynamics.equations import derivatives
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import (
    contact_line_lengths,
    contact_lines,
    hand_name,
    lead,
    normal_module,
    overlap_ratio,
)
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.mesh.slices.helical import slice_layout, tabulate_slices
from tribodyn.mesh.table import MeshData
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.studies.drive_file import DriveModel, load_drive
from tribodyn.train.structure import turn_of

CONSTANT = MeshData("constant", 0.05, stiffness=7.5e9, slices=5)
WIDTH = 0.52
TORQUE = 600e3
#: Stage 2 of a turbine of 10 MW, planet and ring, without the alteration of the tips.
PAIR: dict[str, Any] = {
    "family": "involute",
    "module": "20 mm",
    "pressure_angle": "20 deg",
    "helix_angle": "8 deg",
    "centre_distance": "684.273 mm",
    "roughness": "0.5 um",
    "material": "18CrNiMo7-6",
    "pinion": {"teeth": 41, "face_width": "520 mm", "profile_shift": 0.1213, "tip_diameter": "872.5 mm"},
    "gear": {
        "teeth": 109,
        "face_width": "520 mm",
        "internal": True,
        "profile_shift": -0.0024,
        "tip_diameter": "2161.5 mm",
        "outer_diameter": "2400 mm",
    },
}


@pytest.fixture(scope="module")
def model() -> DriveModel:
    return load_drive(PAIR)


@pytest.fixture(scope="module")
def both(model: DriveModel) -> tuple[Assembly, Assembly]:
    """The planet as the pair's pinion, and the ring."""
    drive = model.drive
    return (
        check(family("involute"), drive),
        check(family("involute"), drive._replace(pinion=drive.gear, gear=drive.pinion)),
    )


def _cycle(model: DriveModel, pair: Assembly, phase: Any = None) -> MeshCycle:
    return tabulate_slices(pair, model.materials, CONSTANT, slice_layout(pair, CONSTANT, 5), phase)


def test_both_gears_have_one_hand_and_leads_in_proportion_of_their_teeth(both: Any):
    drive = both[0].drive
    assert {hand_name(drive, "pinion"), hand_name(drive, "gear")} == {"right"}
    assert lead(drive, "gear") / lead(drive, "pinion") == pytest.approx(109 / 41, rel=1e-12)
    # π z m_n/sin β
    expected = math.pi * 109 * normal_module(drive) / math.sin(drive.helix_angle)
    assert lead(drive, "gear") == pytest.approx(expected, rel=1e-12)


def test_lines_of_contact_have_the_closed_form_whichever_drives(both: Any):
    """s ε_α ε_β and its extremes, with s = p_bt/sin β_b and the fractions of both contact ratios."""
    drive = both[0].drive
    base = math.atan(math.tan(drive.helix_angle) * math.cos(drive.pressure_angle))
    across = math.pi * drive.module * math.cos(drive.pressure_angle) / math.sin(base)
    alpha, beta = both[0].contact_ratio, WIDTH * math.tan(base) / across / math.sin(base)
    a, b = alpha % 1.0, beta % 1.0
    for pair in both:
        lines = contact_lines(pair)
        assert lines.mean == pytest.approx(across * alpha * beta, rel=1e-9)
        assert lines.minimum == pytest.approx(lines.mean - across * (a * b - max(0.0, a + b - 1.0)), rel=1e-9)
        assert lines.maximum == pytest.approx(lines.mean - across * (a * b - min(a, b)), rel=1e-9)
    # seen from the ring the phase runs backwards, from where the pair leaves the middle of the face
    phase = np.linspace(0.0, 1.0, 41)
    ours, theirs = contact_line_lengths(both[0], phase), contact_line_lengths(both[1], alpha - phase)
    np.testing.assert_allclose(theirs, ours, rtol=1e-6)


def test_the_mesh_is_the_same_when_the_ring_drives(model: DriveModel, both: Any):
    """Stiffness over the phase: what is late seen from the planet is early seen from the ring."""
    # phases count from where the earliest edge enters: the whole field is both contact ratios long
    phase, total = np.linspace(0.0, 1.0, 41), both[0].contact_ratio + overlap_ratio(both[0])
    cycles = _cycle(model, both[0], phase), _cycle(model, both[1], (total - phase) % 1.0)
    one, other = (
        quasi_static(cycle, float(cycle.gear_sense) * torque)
        for cycle, torque in zip(cycles, (TORQUE, TORQUE * 41 / 109), strict=True)
    )
    np.testing.assert_allclose(other.deflection[0], one.deflection[0], rtol=1e-9)
    assert 1.02 * one.deflection.min() < one.deflection.max()


def test_a_vanishing_helix_is_the_spur_ring():
    """Sheet and stiffness over the cycle of β = 1e-3 degrees against β = 0."""
    sheets, deflections = [], []
    for angle in ("1e-3 deg", None):
        changes = {} if angle is None else {"drive.helix_angle": angle}
        spur = load_drive("ring-36-93", changes)
        pair = check(family("involute"), spur.drive)
        sheets.append(geometry_sheet(pair))
        deflections.append(quasi_static(_cycle(spur, pair), -TORQUE).deflection)
    for name in ("contact ratio", "operating pressure angle"):
        assert sheets[0][name][0] == pytest.approx(sheets[1][name][0], rel=1e-6)
    assert np.min(deflections[0]) == pytest.approx(np.min(deflections[1]), rel=1e-6)
    assert np.max(deflections[0]) == pytest.approx(np.max(deflections[1]), rel=1e-6)


@pytest.mark.parametrize("hand", ["right", "left"])
def test_forces_along_the_axes_are_those_of_screws(prepared: Any, rng: Any, hand: str):
    """A gear that advances by its lead while it turns once leaves its flanks where they are: no work.

    What the ring does to the planet the planet does to the ring.
    """
    table = {f"drive.{key}": value for key, value in PAIR.items() if isinstance(value, str)}
    for gear in ("pinion", "gear"):
        table |= {f"drive.{gear}.{key}": value for key, value in PAIR[gear].items()}
    table |= {
        "drive.hand": hand,
        "mesh.slices": 5,
        "mesh.compliance": "constant",
        "mesh.stiffness": "4e8 N/m",
    }
    pair = prepared("ring-36-93", **table, **{"friction.coefficient": 0.0})
    springs = {"own", "coupled", "bearings"} ^ set(pair.model.links._fields)
    free = {name: 0.0 * getattr(pair.model.links, name) for name in springs}
    model = altered(pair.model, links=free, bodies={"load": np.zeros(2)})
    layout, bodies = model.layout, model.bodies
    y = random_state(rng, model)
    y[layout.half :] = 0.0
    y[turn_of(1, layout)] = -2e-4 / abs(float(model.meshes[0].driven_radius))
    rates: dict[int, Any] = {}
    derivatives(0.37, 0.0, 0, y, model, contacts_of(model), rates)
    rate = model.operation.pitch_angle / model.operation.nominal_speed
    along = [bodies.mass[body] * rates[layout.half + layout.tilts + 3 * body] / rate for body in range(2)]
    assert along[0] == pytest.approx(-along[1], rel=1e-12)
    turning = bodies.inertia[1] * rates[layout.half + turn_of(1, layout)] / rate
    # both turn clockwise, and what is right-hand then advances along -z
    advance = lead(pair.assembly.drive, "gear") / (2.0 * math.pi) * (-1.0 if hand == "right" else 1.0)
    assert turning > 1e3
    assert turning + along[1] * advance == pytest.approx(0.0, abs=1e-9 * turning)
