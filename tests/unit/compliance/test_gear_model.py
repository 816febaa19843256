"""What is read inside a gear: linear fields, in curved cells and across the tooth's axis; loads on flanks."""

import numpy as np
import pytest

from tests.support.twelve_teeth import GEAR, TOOTH
from tribodyn.compliance.fem.gear import gear_model
from tribodyn.geometry.tooth import flank_point

DEPTHS = pytest.mark.parametrize("depth", [0.75e-3, 1.6e-3])


def straight(matrix, shift, place):
    """Displacement of an even strain and a shift at the places (2, N), (2 N,)."""
    return (matrix @ place + shift[:, None]).T.ravel()


@DEPTHS
def test_displacements_inside_are_read_along_the_load_at_both_depths(rng, depth):
    model = gear_model(GEAR._replace(depth=depth))
    count = model.position.shape[1]
    assert not np.any(model.position[1] <= 0)
    nodes = model.basis.doflocs
    loads = model.loads.reshape(-1, 2, count)
    for m in range(count):
        # one node is loaded, by a unit force, into the tooth and down
        at = np.flatnonzero(np.any(loads[:, :, m] != 0, axis=1))
        np.testing.assert_allclose(nodes[:, at[0]], model.position[:, m], atol=1e-12)
        assert len(at) == 1
        direction = loads[at[0], :, m]
        r = np.linspace(TOOTH.form_distance, TOOTH.tip_distance, 20_001)
        flank = np.array(flank_point(TOOTH, r))
        near = int(np.argmin(np.hypot(*(flank - model.position[:, [m]]))))
        near = min(max(near, 1), len(r) - 2)
        tangent = flank[:, near + 1] - flank[:, near - 1]
        normal = np.array([tangent[1], -tangent[0]]) / np.hypot(*tangent)
        np.testing.assert_allclose(direction, normal * np.sign(normal @ [0, -1]), atol=2e-4)
        for which in (1, 2):
            row = model.inner[(which - 1) * count + m]
            beyond = model.beyond[(which - 1) * count + m]
            place = model.position[:, m] + which * depth * direction
            assert beyond == (place[1] < 0)
            slope = rng.normal(size=(2, 2))
            # alike on both halves, and opposite: the half y > 0 stands for both
            even, odd = slope * np.eye(2), slope * (1 - np.eye(2))
            for matrix, shift, sign in ((even, [0.3, 0.0], 1), (odd, [0.0, 0.7], -1)):
                expected = direction @ (matrix @ place + shift)
                read = row @ straight(matrix, np.array(shift), nodes)
                assert (sign if beyond else 1) * read == pytest.approx(expected, rel=1e-9)


@DEPTHS
def test_a_quadratic_field_is_read_almost(depth):
    """Exactly so where the cells are straight."""
    model = gear_model(GEAR._replace(depth=depth))
    count = model.position.shape[1]
    direction = model.loads.reshape(-1, 2, count)
    direction = np.sum(direction, axis=0)
    x, y = model.basis.doflocs
    scale = 1.0 / TOOTH.tip_radius
    field = np.stack([(y * scale) ** 2 + x * scale, x * y * scale**2], axis=-1).ravel()
    for which in (1, 2):
        place = model.position + which * depth * direction
        expected = direction[0] * ((place[1] * scale) ** 2 + place[0] * scale)
        expected += direction[1] * place[0] * place[1] * scale**2
        rows = slice((which - 1) * count, which * count)
        np.testing.assert_allclose(model.inner[rows] @ field, expected, atol=1e-5)
