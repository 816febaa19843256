"""Runs by time of two gears on a spring and of the shipped pair, and marches by time from call to call."""

from typing import Any, NamedTuple, Self

import numpy as np

import tribodyn as td
from tests.support.spring_trains import Gears, scenario_of, spring_model
from tests.support.train_matrices import Body, Mesh, Train
from tribodyn.dynamics.parameters import Model, with_shared_code
from tribodyn.dynamics.recorded.outputs import Sampled, evaluated
from tribodyn.dynamics.recorded.outputs import sampled as outputs_of
from tribodyn.gears.motion.running import energy_residual
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.choice import choose_in_time
from tribodyn.solve.in_time import transient_in_time
from tribodyn.solve.initial import initial_state
from tribodyn.solve.integrator import Status
from tribodyn.solve.march.by_time import TimeControl, advance, begun_clock, time_buffer, time_control
from tribodyn.solve.march.time_outputs import outputs, time_outputs
from tribodyn.solve.right_hand_side import work_array
from tribodyn.solve.transient import SampledStates, Stop, TransientSettings
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.prepare import prepare

#: Inertias of driver and driven gear, kg m²; loads, N m; mesh, N/m.
DRIVER, DRIVEN, LOAD, STIFFNESS = 2e-2, 4e-3, 20.0, 3e8
TEETH, RADIUS, SPEED, ANGLE = 30, 0.045, 100.0, np.radians(20.0)
TOTAL = DRIVER + DRIVEN


class Run(NamedTuple):
    """A run by time."""

    seen: Sampled
    states: np.ndarray
    residual: float  # of its energy, as a share of the largest work

    def __getitem__(self, name: str) -> np.ndarray:
        return self.seen.whole[name]


def springs(duration: str, brake: dict[str, Any] | None = None, **operating: Any) -> PreparedGearbox:
    """Two equal gears without friction, joined by one spring."""
    bodies, mesh = (
        (Body(1.0, DRIVER), Body(1.0, DRIVEN)),
        Mesh((0, 1), (RADIUS, RADIUS), 0.0, ANGLE, -1, STIFFNESS),
    )
    duty = {"source": "torque", "input_speed": f"{SPEED} rad/s", "output_torque": f"{LOAD} N*m"}
    duty |= {"start_speed": "0 rad/s"} | operating
    made = scenario_of(Train(bodies, (), (), (mesh,)), [Gears((TEETH, TEETH), 3e-3)], 0.1, duty)
    clutch = {"clutch": [brake]} if brake else {}
    return spring_model(made | clutch | {"solver": {"duration": duration}})


def run(prepared: PreparedGearbox, method: str = "auto", rtol: float = 1e-9, samples: int = 20) -> Run:
    model, cycles = prepared.model, prepared.case.solver.cycles
    state = initial_state(model, "static")
    method = choose_in_time(method, model, state).method
    *parts, stop = transient_in_time(model, state, TransientSettings(method, rtol, cycles, 10**6, samples))
    assert isinstance(stop, Stop)
    assert stop.reason == ""
    chunks = [part for part in parts if isinstance(part, SampledStates)]
    states = np.concatenate([chunk.states for chunk in chunks])
    seen = outputs_of(evaluated(np.concatenate([chunk.cycles for chunk in chunks]), states, model))
    stored = seen.whole["stored_energy"][-1] - seen.whole["stored_energy"][0]
    return Run(seen, states, energy_residual(states[0], states[-1], stored, model.layout))


def pair(changes: dict[str, Any], duration: str = "20 ms") -> PreparedGearbox:
    """The shipped involute pair with friction, from rest."""
    plain = {
        "operating.start_speed": "0 rad/s",
        "operating.pinion_torque": "57 N*m",
        "solver.duration": duration,
        "mesh.damping_ratio": 0.1,
    }
    return prepare(td.scenario("run-up", plain | changes))


def train(name: str = "two-stage-reducer", **changes: Any) -> PreparedGearbox:
    """A shipped train that a motor turns, from rest; `changes` are of the operation."""
    motor = {"source": "torque", "start_speed": "0 rad/s", "input_torque": "300 N*m"} | changes
    more: dict[str, Any] = {f"operating.{key}": value for key, value in motor.items()}
    more |= {"film.law": "masjedi-khonsari", "friction.law": "coulomb", "friction.coefficient": 0.06}
    if name == "planetary-24-84":
        more["stage.0.frame_forces"] = False
    return prepare(td.scenario(name, more | {"solver.duration": "1 ms"}))


class Walker(NamedTuple):
    """A march by time from call to call, as of a co-simulation."""

    model: Model
    control: TimeControl
    y: Float[Array, " state"]
    clock: Float[Array, " row"]

    @classmethod
    def begun(cls, model: Model, rtol: float = 1e-8) -> Self:
        """From the equilibrium of the start."""
        y = initial_state(model, "static")
        control = time_control(model, y, rtol, 10**6)
        return cls(with_shared_code(model), control, y, begun_clock(model, y, control))

    def to(self, time: float, **inputs: Any) -> dict[str, float]:
        """Go on to a time (s) with numbers of the operation; outputs there, of meshes by `name.number`."""
        model = self.model._replace(operation=self.model.operation._replace(**inputs))
        scratch = work_array(model), time_buffer(model.layout)
        status, _, _ = advance(time, self.control, model, self.y, self.clock, *scratch)
        assert status == Status.DONE
        places = time_outputs(model)
        out = np.zeros(len(places))
        outputs(model, self.y, self.clock, *scratch, out)
        names = [one.name if one.mesh is None else f"{one.name}.{one.mesh}" for one in places]
        return dict(zip(names, out.tolist(), strict=True))
