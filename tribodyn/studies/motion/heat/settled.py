"""A gearbox at the temperatures that its losses give all of its parts."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from tribodyn.cases.heat_part import HOUSING, OIL, GearboxHeat, SettledHeat, settle
from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.prepare import CLOSE
from tribodyn.gears.tabulated import Tabulated
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.heat.nodes import heat_of
from tribodyn.studies.motion.losses.gearbox import GearboxLoss
from tribodyn.studies.motion.prepare import prepare, tabulated
from tribodyn.tribology.heat.data import SettledTemperatures
from tribodyn.tribology.oil import TEMPERATURE_RANGE, ZERO_CELSIUS, lubricant_at

_REMEDY = "let more heat off (area, air_speed, cooler, oil_flow), or lower the load"


def prepare_settled(case: Gearbox, tables: tuple[Tabulated, ...] | None = None) -> PreparedGearbox:
    """Make a case ready as `prepare` does, with all of its parts at their temperatures where it asks so.

    The case of the result then has its oil at the temperature of the sump. Raises InputError as `prepare`,
    and where oil or teeth get warmer or colder than the oil is known.
    """
    if case.heat is not None and tables is None:
        tables = tabulated(case)
    return prepare(in_balance(case, tables=tables), tables)


def in_balance(
    case: Gearbox, mesh_losses: Sequence[float] | None = None, tables: tuple[Tabulated, ...] | None = None
) -> Gearbox:
    """The case with the temperatures of its parts; as it is where it has them, or asks for none.

    `mesh_losses`, W, of the meshes take the place of the quasi-static ones; `tables` are those of the meshes,
    if known.
    """
    heat = heat_of(case)
    if heat is None or case.heat is None or (case.heat.settled is not None and mesh_losses is None):
        return case
    names = [mesh.name for mesh in case.meshes]
    given = dict(zip(names, mesh_losses, strict=True)) if mesh_losses is not None else None
    loss = GearboxLoss(case, tables or tabulated(case))
    try:
        found = settle(heat, loss.at, names, 1.0, abs(case.source.speed), given)
    except SimulationError as error:
        raise InputError("temperature.housing", None, str(error), _REMEDY) from error
    _refuse_unknown(found, heat)
    return _with_temperatures(case, heat, found, given or {})


def _with_temperatures(
    case: Gearbox, heat: GearboxHeat, found: SettledHeat, given: Mapping[str, float]
) -> Gearbox:
    temperatures = found.temperatures(heat)
    lost = {
        source.element: float(power)
        for source, power in zip(found.losses.sources, found.power, strict=True)
        if source.term == "P_VZP"
    }
    settled = SettledTemperatures(
        temperatures[OIL],
        temperatures[HOUSING],
        tuple((temperatures[one], temperatures[two]) for one, two in heat.meshes),
        tuple((lost | dict(given))[mesh.name] for mesh in case.meshes),
        found.steady.heat,
        sum(found.steady.given_off.values()),
        temperatures,
    )
    meshes = [
        replace(mesh, pair=replace(mesh.pair, lubricant=lubricant_at(mesh.pair.lubricant, settled.oil)))
        for mesh in case.meshes
    ]
    assert case.heat is not None
    return replace(case, meshes=tuple(meshes), heat=replace(case.heat, settled=settled))


def warmer(case: Gearbox, losses: Sequence[float]) -> Gearbox | None:
    """The case at the temperatures that the losses of its motion give, W; None: it is there already."""
    assert case.heat is not None
    before = case.heat.settled
    again = in_balance(case, [max(lost, 0.0) for lost in losses])
    after = again.heat and again.heat.settled
    if before is None or after is None:
        return again
    moved = max(abs(after.parts[name] - before.parts[name]) for name in after.parts)
    return None if moved <= CLOSE else again


def _refuse_unknown(found: SettledHeat, heat: GearboxHeat) -> None:
    """Refuse temperatures for which the oil's data sheet gives no numbers."""
    low, high = (round(limit - ZERO_CELSIUS) for limit in TEMPERATURE_RANGE)
    for temperature in (found.oil_temperature, *found.bulk_temperature):
        if not TEMPERATURE_RANGE[0] <= temperature <= TEMPERATURE_RANGE[1]:
            theta = temperature - ZERO_CELSIUS
            rule = (
                f"teeth or oil would reach {theta:.0f} degC, and the oil is known from {low} to {high} degC"
            )
            remedy = "write a higher ambient_temperature" if theta < low else _REMEDY
            raise InputError("temperature.housing", None, rule, remedy)
