"""The pair's stiffness without any local model: Hertz's pressure itself on a fine mesh of the flank.

The load contact model reads finite elements below a point load and puts a half-plane's deflection between
there and the surface. Here the elements resolve the contact, and the displacement is read at its middle.
"""

import numpy as np
import pytest

from tribodyn.compliance.fem import gear
from tribodyn.compliance.fem.cyclic_symmetry import half_sector, ring_response
from tribodyn.compliance.fem.ring_mesh import half_sector_mesh
from tribodyn.compliance.fem.strips import curved_basis, plane_stiffness
from tribodyn.compliance.local import hertz_half_width
from tribodyn.compliance.sharing.load_sharing import contact_deflection, flexibility
from tribodyn.compliance.sharing.slices import pair_harmonics
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.drive import SIDES, body_of
from tribodyn.geometry.families import family
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.tooth import flank_point
from tribodyn.studies.protocol.load import load_scenario

LINE_LOAD = 235e3


@pytest.fixture(scope="module")
def case():
    return load_scenario("involute-18-36-fem").pair


@pytest.fixture(scope="module")
def assembly(case):
    return assemble(family(case.family), case.drive)


def resolved_compliance(case, assembly, side, material, level):
    """Displacement at the middle of Hertz's pressure at the pitch point, per line load, m²/N."""
    tooth, body = assembly.tooth(side), body_of(case.drive, side)
    curvature = kinematics(assembly.path, np.array([0.0])).relative_curvature[0]
    half_width = float(hertz_half_width(LINE_LOAD, curvature, *case.materials))
    # places on the flank by arc length from the pitch point, in the nodes of Chebyshev's second kind,
    # in whose weights the semi-ellipse is contained
    fine = np.linspace(tooth.form_distance, tooth.tip_distance, 200_001)
    x, y = flank_point(tooth, fine)
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    angle = np.arange(1, 61) * np.pi / 61
    weight = 2.0 / 61 * np.sin(angle) ** 2
    places = np.interp(0.0, fine, arc) + half_width * np.concatenate([[0.0], np.cos(angle)])
    at = np.stack(flank_point(tooth, np.interp(places, arc, fine)))
    slope = float(kinematics(tooth.path, np.array([0.0])).pressure_angle[0]) - tooth.half_angle
    normal = np.array([[-np.sin(slope)], [-np.cos(slope)]])

    mesh = half_sector_mesh(tooth, round(body.teeth), body.bore_radius, level)
    basis = curved_basis(mesh.nodes, mesh.cells)
    rows = gear._probes(basis, at + 1e-9 * normal, np.tile(normal, at.shape[1]))
    response = ring_response(
        half_sector(basis.doflocs, round(body.teeth), body.bore_radius),
        plane_stiffness(basis, material.poisson_ratio),
        (weight @ rows[1:])[:, None],
        rows[:1],
        np.array([False]),
        np.array([0]),
    )
    return float(response.item()) / material.youngs_modulus


def resolved_stiffness(case, assembly, level):
    sides = zip(SIDES, case.materials, strict=True)
    return 1.0 / sum(resolved_compliance(case, assembly, side, m, level) for side, m in sides)


@pytest.mark.slow
def test_pair_is_as_stiff_as_with_the_contact_resolved(case, assembly):
    """13.45 N/(mm µm) at 235 N/mm for 18/36 teeth."""
    flexible = flexibility(assembly, case.materials, held=True)
    geometry = pair_geometry(assembly, np.zeros((1, 1)))
    line_load = np.full((1, 1), LINE_LOAD)
    local, _ = contact_deflection(flexible, geometry.motion.relative_curvature, line_load)
    deflection = pair_harmonics(flexible, geometry) * LINE_LOAD * flexible.width + local
    model = LINE_LOAD / deflection.item()
    resolved = [resolved_stiffness(case, assembly, level) for level in (3, 4)]
    assert resolved[1] == pytest.approx(resolved[0], rel=2e-3)  # the elements resolve the contact
    assert model == pytest.approx(resolved[1], rel=1e-3)
