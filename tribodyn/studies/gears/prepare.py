"""The one preparation of gears: teeth put together and checked, mesh tabulated, oil at its temperature."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.families import family
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.studies.gears.case import GearCase, LubricatedCase
from tribodyn.studies.gears.temperature import Thermal, thermal_state

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
