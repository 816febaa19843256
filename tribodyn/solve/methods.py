"""The methods of integration, by the names that a scenario gives them."""

from tribodyn.errors import unknown_name

SOLVERS = {
    "auto": "explicit or stiff by an estimate; the record says which and why",
    "dopri5": "Dormand-Prince 5(4), native kernel",
    "tsit5": "Tsitouras 5(4), diffrax",
    "dopri8": "Dormand-Prince 8(7), diffrax",
    "kvaerno5": "Kvaerno 5(4), implicit, diffrax",
    "rodas4": "Rodas4P 4(3), Rosenbrock, native",
    "radau": "Radau IIA 5, implicit, SciPy",
    "bdf": "backward differentiation, implicit, SciPy",
    "lsoda": "Adams/BDF with switching, SciPy",
    "dop853": "Dormand-Prince 8(5,3), SciPy",
}


def solver(name: str) -> str:
    """Return the solver's name if there is one of that name."""
    if name not in SOLVERS:
        raise unknown_name("solver.method", name, SOLVERS, "solver")
    return name
