"""Loads along the faces of all meshes, as shafts, bearings and housing let the gears stand under them.

They are those of static equilibria of the equations of motion over the phases of the meshes. z is that of a
mesh's pair, as its modifications take it: from +z its driver turns clockwise; 0 in the middle of the face.
"""

import math
from contextlib import suppress
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.approach import DISTANCE, LINE_LOAD, PRESENT, RADIUS
from tribodyn.dynamics.recorded.outputs import Evaluated, mesh_outputs
from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.case import LubricatedCase
from tribodyn.geometry.modification import FlankModification, Misalignment
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.assembly import PreparedGearbox, table_numbers
from tribodyn.studies.motion.case import Gearbox, TrainMesh
from tribodyn.studies.motion.prepare import assemble
from tribodyn.studies.motion.train.operating_point import (
    PHASES,
    equilibria,
    settled,
    tables_about,
    tilt_of,
    turned,
)
from tribodyn.tribology.contact import hertz_pressure

#: Quantities of a mesh's loads along its face.
#: Width of a spur mesh's slices, modules, where none are given: K_Hβ is that of load contact in finer ones.
SLICE_WIDTH = 0.9
#: Numbers of them.
FEWEST, MOST = 7, 31


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
    """The loads of all meshes of a gearbox."""

    prepared: PreparedGearbox
    meshes: tuple[FaceLoads | None, ...]  # None: a mesh that is not cut into slices
    tilts: tuple[Misalignment, ...]  # of the gears of every mesh, as its pair sees them


def spread_of(prepared: PreparedGearbox, phases: int = PHASES) -> Spread:
    """Find the loads of all meshes; raises SimulationError where there is no static equilibrium."""
    samples = equilibria(prepared, phases)
    meshes = tuple(_of_mesh(prepared, m, samples) for m in range(len(prepared.case.meshes)))
    return Spread(prepared, meshes, tuple(tilt_of(prepared, m, samples) for m in range(len(meshes))))


def flattened(spread: Spread, phases: int = PHASES) -> tuple[dict[str, Any], ...]:
    """Propose for every mesh what makes its load more even, and compute K_Hβ with it; by catalogue names.

    On the driving gear: a helix angle that undoes what tilts and misalignment open under a load in the middle
    of the face, beside its crowning; or, where that is not to be ground, the crowning with which both gears
    have √3/4 of what they open under their load. That is the one of the smallest maximum line load where the
    whole face touches, with uniform stiffness c per length, misalignment f over the face, mean line load q:
    K_Hβ − 1 falls from c f/(2 q) to c f/(2 √3 q). Nothing for meshes that are not cut into slices, and
    nothing that makes no load more even: a face that is crowned already may have more than that.
    """
    case, found = spread.prepared.case, [dict[str, Any]() for _ in spread.meshes]
    for name, of_mesh, tilt in (("helix_slope", _helix, _middle), ("crowning", _crowning, _under_load)):
        amounts = _alike(case, [loads and of_mesh(spread, m, loads) for m, loads in enumerate(spread.meshes)])
        meshes = tuple(
            mesh if amount is None else _with_lead(mesh, name, amount)
            for mesh, amount in zip(case.meshes, amounts, strict=True)
        )
        changed = replace(spread.prepared, case=replace(case, meshes=meshes))
        tables = tables_about(changed, [tilt(spread, m) for m in range(len(meshes))], coarse=True)
        changed = replace(assemble(changed.case, tables, changed.twist), near=changed.near)
        again = spread_of(changed, phases)
        for proposal, amount, before, loads in zip(found, amounts, spread.meshes, again.meshes, strict=True):
            if before is not None and loads is not None and loads.factor < before.factor:
                proposal[f"proposed_{name}"] = amount
                proposal[f"face_load_factor_{name}"] = loads.factor
    return tuple(found)


def _alike(case: Gearbox, amounts: list[float | None]) -> list[float | None]:
    """The mean amounts of equal meshes: planets of a set are alike."""
    numbers = table_numbers(case)
    found = {number: list[float]() for number in numbers}
    for number, amount in zip(numbers, amounts, strict=True):
        found[number] += [] if amount is None else [amount]
    return [float(np.mean(found[number])) if found[number] else None for number in numbers]


def _lift(spread: Spread, m: int, tilt: float) -> float:
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
    lift = _lift(spread, m, pair.supports.misalignment.in_plane)
    (flank, body), _ = _gears(pair)
    return flank.lead.slope - lift * float(body.face_width) / float(cycle.face_width)


def _crowning(spread: Spread, m: int, loads: FaceLoads) -> float:
    pair, cycle = spread.prepared.case.meshes[m].pair, spread.prepared.tables[m].cycle
    lift = _lift(spread, m, loads.misalignment / float(cycle.face_width))
    (_, body), (mate, other) = _gears(pair)
    width, whole = float(cycle.face_width), math.sqrt(3.0) / 4.0 * abs(lift)
    left = whole - mate.lead.crowning * (width / float(other.face_width)) ** 2
    return max(left, 0.0) * (float(body.face_width) / width) ** 2


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
    """The same of a gearbox whose bodies stand on shafts, matrices or pins, with spur meshes in slices too.

    None of others, and where nothing presses its flanks.
    """
    if not prepared.case.supports:
        return None
    with suppress(SimulationError, InputError):  # of loads and tilts that no user has written
        return spread_of(in_slices(prepared))
    return None


def in_slices(prepared: PreparedGearbox) -> PreparedGearbox:
    """The gearbox about where it stands, its external spur meshes cut into slices by the energy method."""
    case, spatial = prepared.case, prepared.order[: prepared.model.layout.spatial]
    meshes = list(case.meshes)
    for m, mesh in enumerate(meshes):
        tilting = mesh.driver in spatial and mesh.driven in spatial
        external = min(case.gears[gear].teeth for gear in mesh.gears) > 0
        if tilting and external and prepared.tables[m].cycle.slices == 1:
            by = "energy" if mesh.pair.mesh.at_load else mesh.pair.mesh.compliance
            width = float(prepared.tables[m].cycle.face_width) / float(mesh.pair.drive.module)
            slices = min(max(int(width / SLICE_WIDTH) | 1, FEWEST), MOST)
            data = replace(mesh.pair.mesh, slices=slices, compliance=by, backlash=None)
            meshes[m] = replace(mesh, pair=replace(mesh.pair, mesh=data))
    if tuple(meshes) != case.meshes:
        return settled(assemble(replace(case, meshes=tuple(meshes))), assemble)
    # tables of many meshes, for 0.1 % in sets
    return prepared if case.system is not None or case.sets else settled(prepared, assemble)


def proposals(spread: Spread | None, meshes: int) -> tuple[dict[str, Any], ...]:
    """`flattened`, of so many meshes; empty where what is proposed cannot be made, and of planets' meshes."""
    if spread is not None and not spread.prepared.case.sets:
        with suppress(SimulationError, InputError):
            return flattened(spread)
    return tuple({} for _ in range(meshes))


def along_face(spread: Spread | None, m: int) -> dict[str, Any]:
    """Quantities of a mesh; nothing of one that is not cut into slices, or without drawn shafts."""
    loads = spread.meshes[m] if spread is not None else None
    return loads.quantities() if loads is not None else {}


def _of_mesh(prepared: PreparedGearbox, m: int, samples: Evaluated) -> FaceLoads | None:
    model, cycle = prepared.model, prepared.tables[m].cycle
    if cycle.slices == 1:
        return None
    mesh, work = model.meshes[m], samples.work[m]
    # z of the table in that of the pair
    way = slice(None, None, int(turned(prepared, m) * mesh.hand))

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
        tilt_of(prepared, m, samples).in_plane * float(cycle.face_width),
        np.array(cycle.face_position),
        np.mean(np.sum(of_slices(LINE_LOAD), axis=1), axis=0),
        path.rotation(of_slices(DISTANCE)),
        pressure,
    )
