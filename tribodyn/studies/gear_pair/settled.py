"""Motions whose own losses give the bulk temperature that they were computed at."""

from dataclasses import replace

from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gears.temperature import bulk_temperature_of_loss

#: Difference of temperatures that is not worth another motion, K; motions of a case at most.
CLOSE, MOST = 0.1, 5


def at_own_temperature(case: Case, bulk_temperature: float | None, mesh_loss: float) -> Case | None:
    """Return the case at the bulk temperature that its motion's loss gives; None where it was run there.

    A case begins at the temperature of its quasi-static loss, from which vibration moves it.

    Parameters
    ----------
    case : Case
        As it was run.
    bulk_temperature : float or None
        At which it was, K; None: it asks for none.
    mesh_loss : float
        Mean loss of its motion to tooth friction, W.
    """
    if bulk_temperature is None or not mesh_loss >= 0.0:
        return None
    own = bulk_temperature_of_loss(case, assemble(family(case.family), case.drive), mesh_loss)
    if abs(own - bulk_temperature) <= CLOSE:
        return None
    assert case.temperature is not None
    return replace(case, temperature=replace(case.temperature, mesh_loss=mesh_loss))
