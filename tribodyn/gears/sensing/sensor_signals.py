"""Signals of many cases: marched side by side, each listened to over its own stretch of the run."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.outputs import Evaluated, evaluated
from tribodyn.gears.motion.samples import Sampled, sampled
from tribodyn.gears.sensing.listening import Listener
from tribodyn.numerics.processes.work import in_threads, usable_cores
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.sensors import Sensed
from tribodyn.sensing.sensed_motion import time_of
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import initial_state
from tribodyn.solve.integrator import REASONS, Status
from tribodyn.train.schedule import interval_of
from tribodyn.train.structure import rotational_error

#: Cycles that cases are marched before they are listened to again. Fixed, so that the steps of a case, which
#: begin anew behind each, do not depend on the cases beside it; short, because all states between are held.
BLOCK = 48
#: Kinds of sensors that need nothing but the states: not the forces of the teeth, nor what drives.
_OF_STATES = ("acceleration", "force", "encoder", "transmission-error", "housing")


class Heard(NamedTuple):
    """A case that is made ready to be listened to."""

    model: Model
    listener: Listener
    solver: Any  # a `methods.SolverData`
    first: int  # reference cycles before it is listened to
    blocks: int  # in which it is
    samples: int  # of a reference cycle
    block: int = BLOCK  # cycles of a block


def listen(cases: Sequence[Heard], workers: int | None = None) -> list[Sensed | str]:
    """March cases from their starts and listen to them; a text where one fails: why.

    What a case gives does not depend on those beside it.
    """
    results: list[Sensed | str] = [""] * len(cases)
    groups: dict[tuple[Any, ...], list[int]] = {}
    for i, case in enumerate(cases):
        solver = case.solver
        key = case.first, case.samples, case.block, solver.rtol, solver.method, solver.max_steps
        groups.setdefault(key, []).append(i)
    for (*_, rtol, method, max_steps), places in groups.items():
        how = {"rtol": rtol, "method": method, "max_steps": max_steps, "workers": workers}
        for place, result in zip(places, _listen([cases[i] for i in places], how), strict=True):
            results[place] = result
    return results


def _listen(cases: Sequence[Heard], how: dict[str, Any]) -> list[Sensed | str]:
    """March cases of one solver, `first` and block, block by block; those at their ends drop out."""
    first, samples, block = cases[0].first, cases[0].samples, cases[0].block
    states = np.array([initial_state(case.model, case.solver.initial) for case in cases])
    failed: dict[int, str] = {}
    going = list(range(len(cases)))
    done = 0
    while going:
        count, kept = (first, 0) if done < first else (block, block)
        part = march(
            [cases[i].model for i in going],
            states[going],
            cycles=count,
            window=kept,
            samples=samples if kept else 0,
            started=done > 0,
            first_cycle=done,
            **how,
        )
        states[going] = part.state
        for row, i in enumerate(going):
            if part.status[row] != Status.DONE:
                reason = REASONS[Status(int(part.status[row]))]
                failed[i] = f"stopped after {done + float(part.reached[row]):.4g} mesh cycles: {reason}"
        sound = [(row, i) for row, i in enumerate(going) if i not in failed]
        if kept:
            cycles = done + np.arange(kept * samples) / samples

            def hear(item: tuple[int, int], part: Any = part, cycles: Any = cycles) -> None:
                row, i = item
                add(cases[i].listener, cases[i].model, cycles, part.samples[row])

            in_threads(hear, sound, how["workers"] or usable_cores())
        done += count
        going = [i for _, i in sound if first + block * cases[i].blocks > done]
    return [failed[i] if i in failed else case.listener.sensed() for i, case in enumerate(cases)]


def add(
    listener: Listener, model: Model, cycles: Float[Array, " sample"], states: Float[Array, "sample state"]
) -> None:
    """Let a listener hear some states; of these no more is worked out than its sensors need."""
    if not all(kind in _OF_STATES for kind in listener.kinds):
        whole = evaluated(cycles, states, model)
        listener.add(whole, sampled(whole))
        return
    _, phase, interval = interval_of(cycles, model.schedule)
    y = np.ascontiguousarray(states.T)
    plain = Evaluated(cycles, phase, interval, y, [], {}, model)
    angle = cycles * float(model.operation.pitch_angle)
    meshes = [
        {"transmission_error_rotational": rotational_error(states, m, model)}
        for m in range(len(model.meshes))
    ]
    listener.add(plain, Sampled(cycles, {"time": time_of(plain), "reference_angle": angle}, meshes))
