"""Figures of one run: means, extremes, spectrum and the energy balance, from the recorded samples."""

from typing import Any

import numpy as np

from tribodyn.dynamics.parameters import (
    LAG,
    WORK_DAMPING,
    WORK_FRICTION,
    WORK_IN,
    WORK_OUT,
    WORK_PARAMETRIC,
    WORK_SLIDING,
)
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.power_flow import driving_gear, efficiency, power_put_in
from tribodyn.post.spectra import amplitude_spectrum
from tribodyn.tribology.surface_state import fraction_in_range

#: Record name -> (summary name, reduction), over the whole run.
EXTREMES = {
    "normal_load": ("normal_load_max", np.nanmax),
    "central_film_thickness": ("film_min", np.nanmin),
    "film_parameter": ("film_parameter_min", np.nanmin),
    "hertz_pressure": ("hertz_pressure_max", np.nanmax),
    "flash_temperature_rise": ("flash_temperature_max", np.nanmax),
}


#: Share of the loss that friction may give to the vibration before it is said.
FEEDS = 0.01
#: What that means, by `friction.sliding`.
ABOUT_FEEDING = {
    "kinematic": 'which kinematic sliding makes of nothing: use friction.sliding = "dynamic"',
    "dynamic": "taken from the drive: a self-excited vibration",
}


class RunningExtremes:
    """Extremes of a run that arrives in blocks."""

    def __init__(self) -> None:
        self.values: dict[str, float] = {}

    def add(self, block: dict[str, np.ndarray]) -> None:
        """Take a block of samples into account."""
        for name, (key, reduce) in EXTREMES.items():
            if np.all(np.isnan(block[name])):
                continue
            value = float(reduce(block[name]))
            old = self.values.get(key, value)
            self.values[key] = max(old, value) if reduce is np.nanmax else min(old, value)


def energy_residual(first: np.ndarray, last: np.ndarray, stored: float) -> float:
    """Residual of the energy balance over a run, as a share of the largest of the works in it.

    W_in + W_parametric − W_out − W_friction − W_damping − ΔE from the first to the last state; `stored` is
    ΔE, J. The largest is that of the driving gear where power flows through, and that of what takes or feeds
    the energy of a mesh without load.
    """
    works = (last - first)[[WORK_IN, WORK_PARAMETRIC, WORK_OUT, WORK_FRICTION, WORK_DAMPING]]
    missing = works @ [1.0, 1.0, -1.0, -1.0, -1.0] - stored
    return float(missing / max(np.max(np.abs(works)), 1e-300))


def friction_work_on_vibration(work: np.ndarray) -> float | None:
    """Work of friction on the vibration, as a share of the loss that the rotation alone has; > 0: fed.

    What friction takes of the moving bodies, Σ F_f v_rel, is what it would take of bodies that only rotate,
    Σ F_f v_s, less what it gives to the vibration. None without friction.

    Parameters
    ----------
    work : (STATES,)
        Change of the state over whole mesh cycles.
    """
    nominal, taken = float(work[WORK_SLIDING]), float(work[WORK_FRICTION])
    return (nominal - taken) / abs(nominal) if nominal != 0.0 else None


def warning_of(share: float | None, sliding: str) -> str | None:
    """Warn where friction feeds the vibration with more than `FEEDS` of its loss.

    Parameters
    ----------
    share : float or None
        See `friction_work_on_vibration`.
    sliding : {"kinematic", "dynamic"}
        `friction.sliding` of the case.
    """
    if share is None or not share > FEEDS:
        return None
    return (
        f"friction feeds the vibration with more than {100 * FEEDS:g} % of its loss, {ABOUT_FEEDING[sliding]}"
    )


def steady_figures(
    window: dict[str, np.ndarray], work: np.ndarray, cycle: MeshCycle, samples: int, nominal_speed: float
) -> dict[str, Any]:
    """Figures of the last whole mesh cycles of a run.

    Those of loads and of single pairs are of the working flanks: the back flanks where the gear drives.

    Parameters
    ----------
    window : dict
        The record's arrays over whole cycles, last sample not included.
    work : (STATES,)
        Change of the state over them: its works are integrated, so that no mean power depends on the
        sampling.
    cycle : MeshCycle
    samples : int
        Samples per mesh cycle.
    nominal_speed : float
        Of the pinion, rad/s.
    """
    error = window["transmission_error_rotational"]
    load = window["normal_load"]
    friction = np.abs(window["friction_force"])
    sliding = np.abs(np.nan_to_num(window["sliding_speed"]))
    slid, loaded = np.sum(friction * sliding), np.sum(load * sliding)
    touching = load > 0.0
    # by the actual rotation: a driven pinion need not turn at its nominal speed
    cycles = len(error) / samples
    duration = float(cycles * cycle.pitch_angle / nominal_speed + work[LAG])
    frequency = cycles / duration
    orders, amplitudes = amplitude_spectrum(error, samples)
    power_in, power_out, power_friction = work[[WORK_IN, WORK_OUT, WORK_FRICTION]] / duration
    share = friction_work_on_vibration(work)
    torque = power_out / np.mean(window["velocity"][:, -1])
    static = float(abs(torque) / cycle.gear_pitch_radius)
    # a load that is reversed on the mean has driving flanks to work on where there is no backlash
    reversed_flow = torque < 0.0 and np.any(cycle.side < 0)
    working = np.flatnonzero(cycle.side < 0 if reversed_flow else cycle.side > 0)
    # the last slot of either side holds a pair that is on the path of contact all the time
    newest = window["transmission_error"][:, working[-1]]
    arm = np.cos(np.nan_to_num(window["pressure_angle"][:, working]))
    moment = np.sum(load[:, working] * arm, axis=1)
    keep = orders <= 20.0 + 1e-9
    return {
        "averaging_cycles": len(error) // samples,
        "mesh_frequency": frequency,
        "transmission_error_mean": float(np.nanmean(newest)),
        "transmission_error_peak_to_peak": float(np.nanmax(newest) - np.nanmin(newest)),
        "transmission_error_rotational_mean": float(np.mean(error)),
        "transmission_error_rotational_peak_to_peak": float(np.ptp(error)),
        "dynamic_factor": float(np.max(moment) / static) if static > 0 else float("nan"),
        "friction_coefficient_mean": float(slid / loaded) if loaded > 0 else float("nan"),
        "friction_force_mean": np.mean(friction, axis=0),
        "efficiency": float(efficiency(power_in, power_out, power_friction)),
        "friction_work_on_vibration": share,
        "driving_gear": driving_gear(power_in, power_out),
        "power_in_mean": float(power_put_in(power_in, power_out)),
        "power_friction_mean": float(power_friction),
        "closure_in_range_fraction": fraction_in_range(window["closure_in_range"][touching]),
        "friction_in_range_fraction": fraction_in_range(window["friction_in_range"][touching]),
        "contact_loss_fraction": float(np.mean(~np.any(touching, axis=1))),
        "spectrum_frequencies": orders[keep] * frequency,
        "spectrum_amplitudes": amplitudes[keep],
    }
