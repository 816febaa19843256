"""Reported quantities of a gear pair's dynamics, how far to trust them, and what a sweep records."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.numerics.parameter import Variable, flag
from tribodyn.post.report import on_closures, on_energy, on_methods
from tribodyn.quantities.catalogue import QUANTITIES, quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record
from tribodyn.record.sweep_schema import WORD, SweepLayout
from tribodyn.solve.orbit.motions import MAX_PERIOD
from tribodyn.studies.gears.case import ENERGY, TEMPERATURE, TEMPERATURE_SWEPT, TRIBOLOGY
from tribodyn.studies.protocol.cost import variable_bytes
from tribodyn.studies.sweeping import branches
from tribodyn.train.structure import TrainLayout

#: `stable`, where the linearised motion was not looked at.
UNKNOWN = -1
#: One number per case, from its steady window.
SWEPT = (
    *quantities(
        *("mesh_frequency", "transmission_error_rms", "transmission_error_peak_to_peak"),
        "transmission_error_mean",
        *("dynamic_factor", "normal_load_max", "hertz_pressure_max"),
        *("film_min", "film_parameter_min", "flash_temperature_max", "friction_coefficient_mean"),
        *("efficiency", "power_in_mean", "power_friction_mean", "friction_work_on_vibration"),
    ),
    *TEMPERATURE_SWEPT,
    *quantities("contact_loss_fraction", "closure_in_range_fraction", "friction_in_range_fraction"),
)

#: Quantities that are kept of unstable motions too.
UNSTABLE_QUANTITIES = (
    *("transmission_error_rms", "transmission_error_peak_to_peak", "dynamic_factor", "contact_loss_fraction"),
    "film_min",
)

#: Everything a sweep records of a case.
CASES: dict[str, Variable] = {
    **{quantity.name: quantity.variable() for quantity in SWEPT},
    "period": Variable((), "1", "mesh cycles in one period of the motion; 0: it has none", "<i4", 0),
    "stable": flag(
        (),
        "whether the periodic motion is stable: 1 yes, 0 no, -1 not periodic, or not known",
        "unknown unstable stable",
    ),
    "multiplier_max": Variable((), "1", "maximum modulus of the Floquet multipliers"),
    "residual": Variable((), "1", "scaled change of the state over one period of the motion"),
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

#: What it records of the unstable motions beyond the ends of branches, see `sweeping.branches`.
UNSTABLE: dict[str, Variable] = {
    **branches.UNSTABLE_VARIABLES,
    **{
        branches.PREFIX + name: CASES[name]._replace(
            dims=("end", "motion"), long_name=f"{CASES[name].long_name}, of an unstable motion"
        )
        for name in UNSTABLE_QUANTITIES
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
STATE_VARIABLE = Variable(("state_variable",), "1", "state of the model, see tribodyn.train.structure")
#: Those of a pair with a motor behind a shaft, as `train.structure.Layout` has them.
STATE_NAMES = (
    *("x_p", "y_p", "lag", "x_g", "y_g", "turn_g", "turn_m"),
    *("vx_p", "vy_p", "slip", "vx_g", "vy_g", "spin_g", "spin_m"),
    *("work_in", "work_out", "work_damping", "work_parametric", "work_friction", "work_sliding"),
)
_OF_MOTOR = ("turn_m", "spin_m")


def state_places(layout: TrainLayout) -> list[int]:
    """Places of a pair's states among `STATE_NAMES`; without a shaft those of the motor are NaN."""
    motor = layout.bodies > 2
    return [i for i, name in enumerate(STATE_NAMES) if motor or name not in _OF_MOTOR]


def row_bytes(settings: Any) -> float:
    """Bytes of a case in the record of a sweep with these `evaluate.Settings`."""
    # sizes without the scales: as many samples may be asked for as no memory holds
    layout = layout_of(settings._replace(samples=1, points=1))
    sizes = {name: len(values) for name, (_, values) in layout.scales.items()}
    sizes |= {"sample": settings.window * settings.samples, "cycle": settings.points}
    return variable_bytes(layout.variables.values(), sizes)


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
        scales["end"] = branches.END, np.arange(1, branches.ENDS + 1)
    if settings.unstable:
        scales["motion"] = branches.MOTION, np.arange(1, branches.MOTIONS + 1)
        scales["return"] = RETURN, np.arange(1, MAX_PERIOD + 1)
    ends = branches.END_VARIABLES if settings.followed else {}
    variables = CASES | ends | (UNSTABLE if settings.unstable else {})
    return SweepLayout(variables, scales, {"samples_per_cycle": settings.samples})


REPORTED: Reported = {
    "Geometry": quantities("contact_ratio", "normal_backlash", "stiffness_single_pair_at_pitch_point"),
    "Dynamics": quantities(
        *("mesh_frequency", "transmission_error_mean", "transmission_error_rms"),
        *("transmission_error_peak_to_peak", "transmission_error_harmonics"),
        *("transmission_error_normal_mean", "transmission_error_normal_peak_to_peak"),
        *("mesh_stiffness_mean", "mesh_stiffness_peak_to_peak", "normal_load_max"),
        *("dynamic_factor", "dynamic_factor_iso", "resonance_ratio_iso", "contact_loss_fraction"),
    ),
    "Tribology": TRIBOLOGY,
    "Energy": ENERGY,
    "Temperature": TEMPERATURE,
    "Solver": quantities("solver", "steps", "rhs_evaluations", "wall_time"),
}

#: What a sweep prints, minimum and maximum of each.
SWEEP_TABLE = quantities(
    *("transmission_error_rms", "transmission_error_peak_to_peak", "dynamic_factor", "normal_load_max"),
    *("hertz_pressure_max", "film_min", "efficiency", "friction_work_on_vibration", "contact_loss_fraction"),
)


#: Relative difference between the extremes of the whole run and those of its last cycles that is said.
DIFFERENT = 0.005

SHORT = {"peak_to_peak": "transmission_error_peak_to_peak", "loss": "power_friction_mean"}

PANELS = (
    *("transmission_error_rotational", "normal_load", "central_film_thickness"),
    *("friction_coefficient", "power_friction"),
)


def on_extremes(summary: Mapping[str, Any]) -> list[str]:
    """Say which extremes of the whole run, or of its last mesh cycles, are not those of the table."""
    described = summary.get("extremes")
    if not described:  # a record of 0.1.0, or of a run that stopped at once
        return []
    said = []
    for part, words in (("run", "Over the whole run"), ("last_cycles", "Over the last mesh cycles")):
        others = []
        for quantity in (QUANTITIES["normal_load_max"], *TRIBOLOGY):
            known, value = described.get(part, {}).get(quantity.name), summary.get(quantity.name)
            if known is None or value is None or not abs(known["value"] - value) > DIFFERENT * abs(value):
                continue
            name = quantity.title[0].lower() + quantity.title[1:]
            at = f" at t = {known['time']:.4g} s" if part == "run" and "time" in known else ""
            others.append(f"{name} {quantity.with_unit(known['value'])}" + at)
        if others:
            said.append(f"{words}: {', '.join(others)}.")
    return said


def sentences(record: Record) -> list[str]:
    """Say how well the run satisfies what can be checked: range of the film law, balance of energy."""
    summary = record.summary
    return [*on_methods(summary), *on_extremes(summary), *on_closures(summary), *on_energy(summary)]
