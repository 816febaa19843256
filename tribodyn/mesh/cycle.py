"""The mesh cycle: everything tooth geometry and elasticity have to say, over one pitch of pinion rotation.

The phase of the mesh, in mesh cycles, is 0 when a new pair of teeth enters at the beginning of contact B_g
and 1 when the next one does. The set of pairs in contact changes at known phases only; these split the
cycle into *segments*, each tabulated on its own uniform grid that includes both ends, so that every
quantity is smooth inside a segment and every jump sits exactly on a segment's boundary.

Of helical gears every pair is cut into slices along the face, each late against the one before it. A slice
counts with the part of its width that is on the path of contact, so that nothing jumps; there is one segment.

Speed, load and temperature never enter the table.
"""

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.elementary import namespace, sense
from tribodyn.numerics.shapes import Array, Float


class MeshCycle(NamedTuple):
    """Immutable table of one mesh cycle; a JAX pytree of float64 arrays.

    Dimensions: S segments, N nodes per segment, Q slots: of every pair so many as it has slices, the slices
    of a pair side by side, the one that is earliest first. The front pairs come first, the one that
    entered last in the last of them ("pair 1" of two, as Liu & Ni number them); back flanks, if any, follow.
    Where a slot is out of contact its values are finite but mean nothing.

    The helix is that of a right-hand pinion which turns clockwise seen from +z, whose +z side is late; where
    it is the other way round, `GearMesh.hand` takes z and axial forces from here with the other sign.

    `record_arrays.MESH_CYCLE` says what each field is. In the table boundaries are (S + 1,), `in_contact`
    (S, Q), `side` (Q,), `phase` (S, N), `coupling` (S, N, Q, Q) and the other arrays (S, N, Q). Beside that:

    - `equivalent_radius` is 0 at the pitch point of a path whose pressure angle is zero there;
    - `compliance` is of both teeth, bodies and, where it is linear, the Hertz contact; `hertz_coefficient` is
      A of the load-dependent Hertz deflection A F^0.9, 0 where the Hertz contact is linear;
    - `gap` is positive where material is missing;
    - `coupling` is through the common gear bodies; zero diagonal, symmetric;
    - `line_load_friction` and `line_load_peak` are those at the load of the table over the load per width of
      a slot, ≥ 1 (`sharing.slices`); of slices per length of the line of contact, so that 1 becomes cos β_b;
    - of slices: loads act along the flanks' normal, with the slope tan β_w cos α to the transverse plane;
      `compliance` is of a slice that touches over its whole width; `equivalent_radius` is across the line of
      contact; distances and speeds are in the middle of the part that touches;
    - back flanks live in the world mirrored about the line of centres;
    - `pitch_point_phase` may exceed 1: the pair that passes the pitch point is then no longer the newest;
    - `pitch_point_length` and `pitch_point_rate` are those of `geometry.pitch_point`, 0 for a regular path;
    - `roll_start` and `roll_end` are the ends of the path of contact, or further out where corners can touch.
    """

    boundary: Any
    in_contact: Any
    side: Any
    phase: Any
    pressure_angle: Any
    signed_distance: Any
    equivalent_radius: Any
    pinion_speed: Any
    gear_speed: Any
    compliance: Any
    gap: Any
    coupling: Any
    hertz_coefficient: Any
    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    pinion_teeth: Any
    face_width: Any
    contact_ratio: Any
    pitch_point_phase: Any
    roll_start: Any
    roll_end: Any
    pitch_point_length: Any = 0.0
    pitch_point_rate: Any = 0.0
    line_load_friction: Any = 1.0
    line_load_peak: Any = 1.0
    share: Any = 1.0  # part of a slice's width that is on the path of contact
    face_position: Any = np.zeros(1)  # (K,), middles of the slices, m from the middle of the face
    pitch_slope: Any = 0.0  # tan β_w ≥ 0
    face_place: Any = (
        0.0  # z in the middle of the part of a slice that touches, m from the middle of the face
    )

    @property
    def slices(self) -> int:
        """Number of slices of a pair."""
        return self.face_position.shape[0]

    @property
    def slots(self) -> int:
        """Number of slots: slices of all pairs, back flanks included."""
        return self.side.shape[0]

    @property
    def front_slots(self) -> int:
        """Number of slots of driving flanks."""
        return int(np.sum(np.asarray(self.side) > 0))

    @property
    def front_pairs(self) -> int:
        """Number of pairs of driving flanks that can be in contact at once: the contact ratio rounded up."""
        return self.front_slots // self.slices

    def fronts(self) -> "MeshCycle":
        """The same without back flanks, which are not coupled with the driving ones."""
        slots, fronts, cut = self.slots, self.front_slots, {}
        for name in ("in_contact", "side", *OF_SLOTS):
            values = np.asarray(getattr(self, name))
            if values.ndim and values.shape[-1] == slots:
                cut[name] = values[..., :fronts]
        coupling = np.asarray(self.coupling)
        if coupling.shape[-1] == slots:
            cut["coupling"] = coupling[..., :fronts, :fronts]
        return self._replace(**cut)

    @property
    def pair_side(self) -> Any:
        """Side of every pair (P,): 1 of driving flanks, −1 of back flanks."""
        return self.side[:: self.slices]

    @property
    def slice_width(self) -> Any:
        """Width of a slice, m."""
        return self.face_width / self.slices

    @property
    def pinion_sense(self) -> Any:
        """1, or −1 of an internal pinion: its own sense of turning over that of its signed radius.

        A gear's torque and speed are positive in its own sense; formulas with signed radii have them times
        this (ISO 21771).
        """
        return sense(self.pinion_pitch_radius)

    @property
    def gear_sense(self) -> Any:
        """The same of the gear."""
        return sense(self.gear_pitch_radius)

    @property
    def speed_ratio(self) -> Any:
        """Speed of the gear over that of the pinion, each in its own sense; > 0."""
        return self.pinion_sense * self.pinion_pitch_radius / (self.gear_sense * self.gear_pitch_radius)

    @property
    def pitch_angle(self) -> Any:
        """Pinion rotation in one mesh cycle, rad (Liu & Ni (1) times the speed)."""
        return 2 * np.pi / self.pinion_teeth


#: Arrays (S, N, Q) of `MeshCycle`.
OF_SLOTS = (
    *("pressure_angle", "signed_distance", "equivalent_radius", "pinion_speed", "gear_speed"),
    *("compliance", "gap", "hertz_coefficient", "line_load_friction", "line_load_peak", "share"),
    "face_place",
)
#: Channels of `Polynomials.channel`, in order; cosine and sine of the pressure angle.
CHANNELS = (
    "cosine",
    "signed_distance",
    "equivalent_radius",
    "pinion_speed",
    "compliance",
    "gap",
    "sine",
    "line_load_friction",
    "line_load_peak",
    "share",
    "face_place",
)
#: Channels that spur gears have none of.
_OF_SLICES = ("face_place",)
_IS_SHARE = np.array([[name == "share"] for name in CHANNELS])


class Polynomials(NamedTuple):
    """The mesh cycle as piecewise cubics in the form that the right-hand side reads.

    Every quantity is the not-a-knot cubic spline through the nodes of its segment: C² inside a segment,
    fourth-order accurate, free to jump between segments; of slices, which come and go within a segment, the
    C¹ cubics of Fritsch and Butland, which never overshoot. Shares of slices are straight lines between the
    nodes, so that what comes in and what goes out add up everywhere as they do there. Coefficients are of
    powers 0 … 3 of the position u ∈ [0, 1] in the cell.
    """

    boundary: Any  # (S + 1,)
    in_contact: Any  # (S, Q)
    side: Any  # (Q,)
    channel: Any  # (S, N − 1, Q, channels, 4)
    coupling: Any  # (S, N − 1, Q, Q, 4); of slices, which are not coupled, empty
    #: (S, N − 1, Q, Q, 4), inverse of the compliance matrix of the pairs in contact; of slices empty
    stiffness: Any
    hertz_coefficient: Any
    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    pitch_angle: Any
    slice_width: Any  # width of a slot, m; that of the face for one slice
    face_position: Any  # (K,)
    pitch_slope: Any
    pitch_point_length: Any = 0.0
    pitch_point_rate: Any = 0.0


@lru_cache(maxsize=8)
def derivative_matrix(nodes: int) -> Float[Array, "node node"]:
    """Matrix that takes values at uniform nodes on [0, 1] to the derivatives of their not-a-knot spline."""
    spacing = 1.0 / (nodes - 1)
    left = np.zeros((nodes, nodes))
    right = np.zeros((nodes, nodes))
    for i in range(1, nodes - 1):
        left[i, i - 1 : i + 2] = 1.0, 4.0, 1.0
        right[i, i - 1], right[i, i + 1] = -3.0, 3.0
    left[0, :2] = 1.0, 2.0
    right[0, :3] = -2.5, 2.0, 0.5
    left[-1, -2:] = 2.0, 1.0
    right[-1, -3:] = -0.5, -2.0, 2.5
    return np.linalg.solve(left, right) / spacing


def slopes(values: Any, slices: int = 1) -> Any:
    """Slopes per cell at the nodes (S, N, …) of the cubics through values (S, N, …); see `Polynomials`."""
    xp = namespace(values)
    if slices == 1:
        nodes = values.shape[1]
        return xp.einsum("nm,sm...->sn...", derivative_matrix(nodes), values) / (nodes - 1)
    rise = values[:, 1:] - values[:, :-1]
    before, after = rise[:, :-1], rise[:, 1:]
    steepest = 3.0 * xp.minimum(xp.abs(before), xp.abs(after))
    central = 0.5 * (before + after)
    inner = xp.where(before * after > 0.0, xp.clip(central, -steepest, steepest), 0.0)
    return xp.concatenate([rise[:, :1], inner, rise[:, -1:]], axis=1)


def cubic(values: Any, slices: int = 1) -> Any:
    """Coefficients in u of the cubics through `values` (S, N, …) -> (S, N − 1, …, 4)."""
    xp = namespace(values)
    slope = slopes(values, slices)
    rise = values[:, 1:] - values[:, :-1]
    start, end = slope[:, :-1], slope[:, 1:]
    return xp.stack([values[:, :-1], start, 3 * rise - 2 * start - end, start + end - 2 * rise], axis=-1)


def _stiffness(cycle: MeshCycle, xp: Any) -> Any:
    """Inverse of the compliance matrix of the pairs in contact (S, N, Q, Q), 0 for the others, N/m."""
    inside = cycle.in_contact[:, None, :]
    # a pair out of contact is left alone on the diagonal, so that the others are inverted without it
    both = inside[..., :, None] * inside[..., None, :]
    matrix = cycle.coupling * both + xp.eye(cycle.slots) * cycle.compliance[..., None, :]
    scale = xp.mean(cycle.compliance)
    return xp.linalg.inv(matrix / scale) / scale * both


def polynomials(cycle: MeshCycle) -> Polynomials:
    """Coefficients of the mesh cycle's cubics.

    Raises TypeError if the table is not float64: under JAX, switch 64-bit numbers on first.
    """
    xp = namespace(*cycle)
    if cycle.compliance.dtype != np.float64:
        raise TypeError(f"the mesh cycle is {cycle.compliance.dtype}, not float64: enable jax_enable_x64")
    angle = {"cosine": xp.cos(cycle.pressure_angle), "sine": xp.sin(cycle.pressure_angle)}
    names = CHANNELS if cycle.slices > 1 else [name for name in CHANNELS if name not in _OF_SLICES]
    columns = [angle[name] if name in angle else getattr(cycle, name) for name in names]
    columns = [xp.broadcast_to(values, cycle.compliance.shape) for values in columns]
    channels = xp.stack(columns, axis=-1)
    kept = {name: getattr(cycle, name) for name in Polynomials._fields if hasattr(cycle, name)}
    channel = cubic(channels, cycle.slices)
    if cycle.slices > 1:
        none = xp.zeros((1, 1, 1, 1, 4))
        cubics = {"coupling": none, "stiffness": none}
        start, rise = channels[:, :-1], channels[:, 1:] - channels[:, :-1]
        lines = xp.stack([start, rise, 0.0 * rise, 0.0 * rise], axis=-1)
        channel = xp.where(_IS_SHARE, lines, channel)
    else:
        cubics = {"coupling": cubic(cycle.coupling), "stiffness": cubic(_stiffness(cycle, xp))}
    return Polynomials(**kept | cubics, channel=channel)
