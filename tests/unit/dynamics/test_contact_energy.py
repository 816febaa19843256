"""Strain energy of one contact: the integral of its load, and what its compliance makes of it."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from tribodyn.dynamics import approach as contact
from tribodyn.dynamics.energy import compliance_force, mesh_energy, pair_energy
from tribodyn.dynamics.parameters import HERTZ_IN_TABLE, HERTZ_POWER_LAW
from tribodyn.numerics.smooth import onset, power_law_force, power_law_stiffness

WIDTH, COEFFICIENT, COMPLIANCE = 2e-6, 4e-9, 2.5e-9


def loaded(hertz, free, compliance):
    """A mesh of one pair, its model, and what `elastic_loads` leaves of an approach in or above the width."""
    mesh = SimpleNamespace(
        table=SimpleNamespace(hertz_coefficient=COEFFICIENT, side=np.ones(1), face_position=np.zeros(1))
    )
    model = SimpleNamespace(
        operation=SimpleNamespace(contact_width=WIDTH), options=SimpleNamespace(hertz=hertz, sweeps=1)
    )
    work = {(contact.EFFECTIVE_APPROACH, 0): free, (contact.COMPLIANCE, 0): compliance}
    work[contact.ELASTIC_LOAD, 0] = work[contact.WHOLE_LOAD, 0] = load_of(hertz, free, compliance)
    work[contact.PRESENT, 0] = 1.0
    work[contact.STIFFNESS, 0] = 1.0 / compliance
    return mesh, model, work


def load_of(hertz, free, compliance):
    share = min(max(free / WIDTH, 0.0), 1.0)
    if hertz == HERTZ_IN_TABLE:
        return free / compliance if share == 1.0 else WIDTH / compliance * share**2 * (2.0 - share)

    def missing(force):
        return compliance * force + COEFFICIENT * force**0.9 - max(free, WIDTH)

    force = brentq(missing, 1e-12, max(free, WIDTH) / compliance, rtol=1e-14)
    if share == 1.0:
        return force
    # the cubic from zero with zero slope to load and stiffness at the width
    rise = WIDTH / (compliance + 0.9 * COEFFICIENT * force**-0.1)
    return share**2 * (3.0 * force - rise) + share**3 * (rise - 2.0 * force)


@pytest.mark.parametrize("hertz", [HERTZ_IN_TABLE, HERTZ_POWER_LAW])
@pytest.mark.parametrize("free", [-1e-6, 0.4e-6, 1.7e-6, 2.5e-6, 3e-5])
def test_energy_is_the_work_of_the_load(hertz, free):
    arguments = loaded(hertz, free, COMPLIANCE)
    parts = [(0.0, min(free, WIDTH)), (WIDTH, free)] if free > WIDTH else [(0.0, max(free, 0.0))]
    energy = sum(quad(lambda x: load_of(hertz, x, COMPLIANCE), *part, epsrel=1e-11)[0] for part in parts)
    assert pair_energy(0, *arguments) == pytest.approx(energy, rel=1e-8, abs=1e-15)
    assert mesh_energy(*arguments) == pytest.approx(energy, rel=1e-8, abs=1e-15)


@pytest.mark.parametrize("hertz", [HERTZ_IN_TABLE, HERTZ_POWER_LAW])
@pytest.mark.parametrize("free", [0.4e-6, 1.7e-6, 2.5e-6, 3e-5])
def test_compliance_takes_the_slope_of_the_energy(hertz, free):
    step = 1e-5 * COMPLIANCE
    above, below = (pair_energy(0, *loaded(hertz, free, COMPLIANCE + by)) for by in (step, -step))
    force = compliance_force(0, *loaded(hertz, free, COMPLIANCE))
    assert force == pytest.approx(-(above - below) / (2.0 * step), rel=1e-6)


@pytest.mark.parametrize("share", [0.2, 0.9])
def test_the_onset_is_the_cubic_of_the_power_law(share):
    force = power_law_force(WIDTH, COMPLIANCE, COEFFICIENT)
    stiffness = power_law_stiffness(force, COMPLIANCE, COEFFICIENT)
    assert onset(share * WIDTH, WIDTH, force, stiffness) == pytest.approx(
        load_of(HERTZ_POWER_LAW, share * WIDTH, COMPLIANCE), rel=1e-9
    )
