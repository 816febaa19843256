"""The layout of a sweep's record: its axes are the varied parameters, its datasets hold a value a case."""

from enum import IntEnum
from typing import NamedTuple

from tribodyn.record.schema import Variable

SWEEP = "sweep"


class CaseStatus(IntEnum):
    """`status` of a case, as the file has it."""

    WAITING = 0
    DONE = 1
    FAILED = 2


WAITING, DONE, FAILED = CaseStatus
CASE_STATES = " ".join(status.name.lower() for status in CaseStatus)
#: `stable`, where the linearised motion was not looked at.
UNKNOWN = -1
DIRECTIONS = ("up", "down")

#: Bytes kept of a message and of a word.
MESSAGE, WORD = 240, 24


class CaseVariable(NamedTuple):
    """A dataset over the cases.

    Attributes
    ----------
    inner : tuple of str
        Dimensions after those of the cases.
    units, long_name : str
    dtype : str
        Type in the file, as NumPy names it.
    fill : object
        Stands where nothing was written.
    """

    inner: tuple[str, ...]
    units: str
    long_name: str
    dtype: str = "<f8"
    fill: object = float("nan")

    def over(self, cases: tuple[str, ...]) -> Variable:
        """The dataset with the dimensions of a sweep's cases."""
        return Variable((*cases, *self.inner), self.units, self.long_name)


def _figure(units: str, long_name: str) -> CaseVariable:
    return CaseVariable((), units, long_name)


#: One number a case, out of its steady window.
FIGURES: dict[str, CaseVariable] = {
    "mesh_frequency": _figure("Hz", "mean mesh frequency"),
    "transmission_error_rms": _figure(
        "m", "root mean square of the rotational transmission error about its mean"
    ),
    "transmission_error_peak_to_peak": _figure("m", "rotational transmission error, peak to peak"),
    "transmission_error_mean": _figure("m", "mean rotational transmission error"),
    "dynamic_factor": _figure("1", "greatest mesh moment over the mean load's"),
    "normal_load_max": _figure("N", "greatest normal load of a pair"),
    "hertz_pressure_max": _figure("Pa", "greatest Hertz pressure"),
    "film_min": _figure("m", "least central film thickness"),
    "film_parameter_min": _figure("1", "least film parameter"),
    "flash_temperature_max": _figure("K", "greatest flash temperature rise"),
    "friction_coefficient_mean": _figure("1", "friction coefficient, mean by loss"),
    "efficiency": _figure("1", "efficiency over whole mesh cycles"),
    "power_in_mean": _figure("W", "mean power of the drive"),
    "power_friction_mean": _figure("W", "mean power lost to tooth friction"),
    "contact_loss_fraction": _figure("1", "share of the time without any contact"),
    "closure_in_range_fraction": _figure("1", "share of the contact in which the film law is in its range"),
}

#: Everything a sweep records of a case. `status` is written last: what it calls done is there.
CASES: dict[str, CaseVariable] = {
    **FIGURES,
    "period": CaseVariable((), "1", "mesh cycles in one period of the motion; 0: none found", "<i4", 0),
    "stable": CaseVariable((), "1", "whether the motion is stable: 1 yes, 0 no, -1 not known", "i1", UNKNOWN),
    "multiplier_max": _figure("1", "greatest modulus of the Floquet multipliers"),
    "residual": _figure("1", "scaled change of the state over one period of the motion"),
    "cycles": CaseVariable((), "1", "mesh cycles integrated", "<i8", 0),
    "solution": CaseVariable((), "1", "sort of motion that was found", f"S{WORD}", b""),
    "transmission_error_rotational": CaseVariable(
        ("sample",), "m", "rotational transmission error in the steady window; NaN beyond whole periods"
    ),
    "poincare_error": CaseVariable(
        ("cycle",), "m", "rotational transmission error at the start of each of the last mesh cycles"
    ),
    "poincare_rate": CaseVariable(
        ("cycle",), "m/s", "rate of the rotational transmission error at the start of each mesh cycle"
    ),
    "mode_frequency": CaseVariable(
        ("mode",), "Hz", "undamped natural frequency of the model linearised at its mean mesh stiffness"
    ),
    "state": CaseVariable(
        ("state_variable",), "SI", "state at the start of a mesh cycle, from which a neighbour continues"
    ),
    "message": CaseVariable((), "1", "why a case failed, or what is to be said of it", f"S{MESSAGE}", b""),
    "status": CaseVariable((), "1", "state of the case: 0 waiting, 1 done, 2 failed", "i1", WAITING),
}

#: The scales after those of the cases.
SAMPLE = Variable(("sample",), "1", "phase of the mesh in mesh cycles, from the start of the window")
CYCLE = Variable(("cycle",), "1", "mesh cycle, counted from the first that was kept")
MODE = Variable(("mode",), "1", "mode of vibration, lowest first")
STATE_VARIABLE = Variable(("state_variable",), "1", "state of the model, see tribodyn.dynamics.parameters")
DIRECTION = Variable(
    ("direction",),
    "1",
    "sense in which the first parameter went from case to case, each from the last's state",
)
STATES = (
    *("x_p", "y_p", "x_g", "y_g", "lag", "xi", "twist"),
    *("vx_p", "vy_p", "vx_g", "vy_g", "slip", "xi_rate", "motor_slip"),
    *("work_in", "work_out", "work_friction", "work_damping", "work_parametric"),
)
