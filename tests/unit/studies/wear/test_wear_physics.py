"""Wear of a pair against closed forms, balances and identities."""

import numpy as np
import pytest

from tests.support.worn_pairs import COEFFICIENT, DRY, OILED, new, study_of, worn
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.studies.wear.outcome import volumes
from tribodyn.studies.wear.passage import march, unworn

HELICAL = {
    **DRY,
    "drive": "helical-23-47",
    "operating": {"pinion_speed": "150 rpm", "gear_torque": "300 N*m"},
}


def alone(study, at):
    """Nodes at which one pair carries the torque by itself."""
    share = at.load.sum(axis=-1) / at.load.sum(axis=(-1, -2))[..., None]
    return np.flatnonzero(np.isclose(study.places.to_node[0] @ share[0].ravel(), 1.0, atol=1e-12))


def test_a_pair_alone_wears_by_the_closed_form_of_the_involute():
    """k w' |v_1 − v_2|/|v_own| per passage, with the radii of curvature a distance s from the pitch point."""
    study = study_of()
    at, drive = new(study), study.case.drive
    nodes = alone(study, at)
    assert len(nodes) >= 8
    angle, module, ratio = np.radians(20.0), 3e-3, 36 / 18
    base = [module * teeth / 2.0 * np.cos(angle) for teeth in (18, 36)]
    # the contact moves r_b dφ along the line of action, between the centres of curvature of the flanks
    s = base[0] * study.places.node[nodes]
    radii = base[0] * np.tan(angle) + s, base[1] * np.tan(angle) - s
    line_load = 318.3 / base[1] / float(drive.pinion.face_width)
    slide = np.abs(s) * (1.0 + 1.0 / ratio)
    depth = COEFFICIENT * line_load * slide
    np.testing.assert_allclose(at.rates[0][0, nodes, 0], depth / radii[0], rtol=1e-9)
    # the gear's flank is passed at ρ_2 ω_2, once in two revolutions of the pinion
    np.testing.assert_allclose(at.rates[1][0, nodes, 0], depth / (radii[1] / ratio) / ratio, rtol=1e-9)


@pytest.mark.parametrize(
    ("table", "keys", "close"),
    [
        (DRY, {}, 1e-12),
        (OILED, {"wear__law": "priest-taylor"}, 1e-12),
        (DRY, {"mesh__slices": 5, "mesh__misalignment__in_plane": "1 arcmin"}, 1e-12),
        (HELICAL, {"mesh__slices": 7}, 1e-3),
    ],
)
def test_what_is_missing_is_what_load_and_sliding_wear_off(table, keys, close):
    """On both gears, with the quadrature of the steps; helical slices are interpolated between positions."""
    study = study_of(table, **keys)
    state, _ = worn(study)
    assert state.volume > 0.0
    np.testing.assert_allclose(volumes(study, state.depths) / state.volume, 1.0, atol=close)


def test_the_volume_is_the_integral_of_k_p_v():
    """Of new flanks: that over time and contact, from the load contact model itself at many positions."""
    flanks = study_of().places.held.flanks
    assembly, count = flanks.flexible.assembly, 8000
    (start, end), pitch = assembly.roll_limits, assembly.pitch_angle
    roll = start + pitch * ((np.arange(count)[:, None] + 0.5) / count + np.array([2.0, 1.0, 0.0, -1.0]))
    load = flanks.share(roll, 318.3).normal_load * ((roll > start) & (roll < end))
    sliding = np.abs(pair_geometry(assembly, roll).motion.sliding)  # m/rad
    # the pressure integrated over the contact is the load; a revolution is 2π of the pinion's rotation
    rubbed = COEFFICIENT * 2.0 * np.pi * np.mean(np.sum(load * sliding, axis=1))
    errors = []
    for positions in (15, 60, 240):
        study = study_of(output__positions_per_cycle=positions)
        errors.append(abs(volumes(study, new(study).rates)[0] / rubbed - 1.0))
    assert errors[0] < 2e-3
    assert errors[1] < errors[0] / 4.0
    assert errors[2] < 2e-4


def test_the_pitch_line_stays_unworn():
    study = study_of()
    state, _ = worn(study)
    node = study.places.node
    for depth in state.depths:
        profile = depth[0, :, 0]
        before, after = np.flatnonzero(node < 0.0)[-2:], np.flatnonzero(node > 0.0)[:2]
        for side in (before, after):  # on either side the depth goes to nothing as a straight line
            at_pitch_point = np.polyval(np.polyfit(node[side], profile[side], 1), 0.0)
            assert abs(at_pitch_point) < 5e-3 * np.max(profile)
        assert np.argmin(profile) in (before[-1], after[0])


def test_twice_the_coefficient_in_half_the_revolutions_is_the_same():
    once, twice = study_of(), study_of(wear__coefficient=f"{2 * COEFFICIENT} m**2/N", wear__revolutions=5e5)
    first, second = worn(once)[0], worn(twice)[0]
    assert first.steps == second.steps
    for a, b in zip(first.depths, second.depths, strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-9)


def test_twice_the_load_in_half_the_revolutions_is_the_same_where_a_pair_is_alone():
    """There the load is the torque's, whatever is worn; where pairs share, they share otherwise."""
    once = study_of(operating__gear_torque="100 N*m")
    twice = study_of(operating__gear_torque="200 N*m", wear__revolutions=5e5)
    (first, at), (second, heavier) = worn(once), worn(twice)
    nodes = np.intersect1d(alone(once, at), alone(twice, heavier))
    nodes = np.intersect1d(nodes, np.intersect1d(alone(once, new(once)), alone(twice, new(twice))))
    assert len(nodes) >= 8
    for a, b in zip(first.depths, second.depths, strict=True):
        np.testing.assert_allclose(a[0, nodes], b[0, nodes], rtol=1e-9)
        assert not np.allclose(a[0], b[0], rtol=1e-2)


def test_pairs_that_share_the_load_come_to_wear_alike():
    """The conjugate limit: flanks wear until k p v of both gears is the same wherever pairs share the load.

    What both pairs leave open then grows by the same: the error no longer changes there but evenly.
    """
    study = study_of(wear__revolutions=5e7)
    node = study.places.node
    pitch = study.places.held.flanks.flexible.assembly.pitch_angle
    shared = node[node + pitch <= node[-1]]

    def ratio(at):
        opened = sum(rate[0, :, 0] for rate in at.rates)
        return np.interp(shared, node, opened) / np.interp(shared + pitch, node, opened)

    _, at = worn(study)
    assert np.max(ratio(new(study))) > 10.0
    np.testing.assert_allclose(ratio(at)[2:-2], 1.0, atol=1e-2)


def test_a_film_above_the_separating_one_wears_nothing():
    keys = {"wear__boundary_film_parameter": 0.01, "wear__separating_film_parameter": 0.05}
    study = study_of(OILED, wear__law="priest-taylor", **keys)
    state, at = worn(study)
    ratio = at.contacts.film[at.load > 0.0] / at.closure.surfaces.roughness
    assert np.min(ratio) > 0.05
    assert all(np.all(depth == 0.0) for depth in state.depths)
    assert (state.volume, state.steps, state.rejected) == (0.0, 1, 0)


def test_wear_by_asperities_is_archards_times_their_share():
    asperities, whole = (new(study_of(OILED, wear__law=law)) for law in ("archard-asperities", "archard"))
    share = asperities.coefficient / whole.coefficient
    carried = whole.load > 0.0
    np.testing.assert_allclose(share[carried], asperities.contacts.asperity_load_ratio[carried], rtol=1e-12)
    assert 0.0 < np.mean(share[carried]) < 1.0


def test_energy_wears_what_friction_dissipates():
    """A constant coefficient of friction makes it Archard's law with k = k_E μ."""
    table = {**OILED, "wear": {"law": "energy", "energy_coefficient": "2e-16 m**2/N", "revolutions": 1e6}}
    thin = {"wear__boundary_film_parameter": 50.0, "wear__separating_film_parameter": 100.0}
    by_energy, by_archard = worn(study_of(table, **thin))[0], worn(study_of(OILED))[0]
    for a, b in zip(by_energy.depths, by_archard.depths, strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-9)  # 2e-16 times 0.05 is the same 1e-17


def test_no_step_moves_a_load_by_more_than_is_allowed():
    study = study_of(wear__load_change=0.01)
    rows = np.linspace(0.0, study.case.revolutions, 30)
    (before, last), *every = march(study, unworn(study), rows)
    for state, at in every:
        assert at.moved_from(last) <= 0.01 * (state.steps - before.steps)
        before, last = state, at
    assert before.steps >= 29


def test_a_step_that_moves_a_load_too_far_is_halved():
    study = study_of()
    far = unworn(study)._replace(next_step=1e6)
    *_, (state, _) = march(study, far, np.array([1e6]))
    assert state.rejected > 2
    steady, _ = worn(study)
    np.testing.assert_allclose(state.depths[0], steady.depths[0], atol=2e-3 * np.max(steady.depths[0]))


def test_running_in_lifts_the_film_over_the_roughness_off_the_wear():
    """σ [s + (1 − s) e^(−N/N_0)]: at first as if nothing ran in, in the end as with smoother flanks."""
    table = {**OILED, "running_in": {"roughness_share": 0.5, "revolutions": 1e5}}
    keys = {"wear__law": "priest-taylor", "wear__revolutions": 4e6, "operating__pinion_speed": "3000 rpm"}
    study, stays = study_of(table, **keys), study_of(OILED, **keys)
    first, last = new(study), worn(study)[1]
    share = last.closure.surfaces.roughness / first.closure.surfaces.roughness
    assert share == pytest.approx(0.5, rel=1e-12)
    middle = worn(study, 1e5)[1].closure.surfaces.roughness / first.closure.surfaces.roughness
    assert middle == pytest.approx(0.5 + 0.5 * np.exp(-1.0), rel=1e-12)
    np.testing.assert_array_equal(first.rates[0], new(stays).rates[0])
    assert volumes(study, last.depths)[0] < 0.97 * volumes(stays, worn(stays)[0].depths)[0]


def test_an_eccentric_pinion_shows_in_the_error_once_per_revolution():
    """e sin(θ + α_w) along the normal: e/cos α_w of the gears' rotations."""
    drive = {"like": DRY["drive"], "pinion": {"eccentricity": "10 um"}}
    study = study_of({**DRY, "drive": drive}, wear__teeth="each")
    error, centred = (new(each).deflection for each in (study, study_of(wear__teeth="each")))
    cycles = np.arange(36)[:, None] + study.places.phase
    turned = 2.0 * np.pi * cycles / 18.0
    weight = study.places.weight / 36.0
    once = 2.0 * np.abs(np.sum(weight * (error - centred) * np.exp(-1j * turned)))
    assert once == pytest.approx(10e-6 / np.cos(np.radians(20.0)), rel=5e-3)


@pytest.mark.parametrize(("side", "teeth"), [("pinion", 18), ("gear", 36)])
def test_a_formula_of_single_teeth_counts_as_their_pitch_errors_do(side: str, teeth: int):
    """Either gear's: material that is missing."""
    errors = 5.0 * np.sin(2.0 * np.pi * np.arange(1, teeth + 1) / teeth)
    ways = ({"pitch_errors": [f"{e!r} um" for e in errors.tolist()]}, {"tooth_formula": "5*sin(2*pi*i/z)"})
    drives = [{"like": DRY["drive"], side: {"modification": way}} for way in ways]
    one, two = (new(study_of({**DRY, "drive": drive}, wear__teeth="each")).deflection for drive in drives)
    assert np.ptp(one) > 5e-6
    np.testing.assert_allclose(two, one, rtol=1e-6)


def test_teeth_that_are_alike_wear_like_their_mean():
    together, each = study_of(), study_of(wear__teeth="each")
    mean, own = worn(together)[0], worn(each)[0]
    assert [len(depth) for depth in own.depths] == [18, 36]
    for a, b in zip(own.depths, mean.depths, strict=True):
        np.testing.assert_allclose(a, np.broadcast_to(b, a.shape), rtol=1e-7, atol=1e-16)


def test_a_tooth_that_stands_ahead_wears_more():
    """With its mates: of 18 and 36 teeth one of the pinion meets two of the gear and no other."""
    table = {
        **DRY,
        "drive": {
            "like": DRY["drive"],
            "pinion": {"modification": {"pitch_errors": ["-4 um", *["0 um"] * 17]}},
        },
    }
    study = study_of(table, wear__teeth="each")
    state, _ = worn(study)
    pinion, gear = (
        np.sum(area * depth, axis=(1, 2)) for area, depth in zip(study.places.area, state.depths, strict=True)
    )
    assert np.argmax(pinion) == 0
    assert set(np.argsort(gear)[-2:]) == {0, 18}
    np.testing.assert_allclose(volumes(study, state.depths) / state.volume, 1.0, atol=1e-12)
    np.testing.assert_allclose(pinion[5:14], pinion[9], rtol=1e-2)  # far from it teeth are all alike


def test_a_ring_wears_like_any_gear():
    ring = {
        **DRY,
        "drive": "ring-36-93",
        "operating": {"pinion_speed": "20 rpm", "gear_torque": "600 kN*m"},
    }
    study = study_of(ring)
    state, _ = worn(study)
    assert all(np.all(depth > 0.0) for depth in state.depths)  # its pitch point is beyond the path
    np.testing.assert_allclose(volumes(study, state.depths) / state.volume, 1.0, atol=1e-12)
