"""Quantities of one run: means, extremes, spectrum, energy balance; whether it lies within its model.

Means are of the recorded samples and of integrated works; extremes of the dense motion, samples included.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly, tip_clearance
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import driving_gear, efficiency, power_put_in, total_stiffness
from tribodyn.post.cycles import amplitude_spectrum
from tribodyn.record.trust import Judge, heat_of
from tribodyn.studies.gear_pair.outputs import MESH
from tribodyn.studies.gear_pair.prepare import PreparedPair
from tribodyn.studies.gears.recorded import pair_numbers
from tribodyn.train.structure import (
    DAMPING,
    FRICTION,
    IN,
    OUT,
    PARAMETRIC,
    SLIDING,
    TrainLayout,
    rotational_error,
    work_of,
    works_of_meshes,
)
from tribodyn.tribology.surface_state import fraction_in_range

#: Summary name -> record name and sign of what is largest there, over the whole run and over its last cycles.
RECORDED = {
    "normal_load_max": ("normal_load", 1),
    "film_min": ("central_film_thickness", -1),
    "film_parameter_min": ("film_parameter", -1),
    "hertz_pressure_max": ("hertz_pressure", 1),
    "flash_temperature_max": ("flash_temperature_rise", 1),
}

#: Mesh orders whose amplitudes of the transmission error are in the summary: 1 to this.
HARMONICS = 5
#: Share of the loss that friction may give to the vibration before it is said.
FEEDS = 0.01
#: What that means, by `friction.sliding`.
ABOUT_FEEDING = {
    "kinematic": 'which kinematic sliding makes of nothing: use friction.sliding = "dynamic"',
    "dynamic": "taken from the drive: a self-excited vibration",
}


#: Prefix of the names of extremes of the driving flanks (1) and of the back flanks (−1).
WORKING = {1.0: "", -1.0: "back_"}


class Extreme(NamedTuple):
    """An extreme of a run: its value, and where it is."""

    value: float
    time: float  # s
    mesh_cycle: float  # mesh cycles since the start, whole and fraction
    pair: int | None  # number of the pair; None where it is the whole mesh's


class RunningExtremes:
    """Extremes of a run that arrives in blocks of states: samples, and where its dense motion is extreme."""

    def __init__(self, cycle: MeshCycle) -> None:
        self.by_name: dict[str, Extreme] = {}
        sides = np.asarray(cycle.side)
        self._slots = {sign: np.flatnonzero(sides * sign > 0) for sign in WORKING}
        self._pairs = pair_numbers(cycle.front_pairs, np.size(cycle.side))

    def add(self, cycles: np.ndarray, block: dict[str, np.ndarray]) -> None:
        """Take a block into account: mesh cycles since the start, and what is recorded there."""
        if not len(cycles):
            return
        error = block["transmission_error_rotational"]
        for name, (recorded, sign) in RECORDED.items():
            self._add(name, sign, block[recorded], cycles, block["time"])
        for name, sign in (("max", 1), ("min", -1)):
            self._add(f"transmission_error_{name}", sign, error, cycles, block["time"])
        for side, slots in self._slots.items():
            if slots.size:
                flanks, newest = WORKING[side], block["transmission_error_normal"][:, slots[-1]]
                for name, sign in (("max", 1), ("min", -1)):
                    found = f"{flanks}transmission_error_normal_{name}"
                    self._add(found, sign, newest, cycles, block["time"])
                self._add(f"{flanks}mesh_force_max", 1, mesh_force(block, slots), cycles, block["time"])

    def _add(self, name: str, sign: int, values: np.ndarray, cycles: np.ndarray, time: np.ndarray) -> None:
        value = float((np.fmax if sign > 0 else np.fmin).reduce(values, axis=None))  # NaN: nothing there
        old = self.by_name.get(name)
        if sign * value > (-np.inf if old is None else sign * old.value):
            row, *pair = np.unravel_index(int(np.argmax(values == value)), values.shape)
            number = self._pairs[int(pair[0])] if pair else None
            self.by_name[name] = Extreme(value, float(time[row]), float(cycles[row]), number)

    def values(self) -> dict[str, float]:
        """Values of `RECORDED`."""
        return {name: self.by_name[name].value for name in RECORDED if name in self.by_name}

    def where(self, name: str, cycle: MeshCycle) -> dict[str, float]:
        """Roll angle (rad, 0 at the pitch point) at which a driving pair has an extreme, by summary name."""
        extreme = self.by_name.get(name)
        if extreme is None or extreme.pair is None or extreme.pair > 1:
            return {}
        turned = extreme.mesh_cycle % 1.0 + 1 - extreme.pair
        roll = float(cycle.roll_start) + turned * float(cycle.pitch_angle)
        return {f"{name}_roll_angle": roll}

    def described(self) -> dict[str, dict[str, Any]]:
        """All extremes by name, for a summary."""
        return {name: extreme._asdict() for name, extreme in self.by_name.items()}

    def spread(self, name: str) -> float:
        """Maximum less minimum of an error."""
        if f"{name}_max" not in self.by_name:
            return float("nan")
        return self.by_name[f"{name}_max"].value - self.by_name[f"{name}_min"].value


def mesh_force(block: dict[str, np.ndarray], slots: np.ndarray) -> np.ndarray:
    """Force of a side's flanks along the pitch tangent (n,), N: the mesh moment over the pitch radius."""
    angle = np.nan_to_num(block["pressure_angle"][:, slots])
    return np.sum(block["normal_load"][:, slots] * np.cos(angle), axis=1)


def energy_residual(first: np.ndarray, last: np.ndarray, stored: float, layout: TrainLayout) -> float:
    """Residual of the energy balance over a run, as a share of the largest of the works in it.

    W_in + W_parametric − W_out − W_friction − W_damping − ΔE from the first to the last state; `stored` is
    ΔE, J. The largest is that of the driving gear where power flows through, and that of what takes or feeds
    the energy of a mesh without load.
    """
    change = last - first
    friction = float(np.sum(change[works_of_meshes(layout, FRICTION)]))
    of_train = [change[work_of(layout, which)] for which in (IN, PARAMETRIC, OUT)]
    works = np.array([*of_train, friction, change[work_of(layout, DAMPING)]])
    missing = works @ [1.0, 1.0, -1.0, -1.0, -1.0] - stored
    return float(missing / max(np.max(np.abs(works)), 1e-300))


def friction_work_on_vibration(work: np.ndarray, layout: TrainLayout) -> float | None:
    """Work of friction on the vibration, as a share of the loss that the rotation alone has; > 0: fed.

    What friction takes of the moving bodies, Σ F_f v_rel, is what it would take of rotation alone, Σ F_f v_s,
    less what it gives to the vibration. None without friction. `work` is the change of the state over whole
    mesh cycles.
    """
    nominal, taken = (float(np.sum(work[works_of_meshes(layout, which)])) for which in (SLIDING, FRICTION))
    return (nominal - taken) / abs(nominal) if nominal != 0.0 else None


def warning_of(share: float | None, sliding: str) -> str | None:
    """Warn where the share of `friction_work_on_vibration` is above `FEEDS`; `sliding`: the case's."""
    if share is None or not share > FEEDS:
        return None
    return (
        f"friction feeds the vibration with more than {100 * FEEDS:g} % of its loss, {ABOUT_FEEDING[sliding]}"
    )


def steady_quantities(
    window: dict[str, np.ndarray],
    work: np.ndarray,
    prepared: PreparedPair,
    samples: int,
    nominal_speed: float,
    extremes: RunningExtremes,
) -> dict[str, Any]:
    """Quantities of the last whole mesh cycles of a run.

    Those of loads and of single pairs are of the working flanks: the back flanks where the gear drives. The
    `window` has the record's arrays over these cycles, last sample not included, so many `samples` in each.
    `work` is the change of the state over them: its works are integrated, so that no mean power
    depends on the sampling. `nominal_speed` is the pinion's, rad/s.
    """
    cycle, layout = prepared.cycle, prepared.model.layout
    error = window["transmission_error_rotational"]
    load = window["normal_load"]
    friction = np.abs(window["friction_force"])
    sliding = np.abs(np.nan_to_num(window["sliding_speed"]))
    slid, loaded = np.sum(friction * sliding), np.sum(load * sliding)
    touching = load > 0.0
    # by the actual rotation: a driven pinion need not turn at its nominal speed
    cycles = len(error) / samples
    duration = float(cycles * cycle.pitch_angle / nominal_speed + work[layout.lag])
    frequency = cycles / duration
    orders, amplitudes = spectrum = amplitude_spectrum(error, samples)
    power_in, power_out, power_damping = (
        work[work_of(layout, which)] / duration for which in (IN, OUT, DAMPING)
    )
    power_friction = np.sum(work[works_of_meshes(layout, FRICTION)]) / duration
    stiffness = total_stiffness(window["mesh_stiffness"], window["pressure_angle"])
    # the mean load by its work over the gear's rotation: neither depends on the sampling
    turned = cycle.pinion_pitch_radius * cycle.pitch_angle * cycles
    turned = turned - float(rotational_error(work, MESH, prepared.model))
    force = float(work[work_of(layout, OUT)] / turned)
    # a load that is reversed on the mean has driving flanks to work on where there is no backlash
    sign = -1.0 if force < 0.0 and np.any(cycle.side < 0) else 1.0
    # the last slot of either side holds a pair that is on the path of contact all the time
    newest = window["transmission_error_normal"][:, np.flatnonzero(cycle.side * sign > 0)[-1]]
    flanks = WORKING[sign]
    keep = orders <= 20.0 + 1e-9
    return {
        "averaging_cycles": len(error) // samples,
        "mesh_frequency": frequency,
        "transmission_error_mean": float(np.mean(error)),
        "transmission_error_rms": float(np.std(error)),
        "transmission_error_peak_to_peak": extremes.spread("transmission_error"),
        "transmission_error_harmonics": spectrum.harmonics(HARMONICS),
        "transmission_error_normal_mean": float(np.nanmean(newest)),
        "transmission_error_normal_peak_to_peak": extremes.spread(f"{flanks}transmission_error_normal"),
        "dynamic_factor": extremes.by_name[f"{flanks}mesh_force_max"].value / abs(force)
        if force != 0.0
        else float("nan"),
        "friction_coefficient_mean": float(slid / loaded) if loaded > 0 else float("nan"),
        "friction_force_mean": np.mean(friction, axis=0),
        "efficiency": float(efficiency(power_in, power_out, power_friction)),
        "power_damping_mean": float(power_damping),
        "mesh_stiffness_mean": float(np.mean(stiffness)),
        "mesh_stiffness_peak_to_peak": float(np.ptp(stiffness)),
        **extremes.where("film_parameter_min", cycle),
        "friction_work_on_vibration": friction_work_on_vibration(work, layout),
        "driving_gear": driving_gear(power_in, power_out),
        "power_in_mean": float(power_put_in(power_in, power_out)),
        "power_friction_mean": float(power_friction),
        "closure_in_range_fraction": fraction_in_range(window["closure_in_range"][touching]),
        "friction_in_range_fraction": fraction_in_range(window["friction_in_range"][touching]),
        "contact_loss_fraction": float(np.mean(~np.any(touching, axis=1))),
        "spectrum_frequencies": orders[keep] * frequency,
        "spectrum_amplitudes": amplitudes[keep],
    }


def judge_block(
    judge: Judge,
    cycles: np.ndarray,
    block: Mapping[str, np.ndarray],
    prepared: PreparedPair,
    between_samples: bool = False,
) -> None:
    """Judge what is recorded of a block of states, at mesh cycles (n,) since the start."""
    if not len(cycles):
        return
    quantities = quantities_of(block, prepared.case.drive.module, smallest_clearance(prepared.assembly))
    quantities |= heat_of(block["flash_temperature_rise"], prepared.case.lubricant.temperature)
    places = {"time": block["time"], "mesh_cycle": cycles}
    numbers = pair_numbers(prepared.cycle.front_pairs, np.size(prepared.cycle.side))
    judge.take(quantities, places, numbers, between_samples)


def quantities_of(block: Mapping[str, np.ndarray], module: float, clearance: float) -> dict[str, np.ndarray]:
    """Quantities by name of their rule, (n, pairs) or (n,).

    The deflection of a pair is its load over its stiffness, both as recorded.
    """
    stiffness = np.where(block["mesh_stiffness"] > 0.0, block["mesh_stiffness"], np.nan)
    pinion_x, pinion_y, gear_x, gear_y = block["displacement"][:, :4].T
    moved = np.maximum(np.hypot(pinion_x, pinion_y), np.hypot(gear_x, gear_y))
    return {
        "deflection": block["normal_load"] / stiffness / module,
        "friction_coefficient": block["friction_coefficient"],
        "hertz_pressure": block["hertz_pressure"],
        "bearing_displacement": moved / clearance,
    }


def smallest_clearance(assembly: Assembly) -> float:
    """The smaller of the two distances between a tip and the mate's root, m."""
    return min(tip_clearance(assembly, "pinion"), tip_clearance(assembly, "gear"))


def judge_balance(judge: Judge, summary: Mapping[str, Any], rtol: float) -> None:
    """Judge the residual of the energy balance against the tolerance of the integration."""
    residual = summary.get("energy_residual")
    if residual is not None:
        judge.take({"energy_residual": abs(residual) / rtol})
