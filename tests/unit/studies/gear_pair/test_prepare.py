"""What a case is made into: enough sweeps over the coupled pairs, however strongly they are coupled."""

import numpy as np
import pytest

from tribodyn.dynamics.contact_forces import ELASTIC_LOAD, XI
from tribodyn.dynamics.equations import strain_energy
from tribodyn.dynamics.parameters import STATES
from tribodyn.mesh.cycle import polynomials
from tribodyn.studies.gear_pair.prepare import prepare, tables


@pytest.mark.parametrize(("factor", "sweeps"), [(0.0, 1), (1.0, 4), (1.8, 8)])
def test_loads_settle_where_one_pair_separates(prepared, factor: float, sweeps: int):
    """Within 1e-4 of what a hundred sweeps give, with weaker and stronger coupling between the pairs."""
    given = prepared("crc-23-47")
    cycle = given.cycle._replace(coupling=given.cycle.coupling * factor)
    lifted = cycle._replace(gap=cycle.gap + np.array([0.0, 10e-6]))
    tabulated = tables(given.case)._replace(cycle=lifted, table=polynomials(lifted))
    model = prepare(given.case, tabulated).model
    assert model.options.sweeps == sweeps
    y = np.zeros(STATES)
    separated = 0
    for y[XI] in np.linspace(2e-6, 30e-6, 29):
        loads = []
        for count in (sweeps, 100):
            work: dict = {}
            exact = model._replace(options=model.options._replace(sweeps=count))
            strain_energy(0.5 * model.table.boundary[1], 0, y, exact, work)
            loads.append([work[ELASTIC_LOAD, i] for i in range(2)])
        separated += min(loads[1]) == 0.0 < max(loads[1])
        np.testing.assert_allclose(loads[0], loads[1], rtol=0, atol=1e-4 * max(loads[1]))
    assert separated > 2
