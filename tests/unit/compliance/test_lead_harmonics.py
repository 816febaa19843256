"""Loads that vary along the teeth: half-space, depth, interpolation, the whole ring, the limits of k."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.sparse.linalg import spsolve

from tests.support.twelve_teeth import BODY, GEAR, POISSON, TOOTH, few_cells, whole_ring
from tribodyn.compliance.fem.gear import gear_compliance, gear_model, lead_harmonics
from tribodyn.compliance.fem.gear_compliance import (
    LARGEST,
    NEIGHBOURS,
    GearCompliance,
    LeadHarmonics,
    at_wave_numbers,
    half_space,
    half_space_surface,
    own_at_solved,
    wave_numbers,
)
from tribodyn.compliance.fem.strips import stress_rows, strip_stiffness
from tribodyn.compliance.local import freed_of_depth, weber_banaschek
from tribodyn.geometry.drive import MaterialData

MODULE, DEPTH = 3e-3, 0.75e-3


def solved(waves, depth=DEPTH, level=1) -> GearCompliance:
    gear = GEAR._replace(depth=depth, level=level, held=True)
    return gear_compliance(gear)._replace(lead=lead_harmonics(gear, np.asarray(waves)))


@pytest.fixture(scope="module")
def gear():
    return solved(wave_numbers(MODULE, TOOTH.root_radius))


@pytest.mark.parametrize("reach", [0.05, 0.5, 2.0])
def test_half_space_is_boussinesq_s_point_load_along_a_line(reach):
    # u_z(r, z) = (1 + ν)/(2 π E) [z²/R³ + 2 (1 − ν)/R] (K. L. Johnson, Contact Mechanics, (3.19d))
    depth = 2.0
    k = reach / depth

    def point(s, power):
        return (depth**2 + s**2) ** (-power / 2)

    near, far = (2 * quad(point, 0, np.inf, args=(power,), weight="cos", wvar=k)[0] for power in (3, 1))
    expected = (1 + POISSON) / (2 * np.pi) * (depth**2 * near + 2 * (1 - POISSON) * far)
    assert half_space(depth, np.array([k]), POISSON)[0] == pytest.approx(expected, rel=1e-6)


def test_surface_of_the_half_space_is_its_displacement_close_to_the_load():
    k, depth = np.array([3.0]), 1e-4
    inside, surface = half_space(depth, k, POISSON), half_space_surface(k, depth, POISSON)
    np.testing.assert_allclose(inside, surface, rtol=1e-6)


def test_surface_with_weber_banaschek_does_not_know_the_depth():
    # B(k; h) + u(h) is the approach under Hertz's pressure; only the contact's width over h is neglected
    steel = MaterialData("unit", 1.0, POISSON, 7850.0, 45.0, 460.0, 6.5e9)
    k, half_width = np.array([200.0]), 1e-5
    total = [
        half_space_surface(k, depth, POISSON)[0] + weber_banaschek(1.0, half_width, depth, steel)[0]
        for depth in (0.5e-3, 1e-3, 2e-3)
    ]
    np.testing.assert_allclose(total, total[0], rtol=1e-4)


def test_without_waves_it_is_the_plane_ring(gear):
    np.testing.assert_allclose(gear.lead.inside[0], gear.inside, rtol=1e-9)
    np.testing.assert_allclose(gear.lead.between[0], gear.between, rtol=1e-9, atol=1e-10)
    plane = at_wave_numbers(gear, np.array([0.0]), POISSON)
    np.testing.assert_allclose(plane.own[0], freed_of_depth(gear.inside, POISSON), rtol=1e-9)
    np.testing.assert_allclose(plane.between[0], gear.between, rtol=1e-9, atol=1e-10)
    np.testing.assert_allclose(plane.root_stress[0], gear.lead.root_stress[0], rtol=1e-9, atol=1e-7)


def test_a_free_gear_differs_under_an_even_load_alone(gear):
    free = gear_compliance(GEAR._replace(depth=DEPTH))._replace(lead=gear.lead)
    waves = np.array([0.0, 0.1, 1.0]) / MODULE
    held, loose = (at_wave_numbers(each, waves, POISSON) for each in (gear, free))
    np.testing.assert_allclose(loose.own[0], freed_of_depth(free.inside, POISSON), rtol=1e-9)
    np.testing.assert_allclose(loose.between[0], free.between, rtol=1e-9, atol=1e-10)
    assert np.all(loose.own[0] < held.own[0])
    np.testing.assert_array_equal(loose.own[1:], held.own[1:])
    np.testing.assert_array_equal(loose.between[1:], held.between[1:])


def test_response_is_even_and_smooth_in_the_wave_number():
    small = np.array([0.0, 1.0, 2.0])
    own = own_at_solved(solved(small), POISSON)
    np.testing.assert_allclose((own[2] - own[0]) / (own[1] - own[0]), 4.0, rtol=2e-3)


def test_interpolation_is_within_a_fifth_of_a_per_cent(gear):
    grid = gear.lead.wave_number
    middle = (grid[1:-1:2] + grid[2::2]) / 2
    direct = solved([0.0, *middle])
    found = at_wave_numbers(gear, middle, POISSON)
    # what gives way altogether: the body and the contact, about 1.4/E at ordinary loads
    local = 1.4
    own = own_at_solved(direct, POISSON)[1:]
    assert np.max(np.abs(found.own - own) / (own + local)) < 2e-3
    for part in ("between", "root_stress"):
        exact = getattr(direct.lead, part)
        near = exact[:, :, ..., 2:-1] if part == "root_stress" else exact[:, [0, 1, 3, 4]]
        guess = getattr(found, part)
        guess = guess[..., 2:-1] if part == "root_stress" else guess[:, [0, 1, 3, 4]]
        assert np.max(np.abs(guess - near[1:])) < 2e-3 * np.max(np.abs(near[0])), part


def test_short_waves_see_a_half_space(gear):
    # in the middle of the flank, away from root and tip; beyond what is solved exactly so
    at = slice(3, 8)
    k = np.array([3.0, LARGEST, 4 * LARGEST]) / MODULE
    found = at_wave_numbers(gear, k, POISSON)
    surface = half_space_surface(k, DEPTH, POISSON)
    excess = np.abs(found.own[:, at] - surface[:, None])
    assert np.all(excess[0] < 0.25)
    assert np.all(excess[1] < 0.02)
    np.testing.assert_allclose(excess[2], excess[1], atol=1e-12)
    assert not np.any(found.between[2])
    assert not np.any(found.root_stress[2])
    joint = at_wave_numbers(gear, k[1] * np.array([1 - 1e-9, 1 + 1e-9]), POISSON)
    np.testing.assert_allclose(joint.own[0], joint.own[1], atol=1e-6)


@pytest.mark.soak
def test_compliance_does_not_depend_on_the_depth_of_the_local_region():
    k, width, total = np.array([0.0, 0.5, 1.5]) / MODULE, 0.03, []
    for depth in (0.2, 0.25, 1 / 3):
        lead = lead_harmonics(GEAR._replace(depth=depth * MODULE, level=2), k)
        gear = GearCompliance(np.empty(0), np.empty(0), np.empty(0), depth * MODULE, lead)
        # with the contact's own deflection, of a half width of 0.03 modules
        local = 2 * (1 - POISSON**2) / np.pi * np.log(depth / width)
        total.append(own_at_solved(gear, POISSON)[:, 4:17] + local)
    assert np.max(np.abs(np.array(total) / total[1] - 1)) < 3e-3


def test_one_sector_of_few_cells_is_the_whole_ring_for_waves_too(monkeypatch):
    few_cells(monkeypatch)
    check_whole_ring(5)


def test_one_sector_is_the_whole_ring_for_waves_too():
    check_whole_ring(12)


def check_whole_ring(teeth):
    """Load a flank in its middle with a wave, and read flanks and roots of three teeth."""
    k = 0.4 / MODULE
    gear = GEAR._replace(teeth=teeth)
    lead = lead_harmonics(gear, np.array([k]))
    basis, mesh = whole_ring(1, teeth)
    flank, root = mesh.nodes[:, mesh.flank], mesh.nodes[:, mesh.root]
    middle = len(mesh.flank) // 2
    place = basis.doflocs

    def nodes(points):
        return np.array([np.argmin(np.hypot(*(place - point[:, None]))) for point in points.T])

    model = gear_model(gear)
    inward = model.loads[:, middle].reshape(-1, 2)
    inward = inward[np.any(inward != 0, axis=1)][0]
    constant, linear, square = strip_stiffness(basis, POISSON)
    matrix = (constant + k * linear + k**2 * square).tocsc()
    free = np.flatnonzero(np.repeat(np.hypot(*place) > BODY.bore_radius * (1 + 1e-9), 3))
    load = np.zeros(3 * basis.N)
    load[3 * nodes(flank[:, [middle]])[0] + np.arange(2)] = inward
    found = np.zeros(3 * basis.N)
    found[free] = spsolve(matrix[free][:, free], load[free])
    for tooth in (-2, 0, 1):
        angle = 2 * np.pi * tooth / teeth
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, -s], [s, c]])
        node = nodes(turn @ flank[:, [middle]])[0]
        expected = found[3 * node : 3 * node + 2] @ (turn @ inward)
        assert lead.between[0, NEIGHBOURS + tooth, middle, middle] == pytest.approx(expected, rel=1e-5)
        for side, mirror in enumerate(([1.0, 1.0], [1.0, -1.0])):
            points = turn @ (np.array(mirror)[:, None] * root)
            rows = stress_rows(points, nodes(points), 3 * basis.N, POISSON, k)
            stress = lead.root_stress[0, NEIGHBOURS + tooth, side, :, middle]
            np.testing.assert_allclose(stress, rows @ found, rtol=1e-5, atol=1e-6 * np.max(np.abs(stress)))


def any_gear(rng, waves, depth):
    """A gear whose responses are smooth and even in the wave number, made up, with a half-space inside."""
    positions, points = 3, 4
    shapes = [(2, positions), (5, positions, positions), (5, 2, points, positions)]
    parts = []
    for shape in shapes:
        size = rng.uniform(0.5, 1.5, shape)
        decay = rng.uniform(2.0, 6.0, shape) * 1e-3
        parts.append(np.stack([size / (1.0 + (decay * wave) ** 2) for wave in waves]))
    # own deflections that leave the half-space's logarithm towards k = 0, as a tooth's do
    logarithm = half_space_surface(np.hypot(waves, 200.0), depth, POISSON)
    surface = half_space_surface(np.maximum(waves, 1e-9), depth, POISSON)
    parts[0] += np.where(waves > 0.0, logarithm - surface, logarithm)[:, None, None]
    excess = parts[0].copy()
    for which in (0, 1):
        deep = half_space((1 + which) * depth, waves[1:], POISSON)
        parts[0][1:, which] += deep[:, None]
    lead = LeadHarmonics(waves, *parts[:2], np.zeros((2, points)), parts[2])
    even = parts[0][0], parts[1][0]
    return GearCompliance(np.linspace(20e-3, 22e-3, positions), *even, depth, lead), excess


def test_what_is_more_than_a_half_space_is_taken_on_to_the_surface(rng):
    waves, depth = wave_numbers(MODULE, 15e-3), 0.6e-3
    gear, excess = any_gear(rng, waves, depth)
    found = own_at_solved(gear, POISSON)
    for n, k in enumerate(waves):
        for m in range(3):
            if n == 0:
                inside = gear.lead.inside[0, :, m]
                expected = 2 * inside[0] - inside[1] - 2 * (1 - POISSON**2) / np.pi * np.log(2)
            else:
                logarithm = -np.log(k * depth / 2) - np.euler_gamma
                surface = (1 + POISSON) / np.pi * (1 + 2 * (1 - POISSON) * logarithm)
                expected = surface + 2 * excess[n, 0, m] - excess[n, 1, m]
            assert found[n, m] == pytest.approx(expected, rel=1e-9)


def test_responses_are_read_between_and_beyond_the_waves_that_were_solved(rng):
    waves, depth = wave_numbers(MODULE, 15e-3), 0.6e-3
    gear, _ = any_gear(rng, waves, depth)
    at_solved = at_wave_numbers(gear, waves, POISSON)
    np.testing.assert_allclose(at_solved.own, own_at_solved(gear, POISSON), rtol=1e-9)
    np.testing.assert_allclose(at_solved.between, gear.lead.between, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(at_solved.root_stress, gear.lead.root_stress, rtol=1e-9, atol=1e-12)
    beyond = waves[-1] * np.array([1.1, 2.5])
    further = at_wave_numbers(gear, beyond, POISSON)
    for n, k in enumerate(beyond):
        less = 2 * (1 - POISSON**2) / np.pi * np.log(k / waves[-1])
        np.testing.assert_allclose(further.own[n], at_solved.own[-1] - less, rtol=1e-9)
    assert not np.any(further.between)
    assert not np.any(further.root_stress)
    # a gear solved at other wave numbers, closer together, says the same in between
    fine = np.sort(np.concatenate([waves, (waves[1:] + waves[:-1]) / 2]))
    denser, _ = any_gear(np.random.default_rng(5), fine, depth)
    coarse, _ = any_gear(np.random.default_rng(5), waves, depth)
    middle = (waves[3:] + waves[2:-1]) / 2
    exact = at_wave_numbers(denser, middle, POISSON)
    read = at_wave_numbers(coarse, middle, POISSON)
    for mine, theirs in zip(read, exact, strict=True):
        np.testing.assert_allclose(mine, theirs, atol=3e-3 * np.abs(theirs).max())


@pytest.mark.parametrize(("module", "root", "most"), [(3e-3, 16e-3, 6.0), (2e-3, 60e-3, 12.0)])
def test_wave_numbers_are_even_near_zero_and_geometric_at_last(module, root, most):
    waves = wave_numbers(module, root, most)
    assert waves[0] == 0.0
    assert waves[-1] == pytest.approx(most / module, rel=1e-12)
    steps = np.diff(np.arcsinh(waves * root / 0.6))
    np.testing.assert_allclose(steps, steps[0], rtol=1e-9)
    assert 0.42 * (1 - 1 / len(steps)) < steps[0] <= 0.42
    # close to zero a step of 0.42 of the turn, then a factor exp(0.42)
    assert waves[1] * root / 0.6 == pytest.approx(np.sinh(steps[0]))
    assert waves[-1] / waves[-2] == pytest.approx(np.exp(steps[0]), rel=2e-2)


def test_a_gear_solved_in_the_plane_says_so():
    plane = gear_compliance(GEAR)
    with pytest.raises(ValueError, match="even along the teeth"):
        at_wave_numbers(plane, np.array([0.0]), POISSON)
