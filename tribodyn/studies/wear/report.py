"""Reported quantities of a wear study, its verdict, and how far to trust it."""

from tribodyn.post.page.data import PageMap
from tribodyn.post.report import on_closures
from tribodyn.post.verdict import advised, lubrication, numbers, with_unit
from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

REPORTED: Reported = {
    "Geometry": quantities("contact_ratio", "slices"),
    "Wear": quantities(
        *("wear_revolutions", "wear_time", "pinion_worn_depth_max", "gear_worn_depth_max"),
        *("pinion_worn_volume", "gear_worn_volume", "pinion_worn_mass", "gear_worn_mass"),
        *("debris_rate", "debris_rate_unworn", "corner_sliding_share"),
    ),
    "Load contact": quantities(
        *("gear_torque", "loaded_transmission_error_peak_to_peak"),
        "loaded_transmission_error_peak_to_peak_unworn",
    ),
    "Tribology": quantities(
        *("hertz_pressure_max", "hertz_pressure_max_unworn", "film_min", "film_min_unworn"),
        *("film_parameter_min", "film_parameter_min_unworn"),
    ),
    "Energy": quantities("power_friction_mean", "power_friction_mean_unworn"),
    "Solver": quantities("wear_balance", "wear_steps", "wear_steps_rejected", "wall_time"),
}

SWEPT = quantities(
    *("pinion_worn_depth_max", "gear_worn_depth_max", "pinion_worn_mass", "gear_worn_mass", "debris_rate"),
    *("loaded_transmission_error_peak_to_peak", "hertz_pressure_max", "power_friction_mean"),
    *("film_min", "film_parameter_min", "corner_sliding_share", "wear_balance"),
)

SHORT = {
    "peak_to_peak": "loaded_transmission_error_peak_to_peak",
    "loss": "power_friction_mean",
    "pinion_depth": "pinion_worn_depth_max",
    "gear_depth": "gear_worn_depth_max",
}

PANELS = ("transmission_error_peak_to_peak", "worn_mass", "debris_rate", "power_friction", "film_min")


def maps(record: Record) -> list[PageMap]:
    """Depth worn off either gear over roll angle and face, where that is in slices."""
    if record.samples < 2 or len(record["slice"]) < 2:
        return []
    depth, roll, face = record["worn_depth"][-1], record["roll"], record["slice"]
    return [
        PageMap("worn_depth", roll, face, depth[place], title=f"Depth worn off the {body}")
        for place, body in enumerate(record["body"])
    ]


def verdict(record: Record) -> list[str]:
    """Say what is worn off, what that does to error, pressure and film, and what to do."""
    summary, sentences = numbers(record.summary), []
    if {"wear_revolutions", "pinion_worn_depth_max", "gear_worn_depth_max"} <= set(summary):
        depths = [
            with_unit(f"{body}_worn_depth_max", summary[f"{body}_worn_depth_max"])
            for body in ("pinion", "gear")
        ]
        count = counted(summary["wear_revolutions"])
        if max(summary["pinion_worn_depth_max"], summary["gear_worn_depth_max"]) > 0.0:
            sentences.append(
                f"After {count} revolutions the pinion has lost up to {depths[0]}, the gear {depths[1]}."
            )
        else:
            sentences.append(f"In {count} revolutions nothing is worn.")
    changed = [
        _change(name, what, summary)
        for name, what in (
            ("loaded_transmission_error_peak_to_peak", "the transmission error under load"),
            ("hertz_pressure_max", "the highest pressure"),
            ("power_friction_mean", "the loss"),
        )
        if {name, f"{name}_unworn"} <= set(summary)
    ]
    if changed:
        text = "; ".join(changed)
        sentences.append(f"{text[0].upper()}{text[1:]}.")
    if (ratio := summary.get("film_parameter_min")) is not None:
        sentences.append(f"The oil film is at least {ratio:.2g} times the roughness: {lubrication(ratio)}.")
    return [*sentences, *advised(record.summary)]


def counted(revolutions: float) -> str:
    """A number of revolutions in words."""
    for size, name in ((1e9, "billion"), (1e6, "million"), (1e3, "thousand")):
        if revolutions >= size:
            return f"{revolutions / size:.3g} {name}"
    return f"{revolutions:.3g}"


def _change(name: str, what: str, summary: dict[str, float]) -> str:
    before, after = (with_unit(name, summary[key]) for key in (f"{name}_unworn", name))
    return f"{what} is {after}" if before == after else f"{what} goes from {before} to {after}"


def sentences(record: Record) -> list[str]:
    """Say what the model leaves out, and how well the volume balances."""
    summary = record.summary
    law = summary.get("wear_law", "the wear law")
    texts = [
        f"Slow rotation at a constant load, by {law}: the wear coefficient is known to a factor of ten at "
        "best, and the revolutions that wear a depth go with its inverse."
    ]
    if (residual := summary.get("wear_balance")) is not None:
        texts.append(
            f"The volume missing on the flanks is that of load and sliding to within {residual:.1e}."
        )
    if (share := summary.get("corner_sliding_share")) is not None and share > 0.0:
        texts.append(
            f"{100.0 * share:.2g} % of the sliding under load is that of tips' corners beyond the path of "
            "contact, which wears nothing here."
        )
    return [*texts, *on_closures(summary)]
