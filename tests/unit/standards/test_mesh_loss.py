"""Loss of a mesh by published formulas: limits between them, sums over the mesh cycle, units."""

import math

import numpy as np
import pytest

import tribodyn as td
from tribodyn.standards.contact_path import ContactPath
from tribodyn.standards.loss_factors import equal_loads, least_line_length, of_even_lines, of_rigid_lines
from tribodyn.standards.mesh_loss.methods import MESH_LOSS_METHODS, LoadedMesh, mechanical_advantage

FZG = ContactPath((16.0, 24.0), (33.829e-3, 50.743e-3), (41.318e-3, 59.272e-3), math.acos(84.572 / 91.5))
MESH = LoadedMesh(FZG, 14e-3, 5912.1, 5.749, 13.28e-3, 878.0, 2.0e-8, 0.355e-6)


def lines(tips: tuple[float, float], overlap: float, ends: np.ndarray):
    """Both ends, in pitches from the pitch point, of all lines of contact at instants `ends`."""
    path = sum(tips)
    places = ends[:, None] + np.arange(-1, 9)
    inside = (places > 0.0) & (places < path + overlap)
    low = np.where(inside, np.maximum(places - overlap, 0.0), 0.0)
    high = np.where(inside, np.minimum(places, path), 0.0)
    return low - tips[1], high - tips[1]


@pytest.mark.parametrize(("tips", "overlap"), [((0.7, 0.8), 0.54), ((1.1, 0.3), 1.35), ((0.45, 0.47), 0.9)])
def test_rigid_lines_against_sums(tips: tuple[float, float], overlap: float):
    low, high = lines(tips, overlap, np.linspace(0.0, 1.0, 400, endpoint=False))
    share = (np.arange(2000) + 0.5) / 2000
    xi = low[..., None] + (high - low)[..., None] * share
    moment = np.abs(xi).mean(axis=-1) * (high - low)
    mean = np.mean(moment.sum(axis=1) / (high - low).sum(axis=1))
    expected = 2.0 * math.pi * 3.0 / (20 * 2.0) * mean / math.cos(0.3)
    assert of_rigid_lines(*tips, overlap, 20, 2.0, 0.3) == pytest.approx(expected, rel=2e-3)


def test_rigid_lines_lie_between_the_formulas_of_spur_gears_and_of_whole_overlap():
    given = 20, 2.0, 0.3
    spur = equal_loads(0.8, 0.7, *given[:2]) / math.cos(0.3)
    assert of_rigid_lines(0.8, 0.7, 1e-4, *given) == pytest.approx(spur, rel=1e-3)
    for whole in (1.0, 2.0):
        assert of_rigid_lines(0.8, 0.7, whole, *given) == pytest.approx(of_even_lines(0.8, 0.7, *given))


@pytest.mark.parametrize(
    ("ratio", "overlap"), [(1.46, 0.54), (1.5, 0.3), (1.3, 1.2), (1.8, 2.7), (0.93, 0.8), (1.6, 1.0)]
)
def test_least_length_of_the_lines(ratio: float, overlap: float):
    low, high = lines((ratio / 2.0, ratio / 2.0), overlap, np.linspace(0.0, 1.0, 20001))
    expected = (high - low).sum(axis=1).min() / overlap / math.cos(0.25)
    assert least_line_length(ratio, overlap, 0.25) == pytest.approx(expected, rel=2e-4)


def test_mechanical_advantage_as_the_standard_writes_it():
    pitch = [radius / math.cos(FZG.pressure_angle) for radius in FZG.base_radius]
    cosine, sine, ratio = math.cos(FZG.pressure_angle), math.sin(FZG.pressure_angle), 1.5
    start = (ratio + 1.0) * (math.sqrt((FZG.tip_radius[1] / pitch[1]) ** 2 - cosine**2) - sine)
    end = (ratio + 1.0) / ratio * (math.sqrt((FZG.tip_radius[0] / pitch[0]) ** 2 - cosine**2) - sine)
    expected = 2.0 * cosine * (start + end) / (start**2 + end**2)
    assert mechanical_advantage(FZG) == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("name", MESH_LOSS_METHODS)
def test_power_is_finite_at_rest_and_zero_without_load(name: str):
    method = MESH_LOSS_METHODS[name]
    duty = MESH._replace(
        base_force=np.array([0.0, 100.0, 5912.1]), pitch_speed=np.array([[0.0], [1e-9], [6.0]])
    )
    torque = method.loss_per_power(duty) * duty.base_force
    assert np.all(np.isfinite(torque))
    assert np.all(torque[:, 0] == 0.0)
    assert np.all(torque[:, 1:] > 0.0)
    np.testing.assert_allclose(torque[0], torque[1])
    power = method.power(duty)
    np.testing.assert_array_equal(power[0], 0.0)
    assert power[2, 2] == pytest.approx(method.power(MESH._replace(pitch_speed=6.0)))
    assert not method.exceeded(MESH) or name == "iso-14179-1"
    assert len(method.exceeded(duty)) == len(method.limits)


@pytest.mark.parametrize("name", MESH_LOSS_METHODS)
def test_methods_agree_on_a_usual_duty_within_what_they_differ(name: str):
    """The FZG pair at 200 N m, 1500 rpm with a thin mineral oil: a mean of 295 W, AGMA's half of it."""
    every = {key: float(method.power(MESH)) for key, method in MESH_LOSS_METHODS.items()}
    assert every[name] == pytest.approx(np.mean(list(every.values())), rel=0.5)


def test_another_programs_pair():
    """STplus 11.1F, FZG type C: 130 N m at 1500 rpm, H_v 0.195, μ 0.045, 177.9 W."""
    path = ContactPath((16.0, 24.0), (33.829e-3, 50.7435e-3), (41.225e-3, 59.175e-3), math.radians(22.43879))
    mesh = LoadedMesh(path, 14e-3, 3842.9, 5.749, 30.93e-3, 854.4, 2e-8, 0.3e-6, 1.0)
    assert float(MESH_LOSS_METHODS["iso-14179-2"].power(mesh)) == pytest.approx(177.9, rel=1e-3)


@pytest.mark.parametrize("name", MESH_LOSS_METHODS)
def test_a_ring_loses_less_than_the_same_teeth_outside(name: str):
    outside = ContactPath((20.0, 60.0), (46.98e-3, 140.95e-3), (55e-3, 155e-3), math.radians(20.0))
    ring = ContactPath((20.0, -60.0), (46.98e-3, -140.95e-3), (55e-3, -146e-3), math.radians(20.0))
    method = MESH_LOSS_METHODS[name]
    losses = [method.power(MESH._replace(path=path)) for path in (ring, outside)]
    assert 0.0 < losses[0] < losses[1]


def test_units_from_python():
    parts = td.standards
    friction = parts.mesh_friction.schlenk(
        "422.3 N/mm", "4.39 m/s", "8.38 mm", "13.28 mPa*s", "0.355 um", 0.846
    )
    assert friction == pytest.approx(0.0449, abs=2e-4)
    with pytest.raises(td.InputError, match="kinematic_viscosity"):
        parts.mesh_friction.iso_14179_1("3 mm", "5 MPa", "6 m/s")
    both = parts.mesh_friction.schlenk([422.3e3, 300e3], 4.39, 8.38e-3, 13.28e-3, 0.355e-6, 0.846)
    assert both.shape == (2,)
    assert both[0] == pytest.approx(friction)
    assert parts.loss_factors.hoehn(0.728, 0.734, 16, 1.5) == pytest.approx(0.1986, abs=1e-3)
