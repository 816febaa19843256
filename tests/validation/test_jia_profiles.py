"""Paths, teeth and rack-cutters of Jia et al. over k1 and k2, by closed forms and what the paper says."""

import numpy as np
import pytest

from tribodyn.geometry.body import rack_outline
from tribodyn.geometry.path import position
from tribodyn.post.style import house_style
from tribodyn.validation.papers.jia_figures import COEFFICIENTS, FIGURES, gears, half_tooth, rack_profile


@pytest.mark.parametrize("k", COEFFICIENTS)
def test_paths_are_the_papers_parabolas(k: float):
    """y = x²/(4 k1 r_g) in the first quadrant, −x²/(4 k2 r_p) in the third."""
    made = gears(k, k)
    path = made.path
    x, y = position(path, path.signed_distance(np.linspace(*made.roll_limits, 41)))
    radius = np.where(x > 0.0, float(path.gear_pitch_radius), -float(path.pinion_pitch_radius))
    np.testing.assert_allclose(y, x**2 / (4.0 * k * radius), atol=1e-9)


def thickness(side, up: float, **coefficients: float) -> float:
    """Thickness of a tooth at a height above the pitch circle, both in mm."""
    across, height = 1e3 * half_tooth(gears(**coefficients), side).T
    return 2.0 * float(np.interp(up, height, across))


@pytest.mark.parametrize(
    ("name", "thicker", "thinner", "same"),
    [
        ("k1", ("pinion", 1.5), ("gear", -1.2), (("pinion", -1.2), ("gear", 1.5))),
        ("k2", ("gear", 1.5), ("pinion", -1.2), (("gear", -1.2), ("pinion", 1.5))),
    ],
)
def test_teeth_grow_and_shrink_as_figures_10_and_11_say(name, thicker, thinner, same):
    grown = [thickness(*thicker, **{name: k}) for k in COEFFICIENTS]
    shrunk = [thickness(*thinner, **{name: k}) for k in COEFFICIENTS]
    assert np.all(np.diff(grown) > 0.0)
    assert np.all(np.diff(shrunk) < 0.0)
    for place in same:
        assert thickness(*place, **{name: 0.2}) == pytest.approx(thickness(*place, **{name: 0.44}), abs=1e-3)


def test_the_rack_cutters_fit_into_each_other():
    """Up to the rounded tips the tooth of one and the tooth of the other together fill half a pitch."""
    made = gears()
    at, widths = np.linspace(-1.1, 1.1, 12), []
    for side in ("pinion", "gear"):
        across, up = 1e3 * rack_profile(made, side).T
        half = np.abs(across[: across.size // 2]), up[: up.size // 2]
        order = np.argsort(half[1])
        widths.append(np.interp(at, half[1][order], half[0][order]))
    assert sum(widths) == pytest.approx(0.5e3 * rack_outline(made, "pinion").pitch, abs=3e-4)


@pytest.mark.parametrize("name", ["figure-7", *(f"figure-{number}" for number in range(9, 13))])
def test_figures_are_drawn(name: str, tmp_path):
    with house_style():
        drawn = FIGURES[name](tmp_path)
    assert all(axes.get_xlabel() for axes in drawn.axes)
