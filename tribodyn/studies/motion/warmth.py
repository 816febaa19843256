"""Temperatures of the meshes of a train: each by its own loss, in oil that all of them heat."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from tribodyn.studies.gears.case import LubricatedCase
from tribodyn.studies.gears.prepare import Thermal, at_own_temperature, at_tooth_temperature
from tribodyn.studies.gears.tabulated import Tabulated, quasi_static_loss
from tribodyn.studies.motion.case import Gearbox

#: Change of a mesh's loss, as a share of it, that is not worth another pass; passes at most.
CLOSE, PASSES = 1e-3, 8

Warm = tuple[LubricatedCase, Thermal | None]


def at_tooth_temperatures(case: Gearbox, made: Sequence[Tabulated]) -> list[Warm]:
    """The pair of every mesh with its oil at the temperature of its teeth, and the thermal state of each.

    In a lumped network all meshes heat one oil and one housing; that heat and the losses settle together.
    """
    lost: list[Callable[[LubricatedCase], float]] = [quasi_static_loss(each) for each in made]
    pairs = [mesh.pair for mesh in case.meshes]
    losses = [_loss(pair, loss) if _shares_oil(case) else 0.0 for pair, loss in zip(pairs, lost, strict=True)]
    found: list[Warm] = []
    for _ in range(PASSES):
        found = [
            at_tooth_temperature(pair, each.assembly, loss)
            for pair, each, loss in zip(_heated(case, losses), made, lost, strict=True)
        ]
        if not _shares_oil(case):
            break
        before, losses = losses, [heat.mesh_loss if heat else 0.0 for _, heat in found]
        if all(abs(new - old) <= CLOSE * abs(new) for new, old in zip(losses, before, strict=True)):
            break
    return found


def at_own_temperatures(
    case: Gearbox, bulk: Sequence[float | None], losses: Sequence[float]
) -> Gearbox | None:
    """The case with every mesh at the temperature that the losses of its motion give; None: all are there.

    `bulk` are the temperatures at which it was run, K; `losses` the mean losses to tooth friction, W. The
    means of these and of those before are taken: the oil of several meshes would swing to and fro.
    """
    before = [
        mesh.pair.temperature.mesh_loss if mesh.pair.temperature and len(case.meshes) > 1 else None
        for mesh in case.meshes
    ]
    losses = [
        lost if known is None else 0.5 * (lost + known) for lost, known in zip(losses, before, strict=True)
    ]
    pairs = [
        at_own_temperature(pair, warm, lost)
        for pair, warm, lost in zip(_heated(case, losses), bulk, losses, strict=True)
    ]
    if not any(pairs):
        return None
    known = [
        pair or _knowing(mesh.pair, lost) for pair, mesh, lost in zip(pairs, case.meshes, losses, strict=True)
    ]
    meshes = (replace(mesh, pair=pair) for mesh, pair in zip(case.meshes, known, strict=True))
    return replace(case, meshes=tuple(meshes))


def _shares_oil(case: Gearbox) -> bool:
    temperature = case.meshes[0].pair.temperature
    return temperature is not None and temperature.model == "network" and len(case.meshes) > 1


def _loss(pair: LubricatedCase, quasi_static: Callable[[LubricatedCase], float]) -> float:
    known = pair.temperature and pair.temperature.mesh_loss
    return quasi_static(pair) if known is None else known


def _knowing(pair: LubricatedCase, lost: float) -> LubricatedCase:
    """The pair with the loss of its motion."""
    return pair and replace(pair, temperature=pair.temperature and replace(pair.temperature, mesh_loss=lost))


def _heated(case: Gearbox, losses: Sequence[float]) -> list[LubricatedCase]:
    """The pairs with what the other meshes give to their oil."""
    pairs = [mesh.pair for mesh in case.meshes]
    if not _shares_oil(case):
        return pairs
    total = sum(losses)
    return [
        replace(pair, temperature=pair.temperature and replace(pair.temperature, other_heat=total - lost))
        for pair, lost in zip(pairs, losses, strict=True)
    ]
