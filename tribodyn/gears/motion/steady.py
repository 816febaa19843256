"""Quantities of the last whole cycles of a run: of every mesh, and of the power through the train.

Means are of the recorded samples and of integrated works; extremes of the dense motion, samples included.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.dynamics.recorded.outputs import UNRECORDED
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.motion.extremes import WORKING, RunningExtremes
from tribodyn.gears.prepare import PreparedGears
from tribodyn.gears.tabulated import Tabulated
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.helix import overlap_ratio
from tribodyn.mesh.by_compliance import compliance_remark
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import driving_gear, efficiency, power_put_in, single_pair
from tribodyn.post.cycles import Spectrum, amplitude_spectrum
from tribodyn.post.verdict import KNOCK
from tribodyn.train.layout import TrainLayout, work_of, works_of_meshes
from tribodyn.train.structure import (
    DAMPING,
    FRICTION,
    IN,
    OUT,
    SLIDING,
)
from tribodyn.tribology.closure import exceeded_limits, law_quantities
from tribodyn.tribology.surface_state import fraction_in_range

#: Mesh orders whose amplitudes of the transmission error are in the summary: 1 to this.
HARMONICS = 5
#: Orders up to which the spectrum is in it.
LAST_ORDER = 20.0
#: Share of the loss that friction may give to the vibration before it is said.
FEEDS = 0.01
#: Share of its swing by which the transmission error of a settled motion may change from period to period,
#: and over several of them where it repeats after these.
SETTLED, REPEATED = 0.05, 0.005
#: Of what repeats with no mesh: how much less of it the second half of a window has of a start that fades,
#: and the share of the swing up to which it may be coupled meshes.
FADES, COUPLED = 0.75, 0.15
#: Orders of a mesh that are its own, at most; share of all orders in a window that may be those of meshes.
OWN_ORDERS, TOLD = 40, 0.5
#: Dynamic factors that are too large far below all resonances, and that engagement has a part in elsewhere;
#: share of the lowest natural frequency that is far below it.
KNOCKING, HARD, SLOW = 1.1, 1.25, 0.1
#: What that means, by `friction.sliding`.
ABOUT_FEEDING = {
    "kinematic": 'which kinematic sliding makes of nothing: use friction.sliding = "dynamic"',
    "dynamic": "taken from the drive: a self-excited vibration",
}


def mesh_quantities(
    window: Mapping[str, np.ndarray],
    cycle: MeshCycle,
    extremes: RunningExtremes,
    force: float,
    frequency: float,
    samples: int,
    rate: float = 1.0,
) -> dict[str, Any]:
    """Quantities of a mesh over the last whole cycles of a run.

    Those of loads and of single pairs are of the working flanks: the back flanks where the gear drives.

    Parameters
    ----------
    window : datasets of the mesh over these cycles, the last sample not included
    extremes : of the motion in them
    force : mean force along the pitch tangent, N; < 0 presses the back flanks
    frequency : of the mesh, Hz
    samples : of a reference cycle, of which the mesh has `rate` cycles
    """
    error = window["transmission_error_rotational"]
    load = window["normal_load"]
    friction = np.abs(window["friction_force"])
    slid, loaded = np.sum(np.abs(window["sliding_loss"])), np.sum(window["sliding_load"])
    touching = load > 0.0
    over_run = amplitude_spectrum(error, samples)
    spectrum = Spectrum(over_run.orders / rate, over_run.amplitudes)
    stiffness = np.sum(window["tangent_stiffness"], axis=1)
    # a load that is reversed on the mean has driving flanks to work on where there is no backlash
    sign = -1.0 if force < 0.0 and np.any(cycle.pair_side < 0) else 1.0
    # the last slot of either side holds a pair that is on the path of contact all the time
    newest = window["transmission_error_normal"][:, np.flatnonzero(cycle.pair_side * sign > 0)[-1]]
    flanks = WORKING[sign]
    keep = spectrum.orders <= LAST_ORDER + 1e-9
    return {
        "mesh_frequency": frequency,
        "transmission_error_mean": float(np.mean(error)),
        "transmission_error_rms": float(np.std(error)),
        "transmission_error_peak_to_peak": extremes.spread("transmission_error"),
        "transmission_error_harmonics": spectrum.harmonics(HARMONICS),
        "transmission_error_normal_mean": float(np.nanmean(newest))
        if np.any(np.isfinite(newest))
        else float("nan"),
        "transmission_error_normal_peak_to_peak": extremes.spread(f"{flanks}transmission_error_normal"),
        "dynamic_factor": extremes.by_name[f"{flanks}mesh_force_max"].value / abs(force)
        if force != 0.0
        else float("nan"),
        "friction_coefficient_mean": float(slid / loaded) if loaded > 0 else float("nan"),
        "friction_force_mean": np.mean(friction, axis=0),
        "mesh_stiffness_mean": float(np.mean(stiffness)),
        "mesh_stiffness_peak_to_peak": float(np.ptp(stiffness)),
        **extremes.where("film_parameter_min", cycle),
        "closure_in_range_fraction": fraction_in_range(window["closure_in_range"][touching]),
        "friction_in_range_fraction": fraction_in_range(window["friction_in_range"][touching]),
        "contact_loss_fraction": float(np.mean(~np.any(touching, axis=1))),
        "spectrum_frequencies": spectrum.orders[keep] * frequency,
        "spectrum_amplitudes": spectrum.amplitudes[keep],
        **({"axial_force_mean": float(np.mean(window["axial_force"]))} if cycle.slices > 1 else {}),
    }


def on_settling(errors: Sequence[np.ndarray], period: int) -> str:
    """Say where the transmission errors of meshes do not repeat after a period, a number of samples, or some.

    "" where all do, and where the samples are of less than two periods, which tell nothing.
    """
    worst = 0.0
    for error in errors:
        lags, swing = range(period, len(error) // 2 + 1, period), float(np.ptp(error))
        changes = [float(np.max(np.abs(error[lag:] - error[:-lag]))) for lag in lags]
        if changes and min(changes) > REPEATED * swing:
            worst = max(worst, changes[0] / swing)
    if not worst > SETTLED:
        return ""
    return (
        "The motion has not settled: from one mesh cycle to the next the transmission error still changes "
        f"by {100.0 * worst:.2g} % of its swing. More solver.cycles let the start fade; tribodyn sweep seeks "
        "the steady motion."
    )


def on_settling_of_meshes(
    errors: Sequence[np.ndarray], rates: Sequence[float], samples: int, cycles: int, period: int
) -> str:
    """Say whether a motion has settled whose samples are of less than two common periods.

    What of a transmission error is of no order of a mesh is the start, which fades, or meshes that are
    coupled. `rates` are those of all that repeats, `cycles` those of the run, all in cycles with `samples`.
    """
    window, every = len(errors[0]) / samples, sorted({round(rate, 12) for rate in rates})
    least = math.ceil(sum(1.0 / rate for rate in every) / TOLD)
    if window < least:
        short = 4 * least < period and cycles < period
        enough = 4 * least if short else period if cycles < period >= least else 8 * period
        return (
            f"Whether the motion has settled cannot be told by the {window:.0f} cycles that means are of: "
            f"solver.cycles = {enough} are enough."
        )
    times = np.arange(len(errors[0])) / samples
    orders = [
        rate * order for rate in every for order in range(1, OWN_ORDERS + 1) if 2.0 * rate * order < samples
    ]
    angles = 2.0 * np.pi * np.outer(times, np.array(orders))
    basis = np.hstack([np.ones((len(times), 1)), np.cos(angles), np.sin(angles)])
    values = np.stack(errors, axis=1)
    rest = values - basis @ np.linalg.lstsq(basis, values, rcond=1e-8)[0]
    swings = np.maximum(np.ptp(values, axis=0), 1e-300)
    begin, end = (np.max(np.abs(half), axis=0) / swings for half in np.array_split(rest, 2))
    fading = end < FADES * begin
    if (worst := float(np.max(np.where(fading, begin, 0.0)))) > SETTLED:
        return (
            f"The motion has not settled: {100.0 * worst:.2g} % of the swing of the transmission error "
            f"repeats with no mesh, and fades over the {window:.0f} cycles that means are of. More "
            "solver.cycles let the start fade."
        )
    if (worst := float(np.max(np.maximum(begin, end)))) > COUPLED:
        return (
            f"Whether the motion has settled cannot be told: {100.0 * worst:.2g} % of the swing of the "
            f"transmission error repeats with no mesh. solver.cycles = {8 * period}, with means of two "
            "common periods, tell."
        )
    return ""


def on_engagement(compliance: str, factor: float, frequency: float, modes: np.ndarray) -> str:
    """Say where a dynamic factor is, or may be, the engagement of pairs at the ends of the path of contact.

    `frequency` of the fastest mesh and `modes`, the natural ones, Hz, 0 of rigid motions. Far below, teeth
    bend as in slow rotation: with constant load and speed nothing but their engagement adds to the load.
    """
    elastic = modes[modes > 1e-3 * np.max(modes, initial=0.0)]
    slow = frequency < SLOW * float(np.min(elastic, initial=np.inf))
    if compliance != "energy" or not factor > (KNOCKING if slow else HARD):
        return ""
    if slow:
        return (
            'mesh.compliance = "fem" lets pairs engage as gradually as teeth bend: this far below all '
            f"natural frequencies K_v {factor:.2f} is {KNOCK} that engage at once, as the energy "
            "method has it."
        )
    return (
        'mesh.compliance = "fem" tells how much of K_v is the engagement by the energy method, harder than '
        "that of bent teeth; tribodyn sweep finds resonances to move speed or stiffness away from."
    )


def at_rest(case: LubricatedCase, tabulated: Tabulated | PreparedGears[Any]) -> dict[str, Any]:
    """Quantities of a mesh that do not depend on its motion, and the laws in use."""
    cycle, assembly = tabulated.cycle, tabulated.assembly
    return {
        "contact_ratio": float(cycle.contact_ratio),
        **of_the_face(cycle, assembly, tabulated.slice_remark),
        **({} if case.mesh.backlash is None else {"normal_backlash": case.mesh.backlash}),
        "stiffness_single_pair_at_pitch_point": single_pair(cycle, case.operating.gear_torque).stiffness,
        "compliance_remark": compliance_remark(assembly, case.materials, case.mesh) or None,
        **law_quantities(case),
    }


def of_the_face(cycle: MeshCycle, assembly: Assembly, remark: str) -> dict[str, Any]:
    """What helical teeth have besides; nothing of spur gears."""
    if not assembly.drive.helix_angle:
        return {}
    overlap = float(overlap_ratio(assembly))
    return {
        "overlap_ratio": overlap,
        "total_contact_ratio": float(cycle.contact_ratio) + overlap,
        "slices": cycle.slices,
        "slice_remark": remark or None,
    }


def limits_in(window: Mapping[str, np.ndarray], case: LubricatedCase) -> dict[str, Any]:
    """Limits of the laws that a mesh exceeds over a window, which has the shares of `UNRECORDED`."""
    touching = window["normal_load"] > 0.0
    loss = np.abs(window["friction_force"] * window["sliding_speed"])[touching]
    film_shares, friction_shares = (window[name][touching] for name in UNRECORDED)
    return exceeded_limits(case, film_shares, friction_shares, loss)


def power_quantities(work: np.ndarray, duration: float, layout: TrainLayout) -> dict[str, Any]:
    """Mean powers and the efficiency; `work` is the change of the state over whole cycles of `duration`, s.

    Its works are integrated, so that no mean power depends on the sampling.
    """
    power_in, power_out, power_damping = (
        float(work[work_of(layout, which)]) / duration for which in (IN, OUT, DAMPING)
    )
    power_friction = float(np.sum(work[works_of_meshes(layout, FRICTION)])) / duration
    return {
        "efficiency": float(efficiency(power_in, power_out, power_friction)),
        "power_damping_mean": power_damping,
        "friction_work_on_vibration": friction_work_on_vibration(work, layout),
        "driving_gear": driving_gear(power_in, power_out),
        "power_in_mean": float(power_put_in(power_in, power_out)),
        "power_friction_mean": power_friction,
    }


def friction_work_on_vibration(work: np.ndarray, layout: TrainLayout) -> float | None:
    """Work of friction on the vibration, as a share of the loss that the rotation alone has; > 0: fed.

    What friction takes of the moving bodies, Σ F_f v_rel, is what it would take of rotation alone, Σ F_f v_s,
    less what it gives to the vibration. None without friction. `work` is the change of the state over whole
    mesh cycles.
    """
    nominal, actual = (float(np.sum(work[works_of_meshes(layout, which)])) for which in (SLIDING, FRICTION))
    return (nominal - actual) / abs(nominal) if nominal != 0.0 else None


def warning_of(share: float | None, sliding: str) -> str | None:
    """Warn where the share of `friction_work_on_vibration` is above `FEEDS`; `sliding`: the case's."""
    if share is None or not share > FEEDS:
        return None
    return (
        f"friction feeds the vibration with more than {100 * FEEDS:g} % of its loss, {ABOUT_FEEDING[sliding]}"
    )
