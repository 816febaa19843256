"""The methods of integration, by the names that a scenario gives them; a file for each native one.

What runs a method is imported when it is used: JAX and SciPy take long to import.
"""

from dataclasses import dataclass
from enum import StrEnum
from importlib import import_module
from typing import Any, Literal, NamedTuple

from tribodyn.errors import unknown_name


class Runs(StrEnum):
    """What runs a method: kernels of our own, SciPy's solvers, or diffrax through JAX."""

    NATIVE = "native"
    SCIPY = "scipy"
    JAX = "jax"


class Entry(NamedTuple):
    """A method: what it is, in a line, and what runs it."""

    about: str
    runs: Runs


METHODS = {
    "dopri5": Entry("Dormand-Prince 5(4), native kernel", Runs.NATIVE),
    "switching": Entry("dopri5, and rodas4 where the mesh cycle is stiff, native", Runs.NATIVE),
    "tsit5": Entry("Tsitouras 5(4), diffrax", Runs.JAX),
    "dopri8": Entry("Dormand-Prince 8(7), diffrax", Runs.JAX),
    "kvaerno5": Entry("Kvaerno 5(4), implicit, diffrax", Runs.JAX),
    "rodas4": Entry("Rodas4P 4(3), Rosenbrock, native", Runs.NATIVE),
    "radau": Entry("Radau IIA 5, implicit, SciPy", Runs.SCIPY),
    "bdf": Entry("backward differentiation, implicit, SciPy", Runs.SCIPY),
    "lsoda": Entry("Adams/BDF with switching, SciPy", Runs.SCIPY),
    "dop853": Entry("Dormand-Prince 8(5,3), SciPy", Runs.SCIPY),
}
AUTO = "auto"
#: Among these "auto" chooses, see `choice`; batches in lanes run the explicit one.
EXPLICIT, STIFF, SWITCHING = "dopri5", "rodas4", "switching"
#: And of these in runs by time.
IN_TIME, IN_TIME_STIFF = EXPLICIT, "lsoda"
#: What a scenario may say, with a line on each.
SOLVERS = {
    AUTO: "explicit or stiff by an estimate; the record says which and why",
    **{name: entry.about for name, entry in METHODS.items()},
}
#: Which class makes an integrator of a method, given its name.
_INTEGRATORS = {
    Runs.NATIVE: "tribodyn.solve.march.marching:NativeIntegrator",
    Runs.SCIPY: "tribodyn.solve.scipy_integrator:ScipyIntegrator",
    Runs.JAX: "tribodyn.solve.jax.integrator:DiffraxIntegrator",
}


@dataclass(frozen=True)
class SolverData:
    """Method, relative tolerance, mesh cycles to run, steps allowed per cycle, and where the run starts.

    With a `duration` (s) the run is by time, and its cycles are those of nominal speed.
    """

    method: str = "auto"
    rtol: float = 1e-6
    cycles: int = 20
    max_steps: int = 1_000_000
    initial: Literal["static", "unloaded"] = "static"
    duration: float | None = None


def solver(name: str) -> str:
    """Return the solver's name if there is one of that name."""
    if name not in SOLVERS:
        raise unknown_name("solver.method", name, SOLVERS, "solver")
    return name


def runs(name: str) -> Runs | None:
    """What runs a method; None for "auto", which is not yet decided."""
    return METHODS[name].runs if name in METHODS else None


def in_time(name: str) -> bool:
    """Whether a method runs by time too."""
    return name == IN_TIME or runs(name) is Runs.SCIPY


def integrator_class(name: str) -> Any:
    """The class of integrators that runs a method; takes its name, model, samples and tolerances."""
    module, _, attribute = _INTEGRATORS[METHODS[name].runs].partition(":")
    return getattr(import_module(module), attribute)
