"""The mesh in slow rotation: loads, deflection, stiffness; and for all studies which gear drives, efficiency.

Powers (W) or works (J) keep the signs of a record: the pinion's is positive where it gives to the mesh, the
gear's where it takes from the mesh. Power therefore flows from the pinion to the gear where both are
positive and from the gear to the pinion where both are negative. Where their signs differ nothing passes
through: both give, and friction and damping take it all (an unloaded mesh, or one that locks).
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.mesh.cycle import MeshCycle, slopes
from tribodyn.numerics.elementary import absolute, maximum, namespace, within
from tribodyn.numerics.iteration import iterate
from tribodyn.numerics.shapes import Array, Float

# The contact part of a load-dependent compliance goes like F^−0.1, so that each step of the secant iteration
# shrinks its error at least tenfold; the set of loaded pairs settles on the way.
_STEPS, _DIFFERENTIATED = 14, 6
_STEPS_NEAR = 3  # from loads that friction changes by some per cent


class QuasiStatic(NamedTuple):
    """State of the mesh at every node of the table."""

    #: (S, N, Q); load of each pair along its normal, N; 0 where it is not in contact or a gap keeps it from
    #: touching. Of slices (`MeshCycle`) that of each slice; `by_pairs` sums them up
    normal_load: Float[Array, "segment node pair"]
    #: (S, N), r_p θ_p − r_g θ_g, by which the pinion is ahead of the gear on the pitch circles, m
    deflection: Float[Array, "segment node"]
    #: (S, N), force on the pitch circles over the part of the deflection that the load makes, N/m: along the
    #: pitch tangent, all pairs together, secant where the Hertz contact is load-dependent
    mesh_stiffness: Float[Array, "segment node"]

    @property
    def friction_load(self) -> Float[Array, "segment node pair"]:
        """Load at which friction acts: that of an even face, N."""
        return self.normal_load


def by_pairs(values: Float[Array, "... slot"], slices: int) -> Float[Array, "... pair"]:
    """Sums over the slices of each pair, (…, Q/K)."""
    return values.reshape(*values.shape[:-1], -1, slices).sum(axis=-1)


def normal_arms(cycle: MeshCycle) -> Float[Array, "segment node slot"]:
    """Torque per load along the flanks' normal, over the pitch radius: h = cos α cos β_n."""
    xp = namespace(*cycle)
    cosine = xp.cos(cycle.pressure_angle)
    if cycle.slices == 1:
        return cosine
    return cosine / xp.sqrt(1.0 + (cycle.pitch_slope * cosine) ** 2)


def sliding_side(cycle: MeshCycle) -> Any:
    """Sign of the sliding, negative in approach, (S, 1, Q); of slices (S, N, Q) its mean over what touches.

    While a slice passes the pitch point its friction thus turns over its width.
    """
    xp = namespace(*cycle)
    r = cycle.signed_distance
    if cycle.slices == 1:
        return xp.sign(r[:, r.shape[1] // 2, None])
    extent = cycle.share * cycle.slice_width * cycle.pitch_slope * xp.cos(cycle.pressure_angle)
    return within(2.0 * r / maximum(extent, 1e-12 * absolute(cycle.pinion_pitch_radius)), -1.0, 1.0)


def quasi_static(
    cycle: MeshCycle,
    gear_torque: Any,
    friction: Float[Array, "*point segment node pair"] | None = None,
    near: Float[Array, "*point segment node pair"] | None = None,
) -> QuasiStatic:
    """Share the gear's torque among the driving pairs by their compliances and gaps.

    With h_i = cos α_i every loaded pair has Δ h_i − e_i = Σ_j C_ij F_j (+ A F_i^0.9), and r_g Σ F_i h_i is
    the torque (N m, of the sign of r_g: `MeshCycle.gear_sense`), to which friction adds
    Σ μ_i F_i (r_g sin α_i − r_i); `friction` is its force over the normal load, with the sign of the sliding:
    negative in approach. Bearings are rigid, and a back flank carries nothing. The table may be traced.
    Torques of several points, (point, 1, 1), give arrays with points first; loads that are `near`, of less
    friction, save steps.

    A slice of which the share s_i is on the path of contact has h_i = cos α_i cos β_n,i, and
    Δ h_i − e_i = C_i F_i/s_i (+ A (F_i/s_i)^0.9).
    """
    xp = namespace(*cycle, gear_torque, friction)
    present = (cycle.in_contact * (cycle.side > 0))[:, None, :] + 0.0 * cycle.compliance
    arms = normal_arms(cycle)
    weight = cycle.share if cycle.slices > 1 else None
    torque_arms = arms
    if friction is not None:
        lever = xp.sin(cycle.pressure_angle) - cycle.signed_distance / cycle.gear_pitch_radius
        torque_arms = arms + friction * lever
    force = gear_torque / cycle.gear_pitch_radius
    on_each = xp.asarray(force)[..., None]
    identity = np.eye(cycle.compliance.shape[-1])

    def share(state: tuple[Any, Any, Any, Any]) -> tuple[Any, Any, Any, Any]:
        load, active, *_ = state
        contact = cycle.hertz_coefficient * maximum(load, 1e-9 * on_each) ** -0.1
        if weight is not None:  # each slice by itself, with its load as if it touched over its whole width
            each = active / (cycle.compliance + contact)
            return settled(active, each * arms, each * cycle.gap)
        diagonal = identity * (cycle.compliance + contact)[..., None]
        loaded = active[..., None] * active[..., None, :]
        matrix = loaded * (cycle.coupling + diagonal) + identity * (1.0 - active)[..., None]
        right = xp.stack([active * arms, active * cycle.gap], axis=-1)
        solution = xp.linalg.solve(matrix, right)
        return settled(active, solution[..., 0], solution[..., 1])

    def settled(active: Any, per_deflection: Any, by_gap: Any) -> tuple[Any, Any, Any, Any]:
        pushing = active * torque_arms if weight is None else active * torque_arms * weight
        stiffness = (pushing * per_deflection).sum(axis=-1)
        total = (force + (pushing * by_gap).sum(axis=-1)) / stiffness
        load = active * (per_deflection * total[..., None] - by_gap)
        overlap = arms * total[..., None] - cycle.gap
        if weight is None:
            overlap = overlap - xp.einsum("...ij,...j->...i", cycle.coupling, load)
        active = present * xp.where(xp.where(active > 0, load, overlap) > 0, 1.0, 0.0)
        return load, active, total, stiffness

    weighed = present if weight is None else present * weight
    steps, active = _STEPS, present
    if near is None:
        guess = present * on_each / (weighed * torque_arms).sum(axis=-1, keepdims=True)
    else:
        steps, active = _STEPS_NEAR, xp.where(near > 0, 1.0, 0.0)
        guess = near if weight is None else near / xp.where(near > 0, weight, 1.0)
    start = (guess, active, guess[..., 0], guess[..., 0])
    load, _, deflection, stiffness = iterate(share, start, steps, _DIFFERENTIATED)
    return QuasiStatic(load if weight is None else load * weight, deflection, stiffness)


def cycle_mean(
    cycle: MeshCycle, values: Float[Array, "segment node *pair"], weight: Float[Array, " node"] | None = None
) -> Float[Array, "*pair"]:
    """Mean over one mesh cycle of values (S, N, …) at the nodes: the integral of the table's splines.

    With the weight of each node where these are not even, in one segment (`helical.mean_nodes`).
    """
    if weight is not None:
        return namespace(weight, values).tensordot(weight, values[0], 1)
    return cycle_integral(cycle, values, cycle.boundary[1:, None])


def cycle_integral(
    cycle: MeshCycle, values: Float[Array, "segment node *pair"], upto: Float[Array, "..."]
) -> Float[Array, "*pair"]:
    """Integral of values at the nodes, (S, N) or (S, N, Q), over the phase from 0 up to a phase, () or (Q,).

    Several such phases `upto` at once, broadcast with (S, Q); a segment that ends before counts whole.
    """
    xp = namespace(*cycle, values, upto)
    flat = values.ndim == 2
    values = values[..., None] if flat else values
    cells = values.shape[1] - 1
    slope = slopes(values, cycle.slices)
    start, end, begin, finish = values[:, :-1], values[:, 1:], slope[:, :-1], slope[:, 1:]
    whole = (start + end) / 2 + (begin - finish) / 12
    before = xp.concatenate([0.0 * whole[:, :1], xp.cumsum(whole, axis=1)], axis=1)

    length = (cycle.boundary[1:] - cycle.boundary[:-1])[:, None]
    safe = xp.where(length > 0, length, 1.0)
    place = within((upto - cycle.boundary[:-1, None]) / safe, 0.0, 1.0) * cells
    place = xp.broadcast_to(place, (values.shape[0], values.shape[2]))
    cell = xp.clip(xp.floor(place).astype(int), 0, cells - 1)
    u = place - cell

    def at_cell(array: Float[Array, "segment cell pair"]) -> Float[Array, "segment pair"]:
        return xp.take_along_axis(array, cell[:, None, :], axis=1)[:, 0, :]

    a, b, m, n = (at_cell(array) for array in (start, end, begin, finish))
    square, cube = 3 * (b - a) - 2 * m - n, m + n - 2 * (b - a)
    inside = u * (a + u * (m / 2 + u * (square / 3 + u * cube / 4)))
    result = ((at_cell(before) + inside) * length / cells).sum(axis=0)
    return result[0] if flat else result


class SinglePair(NamedTuple):
    """One pair at the pitch point."""

    normal_load: float  # load along the normal, N
    #: dF/dδ along the normal, N/m; with a load-dependent Hertz contact the tangent at the load
    stiffness: float


def single_pair(cycle: MeshCycle, gear_torque: float) -> SinglePair:
    """One pair at the pitch point under a gear torque, N m, of either sign, with the load T_g/(r_g cos α).

    In slices: a pair whose slices all stand there, with the load T_g/(r_g cos α cos β_n).
    """
    fronts, slices = cycle.front_slots, cycle.slices
    roll = np.asarray(cycle.signed_distance)[:, :, :fronts]
    inside = np.asarray(cycle.in_contact)[:, None, :fronts] > 0
    if slices > 1:
        inside = inside & (np.asarray(cycle.share)[:, :, :fronts] > 0)
    distance = np.where(inside, np.abs(roll), np.inf)
    segment, _, slot = np.unravel_index(np.argmin(distance), distance.shape)
    near = roll[segment, :, slot]
    order = np.argsort(near)
    compliance = float(np.interp(0.0, near[order], np.asarray(cycle.compliance)[segment, order, slot]))
    # the cubic through the nearest nodes: the load has no error that a linear one would leave
    close = np.argsort(np.abs(near))[:4]
    step = np.ptp(near[close])
    angle = np.polyfit(near[close] / step, np.asarray(cycle.pressure_angle)[segment, close, slot], 3)[-1]
    arm = float(np.cos(angle))
    if slices > 1:
        arm = arm / float(np.hypot(1.0, cycle.pitch_slope * arm))
    load = abs(gear_torque) / (float(cycle.gear_sense * cycle.gear_pitch_radius) * arm)
    contact = 0.9 * float(cycle.hertz_coefficient) * max(load / slices, 1.0) ** -0.1
    return SinglePair(load, slices / (compliance + contact))


def power_put_in(pinion: Any, gear: Any) -> Any:
    """What the mesh is given, ≥ 0: the pinion's power where that drives, the gear's where that does."""
    return maximum(pinion, 0.0) + maximum(-gear, 0.0)


def efficiency(pinion: Any, gear: Any, loss: Any) -> Any:
    """1 − loss over what the driving gear puts in; NaN where power does not pass from one to the other.

    The loss is the power or work lost to tooth friction.
    """
    xp = namespace(pinion, gear, loss)
    through = pinion * gear > 0.0
    put_in = xp.where(through, power_put_in(pinion, gear), 1.0)
    return xp.where(through, 1.0 - loss / put_in, np.nan)


def driving_gear(pinion: float, gear: float) -> str:
    """Say which of the two drives: "pinion", "gear" or "neither"."""
    if pinion * gear <= 0.0:
        return "neither"
    return "pinion" if pinion > 0.0 else "gear"


def friction_loss(
    cycle: MeshCycle,
    normal_load: Float[Array, "segment node slot"],
    friction_coefficient: Float[Array, "*#table"],
    weight: Float[Array, " node"] | None = None,
) -> Any:
    """Mean friction power over a mesh cycle per pinion speed, N m: Σ μ F |v_s|/ω_p.

    Sliding changes sign at the pitch point; the integral is split there, exactly, so that it is smooth in
    the drive's parameters. With weights as of `cycle_mean` it changes over the width of each slice. The
    table's `side` must not be traced; the loads (N) are smooth in every segment.
    """
    xp = namespace(*cycle, normal_load, friction_coefficient)
    pairs, fronts = cycle.front_pairs, cycle.front_slots
    sliding = cycle.pinion_sense * (cycle.pinion_speed - cycle.gear_speed)[..., :fronts]
    power = (friction_coefficient * cycle.in_contact[:, None, :] * normal_load)[..., :fronts] * sliding
    if weight is not None:
        return cycle_mean(cycle, power * sliding_side(cycle)[..., :fronts], weight).sum()
    pitch_point = cycle.pitch_point_phase - xp.arange(pairs - 1.0, -1.0, -1.0)
    if cycle.slices > 1:
        late = cycle.face_position * cycle.pitch_slope / (cycle.pinion_pitch_radius * cycle.pitch_angle)
        pitch_point = (pitch_point[:, None] + late).reshape(-1)
    return (cycle_mean(cycle, power) - 2.0 * cycle_integral(cycle, power, pitch_point[None, :])).sum()


def mean_efficiency(
    cycle: MeshCycle,
    gear_torque: Any,
    friction_coefficient: Float[Array, "*#table"],
    normal_load: Float[Array, "segment node pair"] | None = None,
    weight: Float[Array, " node"] | None = None,
) -> Any:
    """Quasi-static efficiency over a mesh cycle, by energy, with a given friction coefficient μ ≥ 0.

    The table may be traced, but for `side`. The torque (N m) is negative where the gear drives, on back
    flanks that are like the driving ones. Without loads of `equilibrium` (N) those of `quasi_static` without
    friction count: the error is of the order of the loss squared. Weights are as of `cycle_mean`.
    """
    loads = normal_load
    if loads is None:
        torque = cycle.gear_sense * namespace(gear_torque).abs(gear_torque)
        loads = quasi_static(cycle, torque).normal_load
    gear = gear_torque * cycle.speed_ratio
    loss = friction_loss(cycle, loads, friction_coefficient, weight)
    return efficiency(gear + loss, gear, loss)
