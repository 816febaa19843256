"""Two shafts joined by a mesh against ROSS 2.3.0: matrices and frequencies of another program."""

import numpy as np
import pytest

from tests.support.geared_shafts import frequencies

#: What `python -m tools.peers.ross_shafts` prints as ROSS's, Hz, by the pinion's speed in rad/s.
ROSS = {
    0.0: [
        *(224.7591, 275.0638, 279.9547, 349.9714, 416.0147, 453.7775),
        *(496.3740, 534.4428, 630.6267, 756.6431, 788.3644, 893.4881),
    ],
    600.0: [
        *(224.0212, 261.8035, 293.8071, 349.9714, 411.3613, 458.5527),
        *(496.3740, 534.5016, 630.6567, 755.3920, 788.6600, 892.6526),
    ],
}


@pytest.mark.parametrize("speed", sorted(ROSS))
def test_frequencies_of_two_geared_shafts(speed: float):
    """To the digits printed; gyroscopic moments of discs and shafts part those in both senses."""
    assert frequencies(speed)[: len(ROSS[speed])] == pytest.approx(ROSS[speed], rel=1e-6)


@pytest.mark.parametrize("speed", sorted(ROSS))
def test_ross_prints_what_is_stored(speed: float):
    pytest.importorskip("ross")
    from tools.peers.ross_shafts import ross_frequencies

    assert ross_frequencies(speed) == pytest.approx(np.array(ROSS[speed]), abs=1e-4)
