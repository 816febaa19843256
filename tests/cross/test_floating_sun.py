"""A floating sun that runs out: it moves aside by its eccentricity, and no planet notices."""

import numpy as np

from tests.support.planet_sets import planet_set
from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics.approach import NORMAL_LOAD
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import frictionless
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.schedule import interval_of
from tribodyn.train.structure import shift_of

ECCENTRICITY, ANGLE = 15e-6, 40.0


def at_rest(eccentricity: float) -> tuple[np.ndarray, np.ndarray]:
    """Loads of the six meshes, N, and displacements of the sun, m, over a turn against the carrier."""
    table = planet_set(floating=["sun"], solver={"cycles": 24 * 30})
    table["gear"]["sun"] |= {"eccentricity": f"{1e6 * eccentricity} um"}
    if eccentricity:
        table["gear"]["sun"] |= {"eccentricity_angle": f"{ANGLE} deg"}
    prepared = prepare(case_of_table(table))
    model = frictionless(prepared.model)
    model = model._replace(operation=model.operation._replace(nominal_speed=1e-3))
    at = np.arange(24) + 0.3
    _, phases, intervals = interval_of(at, model.schedule)
    sun = prepared.names.index("sun")
    loads, moved = [], []
    for phase, interval in zip(phases, intervals, strict=True):
        y = static_equilibrium(model, float(phase), int(interval))
        work = contacts_of(model)
        derivatives(float(phase), 0.0, int(interval), y, model, work, {})
        loads.append([sum(v for (row, _), v in own.items() if row == NORMAL_LOAD) for own in work])
        moved.append(y[shift_of(sun) : shift_of(sun) + 2])
    return np.array(loads), np.array(moved)


def test_a_floating_sun_runs_out_without_a_planet_noticing():
    """Its axis stands opposite its eccentricity, which turns with it, by as much."""
    loads, moved = at_rest(ECCENTRICITY)
    plain, centred = at_rest(0.0)
    np.testing.assert_allclose(loads, plain, rtol=1e-4)
    aside = moved - centred
    np.testing.assert_allclose(np.hypot(*aside.T), ECCENTRICITY, rtol=1e-3)
    turned = np.unwrap(np.arctan2(aside[:, 1], aside[:, 0]))
    np.testing.assert_allclose(np.abs(np.diff(turned)), 2.0 * np.pi / 24, rtol=1e-3)
