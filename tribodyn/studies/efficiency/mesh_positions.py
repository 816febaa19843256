"""The mesh at given phases, of pairs or of slices; phases for means over a cycle; what is recorded of slices.

At the pitch point of a cycloidal or parabolic path radius, rolling speeds and film go to zero and the
friction coefficient runs through its whole range over a fraction of a millimetre. With ψ = ψ_max t³ the
nodes of the quadrature crowd there and the integrand becomes smooth in t.
"""

from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.dynamics.recorded.faces import over_faces
from tribodyn.errors import InputError
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.path import Kinematics, Path, kinematics
from tribodyn.mesh.cycle import CHANNELS, MeshCycle, polynomials
from tribodyn.mesh.equilibrium import Contacts
from tribodyn.mesh.quasi_static import normal_arms

Array = NDArray[np.float64]


def gauss_legendre(points: int) -> tuple[Array, Array]:
    """Nodes and weights on [0, 1]."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    return (1.0 + nodes) / 2.0, weights / 2.0


def from_pitch_point(end: float, points: int) -> tuple[Array, Array]:
    """Nodes between the pitch point (0) and `end` (either sign), and positive weights that sum to |end|."""
    t, weights = gauss_legendre(points)
    return end * t**3, abs(end) * 3.0 * t**2 * weights


def piecewise(breaks: Array, pitch_points: Array, points: int) -> tuple[Array, Array]:
    """Nodes and weights between the first and the last break, crowded towards the pitch points.

    The integrand may jump at `breaks` (n,), increasing, both ends included, with so many points between two;
    `pitch_points` (m,) that lie inside are breaks as well, and a piece between two of them is split in its
    middle.
    """
    start, end = breaks[0], breaks[-1]
    pitch = pitch_points[(pitch_points >= start) & (pitch_points <= end)]
    edges = np.unique(np.concatenate([breaks, pitch]))
    t, weights = gauss_legendre(points)
    nodes, sizes = [], []
    for low, high in pairwise(edges):
        if high - low < 1e-12:
            continue
        at_low, at_high = low in pitch, high in pitch
        halves = [(low, high)]
        if at_low and at_high:
            middle = (low + high) / 2
            halves = [(low, middle), (high, middle)]
        elif at_high:
            halves = [(high, low)]
        for origin, far in halves:
            if at_low or at_high:
                place, weight = from_pitch_point(far - origin, points)
            else:
                place, weight = (far - origin) * t, (far - origin) * weights
            nodes.append(origin + place)
            sizes.append(weight)
    order = np.argsort(np.concatenate(nodes))
    return np.concatenate(nodes)[order], np.concatenate(sizes)[order]


Sharing = Literal["elastic", "uniform", "single-pair"]
SHARINGS: dict[Sharing, str] = {
    "elastic": "by the compliances of the pairs and of the bodies they share",
    "uniform": "equally among the pairs in contact, as ISO/TC 60 has it",
    "single-pair": "one pair over half a pitch on either side of the pitch point: unit contact ratio",
}


class Places(NamedTuple):
    """The mesh at some phases: K phases, Q pairs."""

    phase: Array  # (K,), mesh cycles
    #: a table of one node in each of K segments, driving flanks only; its kinematics are the path's own, and
    #: in contact are the pairs that may carry load under the load sharing in use
    cycle: MeshCycle
    roll: Array  # (K, Q), pinion angles of the pairs from the pitch point, rad
    #: by what the pairs share the load; None: by the table's compliances, or not elastically
    flanks: LoadedFlanks | None


#: Places on the path that are sought at a time; what to do where one pair cannot carry the load.
AT_A_TIME, _OTHERS = 1000, 'use "elastic" or "uniform"'


def places(
    cycle: MeshCycle,
    path: Path,
    phase: Array,
    sharing: Sharing = "elastic",
    flanks: LoadedFlanks | None = None,
) -> Places:
    """Look up the mesh at phases (K,), 0 … 1: compliance and gap from the table, kinematics from the path.

    `path` and `flanks`, the load contact model, are those that the table was made from. With the latter pairs
    that share elastically touch beyond the path as well, where a corner meets a flank; others know the path
    only. Of slices everything is the table's. Raises InputError if one pair shall carry the load over a pitch
    that its contact does not cover, or of slices.
    """
    if cycle.slices > 1:
        return _slices(cycle, phase, sharing)
    pairs = cycle.front_pairs
    segment, share = _in_segment(cycle, phase)
    position = phase[:, None] + np.arange(pairs - 1.0, -1.0, -1.0)
    roll = cycle.roll_start + cycle.pitch_angle * position
    start, end = float(cycle.roll_start), float(cycle.roll_end)
    corners = flanks is not None and sharing == "elastic"
    if flanks is not None and not corners:
        start, end = flanks.flexible.assembly.roll_limits
    # closed at the beginning, and open at the end by more than rounding
    inside = ((roll >= start - 1e-12) & (roll < end - 1e-12)).astype(float)
    if sharing == "single-pair":
        half = cycle.pitch_angle / 2.0
        if start > -half or end < half:
            rule = "the contact of a pair does not cover half a pitch on either side of the pitch point"
            raise InputError("mesh.load_sharing", f'"{sharing}"', rule, _OTHERS)
        inside = inside * ((roll >= -half) & (roll < half))
    motion: Kinematics
    if flanks is not None and corners:
        motion = pair_geometry(flanks.flexible.assembly, roll).motion
    else:
        within = np.clip(roll, start, end)
        # families without closed forms integrate, and hold a hundred numbers of each place meanwhile
        parts = [within[first : first + AT_A_TIME] for first in range(0, len(within), AT_A_TIME)]
        motion = kinematics(path, np.concatenate([path.signed_distance(part) for part in parts]))
    table = polynomials(cycle)

    def channel(name: str) -> Array:
        return _value(table.channel[:, :, :, CHANNELS.index(name)], segment, share)[:, None, :pairs]

    looked_up = cycle._replace(
        in_contact=inside,
        side=np.ones(pairs),
        phase=phase[:, None],
        pressure_angle=motion.pressure_angle[:, None],
        signed_distance=motion.signed_distance[:, None],
        equivalent_radius=1.0 / motion.relative_curvature[:, None],
        pinion_speed=motion.pinion_speed[:, None],
        gear_speed=motion.gear_speed[:, None],
        compliance=channel("compliance"),
        gap=channel("gap"),
        coupling=_value(table.coupling, segment, share)[:, None, :pairs, :pairs],
    )
    return Places(phase, looked_up, roll, flanks if corners else None)


def _in_segment(cycle: MeshCycle, phase: Array) -> tuple[Any, Array]:
    """Segments of the table at phases (K,), and the shares of these that have passed."""
    segment = np.clip(np.searchsorted(cycle.boundary, phase, side="right") - 1, 0, len(cycle.boundary) - 2)
    begin, end = cycle.boundary[segment], cycle.boundary[segment + 1]
    return segment, np.clip((phase - begin) / (end - begin), 0.0, 1.0)


def _value(coefficients: Any, segment: Any, share: Array) -> Array:
    """The table's splines at shares of their segments."""
    cells = coefficients.shape[1]
    place = share * cells
    cell = np.clip(place.astype(int), 0, cells - 1)
    c = coefficients[segment, cell]
    u = (place - cell).reshape(-1, *[1] * (c.ndim - 2))
    return c[..., 0] + u * (c[..., 1] + u * (c[..., 2] + u * c[..., 3]))


#: Share of its width over which a slice must touch so that its pressure and film are looked at: the line
#: load of a narrower rest, which holds up the edge of the face alone, is one of the discretisation.
LEAST_SHARE = 0.5
_OVER_PHASE = (
    *("pressure_angle", "signed_distance", "equivalent_radius", "pinion_speed", "gear_speed"),
    *("compliance", "gap", "line_load_friction", "line_load_peak", "share"),
)
_IN_CONTACT = ("compliance", "gap")


def _slices(cycle: MeshCycle, phase: Array, sharing: Sharing) -> Places:
    """Look up the slices at phases (K,), 0 … 1."""
    if sharing == "single-pair":
        rule = "a helical pair takes over the load slice by slice"
        raise InputError("mesh.load_sharing", f'"{sharing}"', rule, _OTHERS)
    front, cells = cycle.front_slots, cycle.phase.shape[1] - 1
    segment, share = _in_segment(cycle, phase)
    place = share * cells
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
    length = contacts.carrying * (cycle.share if cycle.slices > 1 else 1.0)
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
