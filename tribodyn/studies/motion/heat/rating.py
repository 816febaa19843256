"""What is said of the heat of a gearbox: its parts and paths, and ISO/TR 14179-1's rating beside them."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.loss_part import OperatingPoints
from tribodyn.cases.results import TextTable
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.heat.nodes import heat_of
from tribodyn.studies.motion.losses.gearbox import GearboxLoss
from tribodyn.tribology.heat.thermal_rating import (
    heat_dissipated,
    heat_transfer_coefficient,
    rated_load,
    sump_temperature,
)
from tribodyn.tribology.oil import TEMPERATURE_RANGE, ZERO_CELSIUS

#: Terms of losses that go with the load.
WITH_LOAD = ("P_VZP", "P_VLP")
#: Temperatures between which losses are interpolated, K apart.
_APART = 5.0


class ThermalRating(NamedTuple):
    """Thermal rating of ISO/TR 14179-1: one coefficient, one temperature; SI, temperatures in K."""

    coefficient: float  # k, W/(m² K)
    sump_temperature: float | None  # at the duty; None: not within the oil's range
    sump_limit: float
    heat_dissipated: float  # at the limit, W
    loss_without_load: float  # at the limit, W
    loss_with_load: float  # at the limit and the duty's power, W
    power: float  # that the input takes at the duty, W
    thermal_power: float  # P_T, W


def rating_of(loss: GearboxLoss) -> ThermalRating | None:
    """The rating of a gearbox; None where its scenario does not ask for its heat."""
    case, data = loss.case, loss.case.heat
    if data is None:
        return None
    speed = abs(case.source.speed)
    known = np.arange(TEMPERATURE_RANGE[0], TEMPERATURE_RANGE[1] + _APART, _APART)
    at = np.append(known[(known > data.ambient_temperature - _APART)], data.sump_limit)
    ones = np.ones(len(at))
    bulk = np.repeat(at[:, None], len(case.meshes), axis=1)
    losses = loss.at(OperatingPoints(ones, speed * ones, at, bulk))
    power = losses.power(speed * ones)
    loaded = np.array([source.term in WITH_LOAD for source in losses.sources])
    total, limit = power.sum(axis=1), power[-1]
    coefficient = data.housing.coefficient or heat_transfer_coefficient(data.housing.air_speed)
    conductance = coefficient * data.housing.area
    sump = sump_temperature(
        lambda temperature: float(np.interp(temperature, at[:-1], total[:-1])),
        conductance,
        data.ambient_temperature,
        (float(at[0]), float(at[-2])),
    )
    dissipated = heat_dissipated(coefficient, data.housing.area, data.sump_limit, data.ambient_temperature)
    idle, with_load = float(limit[~loaded].sum()), float(limit[loaded].sum())
    taken = loss.output_power + float(limit.sum())

    def under(load: float) -> tuple[float, float]:
        point = OperatingPoints(np.array([load]), np.array([speed]), at[-1:], bulk[-1:])
        each = loss.at(point).power(point.speed)[0]
        return float(each[~loaded].sum()), float(each[loaded].sum())

    load = rated_load(under, dissipated)
    rated = load * loss.output_power + dissipated if load > 0.0 else 0.0
    return ThermalRating(coefficient, sump, data.sump_limit, dissipated, idle, with_load, taken, rated)


def heat_part(prepared: PreparedGearbox) -> tuple[dict[str, Any], list[TextTable], list[TextTable]]:
    """Data, tables and tables of details of a case in thermal balance; nothing where it asks for none."""
    case = prepared.case
    network, settled = heat_of(case), case.heat and case.heat.settled
    if network is None or settled is None:
        return {}, [], []
    parts, speed = settled.parts, abs(case.source.speed)
    rows = [
        (name, f"{value - ZERO_CELSIUS:.1f}", f"{network.network.capacities[name]:.4g}")
        if name in network.network.capacities
        else (name, f"{value - ZERO_CELSIUS:.1f}", "–")
        for name, value in parts.items()
    ]
    here = np.array([[parts[name] for name in network.network.nodes]])
    flows = network.network.flows(here, speed)[0].tolist()
    paths = []
    for path, flow in zip(network.network.paths, flows, strict=True):
        apart = parts[path.one] - parts[path.two]
        paths.append({"from": path.one, "to": path.two, "heat": flow, "by": path.what})
        paths[-1] |= {"conductance": flow / apart} if apart else {}
    shown = [
        (
            path["from"],
            path["to"],
            f"{path['heat']:.4g}",
            f"{path['conductance']:.3g}" if "conductance" in path else "–",
            path["by"],
        )
        for path in paths
    ]
    rating = rating_of(GearboxLoss(case, prepared.tables))
    assert rating is not None, "it has a network"
    sump = rating.sump_temperature
    simple = [
        ("k, W/(m² K)", f"{rating.coefficient:.3g}"),
        ("sump at the duty, °C", "beyond 180" if sump is None else f"{sump - ZERO_CELSIUS:.1f}"),
        (f"heat dissipated at {rating.sump_limit - ZERO_CELSIUS:.4g} °C, W", f"{rating.heat_dissipated:.4g}"),
        ("losses there without load, W", f"{rating.loss_without_load:.4g}"),
        ("losses there with the load, W", f"{rating.loss_with_load:.4g}"),
        ("thermal rating P_T, kW", f"{1e-3 * rating.thermal_power:.4g}"),
    ]
    data = {
        "heat": {
            "oil_temperature": settled.oil,
            "housing_temperature": settled.housing,
            "temperatures": dict(parts),
            "heat_generated": settled.heat,
            "heat_given_off": settled.given_off,
            "paths": paths,
            "thermal_rating": rating._asdict(),
        }
    }
    tables = [
        TextTable("Temperatures of the parts", ("part", "°C", "J/K"), rows),
        TextTable("Beside it: thermal rating of ISO/TR 14179-1", ("", ""), simple),
    ]
    return data, tables, [TextTable("Paths of heat", ("from", "to", "W", "W/K", "by"), shown)]
