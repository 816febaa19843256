"""Super-elements: reduction against closed forms and the whole model, and what matrices are refused for."""

import numpy as np
import pytest
from scipy.linalg import eigh

from tests.support.beam_element import DENSITY, DIAMETER, LENGTH, STEEL, bar, whole_bar
from tribodyn.errors import InputError
from tribodyn.train.elastic.superelement import frequencies, modal_damping, rigid_motions, sound


def test_rigid_motions_are_free_to_a_millionth_of_the_lowest_elastic_frequency():
    element = bar()
    motions = rigid_motions(element.places, element.modes)
    strained = np.abs(np.linalg.eigvalsh(motions.T @ element.stiffness @ motions)).max()
    mass = DENSITY * np.pi / 4.0 * DIAMETER**2 * LENGTH
    elastic = 2.0 * np.pi * frequencies(element)[6]
    assert np.sqrt(strained / mass) < 1e-6 * elastic


def test_a_free_bar_has_the_mass_and_frequency_of_the_closed_form():
    """Bernoulli: f = 4.730² /(2π L²) √(EI/ρA); shear and rotary inertia take 0.4 % of it here."""
    _, found = sound(bar())
    area = np.pi / 4.0 * DIAMETER**2
    slender = np.sqrt(STEEL.youngs_modulus * DIAMETER**2 / 16.0 / DENSITY)
    assert found.free
    assert found.mass == pytest.approx(DENSITY * area * LENGTH, rel=1e-9)
    assert found.lowest == pytest.approx(4.730041**2 / (2.0 * np.pi * LENGTH**2) * slender, rel=6e-3)


def test_kept_modes_bring_the_frequencies_to_those_of_the_whole_model():
    exact = np.sqrt(np.abs(eigh(*whole_bar(), eigvals_only=True)[:14])) / (2.0 * np.pi)
    errors = [frequencies(bar(highest))[6:10] / exact[6:10] - 1.0 for highest in (0.0, 1500.0, 20000.0)]
    assert np.all(errors[2] >= -1e-9)  # Rayleigh: from above
    assert np.all(np.diff([error.max() for error in errors]) < 0.0)
    assert errors[2].max() < 1e-3


def test_points_follow_rigid_motions():
    element = bar()
    motions = rigid_motions(element.places, element.modes, about=np.zeros(3))
    expected = rigid_motions(np.array([[0.0, 0.0, LENGTH / 2.0]]), 0, about=np.zeros(3))[:3]
    np.testing.assert_allclose(element.motion_of("middle") @ motions, expected, atol=1e-7)
    np.testing.assert_array_equal(element.motion_of("B") @ motions, motions[6:9])


def test_modal_damping_gives_every_mode_its_ratio():
    element = bar()
    squares, shapes = eigh(element.stiffness, element.mass)
    damping = shapes.T @ modal_damping(element.mass, element.stiffness, 0.03) @ shapes
    np.testing.assert_allclose(damping[6:, 6:], np.diag(0.06 * np.sqrt(squares[6:])), atol=1e-3)


def _changed(name, i, j, factor):
    matrix = getattr(bar(), name).copy()
    matrix[i, j] *= factor
    return bar()._replace(**{name: matrix})


@pytest.mark.parametrize(
    ("broken", "words"),
    [
        (lambda: _changed("stiffness", 0, 4, 1.01), "stiffness is not symmetric"),
        (lambda: _changed("mass", 0, 0, -1.0), "x of seat A"),
        (lambda: _changed("damping", 0, 0, -1.0), "gives energy away"),
        (lambda: _changed("stiffness", 0, 0, 1.5), "5 rigid motions"),
        (lambda: bar()._replace(places=1e3 * bar().places), "resists a rigid turn"),
        (lambda: bar()._replace(mass=bar().mass[:-1]), "coordinates"),
        (lambda: bar()._replace(mass=1e-9 * bar().mass), "faster"),
        (lambda: bar()._replace(mass=np.full_like(bar().mass, np.nan)), "no numbers"),
    ],
)
def test_wrong_matrices_are_refused(broken, words):
    with pytest.raises(InputError, match=words) as refused:
        sound(broken())
    assert "\n" not in str(refused.value)


def test_a_file_read_in_the_wrong_units_is_refused():
    """Millimetres, tonnes and newtons taken for SI: frequencies stay, and the bar is 500 m long."""
    element = bar()
    scale = np.array([*2 * [1e3, 1e3, 1e3, 1.0, 1.0, 1.0], *element.modes * [1.0]])
    both = np.outer(scale, scale)
    as_read = element._replace(
        places=1e3 * element.places,
        mass=element.mass * 1e3 / both,  # t m², then mm
        stiffness=element.stiffness * 1e3 / both,
        damping=element.damping * 1e3 / both,
    )
    with pytest.raises(InputError, match="check units"):
        sound(as_read)


def test_rounding_of_printed_digits_is_taken_out_of_rigid_motions():
    element = bar()
    printed = element._replace(stiffness=np.vectorize(lambda x: float(f"{x:.9e}"))(element.stiffness))
    mended = sound(printed)[0]
    motions = rigid_motions(element.places, element.modes)
    strained = np.abs(motions.T @ mended.stiffness @ motions).max()
    assert strained < 1e-12 * np.abs(element.stiffness).max()
