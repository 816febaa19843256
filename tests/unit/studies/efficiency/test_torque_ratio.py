"""Torque ratio of one pair: Veciana's printed closed forms, equal families, friction in the balance."""

import math

import numpy as np
import pytest

from tests.support.closures import LOCAL_LAWS, VECIANA, coulomb, under
from tribodyn.geometry.families.involute import InvolutePath
from tribodyn.studies.efficiency.published import path_contact, rotations, torque_ratio
from tribodyn.validation.papers.veciana_study import cycloid_contact, involute_contact

TEETH, RADIUS, RATIO, ANGLE = 27.0, 27e-3, 2.0, math.radians(20)
DUTY = (200.0, 400.0, 0.04)  # N m, rad/s, m


@pytest.mark.parametrize("mu", [0.0, 0.05, 0.2])
def test_involute_is_the_closed_form(mu):
    """Γ2/Γ1 = [i + s μ (i tan α − ψ)]/[1 + s μ (tan α + ψ)], Veciana (56)."""
    pair = involute_contact(TEETH, RADIUS, RATIO, ANGLE)
    ours = torque_ratio(pair, *DUTY, coulomb(mu)).torque_ratio
    psi, s = pair.rotation, np.sign(pair.rotation)
    printed = (RATIO + s * mu * (RATIO * math.tan(ANGLE) - psi)) / (1 + s * mu * (math.tan(ANGLE) + psi))
    np.testing.assert_allclose(ours, printed, rtol=1e-13)


@pytest.mark.parametrize("mu", [0.0, 0.05, 0.2])
@pytest.mark.parametrize(("c_h", "c_e"), [(0.1, 0.1), (0.17, 0.3), (0.4, 0.12)])
def test_cycloid_is_the_closed_form(mu, c_h, c_e):
    """Veciana (41) in approach and (42) in recess."""
    pair = cycloid_contact(TEETH, RADIUS, RATIO, c_h, c_e)
    ours = torque_ratio(pair, *DUTY, coulomb(mu)).torque_ratio
    psi = pair.rotation
    a, c = np.abs(psi) / (2 * c_h), c_h
    approach = (RATIO * np.cos(a) - mu * (RATIO + 2 * c) * np.sin(a)) / (
        np.cos(a) - mu * (1 - 2 * c) * np.sin(a)
    )
    a, c = np.abs(psi) / (2 * c_e), c_e
    recess = (RATIO * np.cos(a) + mu * (RATIO - 2 * c) * np.sin(a)) / (
        np.cos(a) + mu * (1 + 2 * c) * np.sin(a)
    )
    np.testing.assert_allclose(ours, np.where(psi < 0, approach, recess), rtol=1e-13)


def test_cycloid_curvature_by_the_radii_of_both_flanks():
    """ρ_epi = 2 d_g (d + d_g)/(d + 2 d_g) sin a, ρ_hypo = 2 d_g (d − d_g)/(d − 2 d_g) sin a, concave."""
    c_h, c_e = 0.17, 0.3
    pair = cycloid_contact(TEETH, RADIUS, RATIO, c_h, c_e)
    d1, d2 = 2 * RADIUS, 2 * RADIUS * RATIO
    for psi, curvature in zip(pair.rotation, pair.curvature, strict=True):
        c = c_h if psi < 0 else c_e
        inner, outer = (d1, d2) if psi < 0 else (d2, d1)
        dg, a = c * d1, abs(psi) / (2 * c)
        convex = 2 * dg * (outer + dg) / (outer + 2 * dg) * math.sin(a)
        concave = 2 * dg * (inner - dg) / (inner - 2 * dg) * math.sin(a)
        assert curvature == pytest.approx(1 / convex - 1 / concave, rel=1e-10)


def test_cycloid_speeds_have_the_curvature_of_the_flanks():
    """Exact rolling speeds obey u = ω ρ (1 + κ) on the pinion: Euler-Savary."""
    pair = cycloid_contact(TEETH, RADIUS, RATIO, 0.2, 0.2, exact_speeds=True)
    recess = pair.rotation > 0
    kappa, dg, d1 = 1 / 0.4, 0.2 * 2 * RADIUS, 2 * RADIUS
    radius = 2 * dg * (d1 + dg) / (d1 + 2 * dg) * np.sin(pair.rotation[recess] / 0.4)
    np.testing.assert_allclose(pair.pinion_speed[recess], radius * (1 + kappa), rtol=1e-12)
    lever = cycloid_contact(TEETH, RADIUS, RATIO, 0.2, 0.2)
    np.testing.assert_allclose(
        pair.pinion_speed - pair.gear_speed, lever.pinion_speed - lever.gear_speed, rtol=1e-12
    )


@pytest.mark.parametrize("law", ["none", "coulomb", *LOCAL_LAWS])
def test_a_path_gives_what_its_closed_form_gives(law):
    path = InvolutePath(RADIUS, RADIUS * RATIO, ANGLE)
    closure = coulomb(0.05) if law == "coulomb" else under(law, VECIANA)
    ours = torque_ratio(path_contact(path, TEETH), *DUTY, closure)
    closed = torque_ratio(involute_contact(TEETH, RADIUS, RATIO, ANGLE), *DUTY, closure)
    for value, expected in zip(ours, closed, strict=True):
        np.testing.assert_allclose(value, expected, rtol=1e-9, atol=1e-12)
    if law == "none":
        assert ours.efficiency == pytest.approx(1.0, abs=1e-15)
    else:
        assert 0.9 < ours.efficiency < 1.0


@pytest.mark.parametrize("law", LOCAL_LAWS)
def test_the_quadrature_copes_with_the_cycloids_pitch_point(law):
    coarse, fine = (
        torque_ratio(
            cycloid_contact(TEETH, RADIUS, RATIO, 0.17, 0.17, rotations(TEETH, n)), *DUTY, under(law, VECIANA)
        ).efficiency
        for n in (24, 200)
    )
    assert coarse == pytest.approx(fine, abs=3e-7)


def test_circles_may_be_arrays():
    circles = np.array([[0.1, 0.2], [0.3, 0.4]])
    pair = cycloid_contact(TEETH, RADIUS, RATIO, circles, circles.T)
    found = torque_ratio(pair, *DUTY, under("xu", VECIANA)).efficiency
    assert found.shape == (2, 2)
    contact = cycloid_contact(TEETH, RADIUS, RATIO, 0.2, 0.3)
    assert found[0, 1] == pytest.approx(
        torque_ratio(contact, *DUTY, under("xu", VECIANA)).efficiency, abs=1e-14
    )
