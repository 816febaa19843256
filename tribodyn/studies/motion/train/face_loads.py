"""Loads along the faces of all meshes, as shafts, bearings and housing let the gears stand under them.

They are those of static equilibria of the equations of motion over the phases of the meshes. z is that of a
mesh's pair, as its modifications take it: from +z its driver turns clockwise; 0 in the middle of the face.
"""

from dataclasses import replace
from math import gcd
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.approach import DISTANCE, LINE_LOAD, PRESENT, RADIUS
from tribodyn.dynamics.mesh_motion import motion_of
from tribodyn.dynamics.recorded.outputs import Evaluated, evaluated, mesh_outputs
from tribodyn.errors import SimulationError
from tribodyn.gears.drawn_system import DrawnSystem, places_of
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.initial import static_equilibrium
from tribodyn.studies.motion.prepare import PreparedGearbox, prepare
from tribodyn.train.elastic.beam_matrices import SIX
from tribodyn.train.schedule import interval_of
from tribodyn.tribology.contact import hertz_pressure

#: Phases of every mesh, at least.
PHASES = 12
#: Relative change of the loads on the shafts at which they and the bearings stand, and passes until then.
STANDS, MOST_PASSES = 1e-6, 12


class FaceLoads(NamedTuple):
    """How a mesh is loaded along its face; K slices, n phases."""

    misalignment: float  # by which the gears' tilts open the flanks over the face, in the plane of action, m
    place: Float[Array, " slice"]  # middles of the slices, increasing, m
    line_load: Float[Array, " slice"]  # mean over the phases, of all pairs together, N/m
    #: roll, pressure: where every slice touches, pinion's roll angle from the pitch point, rad, and its
    #: largest pressure, Pa, 0 where it does not touch
    roll: Float[Array, "phase pair slice"]
    pressure: Float[Array, "phase pair slice"]

    @property
    def factor(self) -> float:
        """K_Hβ: maximum over mean of the line load along the face, each the mean over the mesh cycle."""
        return float(np.max(self.line_load) / np.mean(self.line_load))

    @property
    def centre(self) -> float:
        """Z at which the mean load acts, m."""
        return float(self.place @ self.line_load / np.sum(self.line_load))

    def quantities(self) -> dict[str, Any]:
        """Of a summary, by the names of the catalogue."""
        return {
            "deflected_misalignment": self.misalignment,
            "face_load_factor": self.factor,
            "load_centre": self.centre,
            "face_place": self.place.tolist(),
            "face_line_load": self.line_load.tolist(),
            "face_pressure": np.max(self.pressure, axis=(0, 1)).tolist(),
        }


class Spread(NamedTuple):
    """The loads of all meshes, and the gearbox about whose operating point they are."""

    prepared: PreparedGearbox
    meshes: tuple[FaceLoads | None, ...]  # None: a mesh that is not cut into slices
    passes: int  # of shafts and bearings against the loads


def spread_of(prepared: PreparedGearbox, phases: int = PHASES) -> Spread:
    """Find the loads of all meshes and, where shafts are drawn, the operating point that goes with them.

    Bearings are linear about the loads on the shafts; these are taken anew from the equilibria, moments of
    loads off the middle of a face included, until both stand. Raises SimulationError where there is no static
    equilibrium, InputError where shafts are not held.
    """
    system, samples = prepared.case.system, None
    for passes in range(MOST_PASSES + 1):
        samples = equilibria(prepared, phases, samples)
        if system is None or system.linear or passes == MOST_PASSES:
            break
        loads, before = _on_shafts(system, prepared, np.mean(samples.y, axis=1)), np.array(system.loads)
        if np.linalg.norm(loads - before) <= STANDS * np.linalg.norm(before):
            break
        system = replace(system, loads=tuple(map(tuple, loads.tolist())))
        prepared = prepare(replace(prepared.case, system=system), prepared.tables)
    meshes = tuple(_of_mesh(prepared, m, samples) for m in range(prepared.model.layout.meshes))
    return Spread(prepared, meshes, passes)


def of_deflected(prepared: PreparedGearbox) -> Spread | None:
    """The same of a gearbox whose shafts are drawn; None of others, and where nothing presses its flanks."""
    if prepared.case.system is None:
        return None
    try:
        return spread_of(prepared)
    except SimulationError:
        return None


def along_face(spread: Spread | None, m: int) -> dict[str, Any]:
    """Quantities of a mesh; nothing of one that is not cut into slices, or without drawn shafts."""
    loads = spread.meshes[m] if spread is not None else None
    return loads.quantities() if loads is not None else {}


def equilibria(prepared: PreparedGearbox, phases: int = PHASES, near: Evaluated | None = None) -> Evaluated:
    """Static equilibria spread over the common period, so that every mesh is at so many phases at least.

    They are looked for `near` others, if there are some.
    """
    model, cycles = prepared.model, prepared.model.schedule.period
    turned = [round(cycles * float(mesh.rate)) for mesh in prepared.case.meshes]
    while any(gcd(each, phases) > 1 for each in turned if each):
        phases += 1
    at = cycles * np.arange(phases) / phases
    _, phase, interval = interval_of(at, model.schedule)
    states: list[Float[Array, " state"]] = []
    for n, place in enumerate(zip(phase.tolist(), interval.tolist(), strict=True)):
        start = near.y[:, n] if near is not None else states[-1] if states else None
        states.append(static_equilibrium(model, *place, start))
    return evaluated(at, np.array(states), model, interval)


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
    return (stiffness @ moved - left.force)[:count].reshape(-1, SIX)[:, : SIX - 1]


def _of_mesh(prepared: PreparedGearbox, m: int, samples: Evaluated) -> FaceLoads | None:
    model, cycle = prepared.model, prepared.tables[m].cycle
    if cycle.slices == 1:
        return None
    mesh, work, motion = model.meshes[m], samples.work[m], motion_of(m, samples.y, model)
    # z of the train and of the table in that of the pair
    turned = -prepared.case.bodies[prepared.case.meshes[m].driver].sense
    way = slice(None, None, int(turned * mesh.hand))

    def of_slices(row: int) -> Float[Array, "phase pair slice"]:
        slots = [
            np.broadcast_to(np.nan_to_num(work.get((row, i), 0.0)), samples.size) * (work[PRESENT, i] > 0.0)
            for i in range(cycle.front_slots)
        ]
        return np.stack(slots, axis=-1).reshape(samples.size, -1, cycle.slices)[..., way]

    along = mesh_outputs(m, samples)["line_load"][:, : cycle.front_pairs, way]
    path = prepared.tables[m].assembly.path
    radius, touching = of_slices(RADIUS), along > 0.0
    pressure = np.zeros(along.shape)
    pressure[touching] = hertz_pressure(
        along[touching], 1.0 / radius[touching], mesh.surfaces.effective_modulus
    )
    angle = float(path.pressure_angle(0.0))
    leaning = float(np.mean(motion.lean_along * np.cos(angle) + motion.lean_across * np.sin(angle)))
    return FaceLoads(
        -turned * leaning * float(cycle.face_width),
        np.array(cycle.face_position),
        np.mean(np.sum(of_slices(LINE_LOAD), axis=1), axis=0),
        path.rotation(of_slices(DISTANCE)),
        pressure,
    )
