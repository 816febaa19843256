"""The map of trains over their common period, as the search for steady states takes it.

It takes the mechanical state at phase 0, just after engagement, to the same place a period later, which for a
single pair of gears is a mesh cycle. The rigid rotation has no part in it: the independent variable is the
phase of the reference mesh, and the time lag, on which nothing depends while the load is steady, is omitted
together with the audit's works. Of a pair with prescribed speed ten states remain, with a torque source
eleven, with a shaft thirteen.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import DRIVE_SPEED, ENERGY_CONSISTENT, Model
from tribodyn.numerics.processes.work import usable_cores
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.choice import choose
from tribodyn.solve.ensemble import march
from tribodyn.solve.integrator import MAX_STEPS, REASONS, Ensemble, Status, nothing_yet, put
from tribodyn.solve.methods import Runs, runs
from tribodyn.solve.orbit.motions import BLOCK, DIFFERENCE, Marched, Tangent, by_differences
from tribodyn.solve.right_hand_side import engage_next
from tribodyn.solve.tolerances import state_scales
from tribodyn.train.layout import TrainLayout, displacements, velocities

#: Relative tolerance of a march with coarse derivatives, and of these: a step of Newton's method with them
#: leaves a thousandth of the residual or less (measured on pairs and planetary sets), at a third of the cost.
COARSE = 1e-4
#: Cycles of a map from which its derivative is sought in its leading directions alone, where there are over
#: twice as many; how many these are, and the share of a state's scale that may be left in the last of them.
LONG, LEADING, GONE = 24, 24, 1e-3


class FreeStates(NamedTuple):
    """What models must have in common to be searched side by side."""

    states: tuple[int, ...]  # places of the states that the map acts on
    layout: TrainLayout
    period: int  # reference cycles of the map


def moving_states(model: Model) -> FreeStates:
    """What the map over the common period of a model acts on."""
    layout = model.layout
    free = {*displacements(layout), *velocities(layout)}
    if model.options.drive != DRIVE_SPEED:
        free |= {layout.half + layout.lag}
    return FreeStates(tuple(sorted(free)), layout, model.schedule.period)


class GearMap:
    """Maps over the common period of trains with the same `moving_states`, as `motions.PeriodMap`.

    Scales and the integration method follow from the states at the start; fixed points are sought with
    `fine_rtol`. Tangents are exact with native methods (`variational`), difference quotients with others.
    """

    def __init__(
        self,
        models: Sequence[Model],
        starts: Float[Array, "case state"],
        moving: FreeStates,
        *,
        solver: str,
        rtol: float,
        fine_rtol: float,
        max_steps: int,
        workers: int | None,
    ):
        self.models = models
        self.kind, self.layout, self.cycles = moving, moving.layout, moving.period
        self.moving = list(moving.states)
        self.rtol = {False: rtol, True: min(rtol, fine_rtol)}
        self.settings: dict[str, Any] = {"max_steps": max_steps, "workers": workers}
        self.solvers = [choose(solver, m, y).method for m, y in zip(models, starts, strict=True)]
        #: whether its derivative is sought in leading directions
        self.long = self.cycles >= LONG and len(self.moving) > 2 * LEADING
        self.blur = 0.0 if self.exact and not self.long else DIFFERENCE
        # a coarse derivative takes the time of 5 periods, differences two derivatives; of both twice
        self.shooting_cost = 10.0 if self.exact else 4.0 * (len(self.moving) + 2)
        self.block = max(4, min(BLOCK, 4 * BLOCK // self.cycles))
        self.scale = np.array([state_scales(m, y)[self.moving] for m, y in zip(models, starts, strict=True)])

    @property
    def exact(self) -> bool:
        """Whether tangents come from the variational equations, as native methods integrate them."""
        return all(runs(solver) is Runs.NATIVE for solver in self.solvers)

    def full(self, states: Float[Array, "row moving"]) -> Float[Array, "row state"]:
        """States of the model from states of the map."""
        whole = np.zeros((len(states), self.layout.states))
        whole[:, self.moving] = states
        return whole

    def march(
        self, states: Float[Array, "row moving"], cases: Int[Array, " row"], periods: int, fine: bool
    ) -> Marched:
        """See `motions.PeriodMap`."""
        result = self.integrate(self.full(states), cases, periods, 1, fine)
        end, reasons = result.state, reasons_of(result.status, result.reached)
        for row, case in enumerate(cases):
            if self.models[case].options.formulation == ENERGY_CONSISTENT and not reasons[row]:
                engage_next(end[row], periods * self.cycles, self.models[case])
        begins = result.samples[:, :: self.cycles]
        after = np.concatenate([begins[:, 1:], end[:, None]], axis=1)[..., self.moving]
        after[[bool(reason) for reason in reasons]] = np.nan
        return Marched(after, reasons)

    def tangent(
        self, states: Float[Array, "row moving"], cases: Int[Array, " row"], periods: int, fine: bool = True
    ) -> Tangent:
        """See `motions.PeriodMap`; by the variational equations where `exact`, else by differences."""
        if not self.exact:
            return by_differences(self.march, states, cases, periods, self.scale)
        if self.long:
            leading = self.leading_tangent(states, cases, periods, fine)
            if leading:
                return leading
        everywhere = np.broadcast_to(np.eye(len(self.moving)), (len(cases), *2 * (len(self.moving),)))
        image, slopes, reasons = self.derived(states, cases, periods, fine, everywhere)
        return Tangent(image, slopes / self.scale[cases][:, None, :], reasons)

    def leading_tangent(
        self,
        states: Float[Array, "row moving"],
        cases: Int[Array, " row"],
        periods: int,
        fine: bool = True,
        count: int = LEADING,
    ) -> Tangent | None:
        """The tangent but for what is gone after the period; None where more than `count` directions stay.

        J ≈ J Q Qᵀ with Q an orthonormal basis of J Ω, Ω being directions at random: multipliers are within
        about `GONE`, smaller ones not resolved (N. Halko et al., SIAM Review 53 (2011) 217).
        """
        scale, size = self.scale[cases], len(self.moving)
        start = np.linalg.qr(np.random.default_rng(0).standard_normal((size, count)))[0]
        probes = np.broadcast_to(start, (len(cases), *start.shape))
        _, slopes, reasons = self.derived(states, cases, periods, False, probes)
        if any(reasons):
            return None
        kept, left = np.linalg.qr(slopes / scale[:, :, None])
        if np.max(np.linalg.svd(left, compute_uv=False)[:, -1]) > GONE:
            return None
        # a coarse march serves: over a long period a fine one of the derivatives takes five times as long
        image, slopes, reasons = self.derived(states, cases, periods, False, kept)
        if fine:
            marched = self.march(states, cases, periods, True)
            image, reasons = marched.states[:, -1], marched.reasons
        return Tangent(image, slopes @ np.swapaxes(kept, 1, 2) / scale[:, None, :], reasons)

    def derived(
        self,
        states: Float[Array, "row moving"],
        cases: Int[Array, " row"],
        periods: int,
        fine: bool,
        along: Float[Array, "row moving direction"],
    ) -> tuple[Array, Array, list[str]]:
        """The image, its derivatives in some directions, these over the scale, and what stopped a row."""
        from tribodyn.solve.march.variational import march_with_derivative

        directions = np.zeros((len(cases), self.layout.states, along.shape[-1]))
        directions[:, self.moving] = self.scale[cases][:, :, None] * along
        derived = march_with_derivative(
            [self.models[case] for case in cases],
            self.full(states),
            directions,
            cycles=periods * self.cycles,
            rtol=self.rtol[True] if fine else COARSE,
            fine=fine,
            # the derivatives may need more than the motion, for which the limit is
            max_steps=max(MAX_STEPS, self.settings["max_steps"]),
            methods=[self.solvers[case] for case in cases],
            workers=self.settings["workers"] or usable_cores(),
        )
        image = derived.state[:, self.moving]
        image[derived.status != Status.DONE] = np.nan
        return image, derived.slopes[:, self.moving], reasons_of(derived.status, derived.reached)

    def integrate(
        self,
        states: Float[Array, "row state"],
        cases: Int[Array, " row"],
        periods: int,
        samples: int,
        fine: bool,
        extremes: bool = False,
    ) -> Ensemble:
        """Integrate whole states over some mesh cycles, all of them sampled."""
        cycles = periods * self.cycles
        result = nothing_yet(self.layout, states, cycles * samples, extremes)
        for solver in sorted(set(self.solvers)):
            rows = np.flatnonzero([self.solvers[case] == solver for case in cases])
            if rows.size:
                part = march(
                    [self.models[case] for case in cases[rows]],
                    states[rows],
                    cycles=cycles,
                    window=cycles,
                    samples=samples,
                    rtol=self.rtol[fine],
                    method=solver,
                    extremes=extremes,
                    **self.settings,
                )
                put(result, rows, part)
        return result


def reasons_of(status: Int[Array, " row"], reached: Float[Array, " row"]) -> list[str]:
    """Why rows ended before all of their mesh cycles; empty where they did not."""
    return [
        "" if how == Status.DONE else f"{REASONS[Status(how)]} (after {cycles:.2f} mesh cycles)"
        for how, cycles in zip(status, reached, strict=True)
    ]
