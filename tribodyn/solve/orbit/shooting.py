"""Shooting: Newton's method on x − Pⁿ(x) = 0 for many systems at once, and the orbit that it closes."""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Complex, Float, Int
from tribodyn.solve.orbit.motions import UNSTABLE, Orbit, PeriodMap, periodic

#: Halvings of a Newton step before shooting gives up, and the smallest relative decrease that it must bring.
HALVINGS = 7
DECREASE = 1e-3
#: A derivative serves the next step too where the last one brought the residual down to this share.
WELL_DOWN = 0.1
#: Distance of a multiplier's modulus from 1 within which a state counts as neutral.
NEUTRAL = 1e-6
#: Distance over the scale, about the third root of the smallest tolerance, at which motions may have merged.
MERGED = 1e-3


class Shot(NamedTuple):
    """Result of shooting for one system."""

    state: Float[Array, " state"]
    residual: float  # max |x − Pⁿ(x)| over the scale of each state; inf where the map failed
    #: eigenvalues of the n-fold map's derivative, largest modulus first: Floquet's where the residual
    #: vanishes
    multipliers: Complex[Array, " state"]
    jacobian: Float[Array, "state state"]  # that derivative
    steps: int  # Newton steps taken
    reason: str  # why there is no solution; empty where the residual is within the tolerance


def shoot(
    period_map: PeriodMap,
    states: Float[Array, "row state"],
    cases: Int[Array, " row"],
    periods: int,
    tolerance: float,
    max_steps: int = 20,
) -> list[Shot]:
    """Look for fixed points of the n-fold map near given states, `cases` being the systems of the rows.

    `tolerance` is the maximum scaled residual of a solution; with no Newton step allowed the states given are
    only judged. Each row has its own damping: a step is halved until the residual falls. Rows fail on their
    own.
    """
    scales, alike = period_map.scale, period_map.blur > 0.0  # difference quotients are all alike
    rows = [_Row(state.copy(), case, alike) for state, case in zip(states, map(int, cases), strict=True)]
    marched = period_map.march(states, cases, periods, True)
    for row, end, reason in zip(rows, marched.states[:, -1], marched.reasons, strict=True):
        row.arrive(row.x, end, scales[row.case])
        row.reason = reason
    going = rows
    while going:
        for row in going:
            row.decide(tolerance, max_steps, scales[row.case], period_map.blur)
        going = [row for row in going if not row.done]
        for fine in (False, True):
            stale = [row for row in going if row.jacobian is None and row.fine == fine]
            if stale:
                at, of = np.array([row.x for row in stale]), np.array([row.case for row in stale])
                tangent = period_map.tangent(at, of, periods, fine)
                for k, row in enumerate(stale):
                    row.take(tangent.image[k], tangent.jacobian[k], tangent.reasons[k], scales[row.case])
        _search(period_map, [row for row in going if row.direction is not None], periods)
    return [row.shot() for row in rows]


def critical_direction(
    jacobian: Float[Array, "state state"], scale: Float[Array, " state"]
) -> Float[Array, " state"]:
    """Direction (N,), of scaled size 1, in which a state with this derivative is left, or comes near last."""
    values, vectors = np.linalg.eig(jacobian)
    direction = np.real(vectors[:, np.argmax(np.abs(values))])
    return direction / np.max(np.abs(direction) / scale)


class _Row:
    """One system on its way: state, image, residual, and the derivative with the place it was taken at.

    Steps are taken with coarse derivatives until one does not lower the residual; multipliers are those of a
    fine one at the solution.
    """

    def __init__(self, x: Float[Array, " state"], case: int, fine: bool):
        self.x, self.case = x, case
        self.residual = np.inf
        self.steps = 0
        self.reason = ""
        self.done = False
        self.image = self.base = x
        self.jacobian: Float[Array, "state state"] | None = None
        self.fine = fine  # whether that is a fine one, or is to be
        self.last_jacobian = np.full((len(x), len(x)), np.nan)
        self.direction: Float[Array, " state"] | None = None

    def arrive(
        self, x: Float[Array, " state"], image: Float[Array, " state"], scale: Float[Array, " state"]
    ) -> None:
        """Be at a state with its image."""
        self.x, self.image, self.residual = x, image, _size(image - x, scale)

    def take(
        self,
        image: Float[Array, " state"],
        jacobian: Float[Array, "state state"],
        reason: str,
        scale: Float[Array, " state"],
    ) -> None:
        """Take a derivative in, and the image that came with a fine one."""
        self.base, self.reason = self.x, reason
        self.jacobian = self.last_jacobian = jacobian
        if self.fine:
            self.arrive(self.x, image, scale)

    def decide(self, tolerance: float, max_steps: int, scale: Float[Array, " state"], blur: float) -> None:
        """Be done, ask for another derivative, or set out in a direction."""
        self.direction = None
        if not self.reason and self.residual <= tolerance:
            if not self.fine or _size(self.x - self.base, scale) > blur:
                self.ask(fine=True)
                return
        elif not self.reason and self.steps >= max_steps:
            self.reason = f"shooting ended after {max_steps} steps with the residual {self.residual:.1e}"
        elif not self.reason:
            if self.jacobian is None:
                return
            self.direction = _newton_direction(self.image - self.x, self.jacobian, scale)
            if self.direction is not None:
                return
            if not self.fine:
                self.ask(fine=True)
                return
            self.reason = "the map's derivative has the multiplier 1: the steady state is not isolated"
        self.done = True

    def ask(self, fine: bool) -> None:
        """Want another derivative."""
        self.jacobian, self.fine = None, fine

    def shot(self) -> Shot:
        multipliers = eigenvalues(self.last_jacobian)
        return Shot(self.x, self.residual, multipliers, self.last_jacobian, self.steps, self.reason)


def _search(period_map: PeriodMap, rows: list[_Row], periods: int) -> None:
    """Take the steps of rows, each halved until its residual falls; where none does, the row is done."""
    share = 1.0
    for _ in range(HALVINGS + 1):
        if not rows:
            return
        trial = np.array([row.x + share * np.asarray(row.direction) for row in rows])
        cases = np.array([row.case for row in rows])
        end = period_map.march(trial, cases, periods, True).states[:, -1]
        rest = []
        for row, x, image in zip(rows, trial, end, strict=True):
            before, scale = row.residual, period_map.scale[row.case]
            if _size(image - x, scale) >= (1.0 - DECREASE * share) * before:
                rest.append(row)
                continue
            row.arrive(x, image, scale)
            row.steps += 1
            if row.residual > WELL_DOWN * before:
                row.jacobian = None
        rows = rest
        share *= 0.5
    for row in rows:
        if row.base is row.x and row.fine:
            row.reason = f"no Newton step lowers the residual {row.residual:.1e}"
        # a coarse one, or taken elsewhere: try with that of the place
        row.ask(fine=row.fine or row.base is row.x)


def _size(off: Float[Array, " state"], scale: Float[Array, " state"]) -> float:
    return float(np.max(np.abs(off) / scale)) if np.all(np.isfinite(off)) else np.inf


def _newton_direction(
    off: Float[Array, " state"], jacobian: Float[Array, "state state"], scale: Float[Array, " state"]
) -> Float[Array, " state"] | None:
    """Newton step (N,) from the map's defect; None where the equations are singular."""
    # in units of the scale, so that the singular values can be compared
    matrix = jacobian * scale / scale[:, None]
    if not (np.all(np.isfinite(matrix)) and np.all(np.isfinite(off))):
        return None
    left_vectors, values, right = np.linalg.svd(np.eye(len(matrix)) - matrix)
    if values[-1] <= 1e-9 * max(1.0, values[0]):
        return None
    return scale * (right.T @ ((left_vectors.T @ (off / scale)) / values))


def eigenvalues(jacobian: Float[Array, "state state"]) -> Complex[Array, " state"]:
    """Multipliers (N,) of a map with this derivative (N, N), largest modulus first; NaN where it has none."""
    if not np.all(np.isfinite(jacobian)):
        return np.full(len(jacobian), np.nan, dtype=complex)
    values = np.asarray(np.linalg.eigvals(jacobian), dtype=complex)
    return values[np.lexsort((-np.imag(values), -np.round(np.abs(values), 12)))]


def closed_orbit(
    period_map: PeriodMap, shot: Shot, case: int, period: int, cycles: int, tolerance: float
) -> Orbit:
    """The orbit of a converged shot over some periods: its shortest period and its stability.

    `cycles` are the periods marched before, `tolerance` is that of the shot.
    """
    for n in range(1, period):
        if period % n == 0:
            again = _over_fewer(period_map, shot, case, n, tolerance)
            if again is not None:
                shot, period = again._replace(steps=again.steps + shot.steps), n
                break
    modulus = float(np.abs(shot.multipliers[0]))
    stable = modulus <= 1.0 + NEUTRAL
    message = "" if stable else f"an unstable state of period {period}: {way_out(shot.multipliers)}"
    if stable and modulus >= 1.0 - NEUTRAL:
        message = "neutral: a multiplier of modulus 1, neighbouring states neither return nor leave"
    kind, method = periodic(period) if stable else UNSTABLE, "shooting" if shot.steps else "marching"
    state, residual, multipliers = shot.state, shot.residual, shot.multipliers
    return Orbit(state, state, period, residual, multipliers, stable, kind, method, cycles, message)


def _over_fewer(period_map: PeriodMap, shot: Shot, case: int, periods: int, tolerance: float) -> Shot | None:
    """The shot over fewer periods, where the motion has no more.

    It has no more where it comes back to within a hundred times the tolerance; and where it nearly does and
    the motion of fewer periods is there and stable: where two merge, the residual falls with the third power
    of the distance and tells them apart no better, but then only one of them is stable.
    """
    scale = period_map.scale[case]
    end = period_map.march(shot.state[None], np.array([case]), periods, True).states[0, -1]
    off = np.max(np.abs(end - shot.state) / scale)
    if not off <= MERGED:
        return None
    again = shoot(period_map, shot.state[None], np.array([case]), periods, tolerance)[0]
    away = np.max(np.abs(again.state - shot.state) / scale)
    if again.reason or away > MERGED:
        return None
    stable = np.abs(again.multipliers[0]) <= 1.0 + NEUTRAL
    return again if stable or off <= 100.0 * tolerance else None


def way_out(multipliers: Complex[Array, " state"]) -> str:
    """In words, how a state with these multipliers, the largest first, is left."""
    largest = multipliers[0]
    modulus = f"largest multiplier {abs(largest):.4g}"
    if abs(largest.imag) > 1e-6 * abs(largest):
        return f"{modulus} at ±{np.degrees(abs(np.angle(largest))):.0f}°, left by a second frequency"
    if largest.real < 0.0:
        return f"{modulus}, negative: left towards twice the period"
    return f"{modulus}, positive: left towards another state"
