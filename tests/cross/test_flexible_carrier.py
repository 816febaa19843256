"""Carriers by matrices: stiff ones are rigid, arms on springs are pins in series, loads by closed forms."""

from typing import Any

import numpy as np
import pytest

from tests.support.epicyclic_sets import meshed_set
from tests.support.planet_sets import IN_PHASE, helical_set, planet_set, tangent_loads
from tests.support.spider import RADIUS, around, spider
from tests.support.states import recorded
from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.errors import InputError
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import TransientSettings
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.prepare import prepare

STIFF, MODE = 1e14, 3001.0
ENDS = [("sun", "carrier"), ("carrier", "sun")]


def made(helical: bool = False, **changes: Any) -> PreparedGearbox:
    of = helical_set if helical else planet_set
    return prepare(case_of_table(of(IN_PHASE, **{"frame_forces": False, **changes})))


def rest(prepared: PreparedGearbox) -> np.ndarray:
    """Displacements at rest of all coordinates of bodies."""
    layout = prepared.model.layout
    return static_equilibrium(prepared.model)[: layout.half - layout.modes]


@pytest.mark.parametrize("ends", ENDS)
@pytest.mark.parametrize("helical", [False, True])
def test_a_stiff_one_is_the_rigid_carrier(helical, ends):
    radius = RADIUS / np.cos(np.radians(15.0)) if helical else RADIUS
    carrier = spider([STIFF] * 3, mode=MODE, at=around(3, radius))
    rigid, given = (made(helical, ends=ends, **more) for more in ({}, {"flexible_carrier": carrier}))
    np.testing.assert_allclose(rest(given), rest(rigid), rtol=1e-4, atol=1e-10)
    at_rest = [tangent_loads(each.model, static_equilibrium(each.model)) for each in (rigid, given)]
    np.testing.assert_allclose(*at_rest, rtol=1e-5)
    expected, found = (
        natural_frequencies(each.model, [one.cycle for one in each.tables]) for each in (rigid, given)
    )
    apart = np.abs(found - MODE)
    assert np.min(apart) < 1e-6 * MODE
    found = np.delete(found, np.argmin(apart))[: len(expected)]
    np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1.0)


@pytest.mark.parametrize("ends", ENDS)
def test_arms_that_give_alike_are_pins_in_series_with_the_bearings(ends):
    arm = 2e8
    pinned = made(ends=ends, pin={"stiffness": f"{arm} N/m"})
    given = made(ends=ends, flexible_carrier=spider([arm] * 3))
    np.testing.assert_allclose(rest(given), rest(pinned), rtol=1e-5, atol=1e-9)


def test_planets_that_mesh_with_each_other_have_pins_of_their_own():
    arm, body = 2e8, {"body": [{"name": "carrier", "mass": "8 kg", "inertia": "0.2 kg*m**2"}]}
    pinned = prepare(case_of_table(meshed_set(pin={"stiffness": f"{arm} N/m"}) | body))
    bodies = pinned.case.bodies
    at = [bodies[planet].centre for planet in pinned.case.sets[0].planets]
    table = meshed_set(flexible_carrier=spider([arm] * 6, at=at)) | body
    np.testing.assert_allclose(rest(prepare(case_of_table(table))), rest(pinned), rtol=1e-5, atol=1e-9)


def test_the_planet_on_a_flexible_arm_carries_less_by_the_closed_form():
    """Paths in parallel: c = c_0 + (2 cos α)²/k of an arm, whatever c_0 of the teeth and bearings is."""
    held = {"stiffness_x": "1e13 N/m", "stiffness_y": "1e13 N/m", "damping_ratio": 0.05}
    bearings = {name: held for name in ("sun", "ring", "carrier")}
    ratios = []
    arms = (1e8, 4e7)
    for arm in arms:
        carrier = spider([arm, STIFF, STIFF])
        model = made(flexible_carrier=carrier, bearings=bearings, friction={"coefficient": 0.0}).model
        loads = tangent_loads(model, static_equilibrium(model))[:3]
        np.testing.assert_allclose(loads[1], loads[2], rtol=1e-3)
        ratios.append(loads[1] / loads[0] - 1.0)
    assert ratios[1] / ratios[0] == pytest.approx(arms[0] / arms[1], rel=0.01)
    assert ratios[0] > 0.1


@pytest.mark.parametrize("ends", ENDS)
def test_energy_balances_as_it_turns(ends):
    """In what drives, also where the carrier does and has no micro-rotation."""
    model = made(ends=ends, flexible_carrier=spider([3e8, 2e8, 2e8], mode=MODE)).model
    run = recorded(model, TransientSettings("rodas4", 1e-8, 1, 10**6, 40))
    into = run["work_in"] - run["work_out"] - run["work_friction"] - run["work_damping"]
    into = into + run["work_parametric"]
    stored = run["stored_energy"] - run["stored_energy"][0]
    np.testing.assert_allclose(stored, into - into[0], atol=1e-9 * np.ptp(run["work_in"]))


@pytest.mark.parametrize(
    ("change", "key", "words"),
    [
        ({"pins": ["P1", "P2"]}, "pins", "each of the 3 planets"),
        ({"pins": ["P1", "P2", "P9"]}, "pins.2", "no such seat|seat"),
        ({"pins": ["P2", "P1", "P3"]}, "pins", "stands at"),
        ({"units": "mm, t, s"}, "units", "the file says"),
        (spider([1e9] * 3, hub=20.0), "matrices", "has 20.6 kg"),
    ],
)
def test_what_contradicts_itself_is_one_line(change, key, words):
    table = planet_set(IN_PHASE, flexible_carrier=spider([1e9] * 3) | change)
    with pytest.raises(InputError, match=words) as refused:
        prepare(case_of_table(table))
    assert refused.value.key.startswith("stage.0.flexible_carrier")
    assert refused.value.key.endswith(key)
    assert "\n" not in str(refused.value)
