"""What the record of a sweep of motions has: quantities, samples, sections and states of every case."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.cases.cost import variable_bytes
from tribodyn.numerics.parameter import Variable, flag
from tribodyn.quantities.quantity import Quantity
from tribodyn.record.sweep_schema import WORD, SweepLayout
from tribodyn.solve.orbit.motions import MAX_PERIOD
from tribodyn.studies.protocol import branches

#: `stable`, where the linearised motion was not looked at.
UNKNOWN = -1
#: Quantities that are kept of unstable motions too.
UNSTABLE_QUANTITIES = (
    *("transmission_error_rms", "transmission_error_peak_to_peak", "dynamic_factor", "contact_loss_fraction"),
    "film_min",
)

#: Everything a sweep records of a case beside the quantities of its kind.
CASES: dict[str, Variable] = {
    "period": Variable(
        (), "1", "mesh cycles, of several meshes common periods, in one period; 0: it has none", "<i4", 0
    ),
    "stable": flag(
        (),
        "whether the periodic motion is stable: 1 yes, 0 no, -1 not periodic, or not known",
        "unknown unstable stable",
    ),
    "multiplier_max": Variable((), "1", "maximum modulus of the Floquet multipliers"),
    "residual": Variable((), "1", "scaled change of the state over one period of the motion"),
    "cycles": Variable((), "1", "mesh cycles integrated, of several meshes of the first", "<i8", 0),
    "solution": Variable((), "1", "sort of motion that was found", f"S{WORD}", b""),
    "transmission_error_rotational": Variable(
        ("sample",), "m", "rotational transmission error in the steady window; NaN beyond whole periods"
    ),
    "poincare_error": Variable(
        ("cycle",), "m", "rotational transmission error at the start of each of the last mesh cycles"
    ),
    "poincare_rate": Variable(
        ("cycle",), "m/s", "rate of the rotational transmission error at the start of each mesh cycle"
    ),
    "mode_frequency": Variable(
        ("mode",), "Hz", "undamped natural frequency of the model linearised at its mean mesh stiffness"
    ),
    "state": Variable(
        ("state_variable",), "SI", "state at the start of a mesh cycle, from which a neighbour continues"
    ),
}
#: Of the unstable motions beyond the ends of branches, beside quantities, see `protocol.branches`.
_ERROR_OF_UNSTABLE = Variable(
    ("end", "motion", "return"),
    "m",
    "rotational transmission error at the start of the mesh cycles of an unstable motion",
)

#: Those of every mesh where there are several.
_OVER_MESHES = (
    *("transmission_error_rotational", "poincare_error", "poincare_rate"),
    "unstable_poincare_error",
)

#: The scales after those of the cases.
SAMPLE = Variable(("sample",), "1", "phase of the mesh in mesh cycles, from the start of the window")
CYCLE = Variable(
    ("cycle",), "1", "mesh cycle, of several meshes of the first, counted from the first that was kept"
)
COMMON_CYCLE = Variable(("cycle",), "1", "common period of a case's meshes, counted from the first kept")
COMMON_PERIOD = Variable(
    (), "1", "mesh cycles of the first mesh after which all meshes are at their phases again", "<i4", 0
)
MODE = Variable(("mode",), "1", "mode of vibration, lowest first")
RETURN = Variable(("return",), "1", "mesh cycle of an unstable motion")
STATE_VARIABLE = Variable(("state_variable",), "1", "state of the model, see tribodyn.train.structure")
MESH = Variable(("mesh",), "1", "mesh of the train")


class SweepSettings(NamedTuple):
    """How every case of a sweep is brought to its window."""

    steady: bool  # whether the periodic motion is sought; otherwise `cycles` mesh cycles are marched
    cycles: int  # mesh cycles to march, or at most to march in search of the steady state
    window: int  # mesh cycles that the quantities are taken from
    points: int  # points of the Poincaré section, one per common period
    samples: int  # samples in a mesh cycle
    modes: int
    states: tuple[str, ...]  # names of the states
    method: str = ""  # integration method instead of the scenario's; empty for the scenario's own
    #: whether steady motions are followed from case to case, to the ends of their branches
    followed: bool = False
    unstable: bool = False  # whether branches are continued beyond these
    common: int = 1  # mesh cycles after which all meshes are at their phases again, of all cases the most
    periods_differ: bool = False  # whether these are not the same for all cases
    meshes: tuple[str, ...] = ()  # names of several meshes
    planetary: bool = False  # whether a case has planetary stages

    def window_of(self, period: int) -> int:
        """Mesh cycles of the window of a case of a common period: whole periods where one fits."""
        return self.window // period * period or self.window


def layout_of(
    settings: SweepSettings, swept: Sequence[Quantity], of_meshes: Mapping[str, Variable]
) -> SweepLayout:
    """The layout of a sweep; `of_meshes` are datasets over several meshes."""
    phase = np.arange(settings.window * settings.samples) / settings.samples
    scales = {
        "sample": (SAMPLE, phase),
        "cycle": (COMMON_CYCLE, np.arange(settings.points))
        if settings.periods_differ
        else (CYCLE, settings.common * np.arange(settings.points)),
        "mode": (MODE, np.arange(1, settings.modes + 1)),
        "state_variable": (STATE_VARIABLE, settings.states),
    }
    variables = {quantity.name: quantity.variable() for quantity in swept} | CASES
    if settings.periods_differ:
        variables["common_period"] = COMMON_PERIOD
    if settings.meshes:
        scales["mesh"] = MESH, settings.meshes
        variables |= of_meshes
    if settings.followed:
        scales["end"] = branches.END, np.arange(1, branches.ENDS + 1)
        variables |= branches.END_VARIABLES
    if settings.unstable:
        scales["motion"] = branches.MOTION, np.arange(1, branches.MOTIONS + 1)
        scales["return"] = RETURN, np.arange(1, MAX_PERIOD + 1)
        variables |= branches.UNSTABLE_VARIABLES
        variables |= {
            branches.PREFIX + name: variables[name]._replace(
                dims=("end", "motion"), long_name=f"{variables[name].long_name}, of an unstable motion"
            )
            for name in UNSTABLE_QUANTITIES
        }
        variables["unstable_poincare_error"] = _ERROR_OF_UNSTABLE
    if len(settings.meshes) > 1:
        for name in variables.keys() & _OVER_MESHES:
            variables[name] = variables[name]._replace(dims=("mesh", *variables[name].dims))
    return SweepLayout(variables, scales, {"samples_per_cycle": settings.samples})


def row_bytes(layout: SweepLayout, settings: SweepSettings) -> float:
    """Bytes of a case in the record of a sweep; `layout` is that of one sample and one point of a section."""
    sizes = {name: len(values) for name, (_, values) in layout.scales.items()}
    sizes |= {"sample": settings.window * settings.samples, "cycle": settings.points}
    return variable_bytes(layout.variables.values(), sizes)


def state_names(
    bodies: Sequence[str], planar: int, meshes: Sequence[str], spatial: int = 0, further: int = 0
) -> tuple[str, ...]:
    """Names of the states, see `train.structure`; works of a mesh without a name have none behind them.

    `further` is the number of coordinates of no body.
    """
    displacement, rate = [], []
    for b, body in enumerate(bodies):
        if b < planar:
            displacement += [f"x_{body}", f"y_{body}"]
            rate += [f"vx_{body}", f"vy_{body}"]
        displacement.append(f"turn_{body}" if b else "lag")
        rate.append(f"spin_{body}" if b else "slip")
    displacement += [f"{name}_{body}" for body in bodies[:spatial] for name in ("z", "tilt_x", "tilt_y")]
    rate += [f"{name}_{body}" for body in bodies[:spatial] for name in ("vz", "spin_x", "spin_y")]
    displacement += [f"wave_{number}" for number in range(1, further + 1)]
    rate += [f"vwave_{number}" for number in range(1, further + 1)]
    works = ["work_in", "work_out", "work_damping", "work_parametric"]
    works += [f"work_{what}_{mesh}".rstrip("_") for mesh in meshes for what in ("friction", "sliding")]
    return *displacement, *rate, *works
