"""What the geometry and elasticity of a pair of gears make of it: costly, and the same for every speed."""

import dataclasses
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from functools import cache, lru_cache, partial
from typing import Any, NamedTuple

import numpy as np

from tribodyn.gears.case import GearCase, LubricatedCase
from tribodyn.gears.prepare import assembled
from tribodyn.geometry.assembly import Assembly
from tribodyn.mesh.cycle import MeshCycle, Polynomials, polynomials
from tribodyn.mesh.equilibrium import contacts, elastic, settled
from tribodyn.mesh.quasi_static import friction_loss
from tribodyn.train.schedule import Schedule, of_one_mesh
from tribodyn.tribology.closure import closure_of

#: Fields of a case that its table does not depend on. Whatever is not named here is taken to matter.
_NOT_IN_TABLE = (
    *("title", "name", "toml", "sha256"),
    *("roughness", "mean_roughness", "asperities", "lubricant", "operating"),
    *("film", "friction", "temperature", "losses", "quality", "supports", "teeth"),
)
_MESH_NOT_IN_TABLE = {"damping_ratio": 0.0, "formulation": "classical", "contact_width": 0.0}


def table_key(case: GearCase) -> Hashable:
    """Everything that the table of a case depends on: equal keys mean equal tables, bit for bit."""
    left_out = (*_NOT_IN_TABLE, "mesh")
    parts: list[Any] = [getattr(case, f.name) for f in dataclasses.fields(case) if f.name not in left_out]
    parts.append(dataclasses.replace(case.mesh, **_MESH_NOT_IN_TABLE))
    # slices of helical pairs, and of all that have several, hold each other and are counted under load
    if case.mesh.at_load or case.drive.helix_angle or case.mesh.slices > 1:
        parts.append(case.operating.gear_torque)
    return _hashable(parts)


def _hashable(value: Any) -> Hashable:
    """The content of nested dataclasses, tuples, dictionaries and arrays, to compare and look up by."""
    if isinstance(value, np.ndarray):
        return value.shape, value.tobytes()
    if dataclasses.is_dataclass(value):
        value = [getattr(value, field.name) for field in dataclasses.fields(value)]
    if isinstance(value, Mapping):
        value = sorted(value.items())
    return tuple(map(_hashable, value)) if isinstance(value, (list, tuple)) else value


class Tabulated(NamedTuple):
    """A pair's tables."""

    cycle: MeshCycle
    table: Polynomials  # the same as the right-hand side reads it
    schedule: Schedule  # when the set of contacting pairs changes
    #: (mass kg, inertia kg m²); of pinion and gear alone
    masses: tuple[tuple[float, float], tuple[float, float]]
    assembly: Assembly
    #: () -> the cycle of the driving flanks alone, in which a segment begins where friction turns; made at
    #: the first call
    split: Callable[[], MeshCycle]
    slice_remark: str = ""  # why a helical pair has so many slices, where it was not told


#: Tables kept in a process; a table is about 100 kB.
TABLES_KEPT = 32


@dataclass(frozen=True)
class MadeOnce:
    """A result that is made once: everything that it depends on, and how it is made."""

    key: Hashable
    make: Callable[[], Any] = field(compare=False)


_kept = lru_cache(maxsize=TABLES_KEPT)(lambda wanted: wanted.make())
_kept_cycles = lru_cache(maxsize=TABLES_KEPT)(lambda wanted: wanted.make())


def tables(case: GearCase) -> Tabulated:
    """Check the geometry and tabulate the mesh cycle; raises as `prepare` does.

    The last tables of this process are kept: cases at another speed, with another oil, have the same.
    """
    return _kept(MadeOnce(table_key(case), lambda: _tabulated(case)))


def _tabulated(case: GearCase) -> Tabulated:
    from tribodyn.geometry.body import body_masses
    from tribodyn.mesh.by_compliance import mesh_cycle_of, with_slices

    assembly = assembled(case)
    back, torque = case.mesh.backlash is not None, case.operating.gear_torque
    mesh, remark = with_slices(assembly, case.materials, case.mesh, torque)
    cycle = opened(dataclasses.replace(case, mesh=mesh), assembly, coarse=False)
    masses = [(body.mass, body.inertia) for body in case.masses]
    pinion, gear = body_masses(assembly, masses, [material.density for material in case.materials])

    @cache
    def split() -> MeshCycle:
        if assembly.drive.helix_angle:
            return cycle.fronts() if back else cycle  # friction turns within slices, not between segments
        turning = Assembly(assembly.family._replace(corner=True), assembly.drive)
        return mesh_cycle_of(turning, case.materials, mesh, torque)

    table = polynomials(cycle)
    return Tabulated(cycle, table, of_one_mesh(table.boundary), (pinion, gear), assembly, split, remark)


def opened(case: GearCase, assembly: Assembly, coarse: bool) -> MeshCycle:
    """The mesh cycle alone of a case whose number of slices is given, which is not judged; kept likewise.

    A coarse one has `by_compliance.FEW_NODES`.
    """
    from tribodyn.mesh.by_compliance import FEW_NODES, mesh_cycle_of

    back, torque = case.mesh.backlash is not None, case.operating.gear_torque
    made = partial(mesh_cycle_of, assembly, case.materials, case.mesh, torque, back)
    made = partial(made, FEW_NODES if coarse else None)
    return _kept_cycles(MadeOnce((coarse, table_key(case)), made))


def quasi_static_loss(tabulated: Tabulated) -> Callable[[LubricatedCase], float]:
    """Return what gives the mean loss to tooth friction in slow rotation at the constant torque, W."""

    def lost(case: LubricatedCase) -> float:
        torque, speed = case.operating.gear_torque, case.operating.pinion_speed
        if torque == 0.0:
            return 0.0
        cycle = tabulated.split()
        seen = contacts(cycle, torque, speed, closure_of(case))
        films = settled(seen, elastic(cycle, torque))
        return speed * float(friction_loss(cycle, films.normal_load, films.friction_coefficient))

    return lost
