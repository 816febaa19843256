"""The equations that other programs are timed on are tribodyn's, and what is too inexact has no ratio."""

import shutil

import numpy as np
import pytest

from tools.bench_peers import SAME_EQUATIONS, problem, require_same_equations
from tools.peers.numpy_model import MOVING, difference, numpy_rates
from tools.peers.single import Program, octave_rates, scipy_on_numpy
from tribodyn.dynamics.parameters import SLIDING_DYNAMIC, SLIDING_KINEMATIC

# Amplitude of displacements over the static ones, and of velocities, m/s: as large as the motion's own, so
# that pairs lift off, and flanks that slide slowly turn round.
DISPLACED, VELOCITY = 0.5, 0.2


@pytest.fixture(scope="module")
def posed():
    return problem()


@pytest.fixture(scope="module")
def visited(posed):
    """Phases over the mesh cycle, and random states about the static one."""
    random = np.random.default_rng(20261123)
    phases = random.uniform(0.0, 1.0, 60)
    displacements = posed.state[MOVING[:5]] * random.uniform(1 - DISPLACED, 1 + DISPLACED, (60, 5))
    return phases, np.hstack([displacements, random.uniform(-VELOCITY, VELOCITY, (60, 5))])


def with_sliding(posed, sliding):
    return posed.model._replace(options=posed.model.options._replace(sliding=sliding))


def test_the_comparison_is_of_the_default_sliding(posed):
    assert posed.model.options.sliding == SLIDING_DYNAMIC


OCTAVE = pytest.param(
    octave_rates, marks=pytest.mark.skipif(not shutil.which("octave-cli"), reason="no Octave here")
)


@pytest.mark.parametrize("sliding", [SLIDING_DYNAMIC, SLIDING_KINEMATIC])
@pytest.mark.parametrize("rates", [numpy_rates, OCTAVE])
def test_right_hand_sides_agree_at_random_states(posed, visited, sliding, rates):
    phases, states = visited
    assert difference(with_sliding(posed, sliding), phases, states, rates) <= SAME_EQUATIONS


def test_there_is_no_comparison_of_other_equations(posed):
    def kinematic(model, phases, states):
        return numpy_rates(with_sliding(posed, SLIDING_KINEMATIC), phases, states)

    programs = {"old model": Program(scipy_on_numpy("BDF"), kinematic)}
    with pytest.raises(SystemExit, match=r"no comparison.*: old model"):
        require_same_equations(posed, programs)
