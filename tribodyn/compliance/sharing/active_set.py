"""Which of many elastic places touch, and with what loads: Newton's method with an active set.

At every position n places with the loads f ≥ 0 share a torque:

    ξ a_i − g_i = Σ_j Λ_ij f_j + u_i(f_i)  where f_i > 0,   ξ a_i − g_i ≤ Σ_j Λ_ij f_j  elsewhere,
    Σ_i l_i f_i = T.

A step takes u for its tangent, solves for the loads of the places taken to touch and for ξ, and drops or adds
all places that are on the wrong side (the primal-dual active set of contact mechanics). Where that does not
end, only the worst place changes at a time.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.numerics.shapes import Array, Bool, Float, Int

#: Steps in which all places may change sides, and steps in which one may.
_FREE_STEPS = 25
_CAREFUL_STEPS = 400
_SETTLED = 1e-11
# Load, as a share of the mean, at which a place that just touches is linearised: the contact's deflection
# goes like F ln(1/F) and has no slope at 0.
_MINIMUM_LOAD = 1e-7


class Pressed(NamedTuple):
    """Loads of the places."""

    load: Float[Array, "position place"]  # (position, place), N, ≥ 0
    deflection: Float[Array, " position"]  # (position,), ξ, m
    #: (position, place), ξ a − g less what the other places' loads deflect, m: what a place's own load takes
    #: up where it is positive; the distance still open where negative
    overlap: Float[Array, "position place"]
    #: (position,), dT/dξ, N m/m: of the places that touch, the local deflection's tangent included
    stiffness: Float[Array, " position"]


class _System(NamedTuple):
    """What is asked at some positions, and the units of load and deflection in which it is solved."""

    matrix: Float[Array, "row place place"]
    arm: Float[Array, "row place"]
    lever: Float[Array, "row place"]
    gap: Float[Array, "row place"]
    torque: Float[Array, " row"]
    mean: Float[Array, " row"]
    unit: Float[Array, " row"]

    def at(self, rows: Int[Array, " some"]) -> "_System":
        """Return the part of it at some positions."""
        return _System(*(whole[rows] for whole in self))


class _Local(NamedTuple):
    """The places' own deflection about some loads: its value, m, and its slope, m/N."""

    load: Float[Array, "row place"]
    value: Float[Array, "row place"]
    slope: Float[Array, "row place"]


def press(
    matrix: Float[Array, "position place place"],
    local: Callable[
        [Int[Array, " row"], Float[Array, "row place"]],
        tuple[Float[Array, "row place"], Float[Array, "row place"]],
    ],
    arm: Float[Array, "position place"],
    lever: Float[Array, "position place"],
    gap: Float[Array, "position place"],
    torque: Float[Array, " position"],
) -> Pressed:
    """Find the loads that carry the torques T > 0 (N m): Λ = `matrix` (m/N), a = `arm` (1), l = `lever` (m).

    `local` gives, of positions (indices) and the loads of all their places (N), the own deflection u (m) and
    its slope (m/N). The gaps g (m) are of either sign. SimulationError if no state of contact is found.
    """
    positions, places = gap.shape
    mean = torque / np.max(lever, axis=-1)
    # ξ in units of the deflection that the mean load makes, to keep the systems well conditioned
    even = np.repeat(mean[:, None] / places, places, axis=-1)
    softness = np.abs(np.einsum("...ii->...i", matrix)) + local(np.arange(positions), even)[1]
    unit = mean * np.mean(softness, axis=-1) / places
    active = gap <= (np.min(gap, axis=-1) + unit)[:, None]
    load = active * (mean / np.sum(active, axis=-1))[:, None]
    result = Pressed(np.zeros_like(gap), np.zeros(positions), np.zeros_like(gap), np.zeros(positions))
    whole = _System(matrix, arm, lever, gap, torque, mean, unit)
    rows = np.arange(positions)
    worst = np.inf
    for step in range(_FREE_STEPS + _CAREFUL_STEPS):
        part = whole.at(rows)
        about = np.maximum(load, (_MINIMUM_LOAD / places * part.mean)[:, None])
        new = _newton_step(active, _Local(about, *local(rows, about)), part)
        trial, overlap = new.load, new.overlap
        touching = np.where(active, trial > 0.0, overlap > 0.0)
        if step >= _FREE_STEPS:
            touching = _worst_only(active, touching, trial, overlap)
        # a torque must be carried by something: where all let go, the closest place holds on
        none = ~np.any(touching, axis=-1)
        touching[none] = part.gap[none] <= np.min(part.gap[none], axis=-1, keepdims=True)
        change = np.max(np.abs(trial - load), axis=-1) / part.mean
        settled = (change < _SETTLED) & np.all(touching == active, axis=-1)
        load, active = np.maximum(trial, 0.0), touching
        for field, solution in zip(result, new._replace(load=load), strict=True):
            field[rows[settled]] = solution[settled]
        if np.all(settled):
            return result
        rows, load, active = rows[~settled], load[~settled], active[~settled]
        worst = float(np.max(change[~settled]))
    raise SimulationError(
        f"the load contact model does not settle: loads still move by {worst:.1e} of the mean"
    )


def _newton_step(active: Bool[Array, "row place"], local: _Local, part: _System) -> Pressed:
    """Loads, ξ, overlaps and dT/dξ with the local deflection linearised."""
    matrix, arm, lever, gap = part.matrix, part.arm, part.lever, part.gap
    positions, places = gap.shape
    mean, unit, torque = part.mean[:, None], part.unit[:, None], part.torque[:, None]
    system = np.zeros((positions, places + 1, places + 1))
    right = np.zeros((positions, places + 1, 2))
    both = active[:, :, None] & active[:, None, :]
    system[:, :places, :places] = np.where(both, matrix * (mean / unit)[..., None], 0.0)
    diagonal = np.einsum("...ii->...i", system)[:, :places]
    diagonal += np.where(active, local.slope * mean / unit, 1.0)
    system[:, :places, places] = np.where(active, -arm, 0.0)
    system[:, places, :places] = active * lever * mean / torque
    right[:, :places, 0] = np.where(active, local.slope * local.load - gap - local.value, 0.0) / unit
    right[:, places] = 1.0  # the torque; alone in the second column
    solution = np.linalg.solve(system, right)
    load = active * solution[:, :places, 0] * mean
    deflection = solution[:, places, 0] * unit[:, 0]
    stiffness = torque[:, 0] / (solution[:, places, 1] * unit[:, 0])
    overlap = deflection[:, None] * arm - gap - np.einsum("...ij,...j->...i", matrix, load)
    overlap += np.einsum("...ii->...i", matrix) * load
    return Pressed(load, deflection, overlap, stiffness)


def _worst_only(
    active: Bool[Array, "row place"],
    touching: Bool[Array, "row place"],
    load: Float[Array, "row place"],
    overlap: Float[Array, "row place"],
) -> Bool[Array, "row place"]:
    """Change, of the places on the wrong side, only the one furthest from where it should be."""
    wrong = touching != active
    pull = np.where(active, -load / np.max(np.abs(load)), overlap / np.max(np.abs(overlap)))
    furthest = np.argmax(np.where(wrong, pull, -np.inf), axis=-1)
    chosen = wrong & (np.arange(active.shape[-1]) == furthest[:, None])
    return np.where(chosen, touching, active)
