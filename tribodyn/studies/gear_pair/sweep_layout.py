"""What a sweep records of every case of a gear pair's dynamics."""

from typing import Any

import numpy as np

from tribodyn.numerics.variable import Variable, flag
from tribodyn.record.sweep_schema import OF_EVERY_SWEEP, WORD, SweepLayout
from tribodyn.solve.orbit.motions import MAX_PERIOD
from tribodyn.studies.gears.temperature import THERMAL_FIGURES
from tribodyn.studies.protocol.estimate import variable_bytes
from tribodyn.studies.sweeping import ends, unstable

#: `stable`, where the linearised motion was not looked at.
UNKNOWN = -1


def _figure(units: str, long_name: str) -> Variable:
    return Variable((), units, long_name)


#: One number per case, from its steady window.
FIGURES: dict[str, Variable] = {
    "mesh_frequency": _figure("Hz", "mean mesh frequency"),
    "transmission_error_rms": _figure(
        "m", "root mean square of the rotational transmission error about its mean"
    ),
    "transmission_error_peak_to_peak": _figure("m", "rotational transmission error, peak to peak"),
    "transmission_error_mean": _figure("m", "mean rotational transmission error"),
    "dynamic_factor": _figure("1", "maximum mesh moment over the mean load's"),
    "normal_load_max": _figure("N", "maximum normal load of a pair"),
    "hertz_pressure_max": _figure("Pa", "maximum Hertz pressure"),
    "film_min": _figure("m", "minimum central film thickness"),
    "film_parameter_min": _figure("1", "minimum film parameter"),
    "flash_temperature_max": _figure("K", "maximum flash temperature rise"),
    "friction_coefficient_mean": _figure("1", "friction coefficient, mean by loss"),
    "efficiency": _figure("1", "efficiency over whole mesh cycles"),
    "power_in_mean": _figure("W", "mean power that the driving gear puts in"),
    "power_friction_mean": _figure("W", "mean power lost to tooth friction"),
    "friction_work_on_vibration": _figure(
        "1", "work of friction on the vibration over the loss that the rotation alone has; > 0: fed"
    ),
    **THERMAL_FIGURES,
    "contact_loss_fraction": _figure("1", "share of the time without any contact"),
    "closure_in_range_fraction": _figure("1", "share of the contact in which the film law is in its range"),
    "friction_in_range_fraction": _figure(
        "1", "share of the contact in which the friction law is in its range"
    ),
}

#: Figures that are kept of unstable motions too.
UNSTABLE_FIGURES = (
    "transmission_error_rms",
    "transmission_error_peak_to_peak",
    "dynamic_factor",
    "contact_loss_fraction",
    "film_min",
)

#: Everything a sweep records of a case.
CASES: dict[str, Variable] = {
    **FIGURES,
    "period": Variable((), "1", "mesh cycles in one period of the motion; 0: it has none", "<i4", 0),
    "stable": flag(
        (),
        "whether the periodic motion is stable: 1 yes, 0 no, -1 not periodic, or not known",
        "unknown unstable stable",
    ),
    "multiplier_max": _figure("1", "maximum modulus of the Floquet multipliers"),
    "residual": _figure("1", "scaled change of the state over one period of the motion"),
    "cycles": Variable((), "1", "mesh cycles integrated", "<i8", 0),
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

#: What it records of the unstable motions beyond the ends of branches, see `sweeping.unstable`.
UNSTABLE: dict[str, Variable] = {
    **unstable.VARIABLES,
    **{
        unstable.PREFIX + name: FIGURES[name]._replace(
            dims=("end", "motion"), long_name=f"{FIGURES[name].long_name}, of an unstable motion"
        )
        for name in UNSTABLE_FIGURES
    },
    "unstable_poincare_error": Variable(
        ("end", "motion", "return"),
        "m",
        "rotational transmission error at the start of the mesh cycles of an unstable motion",
    ),
}

#: The scales after those of the cases.
SAMPLE = Variable(("sample",), "1", "phase of the mesh in mesh cycles, from the start of the window")
CYCLE = Variable(("cycle",), "1", "mesh cycle, counted from the first that was kept")
MODE = Variable(("mode",), "1", "mode of vibration, lowest first")
RETURN = Variable(("return",), "1", "mesh cycle of an unstable motion")
STATE_VARIABLE = Variable(("state_variable",), "1", "state of the model, see tribodyn.dynamics.parameters")
STATE_NAMES = (
    *("x_p", "y_p", "x_g", "y_g", "lag", "xi", "twist"),
    *("vx_p", "vy_p", "vx_g", "vy_g", "slip", "xi_rate", "motor_slip"),
    *("work_in", "work_out", "work_friction", "work_damping", "work_parametric", "work_sliding"),
)


def row_bytes(settings: Any) -> float:
    """Bytes of a case in the record of a sweep with these `evaluate.Settings`."""
    sizes = {
        "sample": settings.window * settings.samples,
        "cycle": settings.points,
        "mode": settings.modes,
        "state_variable": len(STATE_NAMES),
        "end": ends.ENDS,
        "motion": unstable.MOTIONS,
        "return": MAX_PERIOD,
    }
    return variable_bytes({**_variables(settings), **OF_EVERY_SWEEP}.values(), sizes)


def _variables(settings: Any) -> dict[str, Variable]:
    """What is recorded of every case."""
    return CASES | (ends.VARIABLES if settings.followed else {}) | (UNSTABLE if settings.unstable else {})


def layout_of(settings: Any) -> SweepLayout:
    """The layout of a sweep with these `evaluate.Settings`."""
    phase = np.arange(settings.window * settings.samples) / settings.samples
    scales = {
        "sample": (SAMPLE, phase),
        "cycle": (CYCLE, np.arange(settings.points)),
        "mode": (MODE, np.arange(1, settings.modes + 1)),
        "state_variable": (STATE_VARIABLE, STATE_NAMES),
    }
    if settings.followed:
        scales["end"] = ends.END, np.arange(1, ends.ENDS + 1)
    if settings.unstable:
        scales["motion"] = unstable.MOTION, np.arange(1, unstable.MOTIONS + 1)
        scales["return"] = RETURN, np.arange(1, MAX_PERIOD + 1)
    return SweepLayout(_variables(settings), scales, {"samples_per_cycle": settings.samples})
