"""Helical pairs in slices: the mesh at given phases from its table, and what is recorded of their pairs."""

from typing import Any

import numpy as np

from tribodyn.dynamics.recorded.faces import over_faces
from tribodyn.errors import InputError
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.equilibrium import Contacts
from tribodyn.mesh.quasi_static import normal_arms
from tribodyn.studies.efficiency.mesh_positions import Array, Places, Sharing

#: Share of its width over which a slice must touch so that its pressure and film are looked at: the line
#: load of a narrower rest, which holds up the edge of the face alone, is one of the discretisation.
LEAST_SHARE = 0.5
_OVER_PHASE = (
    *("pressure_angle", "signed_distance", "equivalent_radius", "pinion_speed", "gear_speed"),
    *("compliance", "gap", "line_load_friction", "line_load_peak", "share"),
)
_IN_CONTACT = ("compliance", "gap")


def slices_at(cycle: MeshCycle, phase: Array, sharing: Sharing) -> Places:
    """Look up the slices at phases (K,), 0 … 1; everything is the table's.

    Raises InputError if one pair shall carry the load: helical pairs take it over slice by slice.
    """
    if sharing == "single-pair":
        raise InputError(
            "mesh.load_sharing",
            f'"{sharing}"',
            "a helical pair takes over the load slice by slice",
            'use "elastic" or "uniform"',
        )
    front = cycle.front_slots
    segment = np.clip(np.searchsorted(cycle.boundary, phase, side="right") - 1, 0, len(cycle.boundary) - 2)
    begin, end = cycle.boundary[segment], cycle.boundary[segment + 1]
    cells = cycle.phase.shape[1] - 1
    place = np.clip((phase - begin) / (end - begin), 0.0, 1.0) * cells
    cell = np.clip(place.astype(int), 0, cells - 1)
    beyond = (place - cell)[:, None]

    def ends(values: Any) -> tuple[Array, Array]:
        every = np.broadcast_to(values, cycle.compliance.shape)[:, :, :front]
        return every[segment, cell], every[segment, cell + 1]

    # what a slice is out of contact means nothing: where it comes or goes only the node beside it counts
    before, after = ((1.0 - beyond) * (ends(cycle.share)[0] > 0.0), beyond * (ends(cycle.share)[1] > 0.0))
    shared = before + after > 0.0
    after = np.where(shared, after / np.where(shared, before + after, 1.0), beyond)

    def between(name: str) -> Array:
        first, second = ends(getattr(cycle, name))
        weight = after if name in _IN_CONTACT else beyond
        return (first + weight * (second - first))[:, None]

    fields = {name: between(name) for name in _OVER_PHASE}
    touching = cycle.in_contact[segment, :front] * (fields["share"][:, 0] > 0.0)
    looked_up = cycle._replace(
        **fields,
        in_contact=touching,
        side=np.ones(front),
        phase=phase[:, None],
        coupling=np.zeros((len(phase), 1, 1, 1)),
    )
    # a slice rolls like a pair that is late by its place on the face
    late = cycle.face_position * cycle.pitch_slope / cycle.pinion_pitch_radius
    age = phase[:, None, None] + np.arange(cycle.front_pairs - 1.0, -1.0, -1.0)[:, None]
    roll = cycle.roll_start + cycle.pitch_angle * age - late
    return Places(phase, looked_up, roll.reshape(len(phase), front), None)


def phases_of(cycle: MeshCycle) -> tuple[Array, Array]:
    """Phases and weights of a mean over the mesh cycle: middles between the nodes of every segment."""
    cells = cycle.phase.shape[1] - 1
    begin, length = cycle.boundary[:-1, None], np.diff(cycle.boundary)[:, None]
    phase = begin + length * (np.arange(cells) + 0.5) / cells
    return phase.ravel(), np.broadcast_to(length / cells, phase.shape).ravel()


def judged(cycle: MeshCycle, normal_load: Array) -> np.ndarray:
    """Where (K, Q) a slot is loaded, and of a slice at least `LEAST_SHARE` touches."""
    loaded = normal_load > 0.0
    return loaded & (cycle.share[:, 0] >= LEAST_SHARE) if cycle.slices > 1 else loaded


def deflections(cycle: MeshCycle, normal_load: Array) -> Array:
    """Deflections (K, Q) of pairs or slices along their normal that their own loads make, m."""
    share = cycle.share[:, 0] if cycle.slices > 1 else np.ones_like(normal_load)
    return normal_load * cycle.compliance[:, 0] / np.where(share > 0.0, share, 1.0)


def share_evenly(contacts: Contacts, cycle: MeshCycle, arms: Array, torque: float) -> Array:
    """Loads (K, 1, Q) in proportion to the length of contact, N."""
    length = contacts.carrying * cycle.share
    return length * torque / np.sum(length * arms, axis=-1, keepdims=True)


def of_pairs(cycle: MeshCycle, arrays: dict[str, Any], normal_load: Array, way: float) -> dict[str, Any]:
    """Datasets of pairs of those of slices, with `line_load` (K, pairs, slices), N/m, and `axial_force`.

    The axial force on the pinion is that of a right-hand one that turns clockwise seen from +z.
    """
    share = np.where(cycle.share[:, 0] > 0.0, cycle.share[:, 0], 1.0)
    line_load = normal_load / (cycle.slice_width * share) * cycle.line_load_friction[:, 0]
    slots = {name: values for name, values in arrays.items() if np.shape(values) == line_load.shape}
    datasets = arrays | over_faces(slots, cycle.front_pairs, line_load)
    # where the gear drives the table is passed backwards, and +z is late all the same
    datasets["line_load"] = datasets["line_load"][:, :, :: int(way)]
    arms = normal_arms(cycle)[:, 0]
    return datasets | {"axial_force": -way * np.sum(normal_load * cycle.pitch_slope * arms, axis=-1)}
