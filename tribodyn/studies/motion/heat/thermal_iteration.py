"""Temperatures of the meshes of a train: each by its own loss, in oil that all of them heat."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.prepare import CLOSE as CLOSE_TO
from tribodyn.gears.prepare import Thermal, at_tooth_temperature, idle_losses
from tribodyn.gears.tabulated import Tabulated, quasi_static_loss
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.families import family
from tribodyn.studies.motion.case import Gearbox
from tribodyn.tribology.bulk_temperature import Heat, Temperatures, heat_of_other_meshes
from tribodyn.tribology.heat.data import SettledTemperatures
from tribodyn.tribology.losses.loss import Loss
from tribodyn.tribology.oil import lubricant_at

#: Change of a mesh's loss, as a share of it, that is not worth another pass; passes at most.
CLOSE, PASSES = 1e-3, 8

Warm = tuple[LubricatedCase, Thermal | None]


def at_tooth_temperatures(case: Gearbox, tables: Sequence[Tabulated]) -> list[Warm]:
    """The pair of every mesh with its oil at the temperature of its teeth, and the thermal state of each.

    In a lumped network all meshes heat one oil and one housing; that heat and the losses settle together.
    """
    if case.heat is not None and case.heat.settled is not None:
        return [_in_gearbox(case, m, case.heat.settled, each) for m, each in enumerate(tables)]
    return _settled(case, [each.assembly for each in tables], [quasi_static_loss(each) for each in tables])


def _in_gearbox(case: Gearbox, m: int, settled: SettledTemperatures, tabulated: Tabulated) -> Warm:
    """A pair whose temperatures are known from the balance of the whole gearbox; its heat is all of that."""
    pair, (driving, driven), lost = case.meshes[m].pair, settled.gears[m], settled.losses[m]
    temperatures = Temperatures(driving, driven, settled.oil, settled.housing)
    oil = replace(lubricant_at(pair.lubricant, temperatures.bulk), supply=settled.oil)
    idle = idle_losses(pair, tabulated.assembly, lubricant_at(pair.lubricant, settled.oil))
    heat = Heat(0.5 * lost, 0.5 * lost, settled.heat - lost)
    thermal = Thermal(oil, lost, idle, temperatures, heat, settled.given_off)
    return replace(pair, lubricant=oil), thermal


def at_own_temperatures(
    case: Gearbox, bulk: Sequence[float | None], losses: Sequence[float]
) -> Gearbox | None:
    """The case with every mesh at the temperature that the losses of its motion give; None: all are there.

    `bulk` are the temperatures at which it was run, K; `losses` the mean losses to tooth friction, W. The
    means of these and of those before are taken: the oil of several meshes would swing to and fro.
    """
    temperatures = [pair.temperature for pair in case.pairs]
    before = [state and state.mesh_loss if len(temperatures) > 1 else None for state in temperatures]
    losses = [
        lost if state is None else 0.5 * (lost + state) for lost, state in zip(losses, before, strict=True)
    ]
    meshes = [
        replace(mesh, pair=_knowing(mesh.pair, lost)) for mesh, lost in zip(case.meshes, losses, strict=True)
    ]
    again = replace(case, meshes=tuple(meshes))
    to_be_settled = [state is not None and lost >= 0.0 for state, lost in zip(bulk, losses, strict=True)]
    if not any(to_be_settled):
        return None
    assemblies = [assemble(family(pair.family), pair.drive) for pair in case.pairs]
    warm = _settled(again, assemblies, [lambda _, lost=lost: lost for lost in losses])
    for (_, thermal), state, wanted in zip(warm, bulk, to_be_settled, strict=True):
        if not wanted or state is None or thermal is None or thermal.temperatures is None:
            continue
        if abs(thermal.temperatures.bulk - state) > CLOSE_TO:
            return again
    return None


def _settled(
    case: Gearbox, assemblies: Sequence[Assembly], lost: Sequence[Callable[[LubricatedCase], float]]
) -> list[Warm]:
    """The pairs at the temperatures of their teeth, by functions that give their losses to friction."""
    shared = _shares_oil(case)
    losses = [_loss(pair, loss) if shared else 0.0 for pair, loss in zip(case.pairs, lost, strict=True)]
    idle: list[dict[str, Loss]] = [{} for _ in losses]
    warmed: list[Warm] = []
    for _ in range(PASSES):
        heated = _heated(case, losses, idle) if shared else case.pairs
        warmed = [
            at_tooth_temperature(pair, assembly, loss)
            for pair, assembly, loss in zip(heated, assemblies, lost, strict=True)
        ]
        if not shared:
            break
        before = [lost + _power(idle_loss) for lost, idle_loss in zip(losses, idle, strict=True)]
        losses = [heat.mesh_loss if heat else 0.0 for _, heat in warmed]
        idle = [heat.losses if heat else {} for _, heat in warmed]
        now = [lost + _power(idle_loss) for lost, idle_loss in zip(losses, idle, strict=True)]
        if all(abs(new - old) <= CLOSE * abs(new) for new, old in zip(now, before, strict=True)):
            break
    return warmed


def _power(losses: Mapping[str, Loss]) -> float:
    return sum(loss.power for loss in losses.values())


def _shares_oil(case: Gearbox) -> bool:
    temperature = case.meshes[0].pair.temperature
    return temperature is not None and temperature.model == "network" and len(case.meshes) > 1


def _loss(pair: LubricatedCase, quasi_static: Callable[[LubricatedCase], float]) -> float:
    given_loss = pair.temperature and pair.temperature.mesh_loss
    return quasi_static(pair) if given_loss is None else given_loss


def _knowing(pair: LubricatedCase, lost: float) -> LubricatedCase:
    """The pair with the loss of its motion."""
    return replace(pair, temperature=pair.temperature and replace(pair.temperature, mesh_loss=lost))


def _heated(
    case: Gearbox, losses: Sequence[float], idle: Sequence[Mapping[str, Loss]]
) -> list[LubricatedCase]:
    """The pairs with what the other meshes give to their oil and housing."""
    heated = []
    for pair, (whole, bearings) in zip(case.pairs, heat_of_other_meshes(losses, idle), strict=True):
        settings = pair.temperature
        assert settings is not None, "they share one oil"
        in_housing = bearings if settings.housing_ambient > 0.0 else 0.0
        heat = {"other_heat": whole - in_housing, "other_housing_heat": in_housing}
        heated.append(replace(pair, temperature=replace(settings, **heat)))
    return heated
