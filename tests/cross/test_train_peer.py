"""The history of a two-stage reducer that trains are compared with, beside that of a multibody program."""

import numpy as np
import pytest

pytest.importorskip("exudyn")

from tools.peers.exudyn_train import compared, differences


def error(rigid, share):
    ours, theirs = compared(rigid, share)
    free = [i for i in range(ours.displacement.shape[1]) if i != 2]
    columns = (theirs.displacement[:, free], theirs.mesh_force)
    return np.concatenate(
        [
            differences(found, expected)
            for found, expected in zip(columns, (ours.displacement[:, free], ours.mesh_force), strict=True)
        ]
    )


@pytest.mark.parametrize("rigid", [False, True])
def test_a_multibody_program_finds_the_same_motion(rigid):
    """Within 0.1 %, most of it the exact geometry of the bodies' displacements: less at less load."""
    whole, tenth = error(rigid, 1.0), error(rigid, 0.1)
    assert whole.max() < 1e-3
    assert tenth.max() < 1.2e-4
