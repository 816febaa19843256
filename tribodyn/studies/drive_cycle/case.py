"""A case of a drive cycle: the gearbox, its duty over time, and what is recorded."""

from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from tribodyn.cases.cost import CostKey, Estimate, in_memory, recorded, total
from tribodyn.cases.heat_part import GearboxHeat
from tribodyn.cases.loss_part import GearboxLosses, NominalPoint
from tribodyn.errors import InputError
from tribodyn.numerics.parameter import Variable
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.schema import TIME, Layout
from tribodyn.studies.protocol.load import Loaded
from tribodyn.studies.protocol.study import CaseHead

_over = partial(Variable, ("time",))
_mesh = partial(Variable, ("time", "mesh"))
_text = partial(Variable, ("source",), "1", dtype="S96", fill=b"")
#: Of the meshes, as `cases.loss_part.LossesOver.meshes` has them.
OF_MESHES = {
    "film_min": _mesh("m", "minimum of the film over mesh cycle and face"),
    "film_parameter_min": _mesh("1", "minimum of the film over the roughness"),
    "friction_coefficient_mean": _mesh("1", "friction coefficient, mean weighted with load times sliding"),
    "hertz_pressure_max": _mesh("Pa", "maximum of the Hertz pressure over mesh cycle and face"),
}
SAMPLES: dict[str, Variable] = {
    "input_speed": _over("rad/s", "speed of the input"),
    "load": _over("1", "loads as a multiple of the scenario's own"),
    "power_in": _over("W", "power that the input takes; below 0 it gives power back"),
    "power_out": _over("W", "power that the loads take; below 0 they drive"),
    "power_loss": _over("W", "power lost, all sources"),
    "heat_given_off": _over("W", "heat that leaves to the surroundings, the coolant and the oil that flows"),
    "term_power": Variable(("time", "term"), "W", "power lost by term"),
    "source_power": Variable(("time", "source"), "W", "power lost by source"),
    "oil_temperature": _over("K", "temperature of the oil around the gears"),
    "node_temperature": Variable(("time", "node"), "K", "temperature of a part"),
    "bulk_temperature": _mesh("K", "bulk temperature of the teeth: mean of both gears"),
    **OF_MESHES,
    "energy_in": _over("J", "energy that the input has taken"),
    "energy_out": _over("J", "energy that the loads have taken"),
    "energy_lost": _over("J", "energy lost"),
    "heat_stored": _over("J", "heat stored in all parts since the start"),
    "heat_gone": _over("J", "heat given off since the start"),
}
_SCALES = {
    "term": Variable(("term",), "1", "term of the losses"),
    "source": Variable(("source",), "1", "loss: its term, its element"),
    "node": Variable(("node",), "1", "part of the gearbox as heat sees it"),
    "mesh": Variable(("mesh",), "1", "mesh of two gears"),
}
_OTHERS = {
    "source_term": _text(long_name="term of the losses that the source belongs to"),
    "source_element": _text(long_name="element that loses, as the scenario names it"),
    "source_method": _text(long_name="formula, as a scenario names it"),
    "node_capacity": Variable(("node",), "J/K", "heat capacity of a part"),
}
LAYOUT = Layout(TIME, SAMPLES, _SCALES, _OTHERS)


#: DutyRows of a cycle at least, where the scenario does not say.
ROWS = 200


@dataclass(frozen=True)
class CycleData:
    """A duty over time; linear between its rows."""

    time: tuple[float, ...]  # s, increasing
    speed: tuple[float, ...]  # of the input, rad/s
    load: tuple[float, ...] | None  # multiples of the scenario's loads
    torque: tuple[float, ...] | None  # at the output in place of them, against its motion, N m
    repeat: int = 1
    step: float | None = None  # longest between two rows that are worked out, s; None: by `ROWS`
    start_temperature: float | None = None  # of all parts, K; None: that of the surroundings
    tolerance: float = 1e-6


class DutyRows(NamedTuple):
    """A duty row by row, its repetitions behind each other."""

    time: Float[Array, " row"]  # s
    speed: Float[Array, " row"]  # rad/s
    load: Float[Array, " row"]  # multiple of the scenario's loads


@dataclass(frozen=True, kw_only=True)
class DriveCycleCase(CaseHead):
    """One drive cycle, complete."""

    subject: Loaded  # the gearbox
    cycle: CycleData

    @property
    def losses(self) -> GearboxLosses:
        """What the study of the gearbox offers."""
        return self.subject.losses

    @cached_property
    def heat(self) -> GearboxHeat:
        """The thermal network of the gearbox."""
        heat_of = self.subject.study.heat()
        heat = heat_of(self.subject.case) if heat_of else None
        assert heat is not None, "refused by the rules"
        return heat

    @cached_property
    def nominal(self) -> NominalPoint:
        """The gearbox at its own point of operation."""
        return self.losses.nominal(self.subject.case)

    @cached_property
    def rows(self) -> DutyRows:
        """The duty row by row."""
        cycle = self.cycle
        time, speed = np.array(cycle.time), np.array(cycle.speed)
        load = np.array(cycle.load if cycle.load is not None else cycle.torque)
        if cycle.load is None:
            if self.nominal.output_torque == 0.0:
                rule = "the scenario has no load, of which a torque could be a multiple"
                remedy = "give scenario.operating.output_torque"
                raise InputError("cycle.torque_table", None, rule, remedy)
            load = load / self.nominal.output_torque
        longest = cycle.step or float(time[-1] - time[0]) / ROWS
        parts = np.maximum(np.ceil(np.diff(time) / longest - 1e-9), 1.0).astype(int)
        place = np.concatenate([n + np.arange(count) / count for n, count in enumerate(parts)])
        place = np.append(place, len(time) - 1.0)
        begin, speed, load = (
            np.interp(place, np.arange(len(time)), values) for values in (time - time[0], speed, load)
        )
        laps = np.arange(cycle.repeat) * begin[-1]
        return DutyRows(
            (begin[None] + laps[:, None]).ravel(), np.tile(speed, cycle.repeat), np.tile(load, cycle.repeat)
        )


#: Core seconds of a point of losses, and of a row of the temperatures; temperatures of a table of losses.
_OF_POINT, _OF_ROW, _TEMPERATURES = 4e-3, 5e-3, 9


def estimate(case: DriveCycleCase) -> Estimate:
    """What a run of a case takes."""
    cycle = case.cycle
    lasts = cycle.time[-1] - cycle.time[0]
    count = len(cycle.time) + (lasts / cycle.step if cycle.step else ROWS)
    rows = round(count * cycle.repeat)
    points = (_TEMPERATURES * count) + 2.0 * rows
    sizes = {"time": rows, "term": 8, "source": 30, "node": 20, "mesh": 8}
    record = recorded(LAYOUT, sizes, copies=3.0)
    drivers = (
        CostKey("cycle.step", count, 2000.0, "write a longer one, or fewer rows"),
        CostKey("cycle.repeat", cycle.repeat, 5.0),
    )
    seconds = Estimate(seconds=_OF_POINT * points + _OF_ROW * rows)
    return total(drivers, record, in_memory(30.0 * points, 8.0), seconds)
