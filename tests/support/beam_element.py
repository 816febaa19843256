"""A free round bar as a super-element: the simplest structure of which everything is known."""

import numpy as np
import scipy.sparse as sparse

from tribodyn.train.elastic.beam import ShaftMetal, ShaftSection
from tribodyn.train.elastic.beam_matrices import SIX, matrices
from tribodyn.train.elastic.craig_bampton import reduced
from tribodyn.train.elastic.superelement import SuperElement, modal_damping

LENGTH, DIAMETER, DENSITY = 0.5, 0.02, 7850.0
STEEL = ShaftMetal(206e9, 0.3)
PIECES = 24


def whole_bar(diameter=DIAMETER):
    """Stiffness and mass of the whole model."""
    size = SIX * (PIECES + 1)
    stiffness, mass = np.zeros((2, size, size))
    for piece in range(PIECES):
        at = slice(SIX * piece, SIX * (piece + 2))
        found = matrices(ShaftSection(LENGTH, diameter), LENGTH / PIECES, STEEL, DENSITY)
        stiffness[at, at] += found.stiffness
        mass[at, at] += found.mass
    return stiffness, mass


def bar(highest: float = 3000.0, diameter: float = DIAMETER) -> SuperElement:
    """Seats at both ends, a point in the middle."""
    stiffness, mass = whole_bar(diameter)
    size = len(mass)
    ends = [*range(SIX), *range(size - SIX, size)]
    left = reduced(*map(sparse.csr_matrix, (stiffness, mass, np.eye(size)[ends])), highest)
    places = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, LENGTH]])
    middle = SIX * (PIECES // 2)
    damping = modal_damping(left.mass, left.stiffness, 0.01)
    matrices_of = left.mass, left.stiffness, damping
    recovery = left.basis[None, middle : middle + 3]
    return SuperElement(("A", "B"), places, len(left.frequency), *matrices_of, ("middle",), recovery)
