"""Efficiency of a dynamic run from its record, by energy over the last whole mesh cycles."""

from typing import NamedTuple

from tribodyn.errors import InputError
from tribodyn.mesh.power_flow import efficiency
from tribodyn.record.reader import Record
from tribodyn.record.withheld import EFFICIENCY, samples_withheld


class DynamicEfficiency(NamedTuple):
    """Work over the last whole mesh cycles of a record.

    Attributes
    ----------
    cycles : number of mesh cycles
    efficiency : 1 less friction work over work put in: what the summary of a run reports
    overall : work put out over work put in; with the damping of mesh and bearings. Both are NaN outside 0 … 1
    work_in, work_out, work_friction, work_damping : J; from the pinion and to the gear, < 0 where that drives
    stored : change of the stored energy, J; small where the run has settled
    """

    cycles: int
    efficiency: float
    overall: float
    work_in: float
    work_out: float
    work_friction: float
    work_damping: float
    stored: float


def dynamic_efficiency(record: Record, cycles: int | None = None) -> DynamicEfficiency:
    """Works of a record over its last whole mesh cycles.

    Energies are divided, and the run has integrated them: neither an average of instantaneous efficiencies
    nor anything that depends on the samples.

    Parameters
    ----------
    record : Record
        Of a gear pair, open.
    cycles : int, optional
        Default: a quarter of the run, at least one cycle.

    Raises
    ------
    InputError
        If the record does not hold that many cycles.
    """
    samples = int(record.scenario["output"]["samples_per_cycle"])
    whole = (len(record["time"]) - 1) // samples
    wanted = max(1, whole // 4) if cycles is None else cycles
    if not 0 < wanted <= whole:
        raise InputError("cycles", wanted, f"the record holds {whole} whole mesh cycles", "use fewer")
    part = slice(-wanted * samples - 1, None)

    def change(name: str) -> float:
        values = record[name][part]
        return float(values[-1] - values[0])

    pinion, gear, lost, damped = (change(f"work_{name}") for name in ("in", "out", "friction", "damping"))
    # what is lost between the two gears, whatever it is lost to
    overall = efficiency(pinion, gear, pinion - gear)
    return DynamicEfficiency(
        wanted,
        float(samples_withheld(EFFICIENCY, efficiency(pinion, gear, lost))),
        float(samples_withheld(EFFICIENCY, overall)),
        pinion,
        gear,
        lost,
        damped,
        change("stored_energy"),
    )
