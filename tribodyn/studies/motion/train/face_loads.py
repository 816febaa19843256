"""Loads along the faces of all meshes, as shafts, bearings and housing let the gears stand under them.

They are those of static equilibria of the equations of motion over the phases of the meshes. z is that of a
mesh's pair, as its modifications take it: from +z its driver turns clockwise; 0 in the middle of the face.
"""

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.approach import DISTANCE, LINE_LOAD, PRESENT, RADIUS
from tribodyn.dynamics.mesh_motion import motion_of
from tribodyn.dynamics.recorded.outputs import Evaluated, evaluated, mesh_outputs
from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.drawn_system import DrawnSystem, places_of
from tribodyn.gears.tabulated import Tabulated, tables
from tribodyn.geometry.modification import FlankModification, Misalignment, misalignment_of_tilts
from tribodyn.mesh.cycle import polynomials
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.initial import static_equilibrium
from tribodyn.studies.motion.case import TrainMesh
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
    passes: int  # in which the loads on the shafts were taken anew, until they and the bearings stood
    tilts: tuple[Misalignment, ...]  # of the gears of every mesh, as its pair sees them


def spread_of(
    prepared: PreparedGearbox, phases: int = PHASES, tilts: Sequence[Misalignment] | None = None
) -> Spread:
    """Find the loads of all meshes and, where shafts are drawn, the operating point that goes with them.

    Bearings are linear about the loads on the shafts; these are taken anew from the equilibria, moments of
    loads off the middle of a face included, until both stand. Slices hold each other as where they carry
    what they do: tables are made again, once, of flanks as far open as the gears tilt. Where `tilts` are
    given, tables are made of these, and bearings stay about the loads that the case has. Raises
    SimulationError where there is no static equilibrium, InputError where shafts are not held.
    """
    system, samples, tilted, anew = prepared.case.system, None, int(tilts is None), 0
    for passes in range(MOST_PASSES + 1 if tilted else 1):
        made = prepared.tables
        if passes == tilted:
            if samples is not None:
                tilts = [_stand(prepared, m, samples) for m in range(len(made))]
            made = tuple(_about(prepared, m, tilt) for m, tilt in enumerate(tilts or ()))
        if samples is not None and system is not None and not system.linear:
            loads, before = _on_shafts(system, prepared, np.mean(samples.y, axis=1)), np.array(system.loads)
            if passes > tilted and np.linalg.norm(loads - before) <= STANDS * np.linalg.norm(before):
                break
            system, anew = replace(system, loads=tuple(map(tuple, loads.tolist()))), anew + 1
        elif passes > tilted:
            break
        if passes or tilts:
            prepared = prepare(replace(prepared.case, system=system), made)
        samples = equilibria(prepared, phases, samples)
    assert samples is not None
    meshes = tuple(_of_mesh(prepared, m, samples) for m in range(prepared.model.layout.meshes))
    stands = tuple(_stand(prepared, m, samples) for m in range(len(meshes)))
    return Spread(prepared, meshes, anew, stands)


def _turned(prepared: PreparedGearbox, m: int) -> float:
    """1 where z of a mesh's pair is that of the train, else −1: its driver turns clockwise."""
    return -float(prepared.case.bodies[prepared.case.meshes[m].driver].sense)


def _stand(prepared: PreparedGearbox, m: int, samples: Evaluated) -> Misalignment:
    motion, turned = motion_of(m, samples.y, prepared.model), _turned(prepared, m)
    skew, inclination = (-turned * float(np.mean(lean)) for lean in (motion.lean_along, motion.lean_across))
    angle = float(prepared.tables[m].assembly.path.pressure_angle(0.0))
    return misalignment_of_tilts(((0.0, 0.0), (-inclination, skew)), angle)


def _about(prepared: PreparedGearbox, m: int, tilt: Misalignment) -> Tabulated:
    """The tables of a mesh made of flanks as far open as a tilt opens them, which then opens them itself."""
    before, pair = prepared.tables[m], prepared.case.meshes[m].pair
    if before.cycle.slices == 1 or not any(tilt):
        return before
    given = pair.mesh.modifications
    stand = Misalignment(*np.add(given.misalignment, tilt).tolist())
    mesh = replace(pair.mesh, modifications=given._replace(misalignment=stand), slices=before.cycle.slices)
    made = tables(replace(pair, mesh=mesh))
    cycle, hand = made.cycle, 1.0 if float(pair.drive.helix_angle) >= 0.0 else -1.0
    flanks = np.asarray(cycle.side)
    turned = flanks * (cycle.pressure_angle) - float(made.assembly.path.pressure_angle(0.0))
    leaning = cycle.pitch_slope * np.cos(cycle.pressure_angle)
    across = hand * (tilt.in_plane * np.cos(turned) + tilt.out_of_plane * np.sin(turned)) * flanks
    opened = across * (cycle.face_place - flanks * cycle.signed_distance * leaning) / np.hypot(1.0, leaning)
    cycle = cycle._replace(gap=cycle.gap - opened)
    return before._replace(cycle=cycle, table=polynomials(cycle))


def flattened(spread: Spread, phases: int = PHASES) -> tuple[dict[str, Any], ...]:
    """Propose for every mesh what makes its load more even, and compute K_Hβ with it; by catalogue names.

    On the driving gear, beside what it has: a helix angle that undoes what tilts and misalignment open under
    a load in the middle of the face; or, where that is not to be ground, a crowning of √3/4 of what they open
    under their load. That is the one of the smallest maximum line load where the whole face touches, with
    uniform stiffness c per length, misalignment f over the face, mean line load q: K_Hβ − 1 falls from
    c f/(2 q) to c f/(2 √3 q). Nothing for meshes that are not cut into slices.
    """
    case, found = spread.prepared.case, [dict[str, Any]() for _ in spread.meshes]
    for name, of_mesh, tilt in (("helix_slope", _helix, _middle), ("crowning", _crowning, _under_load)):
        amounts = [loads and of_mesh(spread, m, loads) for m, loads in enumerate(spread.meshes)]
        meshes = tuple(
            mesh if amount is None else _with_lead(mesh, name, amount)
            for mesh, amount in zip(case.meshes, amounts, strict=True)
        )
        changed = replace(spread.prepared, case=replace(case, meshes=meshes))
        again = spread_of(changed, phases, [tilt(spread, m) for m in range(len(meshes))])
        for proposal, amount, loads in zip(found, amounts, again.meshes, strict=True):
            if loads is not None:
                proposal[f"proposed_{name}"] = amount
                proposal[f"face_load_factor_{name}"] = loads.factor
    return tuple(found)


def _opened(spread: Spread, m: int, tilt: float) -> float:
    """What a tilt (rad), misalignment and helix angles open over the common face, m."""
    pair, cycle = spread.prepared.case.meshes[m].pair, spread.prepared.tables[m].cycle
    made, width = pair.mesh.modifications, float(cycle.face_width)
    slopes = (flank.lead.slope / float(body.face_width) for flank, body in _gears(pair))
    return (tilt + made.misalignment.in_plane + sum(slopes)) * width


def _gears(pair: LubricatedCase) -> tuple[tuple[FlankModification, Any], ...]:
    made = pair.mesh.modifications
    return (made.pinion, pair.drive.pinion), (made.gear, pair.drive.gear)


def _helix(spread: Spread, m: int, loads: FaceLoads) -> float:
    pair, cycle = spread.prepared.case.meshes[m].pair, spread.prepared.tables[m].cycle
    opened = _opened(spread, m, pair.supports.misalignment.in_plane)
    (flank, body), _ = _gears(pair)
    return flank.lead.slope - opened * float(body.face_width) / float(cycle.face_width)


def _crowning(spread: Spread, m: int, loads: FaceLoads) -> float:
    pair, cycle = spread.prepared.case.meshes[m].pair, spread.prepared.tables[m].cycle
    opened = _opened(spread, m, loads.misalignment / float(cycle.face_width))
    (flank, body), _ = _gears(pair)
    share = float(body.face_width) / float(cycle.face_width)
    return flank.lead.crowning + math.sqrt(3.0) / 4.0 * abs(opened) * share**2


def _middle(spread: Spread, m: int) -> Misalignment:
    return spread.prepared.case.meshes[m].pair.supports.misalignment


def _under_load(spread: Spread, m: int) -> Misalignment:
    return spread.tilts[m]


def _with_lead(mesh: TrainMesh, name: str, amount: float) -> TrainMesh:
    made = mesh.pair.mesh.modifications
    lead = made.pinion.lead._replace(**{"slope" if name == "helix_slope" else name: amount})
    made = made._replace(pinion=made.pinion._replace(lead=lead))
    data = replace(mesh.pair.mesh, modifications=made)
    return replace(mesh, pair=replace(mesh.pair, mesh=data))


def of_deflected(prepared: PreparedGearbox) -> Spread | None:
    """The same of a gearbox whose shafts are drawn; None of others, and where nothing presses its flanks."""
    if prepared.case.system is None:
        return None
    with suppress(SimulationError, InputError):  # of loads and tilts that no user has written
        return spread_of(prepared)
    return None


def proposals(spread: Spread | None, meshes: int) -> tuple[dict[str, Any], ...]:
    """`flattened`, of so many meshes; empty where what is proposed cannot be made."""
    if spread is not None:
        with suppress(SimulationError, InputError):
            return flattened(spread)
    return tuple({} for _ in range(meshes))


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
    while any(math.gcd(each, phases) > 1 for each in turned if each):
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
    mesh, work = model.meshes[m], samples.work[m]
    # z of the table in that of the pair
    way = slice(None, None, int(_turned(prepared, m) * mesh.hand))

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
    return FaceLoads(
        _stand(prepared, m, samples).in_plane * float(cycle.face_width),
        np.array(cycle.face_position),
        np.mean(np.sum(of_slices(LINE_LOAD), axis=1), axis=0),
        path.rotation(of_slices(DISTANCE)),
        pressure,
    )
