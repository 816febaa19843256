"""Where drawn shafts stand under the loads of their meshes, which act off the middles of tilted faces.

Bearings are linear about the loads on the shafts, which are taken from static equilibria over the phases of
the meshes; these depend on the bearings. Both are repeated until they stand.
"""

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np

from tribodyn.dynamics.mesh_motion import motion_of
from tribodyn.dynamics.recorded.outputs import Evaluated, evaluated
from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.drawn_system import DrawnSystem, places_of
from tribodyn.gears.tabulated import Tabulated, opened
from tribodyn.geometry.modification import Misalignment, misalignment_of_tilts
from tribodyn.mesh.cycle import polynomials
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.initial import static_equilibria
from tribodyn.studies.motion.assembly import PreparedGearbox, table_numbers
from tribodyn.train.elastic.beam_matrices import SIX
from tribodyn.train.elastic.in_time import push_in_time
from tribodyn.train.schedule import interval_of

#: Phases of every mesh, at least.
PHASES = 12
#: Relative change of the loads on the shafts at which they and the bearings stand, and passes until then.
STANDS, MOST_PASSES = 1e-6, 12
#: Slope of flanks to which tables are made of opened ones: those of cases that differ little are the same.
SLOPE = 1e-7


def settled(prepared: PreparedGearbox, assemble: Callable[..., PreparedGearbox]) -> PreparedGearbox:
    """The gearbox about where its shafts stand; as it is where there is no equilibrium.

    `assemble(case, tables, twist)` puts it together. Slices hold each other as where they carry what they do:
    tables are made again, once, of flanks as far open as the gears tilt.
    """
    with suppress(SimulationError, InputError):  # of loads and tilts that no user has written
        return _settled(prepared, assemble)
    return prepared


def _settled(prepared: PreparedGearbox, assemble: Callable[..., PreparedGearbox]) -> PreparedGearbox:
    system = prepared.case.system
    for passes in range(MOST_PASSES):
        samples, tables = equilibria(prepared), prepared.tables
        if not passes:
            tables = tables_about(prepared, [tilt_of(prepared, m, samples) for m in range(len(tables))])
        if system is not None and not system.linear:
            loads, before = _on_shafts(system, prepared, np.mean(samples.y, axis=1)), np.array(system.loads)
            if passes and np.linalg.norm(loads - before) <= STANDS * np.linalg.norm(before):
                break
            system = replace(system, loads=tuple(map(tuple, loads.tolist())))
        elif passes:
            break
        changed = assemble(replace(prepared.case, system=system), tables, prepared.twist)
        prepared = replace(changed, near=samples.y.T)
    return prepared


def turned(prepared: PreparedGearbox, m: int) -> float:
    """1 where z of a mesh's pair is that of the train, else −1: its driver turns clockwise."""
    return -float(prepared.case.bodies[prepared.case.meshes[m].driver].sense)


def tilt_of(prepared: PreparedGearbox, m: int, samples: Evaluated) -> Misalignment:
    """Mean tilt of the gears of a mesh against each other, as its pair sees it."""
    motion, way = motion_of(m, samples.y, prepared.model), turned(prepared, m)
    skew, inclination = (-way * float(np.mean(lean)) for lean in (motion.lean_along, motion.lean_across))
    angle = float(prepared.tables[m].assembly.path.pressure_angle(0.0))
    return misalignment_of_tilts(((0.0, 0.0), (-inclination, skew)), angle)


def tables_about(
    prepared: PreparedGearbox, tilts: Sequence[Misalignment], coarse: bool = False
) -> tuple[Tabulated, ...]:
    """The tables of all meshes, made of flanks as far open as tilts open them, which then open them again.

    Equal meshes stay so: all have the mean of their tilts, in steps of `SLOPE`.
    """
    numbers = np.array(table_numbers(prepared.case))
    mean = [
        np.mean([tilt for tilt, of in zip(tilts, numbers, strict=True) if of == n], axis=0) for n in numbers
    ]
    made: dict[int, Tabulated] = {}
    for m, n in enumerate(numbers.tolist()):
        if n not in made:
            made[n] = _about(prepared, m, Misalignment(*(SLOPE * np.round(mean[m] / SLOPE)).tolist()), coarse)
    return tuple(made[n] for n in numbers.tolist())


def _about(prepared: PreparedGearbox, m: int, tilt: Misalignment, coarse: bool) -> Tabulated:
    before, pair = prepared.tables[m], prepared.case.meshes[m].pair
    if before.cycle.slices == 1 or not any(tilt):
        return before
    given = pair.mesh.modifications
    stand = Misalignment(*np.add(given.misalignment, tilt).tolist())
    mesh = replace(pair.mesh, modifications=given._replace(misalignment=stand), slices=before.cycle.slices)
    cycle = opened(replace(pair, mesh=mesh), before.assembly, coarse)
    hand = 1.0 if float(pair.drive.helix_angle) >= 0.0 else -1.0
    flanks = np.asarray(cycle.side)
    apart = flanks * (cycle.pressure_angle) - float(before.assembly.path.pressure_angle(0.0))
    leaning = cycle.pitch_slope * np.cos(cycle.pressure_angle)
    across = hand * (tilt.in_plane * np.cos(apart) + tilt.out_of_plane * np.sin(apart)) * flanks
    gap = across * (cycle.face_place - flanks * cycle.signed_distance * leaning) / np.hypot(1.0, leaning)
    cycle = cycle._replace(gap=cycle.gap - gap)
    return before._replace(cycle=cycle, table=polynomials(cycle))


def equilibria(prepared: PreparedGearbox, phases: int = PHASES) -> Evaluated:
    """Static equilibria spread over the common period, so that every mesh is at so many phases at least."""
    model, cycles = prepared.model, prepared.model.schedule.period
    rates = [round(cycles * float(mesh.rate)) for mesh in prepared.case.meshes]
    while any(math.gcd(each, phases) > 1 for each in rates if each):
        phases += 1
    at = cycles * np.arange(phases) / phases
    _, phase, interval = interval_of(at, model.schedule)
    near = prepared.near if prepared.near is not None and len(prepared.near) == phases else None
    return evaluated(at, static_equilibria(model, phase, interval, near), model, interval)


def _on_shafts(
    system: DrawnSystem, prepared: PreparedGearbox, mean: Float[Array, " state"]
) -> Float[Array, "point 5"]:
    """What the shafts hold their bodies by in a mean state, which is what loads them; N, N m."""
    new, left = {body: number for number, body in enumerate(prepared.order)}, system.reduced
    moved = mean[places_of([new[body] for body in system.bodies], prepared.model.layout, left.modes)]
    count = SIX * len(system.bodies)
    turns = np.arange(SIX - 1, count, SIX)
    stiffness = left.stiffness.copy()
    stiffness[turns], stiffness[:, turns] = 0.0, 0.0
    held = stiffness @ moved - left.force + push_in_time(left.in_time, moved)
    return held[:count].reshape(-1, SIX)[:, : SIX - 1]
