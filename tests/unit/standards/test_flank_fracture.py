"""Tooth flank fracture: printed factors, Lang's hardness, and stresses beside Hertz's half-space."""

import numpy as np
import pytest

from tribodyn.standards.case_hardening import flank_fracture
from tribodyn.standards.case_hardening.flank_fracture import HardenedCase
from tribodyn.standards.metals import VICKERS

#: KISSsoft 2017, third stage: 61 HRC, 342 HV, 0.50 mm; 1014.7 N/mm² on 37.122 mm.
CASE = HardenedCase(720.0 * VICKERS, 342.0 * VICKERS, 0.5e-3)


@pytest.mark.parametrize(
    ("module", "teeth", "helix", "shift", "b_and_d", "printed"),
    [
        (21.0, 18, 0.0, 0.389, (408.342, 376.013), 0.943),
        (21.0, 36, 0.0, 0.5039, (762.426, 794.110), 0.956),
        (21.0, 36, 0.0, 0.5039, (780.889, 762.426), 0.936),  # against the ring
        (45.0, 19, 0.0, 0.617, (961.716, 855.324), 0.900),
        (14.0, 24, 10.0, 0.48, (342.670, 361.216), 1.026),
        (14.0, 95, 10.0, 0.6691, (1379.568, 1362.368), 1.042),
    ],
)
def test_material_factors_of_three_stages_in_print(module, teeth, helix, shift, b_and_d, printed):
    beta, normal = np.radians(helix), np.radians(20.0)
    transverse = np.arctan(np.tan(normal) / np.cos(beta))
    reference = teeth * module / np.cos(beta)
    at = np.mean(b_and_d)
    angle = np.arccos(reference * np.cos(transverse) / at)
    own = module * (np.pi / 2.0 + 2.0 * shift * np.tan(normal)) / np.cos(beta) / reference
    thickness = at * (own + (np.tan(transverse) - transverse) - (np.tan(angle) - angle))
    assert flank_fracture.material_factor(1e-3 * thickness) == pytest.approx(printed, abs=5e-4)


def test_the_case_is_half_as_hard_at_its_depth_and_in_balance_below():
    """At CHD half of what the surface is harder is left (10^−0.3043); from 300 HV on stress falls again."""
    assert CASE.hardness(0.0) == pytest.approx(720.0 * VICKERS)
    left = (CASE.hardness(0.5e-3) - CASE.core_hardness) / (CASE.surface_hardness - CASE.core_hardness)
    assert left == pytest.approx(0.496, abs=1e-3)
    depths = np.linspace(0.0, 2e-3, 2001)
    stress = CASE.residual_stress(depths)
    harder = (CASE.hardness(depths) - CASE.core_hardness) / VICKERS
    assert harder[np.argmin(stress)] == pytest.approx(300.0, abs=1.0)
    assert stress.min() == pytest.approx(-375e6, rel=2e-3)
    assert CASE.permissible_stress(1.1e-3, 1.026072) == pytest.approx(146.951e6, rel=1e-5)  # printed


def test_the_equivalent_stress_is_near_shear_over_all_planes_in_the_half_space():
    """Every plane's greatest shear while Hertz's load rolls over, its root mean square over directions."""
    cosine, around = np.meshgrid((np.arange(16) + 0.5) / 16, np.pi * (np.arange(32) + 0.5) / 16)
    sine = np.sqrt(1.0 - cosine**2)
    planes = np.stack([sine * np.cos(around), sine * np.sin(around), cosine], axis=-1).reshape(-1, 1, 3)
    x = np.linspace(-4.0, 4.0, 121)
    for depth, off in ((0.45, 0.01), (0.65, 0.01), (1.0, 0.03)):
        root = np.sqrt((1.0 - x**2 + depth**2) ** 2 + 4.0 * x**2 * depth**2)
        m = np.sqrt(0.5 * (root + 1.0 - x**2 + depth**2))
        n = np.sign(x) * np.sqrt(np.maximum(0.5 * (root - 1.0 + x**2 - depth**2), 0.0))
        ratio = (depth**2 + n**2) / (m**2 + n**2)
        along, down = -(m * (1.0 + ratio) - 2.0 * depth), -m * (1.0 - ratio)
        shear = n * (m**2 - depth**2) / (m**2 + n**2)
        stress = np.zeros((len(x), 3, 3))
        stress[:, 0, 0], stress[:, 1, 1], stress[:, 2, 2] = along, 0.3 * (along + down), down
        stress[:, 0, 2] = stress[:, 2, 0] = shear
        traction = np.einsum("tij,ptj->pti", stress, np.broadcast_to(planes, (len(planes), len(x), 3)))
        normal = (traction * planes).sum(axis=-1, keepdims=True)
        greatest = np.linalg.norm(traction - normal * planes, axis=-1).max(axis=1)
        mean = np.sqrt(np.mean(greatest**2))
        assert flank_fracture.equivalent_stress(1.0, 1.0, depth) == pytest.approx(mean, rel=off)


def test_exposure_and_safety_of_the_report():
    """A_FF 1.166 at 1.1 mm and S_FF 0.932; with pressures and b_H raised by S_FF τ_eff is τ_per."""
    width = 4.0 * 37.122e-3 * 1014.701e6 / 226374e6
    printed = flank_fracture.greatest_exposure(CASE, 1014.701e6, width, 1.026072, np.array([1.1e-3]))
    assert printed.exposure == pytest.approx(1.166, abs=1e-3)
    safety = flank_fracture.fracture_safety(CASE, 1014.701e6, width, 1.026072)
    assert safety == pytest.approx(0.932, abs=1.5e-3)
    raised = flank_fracture.greatest_exposure(CASE, safety * 1014.701e6, safety * width, 1.026072)
    assert raised.stress == pytest.approx(raised.strength, rel=1e-4)
    softer = CASE._replace(case_depth=0.25e-3)
    assert flank_fracture.fracture_safety(softer, 1014.701e6, width, 1.026072) < safety
