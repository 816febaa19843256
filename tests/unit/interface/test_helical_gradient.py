"""Derivatives of helical pairs, against differences of scenarios and the tables that runs have."""

import math

import numpy as np
import pytest

import tribodyn as td
from tests.support.soak_parameters import all_in_soak
from tribodyn.derivatives.differentiable import fixed_of
from tribodyn.derivatives.numbers import numbers_of
from tribodyn.derivatives.quantities import PairEvaluation, quantity_of
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.mesh.equilibrium import contacts, elastic, settled
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.mesh.slices.fine import tabulate_integrated
from tribodyn.studies import study_of
from tribodyn.tribology.closure import closure_of, surfaces_of

PAIR = "helical-23-47"
OF = ["transmission_error_swing", "mean_stiffness", "efficiency", "friction_power", "hertz_pressure_max"]
KEYS = {
    "drive.helix_angle": "rad",
    "drive.module": "m",
    "drive.pinion.face_width": "m",
    "operating.gear_torque": "N*m",
    "operating.pinion_speed": "rad/s",
}
#: The gear's face is wider: at equal widths the common one has a kink.
FEW = {"drive.gear.face_width": "26 mm", "mesh.slices": 5}
#: What is differentiated as a whole; XLA compiles for as long as there are quantities.
SOME = ["transmission_error_swing", "efficiency", "hertz_pressure_max"]
OTHERS = {
    "coupled": {"mesh.hertz": "load-dependent", "drive.hand": "left"},
    "apart": {"mesh.slice_coupling": False},
}


def changed(overrides, key, value):
    return td.scenario(PAIR, overrides | {key: f"{float(value)!r} {KEYS[key]}"}).pair


def value(case, name):
    """Of plain numbers, without a compiled program."""
    return float(quantity_of(case, name).function(PairEvaluation(case, fixed_of(case))))


def quantities(case, of=OF):
    at = PairEvaluation(case, fixed_of(case))
    return np.array([float(quantity_of(case, name).function(at)) for name in of])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "of", "slices"),
    all_in_soak(
        [("apart", SOME, 3), *((name, OF, 5) for name in OTHERS)], lambda case: case[1] is SOME, names=3
    ),
)
def test_slopes_are_those_of_other_scenarios(name, of, slices):
    overrides = FEW | OTHERS[name] | {"mesh.slices": slices}
    function = td.differentiable(PAIR, of, list(KEYS), overrides)
    values, slopes = function.jacobian(function.at)
    assert values == pytest.approx(quantities(td.scenario(PAIR, overrides).pair, of), rel=1e-10)
    for key, at, slope in zip(KEYS, function.at, slopes.T, strict=True):
        ends = [quantities(changed(overrides, key, (1.0 + way * 1e-5) * at), of) for way in (1, -1)]
        expected = (ends[0] - ends[1]) / (2e-5 * at)
        np.testing.assert_allclose(slope, expected, rtol=1e-5, atol=1e-7 * np.abs(values / at).min())


def by_the_table_of_a_run(case):
    """The first four quantities by sums over many even nodes."""
    pair = assemble(family(case.family), case.drive)
    torque, speed = case.operating.gear_torque, case.operating.pinion_speed
    cycle = tabulate_integrated(pair, case.materials, case.mesh, torque, nodes=2049)
    state = quasi_static(cycle, torque)
    seen = contacts(cycle, torque, speed, closure_of(case))
    found = settled(seen, elastic(cycle, torque))
    sliding = seen.side * (seen.pinion_speed - seen.gear_speed)
    lost = float(np.mean((found.friction_coefficient * found.normal_load * sliding).sum(axis=-1)[0, :-1]))
    through = torque * speed * case.drive.pinion.teeth / case.drive.gear.teeth
    stiffness = float(np.mean(state.mesh_stiffness[0, :-1]))
    return np.array([np.ptp(state.deflection), stiffness, through / (through + lost), lost])


@pytest.mark.parametrize("key", all_in_soak(KEYS, ("drive.helix_angle", "operating.gear_torque")))
def test_values_and_slopes_are_those_of_a_fine_table(key):
    """Over steps by which kinks pass many nodes, so that the error of the table averages out."""
    overrides = FEW | {"mesh.slices": 7}
    case = td.scenario(PAIR, overrides).pair
    values = quantities(case)[:4]
    assert by_the_table_of_a_run(case) == pytest.approx(values, rel=1e-5)
    at = numbers_of(case, study_of({"kind": case.kind}).table())[key].value
    ends = [changed(overrides, key, (1.0 + way * 3e-3) * at) for way in (1, -1)]
    slopes, expected = (
        (of(ends[0])[:4] - of(ends[1])[:4]) / (6e-3 * at) for of in (quantities, by_the_table_of_a_run)
    )
    np.testing.assert_allclose(slopes, expected, rtol=6e-4, atol=1e-6 * np.abs(values / at).min())


@pytest.mark.parametrize(
    ("overrides", "of", "said"),
    [
        ({"drive.pinion.modification.crowning": "5 um"}, "efficiency", "modified or misaligned flanks"),
        ({"mesh.compliance": "fem", "mesh.slices": 5}, "mean_stiffness", "by finite elements"),
    ],
)
def test_what_is_refused(overrides, of, said):
    with pytest.raises(td.InputError, match=said):
        td.gradient(PAIR, of, "drive.helix_angle", overrides)


def test_contact_at_the_pitch_point_in_closed_form():
    """An involute's normal section: ρ = ρ_t/cos β_b, and the load F_t/cos α_t/cos β_b on b/cos β_b."""
    case = td.scenario(PAIR).pair
    beta, alpha = abs(case.drive.helix_angle), case.drive.pressure_angle
    lean = math.atan(math.tan(beta) * math.cos(alpha))
    radii = [case.drive.module * side.teeth / 2.0 for side in (case.drive.pinion, case.drive.gear)]
    radius = math.sin(alpha) / sum(1.0 / r for r in radii) / math.cos(lean)
    assert value(case, "equivalent_radius") == pytest.approx(radius, rel=1e-12)
    width, torque = case.drive.pinion.face_width, case.operating.gear_torque
    line_load = torque / radii[1] / math.cos(alpha) / width  # both by cos β_b
    pressure = math.sqrt(line_load * surfaces_of(case).effective_modulus / (2.0 * math.pi * radius))
    assert value(case, "hertz_pressure") == pytest.approx(pressure, rel=1e-9)
