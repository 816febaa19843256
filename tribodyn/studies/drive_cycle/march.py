"""Temperatures and losses of a gearbox over its cycle."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from tribodyn.cases.heat_part import AMBIENT, GearboxHeat
from tribodyn.cases.loss_part import LossesOver, OperatingPoints
from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.drive_cycle.case import DriveCycleCase
from tribodyn.studies.drive_cycle.warm_losses import WarmLosses
from tribodyn.tribology.heat.transient import HeatHistory, heat_over_time
from tribodyn.tribology.oil import TEMPERATURE_RANGE, ZERO_CELSIUS

#: Difference between the losses at the temperatures of the rows and those interpolated, as a share of the
#: largest loss, that is not worth another pass; passes at most.
CLOSE, PASSES = 1e-4, 5


class CycleHistory(NamedTuple):
    """A cycle row by row."""

    heat: HeatHistory
    losses: LossesOver  # at the temperatures of the rows
    power: Float[Array, "row source"]  # W
    oil: Float[Array, " row"]  # K
    bulk: Float[Array, "row mesh"]  # K
    #: largest difference between losses evaluated and those that were integrated, as a share of the largest
    error: float


def march(case: DriveCycleCase, progress: Callable[[float], None] | None = None) -> CycleHistory:
    """Integrate the temperatures over the cycle.

    Losses are interpolated over the temperature, corrected row by row to those at the temperatures that come
    out, and the temperatures integrated again until the two agree. Raises InputError where the oil leaves
    the range in which it is known, SimulationError where the integration fails.
    """
    heat, rows = case.heat, case.rows
    names = case.losses.names(case.subject.case)

    def losses_at(points: OperatingPoints) -> LossesOver:
        return case.losses.at(case.subject.case, points)

    given = case.cycle.start_temperature
    start = heat.network.held[AMBIENT] if given is None else given
    table = WarmLosses(losses_at, rows, names, start)
    shares = heat.entering(table.sources, names)
    first = np.full(len(heat.network.nodes), start)

    def arises(row: int, share: float, points: Float[Array, "point node"]) -> Float[Array, "point any"]:
        return table.power(row, share, _of_sources(heat, table, points)) @ shares

    def speed(row: int, share: float) -> float:
        low, high = rows.speed[row], rows.speed[min(row + 1, len(rows.speed) - 1)]
        return abs(float(low + share * (high - low)))

    for number in range(PASSES):

        def told(row: int, number: int = number) -> None:
            if progress is not None:
                progress((number + row / len(rows.time)) / PASSES)

        history = heat_over_time(heat.network, arises, speed, first, rows.time, case.cycle.tolerance, told)
        _refuse_unknown(rows.time, heat, history)
        oil, bulk = heat.at_meshes(history.temperatures)
        losses = losses_at(OperatingPoints(rows.load, rows.speed, oil, bulk))
        power = losses.power(rows.speed)
        temperatures = _of_sources(heat, table, history.temperatures)
        integrated = np.concatenate([table.power(row, 0.0, at[None]) for row, at in enumerate(temperatures)])
        error = float(np.abs(power - integrated).sum(axis=1).max() / max(power.sum(axis=1).max(), 1e-300))
        if error <= CLOSE or number == PASSES - 1:
            return CycleHistory(history, losses, power, oil, bulk, error)
        with np.errstate(divide="ignore", invalid="ignore"):
            table.correction *= np.where(integrated > 0.0, power / integrated, 1.0)
    raise AssertionError("the last pass returns")


def _of_sources(
    heat: GearboxHeat, table: WarmLosses, points: Float[Array, "point node"]
) -> Float[Array, "point source"]:
    """The temperature that each source goes by."""
    oil, bulk = heat.at_meshes(points)
    return np.concatenate([bulk, oil[:, None]], axis=1)[:, table.goes_by]


def _refuse_unknown(time: Float[Array, " row"], heat: GearboxHeat, history: HeatHistory) -> None:
    """Refuse temperatures of oil or teeth for which the oil's data sheet gives no numbers."""
    oil, bulk = heat.at_meshes(history.temperatures)
    every = np.concatenate([oil[:, None], bulk], axis=1)
    beyond = np.argwhere((every < TEMPERATURE_RANGE[0]) | (every > TEMPERATURE_RANGE[1]))
    if len(beyond):
        row, column = beyond[0]
        low, high = (round(limit - ZERO_CELSIUS) for limit in TEMPERATURE_RANGE)
        reached = f"{every[row, column] - ZERO_CELSIUS:.0f} degC after {time[row]:.4g} s"
        rule = f"teeth or oil would reach {reached}, and the oil is known from {low} to {high} degC"
        remedy = "let more heat off (area, air_speed, cooler), or lower the load"
        raise InputError("scenario.temperature", None, rule, remedy)
