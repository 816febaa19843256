"""Gear bodies that nothing but their inertia holds: energy method and finite elements by second methods."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.sparse import bmat, csc_matrix, hstack, identity, kron
from scipy.sparse.linalg import eigsh, spsolve
from skfem import Basis, BilinearForm, ElementQuad2, MeshQuad

from tests.support.twelve_teeth import GEAR, POISSON, whole_ring
from tribodyn.compliance.fem.gear import gear_compliance, gear_model
from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, meshed_bore
from tribodyn.compliance.fem.strips import plane_stiffness
from tribodyn.compliance.foundation import _root_loads, free_foundation, ring_compliance, ring_foundation
from tribodyn.compliance.iso6336 import pair_of, reference_stiffness
from tribodyn.compliance.local import freed_of_depth
from tribodyn.compliance.rim import free_shift, free_torsion
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import Drive, GearBody, MaterialData
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.mesh.quasi_static import cycle_mean, quasi_static
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate

NU = 0.3
STEEL = MaterialData("steel", 206e9, NU, 7850.0, 46.0, 470.0, 6e9)
jax.config.update("jax_enable_x64", True)


def radial_elements(order, bore, count=200, empty=False):
    """Displacement amplitudes (2, 2) at r = 1 per traction there, 2 G = 1, by quadratic elements over r.

    Of an annulus between the bore, which keeps its shape or is `empty`, and r = 1: what is balanced by
    inertia, against the mean motion; orders from 2 on have none.
    """
    low, high = sorted((bore, 1.0))
    place = np.linspace(low, high, 2 * count + 1)
    stiffness, mass = (np.zeros((2 * len(place), 2 * len(place))) for _ in range(2))
    gauss, weights = np.polynomial.legendre.leggauss(4)
    dilation = NU / (1.0 - NU)  # λ/2G of plane stress
    law = np.diag([1.0, 1.0, 0.5]) + dilation * np.outer([1, 1, 0], [1, 1, 0])
    for first in range(0, 2 * count, 2):
        length = place[first + 2] - place[first]
        for t, weight in zip(gauss, weights, strict=True):
            shape = np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2])
            slope = np.array([t - 0.5, -2 * t, t + 0.5]) * 2 / length
            r, part = shape @ place[first : first + 3], weight * length / 2
            # ε_r, ε_θ by cos nθ, γ_rθ by sin nθ; order 0: the tangential part alone turns
            radial = np.stack([slope, shape / r, -order * shape / r])
            around = np.stack([0 * shape, order * shape / r, slope - shape / r])
            strain = np.stack([radial, around], axis=-1).reshape(3, 6)
            at = np.s_[2 * first : 2 * first + 6]
            stiffness[at, at] += strain.T @ law @ strain * r * part
            mass[at, at] += np.kron(np.outer(shape, shape), np.eye(2)) * r * part
    rigid = np.zeros(2 * len(place))
    if order == 0:
        rigid[1::2] = place
    elif order == 1:
        rigid[::2], rigid[1::2] = 1.0, -1.0
    momentum = mass @ rigid / max(rigid @ mass @ rigid, 1e-300)
    node, inner = (-2, 0) if bore < 1.0 else (0, -2)
    # the bore is a circle, that moves: in order 0 it does not widen; all others hold it
    kept = np.zeros((2 if order > 1 else 1, len(rigid)))
    kept[0, inner] = 1.0
    kept[-1, inner + 1] = float(order)
    rows = ([] if empty else [*kept]) + ([momentum] if order < 2 else [])
    sums = np.array(rows).reshape(-1, len(rigid))
    ends = np.zeros((len(rigid), 2))
    ends[node, 0] = ends[node + 1, 1] = 1.0
    balanced = ends - np.outer(momentum, rigid @ ends)
    left = np.block([[stiffness, sums.T], [sums, np.zeros((len(sums), len(sums)))]])
    moved = np.linalg.solve(left, np.vstack([balanced, np.zeros((len(sums), 2))]))
    moved = moved[: len(rigid)]
    return moved[-2:] if bore < 1.0 else moved[:2]


@pytest.mark.parametrize("bore", [0.01, 0.2, 0.5, 0.9, 1.1, 2.0])
def test_rings_balanced_by_inertia_solve_the_equations_of_plane_stress(bore):
    shift, turn = radial_elements(1, bore), radial_elements(0, bore)
    np.testing.assert_allclose(free_shift(bore, NU), shift, rtol=2e-4, atol=2e-4 * np.abs(shift).max())
    assert free_torsion(bore) == pytest.approx(turn[1, 1], rel=1e-4)


def test_a_solid_disc_turns_by_a_twelfth():
    """θ = T/(12π G b a²): 2 G = 1, T = 2π."""
    assert free_torsion(0.0) == pytest.approx(2 * np.pi / (12 * np.pi * 0.5))
    assert np.all(np.isfinite(free_shift(0.0, NU)))
    np.testing.assert_allclose(free_shift(1e-5, NU), free_shift(0.0, NU), rtol=1e-8)


def test_held_less_free_is_wind_up():
    """Teeth all round: the held ring has (1/r_b² − 1/r_a²) T/(4π G b), the free one its own twist alone."""
    teeth, bore = 40, 0.3
    held, free = (
        sum(
            ring_compliance(2 * np.pi * k / teeth, 0.06, bore, NU, 100, held=held)[1, 1] for k in range(teeth)
        )
        for held in (True, False)
    )
    shear = 0.5 / (1 + NU)  # G for E = 1; load 1 on every tooth, r = 1
    twisted = teeth * (1 / bore**2 - 1) / (4 * np.pi * shear)
    x = bore**2
    own = teeth * (1 - x) * (1 + 3 * x) / (1 + x) ** 2 / (12 * np.pi * shear)
    assert held - free == pytest.approx(twisted - own, rel=1e-3)  # tractions of an arc, not of a point


def pair(first, second, bores, module=2e-3):
    bodies = [
        GearBody(float(z), 0.0, 1.0, 1.25, 0.38, 0.02, bore)
        for z, bore in zip((first, second), bores, strict=True)
    ]
    return assemble(FAMILY, Drive(module, np.radians(20.0), *bodies))


@pytest.mark.parametrize("by", ["sainsot-velex", "ring"])
def test_compliance_of_a_mesh_does_not_depend_on_the_bore(by):
    """From a solid body to a bore of root radius/2.3: 2 %; 3 % at half the root radius."""
    mesh = MeshData("energy", 0.05, foundation=by)

    def mean(bore):
        assembly = pair(62, 62, (bore, bore))
        table = tabulate(assembly, (STEEL, STEEL), mesh, pair_slots(assembly))
        return np.array([table.compliance.mean(), np.abs(table.coupling).max()])

    solid = mean(0.0)
    for bore, within in ((4e-3, 2e-3), (12.4e-3, 0.01), (59.5e-3 / 2.3, 0.02), (59.5e-3 / 2.0, 0.03)):
        assert mean(bore)[0] == pytest.approx(solid[0], rel=within)
    np.testing.assert_allclose(mean(1e-9), solid, rtol=1e-6)


def test_a_bore_of_half_the_root_radius_stiffens_filled_and_softens_empty():
    """By 2.6 and 2.3 % of the pair of the test above: no bore, however it is held, is without any effect.

    Filled by a stiff shaft, of which order 1 does most: the ring must not change its circle as it shifts.
    """
    angle, whole = 0.0486, 14.88  # half the root's arc of 62 teeth; mean compliance of a pair, times E b
    load = np.array([0.318, 0.948, 0.031])  # at the pitch point

    def by_order(bore, empty):
        amplitudes = _root_loads(np.arange(8.0), angle)
        even, odd = amplitudes[0] * load[0], np.tensordot(load[1:], amplitudes[1:], 1)
        found = []
        for n in range(8):
            moved = radial_elements(n, bore, 100, empty) * (1.0 + NU) * (np.pi if n else np.pi / 2.0)
            found.append(even[n] @ moved @ even[n] + odd[n] @ moved @ odd[n])
        return 2.0 * np.array(found) / whole

    solid = by_order(0.01, False)
    filled, empty = (by_order(0.5, hollow) - solid for hollow in (False, True))
    assert filled[1] < 2.5 * filled[2:].sum() < 0.0
    assert filled.sum() == pytest.approx(-0.026, abs=0.002)
    assert empty.sum() == pytest.approx(0.023, abs=0.002)
    series = [load @ ring_compliance(0.0, angle, bore, NU, 300) @ load for bore in (0.5, 0.01)]
    assert filled.sum() == pytest.approx(2.0 * (series[0] - series[1]) / whole, rel=0.03)


def test_what_holds_the_bodies_hardly_changes_how_the_deflection_varies():
    """Wind-up is the same for all teeth: it moves the mean, not the share of a pair or the peak to peak."""
    assembly = pair(23, 47, (8e-3, 15e-3))
    swing, mean, share = [], [], []
    for body in ("held", "free"):
        mesh = MeshData("energy", 0.05, foundation="ring", body=body)
        still = quasi_static(tabulate(assembly, (STEEL, STEEL), mesh, pair_slots(assembly)), 100.0)
        swing.append(np.ptp(still.deflection))
        mean.append(np.mean(still.deflection))
        share.append(still.normal_load)
    assert swing[1] == pytest.approx(swing[0], rel=0.01)
    assert mean[1] < 0.85 * mean[0]
    np.testing.assert_allclose(share[1], share[0], atol=0.01 * share[0].max())


@pytest.mark.parametrize("angle", [0.03, 0.06, 0.09, 0.12])
@pytest.mark.parametrize("ratio", [2.0, 2.5, 4.0, 7.0, 50.0])
def test_polynomials_of_free_bodies_follow_the_ring(angle, ratio):
    load, lever = np.radians(20.0), 1.2 * angle
    root = np.array([np.sin(load), np.cos(load), np.cos(load) * lever])
    fitted = free_foundation(root, load, lever, 1.0, 1.0 / ratio, angle, 1.0, NU, 1.0)
    assert fitted == pytest.approx(ring_foundation(root, 1.0, 1.0 / ratio, angle, 1.0, NU, 1.0), rel=0.065)


def test_slopes_of_a_solid_body_are_finite_and_vanish():
    root, load = jnp.array([0.34, 0.94, 0.1]), 0.34

    def both(bore):
        ring = ring_foundation(root, 0.03, bore, 0.06, 1.0, NU, 1.0)
        return jnp.stack([ring, free_foundation(root, load, 0.003, 0.03, bore, 0.06, 1.0, NU, 1.0)])

    value, slope = both(jnp.asarray(0.0)), jax.jacfwd(both)(0.0)
    assert np.all(np.isfinite(value))
    np.testing.assert_allclose(slope, 0.0, atol=1e-9)
    step = 1e-6
    at = 6e-3
    np.testing.assert_allclose(
        jax.jacfwd(both)(at), (both(at + step) - both(at - step)) / (2 * step), rtol=1e-5
    )


@pytest.mark.parametrize(("first", "second"), [(20, 62), (31, 62), (62, 62), (24, 120)])
def test_solid_gears_are_as_stiff_as_iso_6336_has_them(first, second):
    """ISO 6336-1's theory is of solid discs: c'_th of one pair within a tenth."""
    assembly = pair(first, second, (0.0, 0.0))
    table = tabulate(assembly, (STEEL, STEEL), MeshData("energy", 0.05), pair_slots(assembly))
    single = 1.0 / table.compliance.min() / 0.02
    assert single == pytest.approx(
        reference_stiffness(pair_of(assembly, (STEEL, STEEL), 1e4)).theoretical, rel=0.1
    )


@pytest.mark.parametrize("hertz", ["linear", "load-dependent"])
@pytest.mark.parametrize("by", ["sainsot-velex", "ring"])
@pytest.mark.parametrize(("first", "second"), [(20, 62), (31, 62), (62, 62), (24, 120)])
def test_mesh_stiffness_is_within_the_scatter_of_iso_6336(first, second, by, hertz):
    """Mean over the cycle at 300 N/mm, solid and with bores: within 20 % of c_γα.

    Of two gears with 17 teeth it is up to 1.5 times that, and of elements too: the series has no small discs.
    """
    for share in (0.0, 0.2, 0.5):
        assembly = pair(first, second, [share * (z - 2.5) * 1e-3 for z in (first, second)])
        mesh, torque = MeshData("energy", 0.05, foundation=by, hertz=hertz), 300e3 * 0.02 * second * 1e-3
        table = tabulate(assembly, (STEEL, STEEL), mesh, pair_slots(assembly))
        mean = cycle_mean(table, quasi_static(table, torque).mesh_stiffness)
        along = np.cos(assembly.path.pressure_angle(0.0)) ** 2 * 0.02
        load = torque / float(assembly.path.gear_pitch_radius * np.sqrt(along / 0.02))
        standard = reference_stiffness(pair_of(assembly, (STEEL, STEEL), load)).mesh
        assert mean / along == pytest.approx(standard, rel=0.2)


def mesh_frequency(bore, half_angle, spring):
    """ω of two equal free discs, r = 1, whose arcs a tangential spring joins, by plane finite elements.

    E = ρ = 1, plane stress; half of one disc, as the load is odd in x, against a spring to its mirror image.
    """
    fine = np.linspace(0.0, half_angle, 5), half_angle + (np.pi - half_angle) * np.linspace(0, 1, 41)[1:] ** 2
    grid = MeshQuad.init_tensor(1.0 - (1.0 - bore) * np.linspace(1.0, 0.0, 25) ** 1.5, np.concatenate(fine))
    radius, angle = grid.p
    disc = MeshQuad(np.stack([radius * np.cos(angle), radius * np.sin(angle)]), grid.t)
    basis = Basis(disc, ElementQuad2())
    # plane stress by plane strain: ν' = ν/(1 + ν), E' = E (1 + 2ν)/(1 + ν)²
    elastic = plane_stiffness(basis, NU / (1.0 + NU)) * (1.0 + 2.0 * NU) / (1.0 + NU) ** 2
    mass = kron(BilinearForm(lambda u, v, _: u * v).assemble(basis), np.eye(2))
    x, y = basis.doflocs
    turn = np.arctan2(y, x)
    arc = np.flatnonzero((np.hypot(x, y) > 1.0 - 1e-3) & (turn < half_angle * (1 + 1e-6)))
    arc = arc[np.argsort(turn[arc])]
    weights = np.tile([2.0, 4.0], len(arc))[: len(arc)]  # Simpson's
    weights[0] = weights[-1] = 1.0
    reader = np.zeros((basis.N, 2))
    reader[arc, 1] = weights / weights.sum()
    kept = np.setdiff1d(np.arange(2 * basis.N), 2 * np.flatnonzero(np.abs(y) < 1e-9))
    row = csc_matrix(reader.ravel()[kept])
    whole = csc_matrix(elastic)[kept][:, kept] + spring * row.T @ row
    modes = eigsh(whole, 4, csc_matrix(mass)[kept][:, kept], sigma=-1e-3, return_eigenvectors=False)
    return np.sqrt(np.sort(modes)[1])  # the first leaves the arc at rest


@pytest.mark.parametrize(("bore", "within"), [(4.0 / 59.5, 0.005), (12.4 / 59.5, 0.01), (30.0 / 59.5, 0.03)])
def test_lowest_mesh_frequency_is_that_of_whole_elastic_discs(bore, within):
    """Gears of 62 teeth with bores of 8, 24.8 and 60 mm, all of them free; ISO's c_γα = 19.8 N/(mm µm)."""
    spring, half_angle = 19.8e9 / 206e9, 0.045
    found = mesh_frequency(bore, half_angle, spring)
    body = ring_compliance(0.0, half_angle, bore, NU, 600)[1, 1]
    area, inertia = np.pi * (1.0 - bore**2), np.pi / 2.0 * (1.0 - bore**4)
    rigid = np.sqrt((1.0 / area + 1.0 / inertia) / (1.0 / (2.0 * spring) + body))
    assert rigid == pytest.approx(found, rel=within)


def test_finite_elements_of_a_free_gear_by_its_whole_ring():
    """Every tooth in one matrix, the bore a rigid circle, three sums of inertia in the place of supports."""
    basis, _ = whole_ring(1)
    stiffness = plane_stiffness(basis, POISSON)
    mass = csc_matrix(kron(BilinearForm(lambda u, v, _: u * v).assemble(basis), np.eye(2)))
    x, y = basis.doflocs
    rigid = np.zeros((basis.N, 2, 3))
    rigid[:, 0, 0], rigid[:, 1, 0], rigid[:, 0, 1], rigid[:, 1, 2] = -y, x, 1.0, 1.0
    rigid = rigid.reshape(-1, 3)
    bore = np.repeat(np.hypot(x, y) < GEAR.bore_radius * (1 + 1e-9), 2)
    # orders 0 and 1 of a bore that keeps its shape: it moves as a whole; all others hold it
    inside = csc_matrix(identity(len(bore)))[:, ~bore]
    allowed = csc_matrix(hstack([inside, csc_matrix(rigid * bore[:, None])]))
    momentum = mass @ rigid
    model = gear_model(GEAR)
    flank = [int(np.argmin(np.hypot(x - px, y - py))) for px, py in model.position.T]
    vertex = 5
    near = int(np.argmin(np.hypot(*(model.basis.doflocs - model.position[:, vertex : vertex + 1]))))
    load = np.zeros(2 * basis.N)
    load[2 * flank[vertex] : 2 * flank[vertex] + 2] = model.loads[2 * near : 2 * near + 2, vertex]
    inertia = np.linalg.inv(rigid.T @ momentum)
    balanced = load - momentum @ inertia @ (rigid.T @ load)
    sums = csc_matrix(allowed.T @ momentum)
    left = bmat([[allowed.T @ stiffness @ allowed, sums], [sums.T, None]], format="csc")
    solved = np.asarray(spsolve(left, np.append(allowed.T @ balanced, np.zeros(3))))
    moved = allowed @ solved[:-3]
    seen = gear_compliance(GEAR).between[NEIGHBOURS, :, vertex]
    for other, node in enumerate(flank):
        if other != vertex:
            at = int(np.argmin(np.hypot(*(model.basis.doflocs - model.position[:, other : other + 1]))))
            direction = model.loads[2 * at : 2 * at + 2, other]
            assert direction @ moved[2 * node : 2 * node + 2] == pytest.approx(seen[other], rel=1e-6)


def test_finite_elements_of_solid_gears_tend_to_a_limit():
    root = float(GEAR.tooth.root_radius)
    meshed = meshed_bore(GearBody(12, 0.3, 1.0, 1.25, 0.25, 0.02, 0.0), GEAR.tooth, False)
    assert 0.0 < meshed <= 0.1 * root
    small, smaller = (
        freed_of_depth(gear_compliance(GEAR._replace(bore_radius=bore)).inside, POISSON)
        for bore in (meshed, meshed / 2.0)
    )
    np.testing.assert_allclose(small, smaller, rtol=2e-3)
