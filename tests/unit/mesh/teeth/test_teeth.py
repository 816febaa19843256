"""Teeth that differ: what run-out and errors of single teeth make of the quasi-static transmission error."""

from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tests.support.own_teeth import errors, made
from tests.support.pair_outputs import outputs
from tribodyn.mesh.teeth.fields import LEADING, TRAILING
from tribodyn.solve.initial import initial_state
from tribodyn.solve.transient import Stop, TransientSettings, transient
from tribodyn.studies.motion.assembly import PreparedGearbox

ECCENTRICITY = 20e-6


@pytest.mark.parametrize(
    ("side", "name", "more"),
    [
        ("pinion", "involute-23-47", {}),
        ("gear", "involute-23-47", {"mesh.backlash": "0.1 mm", "operating.gear_torque": "-500 N*m"}),
        ("pinion", "helical-23-47", {}),
        pytest.param("gear", "helical-23-47", {}, marks=pytest.mark.soak),
    ],
    ids=["spur", "back flanks", "helical", "helical gear"],
)
def test_run_out_is_a_sine_of_the_gear_s_rotation(side: str, name: str, more: dict[str, Any]):
    """e along the transverse normal, e/cos α_w along the pitch tangent, at any phase of the mesh."""
    teeth = {"pinion": 23, "gear": 47}[side]
    case = made(name, more | {f"drive.{side}.eccentricity": "20 um"})
    plain = made(name, more)
    at = np.arange(teeth) + 0.37
    found = errors(case.model, at) - errors(plain.model, np.full(1, 0.37))
    lines = np.abs(np.fft.rfft(found)) / teeth * 2.0
    cosine = np.cos(float(case.assembly.path.pressure_angle(0.0)))
    assert lines[1] == pytest.approx(ECCENTRICITY / cosine, rel=1e-3)
    assert max(lines[0], *lines[2:]) < 1e-3 * lines[1]


@pytest.mark.parametrize("side", ["pinion", "gear"])
def test_run_out_has_an_angle(side: str):
    """Half a turn further it is the opposite."""
    changes, end = {f"drive.{side}.eccentricity": "20 um"}, {"pinion": "driver", "gear": "driven"}[side]
    angles = ({f"drive.{side}.eccentricity_angle": angle} for angle in ("0 deg", "180 deg"))
    one, two = (getattr(made("involute-23-47", changes | a).model.meshes[0].teeth, end) for a in angles)
    np.testing.assert_allclose(one.channel, -two.channel, rtol=0, atol=1e-12)


def test_wobble_is_eccentricity_that_grows_along_the_face():
    tilt = 1e-3
    case = made("helical-23-47", {"drive.gear.wobble": f"{tilt} rad"})
    channel = case.model.meshes[0].teeth.driven.channel[:, :, :, 0, 0]
    faces = np.abs(np.asarray(case.cycle.face_position))
    largest = np.abs(channel).max(axis=(0, 1))
    lean = np.cos(
        np.arctan(float(case.cycle.pitch_slope) * np.cos(np.asarray(case.cycle.pressure_angle).flat[0]))
    )
    np.testing.assert_allclose(largest, tilt * faces * lean, rtol=5e-3, atol=1e-12)


def test_one_pitch_error_is_seen_while_its_tooth_carries_alone():
    error, tooth = 10e-6, 5
    listed = [f"{1e6 * error if n == tooth else 0.0} um" for n in range(23)]
    case, plain = (
        made("involute-23-47", {"drive.pinion.modification.pitch_errors": listed}),
        made("involute-23-47", {}),
    )
    alone = 0.5 * (float(case.assembly.contact_ratio) - 1.0 + 1.0)  # in the middle between two changes
    at = np.arange(46) + alone
    found = errors(case.model, at) - errors(plain.model, np.array([alone]))
    cosine = np.cos(float(case.assembly.path.pressure_angle(0.0)))
    expected = np.where(np.arange(46) % 23 == tooth, error / cosine, 0.0)
    np.testing.assert_allclose(np.abs(found), expected, rtol=0, atol=1e-3 * error)


def test_formula_and_measured_flanks_are_the_same():
    """Linear over height, so that both are exact."""
    formula = {"drive.gear.modification.tooth_formula": "i*h"}
    tooth, height = (part.ravel() for part in np.meshgrid(np.arange(1, 48), [0.0, 1.0], indexing="ij"))
    columns = {
        "tooth": {"unit": "1", "values": tooth.tolist()},
        "height": {"unit": "1", "values": height.tolist()},
        "face": {"unit": "mm", "values": [0.0] * len(tooth)},
        "error": {"unit": "um", "values": (tooth * height).tolist()},
    }
    one = made("involute-23-47", formula).model.meshes[0].teeth
    two = made("involute-23-47", {"drive.gear.modification.tooth_errors": columns}).model.meshes[0].teeth
    np.testing.assert_allclose(one.driven.channel, two.driven.channel, rtol=0, atol=1e-12)


def test_a_sample_keeps_its_tolerances_and_its_seed():
    changes = {"drive.quality": 6, "mesh.tooth_sample": 3}
    case = made("involute-23-47", changes)
    (own,) = case.warm_pairs[0].teeth[0]
    again = made("involute-23-47", changes).warm_pairs[0].teeth[0][0]
    other = made("involute-23-47", changes | {"mesh.tooth_sample": 4}).warm_pairs[0].teeth[0][0]
    assert own == again != other
    places = _places(case)
    flanks = [own.fields(tooth, LEADING, places).gap for tooth in range(23)]
    pitch = np.array([gap.mean() for gap in flanks])
    allowed = own.limits
    most = 0.5 * allowed.profile_form
    assert np.ptp(pitch) <= allowed.total_pitch + 2.0 * most
    assert np.abs(np.diff(pitch)).max() <= allowed.single_pitch + 2.0 * most
    for gap in flanks:
        assert np.ptp(gap) <= allowed.profile_slope + allowed.profile_form
    trailing = own.fields(0, TRAILING, places)
    assert not np.allclose(trailing.gap, flanks[0])


def _places(case: PreparedGearbox):
    from tribodyn.mesh.teeth.table import places_of

    return places_of(case.assembly, case.warm_pairs[0].mesh, case.cycle)[0].driver


@pytest.mark.parametrize("name", ["crc-23-47", "helical-23-47"])
def test_teeth_that_are_alike_are_those_of_one_mesh_cycle(name: str):
    """A formula that is zero goes through the look-up of single teeth, and changes nothing but rounding.

    At the states of a run, so that no decision of the step control stands between the two.
    """
    short = {"operating.pinion_speed": "900 rpm"}
    one = made(name, short).model
    two = made(name, short | {"drive.pinion.modification.tooth_formula": "0*i"}).model
    assert len(two.meshes[0].teeth.rate)
    settings = TransientSettings("dopri5", 1e-6, 4, 10**6, 40)
    parts = [
        part for part in transient(one, initial_state(one, "static"), settings) if not isinstance(part, Stop)
    ]
    cycles, states = (
        np.concatenate([getattr(part, what) for part in parts]) for what in ("cycles", "states")
    )
    first, second = (outputs(cycles, states, model) for model in (one, two))
    for quantity, values in first.items():
        size = np.nanmax(np.abs(values), initial=0.0)
        np.testing.assert_allclose(second[quantity], values, rtol=1e-9, atol=1e-12 * size, err_msg=quantity)


def test_bad_input_is_one_message():
    wrong = {
        "drive.pinion.eccentricity_angle": "10 deg",
        "drive.gear.modification.tooth_formula": "open('x')",
        "drive.pinion.modification.tooth_formula": "i**i**i**i",
        "drive.pinion.eccentricity": "3 mm",
        "drive.gear.wobble": "5 deg",
    }
    for key, value in wrong.items():
        with pytest.raises(td.InputError) as caught:
            td.scenario("involute-23-47", {key: value})
        assert key in str(caught.value)
    for formula in ("(-8)**(1/3)", "sin(h, h)", "sqrt(abs(h-0.06) - 0.01)"):
        with pytest.raises(td.InputError, match="tooth_formula"):
            td.scenario("involute-23-47", {"drive.gear.modification.tooth_formula": formula})
    columns = {
        name: {"unit": unit, "values": [1.0, 2.0]}
        for name, unit in (("tooth", "1"), ("face", "mm"), ("error", "um"))
    }
    columns |= {"tooth": {"unit": "1", "values": [24.0, 24.0]}, "height": {"unit": "1", "values": [0.0, 1.0]}}
    with pytest.raises(td.InputError, match="teeth 1 to 23"):
        td.scenario("involute-23-47", {"drive.pinion.modification.tooth_errors": columns})
    with pytest.raises(td.InputError, match="takes all teeth of a gear alike"):
        td.scenario("efficiency-involute-18-36", {"drive.pinion.eccentricity": "10 um"})
