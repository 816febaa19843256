"""The one preparation of gears: teeth put together and checked, mesh tabulated, oil at its temperature.

The bulk temperature follows from the losses, the losses from the film, and the film from the oil at the bulk
temperature: a fixed point. Load-independent losses are those at the oil's temperature.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Generic, NamedTuple, TypeVar

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.drive import SIDES, Side, body_of, tip_radius
from tribodyn.geometry.families import family
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.standards.micropitting import LUBRICATION_FACTORS, bulk_rise
from tribodyn.studies.gears.case import GearCase, LubricatedCase
from tribodyn.tribology.bulk_temperature import (
    Heat,
    Network,
    TemperatureData,
    Temperatures,
    fixed_point,
    heat_given_off,
    network_temperatures,
)
from tribodyn.tribology.losses import Loss, LossData, Wheel, losses_of_pair
from tribodyn.tribology.oil import TEMPERATURE_RANGE, ZERO_CELSIUS, LubricantData, lubricant_at, specific_heat

#: Difference of temperatures that is not worth another motion, K; motions of a case at most.
CLOSE, MOST_MOTIONS = 0.1, 5
#: Share of the heat of tooth friction that either gear takes.
SHARE = 0.5


class Thermal(NamedTuple):
    """Where temperature, film and friction have settled."""

    lubricant: LubricantData  # at the bulk temperature
    mesh_loss: float  # mean loss to tooth friction, W
    losses: dict[str, Loss]  # load-independent ones by name
    temperatures: Temperatures | None  # None: the teeth are taken to be as warm as the oil
    heat: Heat
    given_off: float | None  # heat that leaves the network, W; None without a network


def thermal_state(case: Any, assembly: Assembly, mesh_loss: Callable[[Any], float]) -> Thermal | None:
    """Return bulk temperature and losses of a case; None where it asks for neither.

    Parameters
    ----------
    case : case
        With `lubricant`, `operating`, `temperature` and `losses`.
    assembly : its gears
    mesh_loss : (case, its lubricant at some temperature) -> mean loss to tooth friction, W

    Raises
    ------
    InputError
        If the teeth get hotter than the oil is known.
    SimulationError
        If the temperature does not settle.
    """
    asked: TemperatureData | None = case.temperature
    if asked is None:
        if case.losses is None:
            return None
        losses = idle_losses(case, assembly, case.lubricant)
        lost = mesh_loss(case)
        return Thermal(case.lubricant, lost, losses, None, _heat(lost, losses, housing=False), None)
    oil: LubricantData = case.lubricant
    supplied = float(oil.temperature)
    latest: list[Thermal] = []

    def step(here: tuple[float, float]) -> tuple[float, float]:
        bulk, around = here
        lubricant = replace(lubricant_at(oil, bulk), supply=around)
        lost = asked.mesh_loss
        if lost is None:
            lost = mesh_loss(replace(case, lubricant=lubricant))
        losses = idle_losses(case, assembly, lubricant_at(oil, around))
        heat = _heat(lost, losses, asked.housing_ambient > 0.0)
        found, given_off = _temperatures(case, assembly, asked, heat, lost, supplied)
        latest[:] = [Thermal(lubricant, lost, losses, found, heat, given_off)]
        return found.bulk, found.oil

    for one in fixed_point(step, (supplied, supplied), TEMPERATURE_RANGE):
        _refuse_unknown(one, asked)
    return latest[0]


def at_own_temperature(case: Any, bulk_temperature: float | None, mesh_loss: float) -> Any | None:
    """Return the case at the bulk temperature that its motion's loss gives; None where it was run there.

    A case begins at the temperature of its quasi-static loss, from which vibration moves it.

    Parameters
    ----------
    case : case
        As it was run, its oil as it enters the mesh.
    bulk_temperature : at which it was run, K; None: it asks for none
    mesh_loss : mean loss of its motion to tooth friction, W
    """
    if bulk_temperature is None or not mesh_loss >= 0.0:
        return None
    again = replace(case, temperature=replace(case.temperature, mesh_loss=mesh_loss))
    thermal = thermal_state(again, assemble(family(case.family), case.drive), lambda _: mesh_loss)
    assert thermal is not None
    assert thermal.temperatures is not None
    return None if abs(thermal.temperatures.bulk - bulk_temperature) <= CLOSE else again


def idle_losses(case: Any, assembly: Assembly, oil: LubricantData) -> dict[str, Loss]:
    """Return the load-independent losses that a case asks for, in the oil at its own temperature."""
    asked: LossData | None = case.losses
    if asked is None:
        return {}
    drive, path, speed = case.drive, assembly.path, case.operating.pinion_speed
    radii, depths = (
        (path.pinion_pitch_radius, path.gear_pitch_radius),
        (asked.pinion_immersion, asked.gear_immersion),
    )

    def wheel(side: Side) -> Wheel:
        body, place = body_of(drive, side), SIDES.index(side)
        return Wheel(
            float(speed * drive.pinion.teeth / body.teeth),
            float(radii[place]),
            float(tip_radius(drive, side)),
            float(assembly.tooth(side).root_radius),
            float(body.face_width),
            float(drive.module),
            float(body.teeth),
            depths[place],
        )

    pinion, gear = wheel("pinion"), wheel("gear")
    return losses_of_pair(asked, (pinion, gear), float(oil.inlet_viscosity), float(oil.density))


def thermal_quantities(thermal: Thermal | None, power_in: float, efficiency: float) -> dict[str, Any]:
    """Quantities of temperatures and load-independent losses for a summary; SI, temperatures in K.

    Parameters
    ----------
    power_in : that the driving gear puts in, without load-independent losses, W
    efficiency : of the mesh
    """
    if thermal is None:
        return {}
    quantities: dict[str, Any] = {}
    if (found := thermal.temperatures) is not None:
        quantities |= {
            "bulk_temperature": found.bulk,
            "bulk_temperature_pinion": found.pinion,
            "bulk_temperature_gear": found.gear,
            "oil_temperature": found.oil,
            "heat_generated": thermal.heat.total,
        }
        if thermal.given_off is not None:
            quantities |= {"housing_temperature": found.housing, "heat_given_off": thermal.given_off}
    if thermal.losses:
        idle = sum(one.power for one in thermal.losses.values())
        quantities |= {f"power_{name}": one.power for name, one in thermal.losses.items()}
        quantities |= {
            "power_load_independent": idle,
            "efficiency_with_losses": efficiency * power_in / (power_in + idle),
        }
        outside = [f"{name}: {limit}" for name, one in thermal.losses.items() for limit in one.exceeded]
        if outside:
            quantities["losses_outside"] = "; ".join(outside)
    return quantities


def contact_quantities(lubricant: LubricantData, quantities: Mapping[str, Any]) -> dict[str, float]:
    """Maximum contact temperature, K: bulk of the teeth, else of the oil, and the maximum flash temperature.

    Nothing where neither temperature is known.
    """
    warm = quantities.get("bulk_temperature", lubricant.temperature)
    return (
        {} if warm is None else {"contact_temperature_max": float(warm + quantities["flash_temperature_max"])}
    )


def _heat(mesh_loss: float, losses: dict[str, Loss], housing: bool) -> Heat:
    """Heat by where it arises: that of bearings in the housing, where there is one."""
    power = {name: one.power for name, one in losses.items()}
    bearings = power.get("bearings", 0.0)
    in_oil = power.get("churning", 0.0) + power.get("windage", 0.0)
    to_oil, to_housing = (in_oil, bearings) if housing else (in_oil + bearings, 0.0)
    return Heat(SHARE * mesh_loss, (1.0 - SHARE) * mesh_loss, to_oil, to_housing)


def _temperatures(
    case: Any, assembly: Assembly, asked: TemperatureData, heat: Heat, lost: float, supplied: float
) -> tuple[Temperatures, float | None]:
    if asked.model == "iso":
        centre = float(assembly.path.pinion_pitch_radius + assembly.path.gear_pitch_radius)
        width = float(min(case.drive.pinion.face_width, case.drive.gear.face_width))
        supply = LUBRICATION_FACTORS[asked.lubrication] / asked.tip_relief_factor
        bulk = supplied + bulk_rise(lost, 1.0, 1.0, centre, width, supply)
        return Temperatures(bulk, bulk, supplied, supplied), None
    sheet = case.lubricant.sheet
    flow = asked.oil_flow * float(case.lubricant.density) * float(specific_heat(sheet.density_15, supplied))
    network = Network(
        asked.pinion_oil,
        asked.gear_oil,
        flow,
        asked.oil_housing,
        asked.housing_ambient,
        asked.ambient_temperature,
    )
    found = network_temperatures(network, heat, supplied)
    return found, heat_given_off(network, found, supplied)


def _refuse_unknown(temperature: float, asked: TemperatureData) -> None:
    """Refuse a temperature for which the oil's data sheet gives no numbers."""
    low, high = (round(one - ZERO_CELSIUS) for one in TEMPERATURE_RANGE)
    theta = temperature - ZERO_CELSIUS
    if not low <= theta <= high:
        raise InputError(
            "temperature.model",
            f'"{asked.model}"',
            f"teeth or oil would reach {theta:.0f} degC, and the oil is known from {low} to {high} degC",
            "let more heat off (oil_flow, conductances), lower the load, or leave the table out"
            if theta > high
            else "write a higher ambient_temperature",
        )


AnyCase = TypeVar("AnyCase", bound=LubricatedCase)


@dataclass(frozen=True)
class PreparedGears(Generic[AnyCase]):
    """Gears put together, and their mesh tabulated."""

    case: AnyCase  # Its oil at the temperature at which film and friction are evaluated: that of the teeth.
    assembly: Assembly
    cycle: MeshCycle
    thermal: Thermal | None  # bulk temperature and load-independent losses, where the scenario asks for them


def assembled(case: GearCase) -> Assembly:
    """Put the gears of a case together.

    Raises
    ------
    InputError
        Where the teeth cannot be made or cannot run together.
    """
    from tribodyn.geometry.limits.checks import check

    return check(family(case.family), case.drive)


def at_tooth_temperature(
    case: AnyCase, assembly: Assembly, mesh_loss: Callable[[AnyCase], float]
) -> tuple[AnyCase, Thermal | None]:
    """Return a case with its oil at the temperature of its teeth, and what that follows from.

    Arguments and errors as those of `temperature.thermal_state`.
    """
    thermal = thermal_state(case, assembly, mesh_loss)
    return (case if thermal is None else replace(case, lubricant=thermal.lubricant)), thermal
