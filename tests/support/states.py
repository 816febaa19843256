"""States of the model: random but physically sensible ones, and those of a run; where a pair keeps them."""

from typing import Any

import numpy as np

from tests.support.pair_outputs import outputs
from tribodyn.dynamics.parameters import DRIVE_TORQUE, Model
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import SampledStates, Stop, TransientSettings, transient
from tribodyn.train.flow import tree
from tribodyn.train.layout import layout_of, works
from tribodyn.train.schedule import Schedule
from tribodyn.train.structure import (
    GROUND,
    TURN,
    shift_of,
    turn_of,
)

#: Ends of the bearings of pinion and gear, and layouts of a pair: alone, and with a motor behind a shaft.
_BEARINGS = [(0, GROUND), (1, GROUND)]
PAIR = layout_of(2, 2, [(0, 1)], _BEARINGS, 0, 1)
PAIR_WITH_MOTOR = layout_of(2, 3, [(0, 1)], [*_BEARINGS, (2, 0)], 2, 1)
#: Coordinates of a pair; the rate of one stands `half` behind it, e.g. SLIP = PAIR.half + LAG.
LAG = PAIR.lag
X_P, Y_P = shift_of(0), shift_of(0) + 1
X_G, Y_G, TURN_G = shift_of(1), shift_of(1) + 1, turn_of(1, PAIR)
TURN_M = turn_of(2, PAIR_WITH_MOTOR)
VX_P, VY_P, VX_G, VY_G, SLIP, SPIN_G = (PAIR.half + i for i in (X_P, Y_P, X_G, Y_G, LAG, TURN_G))
WORK_IN, WORK_OUT, WORK_DAMPING, WORK_PARAMETRIC, WORK_FRICTION, WORK_SLIDING = works(PAIR)


def random_state(rng: np.random.Generator, model: Model, speed: float = 10.0) -> np.ndarray:
    """Bodies displaced by micrometres and vibrating at up to 0.1 m/s, and tilted; flanks loaded or apart."""
    layout = model.layout
    y = np.zeros(layout.states)
    for body in range(layout.planar):
        x = shift_of(body)
        y[x : x + 2] = rng.uniform(-8e-6, 8e-6, 2)
        y[layout.half + x : layout.half + x + 2] = rng.uniform(-0.05, 0.05, 2)
    for body in range(layout.spatial):
        z = layout.tilts + 3 * body
        y[z : z + 3] = rng.uniform(-1.0, 1.0, 3) * [8e-6, 2e-4, 2e-4]
        y[layout.half + z : layout.half + z + 3] = rng.uniform(-1.0, 1.0, 3) * [0.05, 1.0, 1.0]
    modes = layout.half - layout.modes
    y[modes : layout.half] = rng.uniform(-8e-6, 8e-6, layout.modes)
    y[layout.half + modes : layout.mechanical] = rng.uniform(-0.05, 0.05, layout.modes)
    y[layout.lag] = rng.uniform(-1e-6, 1e-6)
    y[layout.half + layout.lag] = rng.uniform(-0.05, 0.05) * speed
    for body, nearer, m, _ in tree(layout, tuple(np.asarray(model.links.stiffness)[:, TURN] > 0.0)):
        turn, start = turn_of(body, layout), turn_of(nearer, layout)
        near, near_rate = (y[start], y[layout.half + start]) if nearer else (0.0, 0.0)
        if m < 0:
            y[turn] = near + rng.uniform(-1e-3, 1e-3)
            y[layout.half + turn] = near_rate + rng.uniform(-0.05, 0.05) * speed
            continue
        radii = float(model.meshes[m].driver_radius), float(model.meshes[m].driven_radius)
        far, sign = (1, 1.0) if body == layout.driven[m] else (0, -1.0)
        y[turn] = (radii[1 - far] * near - sign * rng.uniform(-20e-6, 60e-6)) / radii[far]
        y[layout.half + turn] = (radii[1 - far] * near_rate - rng.uniform(-0.1, 0.1)) / radii[far]
    y[works(layout)] = rng.uniform(0.0, 10.0, layout.states - layout.mechanical)
    return y


def random_place(
    rng: np.random.Generator, schedule: Schedule, interval: int | None = None
) -> tuple[float, int]:
    """A phase, well inside its interval, and the interval, by default any."""
    chosen = int(rng.integers(len(schedule.start))) if interval is None else interval
    start, end = float(schedule.start[chosen]), float(schedule.end[chosen])
    return start + rng.uniform(0.02, 0.98) * (end - start), chosen


def altered(model: Model, **parts: dict[str, Any]) -> Model:
    """The model with other numbers, e.g. ``operation={"nominal_speed": 9.0}``; `mesh` is the first one."""
    first = model.meshes[0]._replace(**parts.pop("mesh", {}))
    changed = {name: getattr(model, name)._replace(**values) for name, values in parts.items()}
    return model._replace(meshes=(first, *model.meshes[1:]), **changed)


def with_motor(model: Model, inertia: float, stiffness: float, damping: float) -> Model:
    """A pair driven by a motor's torque through a compliant shaft."""
    ends = {"ratio": 1.0, "inertia": inertia, "load": 0.0, "load_damping": 0.0}
    shaft = {"stiffness": [0.0, 0.0, stiffness], "damping": [0.0, 0.0, damping]}
    return altered(
        model,
        bodies={name: np.append(getattr(model.bodies, name), value) for name, value in ends.items()},
        links={name: np.vstack([getattr(model.links, name), value]) for name, value in shaft.items()},
        options={"layout": PAIR_WITH_MOTOR, "drive": DRIVE_TORQUE},
    )


def sampled(model, settings: TransientSettings, start: np.ndarray | None = None):
    """Mesh cycles and states of all samples of a run, from the static equilibrium unless told otherwise."""
    *parts, stop = transient(model, static_equilibrium(model) if start is None else start, settings)
    assert isinstance(stop, Stop)
    assert stop.reason == ""
    chunks = [part for part in parts if isinstance(part, SampledStates)]
    return tuple(np.concatenate([getattr(chunk, of) for chunk in chunks]) for of in ("cycles", "states"))


def recorded(model, settings: TransientSettings, start: np.ndarray | None = None) -> dict[str, np.ndarray]:
    """What is recorded of these samples."""
    return outputs(*sampled(model, settings, start), model)
