"""The one preparation of gears: teeth put together and checked, mesh tabulated, oil at its temperature.

The bulk temperature follows from the losses, the losses from the film, and the film from the oil at the bulk
temperature: a fixed point. Load-independent losses are those at the oil's temperature.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Generic, NamedTuple, TypeVar

from tribodyn.errors import InputError
from tribodyn.gears.case import GearCase, LawfulCase, LubricatedCase
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, Side, body_of, tip_radius
from tribodyn.geometry.families import family
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.standards.micropitting import LUBRICATION_FACTORS, bulk_rise
from tribodyn.tribology.bulk_temperature import (
    Heat,
    Network,
    TemperatureData,
    Temperatures,
    fixed_point,
    heat_given_off,
    heat_partition,
    network_temperatures,
)
from tribodyn.tribology.law import AUTO
from tribodyn.tribology.losses.loss import Loss, Wheel, oil_state
from tribodyn.tribology.losses.pair import LossData, losses_of_pair
from tribodyn.tribology.oil import TEMPERATURE_RANGE, ZERO_CELSIUS, LubricantData, lubricant_at, specific_heat

#: Difference of temperatures that is not worth another motion, K; motions of a case at most.
CLOSE, MOST_MOTIONS = 0.1, 5


def with_chosen_laws(case: LawfulCase) -> LawfulCase:
    """Return the case with laws in the place of "auto"; raises as `assembled` and `choice.settled`.

    Where no "auto" is asked for, teeth that cannot be made are left to who puts them together.
    """
    from tribodyn.tribology.closure import is_open  # the registries of all laws

    if not is_open(case):
        return case
    from tribodyn.tribology.choice import settled  # the solved contact

    try:
        assembled(case)
    except InputError:
        if AUTO in (case.friction.law, case.film.law):
            raise
        return case
    return settled(case)


class Thermal(NamedTuple):
    """Where temperature, film and friction have settled."""

    lubricant: LubricantData  # at the bulk temperature
    mesh_loss: float  # mean loss to tooth friction, W
    losses: dict[str, Loss]  # load-independent ones by name
    temperatures: Temperatures | None  # None: the teeth are taken to be as warm as the oil
    heat: Heat
    given_off: float | None  # heat that leaves the network, W; None without a network


def thermal_state(case: Any, assembly: Assembly, mesh_loss: Callable[[Any], float]) -> Thermal | None:
    """Return bulk temperature and losses of a lubricated case; None where it asks for neither.

    `mesh_loss` gives the mean loss to tooth friction, W, of the case with its lubricant at some temperature.
    Raises InputError if the teeth get hotter than the oil is known, SimulationError if nothing settles.
    """
    wanted: TemperatureData | None = case.temperature
    if wanted is None:
        if case.losses is None:
            return None
        losses, lost = idle_losses(case, assembly, case.lubricant), mesh_loss(case)
        return Thermal(case.lubricant, lost, losses, None, heat_partition(lost, losses, housing=False), None)
    oil: LubricantData = case.lubricant
    supplied = float(oil.temperature)
    latest: list[Thermal] = []

    def step(here: tuple[float, float]) -> tuple[float, float]:
        bulk, around = here
        lubricant = replace(lubricant_at(oil, bulk), supply=around)
        given_loss = wanted.mesh_loss
        lost = mesh_loss(replace(case, lubricant=lubricant)) if given_loss is None else given_loss
        losses = idle_losses(case, assembly, lubricant_at(oil, around))
        heat = heat_partition(lost, losses, housing=wanted.housing_ambient > 0.0)
        heat = heat._replace(
            oil=heat.oil + wanted.other_heat, housing=heat.housing + wanted.other_housing_heat
        )
        temperatures, given_off = temperatures_of(case, assembly, wanted, heat, lost, supplied)
        latest[:] = [Thermal(lubricant, lost, losses, temperatures, heat, given_off)]
        return temperatures.bulk, temperatures.oil

    for temperature in fixed_point(step, (supplied, supplied), TEMPERATURE_RANGE):
        _refuse_unknown(temperature, wanted)
    return latest[0]


def idle_losses(case: Any, assembly: Assembly, oil: LubricantData) -> dict[str, Loss]:
    """Return the load-independent losses that a case asks for, in the oil at its own temperature."""
    wanted: LossData | None = case.losses
    if wanted is None:
        return {}
    drive, speed = case.drive, case.operating.pinion_speed
    speeds = float(speed), float(speed * abs(drive.pinion.teeth / drive.gear.teeth))
    return losses_of_pair(wanted, wheels_of(case, assembly), speeds, oil_state(oil), normal_module(case))


def normal_module(case: Any) -> float:
    """Normal module of a case's teeth, m."""
    return float(case.drive.module) * math.cos(abs(float(case.drive.helix_angle)))


def wheels_of(case: Any, assembly: Assembly) -> tuple[Wheel, Wheel]:
    """The gears of a case as formulas of churning and windage take them."""
    drive, path = case.drive, assembly.path
    radii = path.pinion_pitch_radius, path.gear_pitch_radius
    depths = case.losses.pinion_immersion, case.losses.gear_immersion

    def wheel(side: Side) -> Wheel:
        body, place = body_of(drive, side), SIDES.index(side)
        return Wheel(
            abs(float(radii[place])),
            abs(float(tip_radius(drive, side))),
            abs(float(assembly.tooth(side).root_radius)),
            float(body.face_width),
            float(drive.module),
            abs(float(body.teeth)),
            depths[place],
            abs(float(drive.helix_angle)),
            float(drive.pressure_angle),
        )

    return wheel("pinion"), wheel("gear")


def thermal_quantities(thermal: Thermal | None, power_in: float, efficiency: float) -> dict[str, Any]:
    """Quantities of temperatures and load-independent losses for a summary; SI, temperatures in K.

    `power_in` is that of the driving gear without load-independent losses, `efficiency` that of the mesh.
    """
    if thermal is None:
        return {}
    quantities: dict[str, Any] = {}
    if (temperatures := thermal.temperatures) is not None:
        quantities |= {
            "bulk_temperature": temperatures.bulk,
            "bulk_temperature_pinion": temperatures.pinion,
            "bulk_temperature_gear": temperatures.gear,
            "oil_temperature": temperatures.oil,
            "heat_generated": thermal.heat.total,
        }
        if thermal.given_off is not None:
            quantities |= {"housing_temperature": temperatures.housing, "heat_given_off": thermal.given_off}
    if thermal.losses:
        power = {f"power_{name}": loss.power for name, loss in thermal.losses.items()}
        every = sum(power.values())
        quantities |= power
        quantities |= {
            "power_load_independent": every - power.get("power_bearings_under_load", 0.0),
            "efficiency_with_losses": efficiency * power_in / (power_in + every),
        }
        outside = [f"{name}: {limit}" for name, loss in thermal.losses.items() for limit in loss.exceeded]
        if outside:
            quantities["losses_outside"] = "; ".join(outside)
    return quantities


def contact_quantities(lubricant: LubricantData, summary: Mapping[str, Any]) -> dict[str, float]:
    """Maximum contact temperature, K: bulk of the teeth, else of the oil, and the maximum flash temperature.

    Nothing where neither temperature is known, or no teeth touch.
    """
    warm, flash = summary.get("bulk_temperature", lubricant.temperature), summary.get("flash_temperature_max")
    return {} if warm is None or flash is None else {"contact_temperature_max": float(warm + flash)}


def temperatures_of(
    case: Any, assembly: Assembly, wanted: TemperatureData, heat: Heat, lost: Any, supplied: Any
) -> tuple[Temperatures, Any]:
    """Temperatures that heat gives, of the loss to tooth friction, W, in oil supplied at a temperature, K.

    The heat that leaves a network besides. Losses and temperatures may be arrays over points of operation.
    """
    if wanted.model == "iso":
        centre = float(assembly.path.pinion_pitch_radius + assembly.path.gear_pitch_radius)
        width = float(min(case.drive.pinion.face_width, case.drive.gear.face_width))
        supply = LUBRICATION_FACTORS[wanted.lubrication] / wanted.tip_relief_factor
        bulk = supplied + bulk_rise(lost, 1.0, 1.0, centre, width, supply)
        return Temperatures(bulk, bulk, supplied, supplied), None
    sheet = case.lubricant.sheet
    flow = wanted.oil_flow * float(case.lubricant.density) * specific_heat(sheet.density_15, supplied)
    network = Network(
        wanted.pinion_oil,
        wanted.gear_oil,
        flow,
        wanted.oil_housing,
        wanted.housing_ambient,
        wanted.ambient_temperature,
    )
    temperatures = network_temperatures(network, heat, supplied)
    return temperatures, heat_given_off(network, temperatures, supplied)


def _refuse_unknown(temperature: float, wanted: TemperatureData) -> None:
    """Refuse a temperature for which the oil's data sheet gives no numbers."""
    low, high = (round(limit - ZERO_CELSIUS) for limit in TEMPERATURE_RANGE)
    theta = temperature - ZERO_CELSIUS
    if not low <= theta <= high:
        raise InputError(
            "temperature.model",
            f'"{wanted.model}"',
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
    slice_remark: str = field(default="", kw_only=True)  # why a helical pair has so many slices


def assembled(case: GearCase) -> Assembly:
    """Put the gears of a case together; InputError where teeth cannot be made or cannot run together."""
    from tribodyn.geometry.limits.checks import check

    return check(family(case.family), case.drive)


def at_tooth_temperature(
    case: AnyCase, assembly: Assembly, mesh_loss: Callable[[AnyCase], float]
) -> tuple[AnyCase, Thermal | None]:
    """Return a case with its oil at the temperature of its teeth, and the `thermal_state` that it is of."""
    thermal = thermal_state(case, assembly, mesh_loss)
    return (case if thermal is None else replace(case, lubricant=thermal.lubricant)), thermal
