"""What is recorded at a row, and what the summary of a run says."""

from typing import Any

import numpy as np

from tribodyn.record.trust import Judge, judge_tribology
from tribodyn.studies.wear.case import BODIES, OF_FILM, OF_TEETH
from tribodyn.studies.wear.passage import Depths, Wearing, WearPassage, Worn, by_teeth
from tribodyn.tribology.closure import exceeded_limits, law_quantities
from tribodyn.tribology.surface_state import fraction_in_range, range_shares

#: Names of the summary -> datasets: values at the end, and, with `_unworn`, of new flanks.
_ENDS = {
    "loaded_transmission_error_peak_to_peak": "transmission_error_peak_to_peak",
    "hertz_pressure_max": "hertz_pressure_max",
    "power_friction_mean": "power_friction",
    "film_min": "film_min",
    "debris_rate": "debris_rate",
}


def row_of(study: Wearing, state: Worn, at: WearPassage) -> dict[str, Any]:
    """Datasets of one row, each with an axis of length 1 before its own."""
    case, places = study.case, study.places
    mean = [np.mean(depth, axis=0) for depth in state.depths]
    volume = volumes(study, state.depths)
    density = np.array([material.density for material in case.materials])
    turns = case.operating.pinion_speed / (2.0 * np.pi)
    line_load, loaded = by_teeth(places, at.line_load)[0], at.load > 0.0
    share = by_teeth(places, loaded.astype(float))[0]

    def over_path(values: Any) -> Any:
        """Mean over teeth of what has a meaning under load only."""
        mean = by_teeth(places, np.where(loaded, values, 0.0))[0] / np.where(share > 0.0, share, 1.0)
        return np.where(line_load > 0.0, mean, np.nan)

    row: dict[str, Any] = {
        "revolutions": state.revolutions,
        "time": state.revolutions / turns,
        "worn_depth": np.stack(mean),
        "wear_rate": np.stack([np.mean(rate, axis=0) for rate in at.rates]),
        "worn_volume": volume,
        "worn_mass": volume * density,
        "debris_rate": turns * float(volumes(study, at.rates) @ density),
        "loaded_transmission_error": at.deflection,
        "transmission_error_peak_to_peak": float(np.ptp(at.deflection)),
        "line_load": line_load,
        "hertz_pressure": by_teeth(places, at.pressure)[0],
        "friction_coefficient": over_path(at.contacts.friction_coefficient),
        "power_friction": at.power_friction,
        "hertz_pressure_max": float(np.max(at.pressure)),
        "worn_volume_by_time": state.volume,
        "next_step": state.next_step,
        "steps": float(state.steps),
        "steps_rejected": float(state.rejected),
    }
    if case.lubricated is not None:
        least = float(np.min(at.contacts.film[at.load > 0.0]))
        roughness = np.nan if at.closure is None else float(at.closure.surfaces.roughness)
        row |= dict(zip(OF_FILM, (over_path(at.contacts.film), least, roughness), strict=True))
    if case.each_tooth:
        row |= dict(zip(OF_TEETH, state.depths, strict=True))
    return {name: np.asarray(value, dtype=float)[None] for name, value in row.items()}


def state_of(study: Wearing, row: dict[str, Any]) -> Worn:
    """The state that a row was made of."""
    if study.case.each_tooth:
        pinion, gear = (np.array(row[name]) for name in OF_TEETH)
    else:
        pinion, gear = (np.array(depth)[None] for depth in row["worn_depth"])
    return Worn(
        float(row["revolutions"]),
        (pinion, gear),
        float(row["next_step"]),
        float(row["worn_volume_by_time"]),
        int(row["steps"]),
        int(row["steps_rejected"]),
    )


def volumes(study: Wearing, depths: Depths) -> np.ndarray:
    """Volume of depths (m) on all teeth of pinion and gear, m³."""
    both = zip(study.places.area, depths, strict=True)
    return np.array([float(np.sum(area * np.mean(depth, axis=0))) for area, depth in both])


def summary_of(
    study: Wearing, first: dict[str, Any], last: dict[str, Any], at: WearPassage
) -> dict[str, Any]:
    """Quantities of a run, from the rows (without their first axis) of new and of worn flanks."""
    case, assembly = study.case, study.places.held.flanks.flexible.assembly
    worn = {"depth_max": np.max(last["worn_depth"], axis=(1, 2))}
    worn |= {name: last[f"worn_{name}"] for name in ("volume", "mass")}
    summary: dict[str, Any] = {
        "contact_ratio": float(assembly.contact_ratio),
        "gear_torque": case.operating.gear_torque,
        "slices": case.mesh.slices,
        "wear_law": study.law.name,
        "wear_revolutions": float(last["revolutions"]),
        "wear_time": float(last["time"]),
        **{
            f"{body}_worn_{name}": float(values[place])
            for name, values in worn.items()
            for place, body in enumerate(BODIES)
        },
        "corner_sliding_share": at.corner_share,
        "wear_balance": balance(last),
        "wear_steps": int(last["steps"]),
        "wear_steps_rejected": int(last["steps_rejected"]),
    }
    for name, dataset in _ENDS.items():
        if dataset in last:
            summary |= {name: float(last[dataset]), f"{name}_unworn": float(first[dataset])}
    return summary | _of_laws(study, summary, first, last, at)


def balance(row: dict[str, Any]) -> float:
    """Volume missing on the flanks over ∫ K F |v_s| dt, less 1: the larger of both gears."""
    by_time, volume = float(row["worn_volume_by_time"]), row["worn_volume"]
    return float(np.max(np.abs(volume / by_time - 1.0))) if by_time > 0.0 else 0.0


def _of_laws(
    study: Wearing, summary: dict[str, Any], first: dict[str, Any], last: dict[str, Any], at: WearPassage
) -> dict[str, Any]:
    """What the laws of film and friction say of themselves, and whether the contact lies within its model."""
    case, judge, quantities = study.case, Judge(), dict[str, Any]()
    oiled, closure, seen = case.lubricated, at.closure, at.contacts.seen
    if oiled is not None and closure is not None and seen is not None:
        carried = at.load > 0.0
        loss = (at.load * at.contacts.friction_coefficient * study.places.sliding.sliding)[carried]
        inside = fraction_in_range(seen.surface.friction_in_range)
        quantities = {
            "film_parameter_min": summary["film_min"] / float(last["roughness"]),
            "film_parameter_min_unworn": summary["film_min_unworn"] / float(first["roughness"]),
            "closure_in_range_fraction": fraction_in_range(seen.surface.closure_in_range),
            **({} if inside is None else {"friction_in_range_fraction": inside}),
            **law_quantities(oiled),
            **exceeded_limits(oiled, *range_shares(seen.contact, closure), loss),
        }
    bent = at.approach / float(case.drive.module)
    judge.take({"deflection": bent, "hertz_pressure": at.pressure.reshape(len(at.pressure), -1)})
    judge.take({"friction_coefficient": at.friction.reshape(len(at.friction), -1)})
    judge_tribology(judge, quantities | summary)
    return quantities | judge.summary()
