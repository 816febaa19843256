"""Friction clutches between bodies and brakes on bodies: torque over slip speed and time. For all compilers.

The torque against the slip speed v is C(t) (1 + e exp(−(v/v_f)²)) s(v/w), with C what the clutch transmits
while it slips, e what it holds more at rest, and s the sign made C1 over the width w. A closed clutch thus
creeps: under a torque T at v = 2 w sin(arcsin(T/C)/3), below w. What joins both sides of a clutch is its
friction alone, so that the micro-rotations of bodies beyond it grow without bound, and no teeth mesh there.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.elementary import exp, law, minimum
from tribodyn.numerics.shapes import Array, Float
from tribodyn.numerics.smooth import cubic_rise, cubic_rise_slope, place_between, sign, sign_slope
from tribodyn.train.joints import joined
from tribodyn.train.structure import OF_MESHES, TURN, WORKS_OF_MESH, speed_of, turning

#: Exponent of the static torque's fall below which nothing of it is left.
_FALLEN = 700.0


class Clutches(NamedTuple):
    """Numbers of the clutches and brakes; their ends are in the layout."""

    times: Float[Array, " knot"] = np.zeros(0)  # of the C1 capacities of all, s; two at least
    capacity: Float[Array, "clutch knot"] = np.zeros((0, 0))  # torque while it slips, N m
    slope: Float[Array, "clutch knot"] = np.zeros((0, 0))
    excess: Float[Array, " clutch"] = np.zeros(0)  # static over kinetic friction, less 1
    fall_speed: Float[Array, " clutch"] = np.zeros(0)  # over which that falls off, rad/s
    width: Float[Array, " clutch"] = np.zeros(0)  # slip speed over which friction reverses, rad/s
    #: at the start, rad/s; NaN: closed if it can be, else it begins to slip
    slip: Float[Array, " clutch"] = np.zeros(0)


@law
def friction_torque(slip, capacity, c, clutches):
    """Torque of a clutch against its slip speed, N m, and its slope, N m s/rad."""
    fall, width = clutches.fall_speed[c], clutches.width[c]
    share = slip / fall
    held = clutches.excess[c] * exp(-minimum(share * share, _FALLEN))
    way = sign(slip / width)
    slope = (1.0 + held) * sign_slope(slip / width) / width - 2.0 * held * share / fall * way
    return capacity * (1.0 + held) * way, capacity * slope


@law
def capacity_at(c, time, clutches):
    """Torque that a clutch transmits while it slips, N m."""
    i, width, u = place_between(clutches.times, time)
    start, end = clutches.capacity[c, i], clutches.capacity[c, i + 1]
    out, back = clutches.slope[c, i] * width, clutches.slope[c, i + 1] * width
    return start + cubic_rise(u, end - start, out, back)


@law
def slip_speed(c, y, model):
    """Speed of the first end of a clutch over the second's, of a brake that of its body, rad/s."""
    layout = model.options.layout
    first, second = layout.clutch_first[c], layout.clutch_second[c]
    if second < 0:
        return speed_of(first, y, model)
    return turning(first, y, layout) - turning(second, y, layout)


@law
def work_of_clutch(c, layout):
    """Place of the work that friction in a clutch has taken, J."""
    return layout.mechanical + OF_MESHES + WORKS_OF_MESH * layout.meshes + c


@law
def clutch_friction(c, time, y, model):
    """Slip speed of a clutch, its torque against it and the slope of that."""
    slip = slip_speed(c, y, model)
    clutches = model.operation.clutches
    torque, slope = friction_torque(slip, capacity_at(c, time, clutches), c, clutches)
    return slip, torque, slope


class Standing(NamedTuple):
    """How clutches stand at the start of a run."""

    group: tuple[int, ...]  # of each body: bodies are alike that more than clutches join
    roots: tuple[int, ...]  # one body of each group but the reference's
    rate: Float[Array, " body"]  # of the micro-rotations, rad/s
    load: Float[Array, " body"]  # of clutches and brakes on the bodies, against their motion, N m


def groups(layout: Any, links: Any) -> tuple[int, ...]:
    """Number alike the bodies that meshes, carriers and springs join."""
    pairs = list(zip(layout.driver, layout.driven, strict=True))
    pairs += [(a, b) for a, b in zip(layout.driver, layout.carrier, strict=True) if b >= 0]
    stiffness = np.asarray(links.stiffness)
    for k, (first, second) in enumerate(zip(layout.first, layout.second, strict=True)):
        if second >= 0 and (stiffness[k, TURN] > 0.0 or layout.pins[k]):
            pairs.append((first, second))
    return tuple(joined(layout.bodies, pairs))


def standing(model: Any, wanted: Float[Array, " body"]) -> Standing:
    """How clutches stand at the start, where `wanted` are the other loads on the bodies, N m.

    A clutch of no given slip is closed where its capacity holds what the loads ask for, and creeps; else it
    slips by the width over which friction reverses.
    """
    layout, clutches, drives = model.options.layout, model.operation.clutches, model.options.drive
    ratio, inertia = (np.asarray(each, dtype=float) for each in (model.bodies.ratio, model.bodies.inertia))
    group = np.array(groups(layout, model.links))
    numbers = range(layout.clutches)
    ends = list(zip(layout.clutch_first, layout.clutch_second, strict=True))
    bridging = [c for c in numbers if ends[c][1] >= 0 and group[ends[c][0]] != group[ends[c][1]]]
    given = np.asarray(clutches.slip, dtype=float)
    closed = [c for c in bridging if np.isnan(given[c])]
    slip = np.nan_to_num(given)
    capacity = np.array([float(capacity_at(c, 0.0, clutches)) for c in numbers])
    others = [c for c in numbers if c not in closed]
    rate = _rates(slip, bridging, ends, group, ratio)
    reference = float(model.operation.nominal_speed + model.operation.start_slip)
    load = np.zeros(layout.bodies)
    for c in others:
        first, second = ends[c]
        speed = slip[c] if second >= 0 else ratio[first] * reference + rate[first]
        _add(load, ends[c], float(friction_torque(speed, capacity[c], c, clutches)[0]))
    on_all = wanted + load
    cluster = np.array(joined(layout.bodies, [*enumerate(group), *(ends[c] for c in closed)]))
    for one in dict.fromkeys(cluster.tolist()):
        inside = cluster == one
        if drives or not inside[0]:
            on_all = on_all - inside * taken_by_inertia(on_all * inside, inertia * inside, ratio)
    names = [g for g in dict.fromkeys(group.tolist()) if drives or g != group[0]]
    balance = np.zeros((len(names), len(closed)))
    for place, c in enumerate(closed):
        for end, way in zip(ends[c], (1.0, -1.0), strict=True):
            if group[end] in names:
                balance[names.index(group[end]), place] += way * ratio[end]
    asked = np.array([-float(np.sum((on_all * ratio)[group == g])) for g in names])
    torques, *_ = np.linalg.lstsq(balance, asked) if closed and names else (np.zeros(len(closed)),)
    for c, torque in zip(closed, torques.tolist(), strict=True):
        holds = capacity[c] * (1.0 + float(clutches.excess[c]))
        width = float(clutches.width[c])
        if abs(torque) < holds:
            slip[c] = 2.0 * width * np.sin(np.arcsin(torque / holds) / 3.0)
        else:
            slip[c] = np.copysign(width, torque)
            torque = np.copysign(capacity[c], torque)
        _add(load, ends[c], torque)
    roots = [int(np.flatnonzero(group == g)[0]) for g in dict.fromkeys(group.tolist()) if g != group[0]]
    return Standing(tuple(group.tolist()), tuple(roots), _rates(slip, bridging, ends, group, ratio), load)


def accelerating(load: Float[Array, " body"], standing: Standing, model: Any) -> Float[Array, " body"]:
    """What the inertia of every group that is free to turn takes of the loads, N m."""
    ratio, inertia = (np.asarray(each, dtype=float) for each in (model.bodies.ratio, model.bodies.inertia))
    group, taken = np.array(standing.group), np.zeros(len(ratio))
    for one in dict.fromkeys(standing.group):
        inside = group == one
        if model.options.drive or not inside[0]:
            taken = taken + taken_by_inertia(load * inside, inertia * inside, ratio)
    return taken


def taken_by_inertia(
    load: Float[Array, " body"], inertia: Float[Array, " body"], ratio: Float[Array, " body"]
) -> Float[Array, " body"]:
    """What bodies that turn together, by their ratios, take of the loads as they accelerate, N m."""
    moved = float(inertia @ ratio**2)
    return inertia * ratio * float(load @ ratio) / moved if moved > 0.0 else 0.0 * load


def _add(load: Float[Array, " body"], ends: tuple[int, int], torque: float) -> None:
    load[ends[0]] += torque
    if ends[1] >= 0:
        load[ends[1]] -= torque


def _rates(
    slip: Float[Array, " clutch"],
    bridging: list[int],
    ends: list[tuple[int, int]],
    group: Any,
    ratio: Float[Array, " body"],
) -> Float[Array, " body"]:
    """Rates of the micro-rotations of bodies whose clutches slip so, rad/s; none of the reference's group."""
    of_group = {int(group[0]): 0.0}  # over the ratio
    waiting = list(bridging)
    while waiting:
        left = []
        for c in waiting:
            one, two = (int(group[end]) for end in ends[c])
            apart = slip[c] / ratio[ends[c][0]]
            if one in of_group and two not in of_group:
                of_group[two] = of_group[one] - apart
            elif two in of_group and one not in of_group:
                of_group[one] = of_group[two] + apart
            elif one not in of_group:
                left.append(c)
        if len(left) == len(waiting):
            break
        waiting = left
    return np.array([ratio[b] * of_group.get(int(g), 0.0) for b, g in enumerate(group)])


def common_knots(
    curves: list[tuple[Float[Array, " point"], Float[Array, " point"], Float[Array, " point"]]],
) -> tuple[Float[Array, " knot"], Float[Array, "clutch knot"], Float[Array, "clutch knot"]]:
    """Times, values and slopes of C1 curves (times, values, slopes) at the times of all: the same curves."""
    times = np.array(sorted({0.0, 1.0, *(float(t) for curve in curves for t in curve[0])}))
    values, slopes = np.zeros((2, len(curves), len(times)))
    for c, (own, at, rise) in enumerate(curves):
        if len(own) < 2:
            values[c] = at[0]
            continue
        i = np.clip(np.searchsorted(own, times, side="right") - 1, 0, len(own) - 2)
        width = own[i + 1] - own[i]
        u = np.clip((times - own[i]) / width, 0.0, 1.0)
        up, out, back = at[i + 1] - at[i], rise[i] * width, rise[i + 1] * width
        values[c] = at[i] + cubic_rise(u, up, out, back)
        slope = cubic_rise_slope(u, up, out, back)
        slopes[c] = np.where((times >= own[0]) & (times <= own[-1]), slope / width, 0.0)
    return times, values, slopes
