"""Order of convergence of wear over steps and positions."""

import numpy as np

from tests.support.worn_pairs import study_of, worn
from tribodyn.studies.wear.outcome import volumes

#: Roll angles at which depths are compared, rad.
ROLL = np.linspace(-0.28, 0.25, 23)
FAR = 1e7


def slope(sizes, errors) -> float:
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


def test_heuns_steps_are_of_second_order_in_the_change_of_load():
    """Fourfold fewer changes of load, about sixteenfold smaller errors of the depths."""
    exact = worn(study_of(wear__revolutions=FAR, wear__load_change=0.002))[0].depths[0]
    changes = np.array([0.04, 0.02, 0.01])
    errors = [
        np.max(np.abs(worn(study_of(wear__revolutions=FAR, wear__load_change=change))[0].depths[0] - exact))
        for change in changes
    ]
    assert slope(changes, errors) > 1.5
    assert errors[1] < 2e-3 * np.max(exact)  # with the default


def test_depths_and_volume_are_of_second_order_in_the_positions():
    def found(positions: int) -> tuple[np.ndarray, float]:
        study = study_of(wear__revolutions=FAR, output__positions_per_cycle=positions)
        state, _ = worn(study)
        depth = np.interp(ROLL, study.places.node, state.depths[0][0, :, 0])
        return depth, float(volumes(study, state.depths)[0])

    exact, volume = found(480)
    counts = np.array([15, 30, 60, 120])
    coarse = [found(int(count)) for count in counts]
    errors = [np.max(np.abs(depth - exact)) for depth, _ in coarse]
    assert slope(1.0 / counts, errors) > 1.6
    assert errors[2] < 2e-3 * np.max(exact)  # with the default
    assert abs(coarse[2][1] / volume - 1.0) < 1e-3
