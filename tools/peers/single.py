"""Programs that integrate one case: from a relative tolerance to samples of the transmission error."""

import shutil
import subprocess
import tempfile
from collections.abc import Callable
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.io import loadmat, savemat

from tools.peers.numpy_model import MOVING, PAIR, NumpyModel, numpy_rates
from tribodyn.dynamics.parameters import Model
from tribodyn.kernels.native import packed
from tribodyn.solve.integrator import Status
from tribodyn.solve.right_hand_side import rhs, work_array
from tribodyn.solve.tolerances import StepTolerances, tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.train.structure import rotational_error

Array = Any


class Problem(NamedTuple):
    """What all of them solve: CYCLES mesh cycles from a state, sampled."""

    model: Model
    state: Array
    cycles: int
    samples: int

    def tolerances(self, rtol: float) -> StepTolerances:
        """StepTolerances scaled to the case, the same for every program."""
        return tolerances_from(self.model, self.state, rtol, 10**6)

    def segments(self) -> list[tuple[int, float, float, Array]]:
        """Segments of one mesh cycle: number, both ends and the phases to sample."""
        boundary = np.asarray(self.model.meshes[0].table.boundary)
        at = np.arange(self.samples) / self.samples
        return [
            (k, float(a), float(b), at[(at >= a) & (at < b)]) for k, (a, b) in enumerate(pairwise(boundary))
        ]


Runner = Callable[[Problem, float], Array]


class Program(NamedTuple):
    """A program of the comparison: how it runs, and the right-hand side that it brings along, or None.

    `run` takes problem and relative tolerance and returns samples of the transmission error, m, of several
    meshes in rows; it raises RuntimeError where it gives up. `rates` are as of `numpy_model.difference`.
    """

    run: Runner
    rates: Callable[[Model, Array, Array], Array] | None = None


def tribodyn_engine(method: str) -> Runner:
    """One of tribodyn's own engines."""

    def run(problem: Problem, rtol: float) -> Array:
        integrator = make_integrator(method, problem.model, problem.samples, problem.tolerances(rtol))
        part = integrator.integrate(problem.state, 0, problem.cycles)
        if part.status != Status.DONE:
            raise RuntimeError(f"{method}: {part.message or part.status}")
        errors = [
            rotational_error(part.samples, mesh, problem.model) for mesh in range(len(problem.model.meshes))
        ]
        return np.stack(errors) if len(errors) > 1 else errors[0]

    return run


def scipy_on_numpy(method: str) -> Runner:
    """SciPy on the NumPy model, restarted at every engagement."""

    def run(problem: Problem, rtol: float) -> Array:
        function = NumpyModel(problem.model)
        atol = problem.tolerances(rtol).atol[MOVING]
        y = problem.state[MOVING].copy()
        samples = []
        for _ in range(problem.cycles):
            for segment, start, end, at in problem.segments():
                given = {"rtol": rtol, "atol": atol, "t_eval": np.append(at, end), "args": (segment,)}
                solution = solve_ivp(function, (start, end), y, method=method, **given)
                if not solution.success:
                    raise RuntimeError(f"{method}: {solution.message}")
                samples.append(-function.gear_radius * solution.y[4, :-1])
                y = solution.y[:, -1]
        return np.concatenate(samples)

    return run


def cvode(problem: Problem, rtol: float) -> Array:
    """CVODE's BDF through scikit-sundae, on tribodyn's compiled right-hand side."""
    from sksundae.cvode import CVODE  # pyright: ignore[reportMissingImports]

    model = problem.model
    work, radius = work_array(model), float(model.meshes[0].driven_radius)
    atol = problem.tolerances(rtol).atol[MOVING]
    y = problem.state[MOVING].copy()
    samples = []
    for cycle in range(problem.cycles):
        for segment, start, end, at in problem.segments():
            # of three or more times the solver reports exactly these
            times = np.unique(np.concatenate([[start], at, [end]]))
            function = _right_hand_side(model, work, float(cycle), segment)
            solver = CVODE(function, method="BDF", rtol=rtol, atol=atol, max_num_steps=10**6)
            solution = solver.solve(times, y)
            if not solution.success:
                raise RuntimeError(f"CVODE: {solution.message}")
            samples.append(-radius * solution.y[np.isin(times, at), 4])
            y = solution.y[-1].copy()
    return np.concatenate(samples)


def _right_hand_side(model: Model, work: Array, cycle: float, segment: int) -> Callable[..., None]:
    full, rates = np.zeros(PAIR.states), np.zeros(PAIR.states)
    items = [packed(item) for item in (full, model, work, rates)]

    def function(t: float, y: Array, out: Array) -> None:
        full[MOVING] = y
        rhs(t, cycle, segment, *items)
        out[:] = rates[MOVING]

    return function


def octave(problem: Problem, rtol: float) -> Array:
    """Octave's ode15s on the model in Octave; times itself, so that its start does not count."""
    return octave_timed(problem, rtol)[0]


def octave_timed(problem: Problem, rtol: float) -> tuple[Array, float]:
    """Samples, and the seconds that Octave took for the integration alone."""
    given = {
        "y0": problem.state[MOVING][:, None],
        "rtol": rtol,
        "atol": problem.tolerances(rtol).atol[MOVING],
        "cycles": float(problem.cycles),
        "samples": float(problem.samples),
    }
    output = _in_octave(problem.model, given)
    return output["xi"].ravel(), float(output["seconds"].item())


def octave_rates(model: Model, phases: Array, states: Array) -> Array:
    """Derivatives of the ten moving states at given phases by the model in Octave: (time, 10)."""
    segment = [NumpyModel(model).segment(phase) + 1.0 for phase in phases]
    return _in_octave(model, {"phase": phases, "states": states.T, "segment": segment})["rates"].T


def _in_octave(model: Model, given: dict[str, Any]) -> dict[str, Any]:
    numpy_model = NumpyModel(model)
    numbers = {
        name: np.asarray(value, dtype=float)
        for part in (numpy_model.s, numpy_model.c)
        for name, value in part._asdict().items()
        if np.ndim(value) == 0
    }
    numbers |= {name: float(getattr(numpy_model.t, name)) for name in ("face_width", "pitch_angle")}
    derived = "w omega rate dynamic reversed_at material asperity rough gear_radius mesh_damping"
    derived += " gear_inertia load_torque"
    numbers |= {name: float(getattr(numpy_model, name)) for name in derived.split()}
    numbers |= {name: getattr(numpy_model, name)[:, None] for name in ("masses", "springs", "dampers")}
    channel, stiffness = (np.empty(len(numpy_model.pairs), dtype=object) for _ in range(2))
    for segment in range(len(numpy_model.pairs)):
        channel[segment], stiffness[segment] = numpy_model.channel[segment], numpy_model.stiffness[segment]
    case = {"p": numbers, "channel": channel, "stiffness": stiffness, "boundary": numpy_model.boundary}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        savemat(folder / "case.mat", case | given)
        script = Path(__file__).with_name("gear_pair.m")
        command = ["octave-cli", "--quiet", "--no-init-file", str(script), str(folder)]
        subprocess.run(command, check=True, capture_output=True, text=True)
        return loadmat(folder / "found.mat")


def peers_on_trains() -> dict[str, Program]:
    """Programs that take the compiled right-hand side of any train, ours first."""
    programs = {f"tribodyn {name}": Program(tribodyn_engine(name)) for name in ("dopri5", "rodas4")}
    for name in ("BDF", "LSODA", "DOP853"):
        programs[f"SciPy {name}, numba"] = Program(tribodyn_engine(name.lower()))
    return programs


def peers() -> dict[str, Program]:
    """All programs that can be run here, ours first."""
    programs = peers_on_trains()
    for name in ("BDF", "LSODA"):
        programs[f"SciPy {name}, NumPy"] = Program(scipy_on_numpy(name), numpy_rates)
    for name in ("Tsit5", "Dopri8", "Kvaerno5"):
        programs[f"diffrax {name}"] = Program(tribodyn_engine(name.lower()))
    if find_spec("sksundae"):
        programs["CVODE BDF, numba"] = Program(cvode)
    if shutil.which("octave-cli"):
        programs["Octave ode15s"] = Program(octave, octave_rates)
    return programs
