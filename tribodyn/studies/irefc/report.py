"""Reported quantities of a gear with rolling elements, how far to trust them, and its bodies for a page."""

import numpy as np

from tribodyn.post.page.motion import Body, Mechanism
from tribodyn.post.report import on_energy
from tribodyn.post.verdict import lost, numbers, share, with_unit
from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

REPORTED: Reported = {
    "Geometry": quantities("ratio", "eccentricity"),
    "Dynamics": quantities(
        *("mesh_frequency", "normal_load_max", "elements_loaded_min", "elements_loaded_max"),
        *("output_torque_mean", "output_torque_peak_to_peak"),
    ),
    "Tribology": quantities("slip_speed_max", "spin_speed_max"),
    "Energy": quantities(
        *("power_in_mean", "power_friction_mean", "power_cam_mean", "power_crown_mean"),
        *("power_element_max", "efficiency"),
    ),
    "Solver": quantities("wall_time"),
}

SWEPT = quantities(
    *("efficiency", "efficiency_by_energy"),
    *("power_friction_mean", "power_element_max", "power_cam_mean", "power_crown_mean"),
    *("normal_load_max", "slip_speed_max", "spin_speed_max"),
    *("output_torque_mean", "output_torque_peak_to_peak"),
)

#: What the modes amount to.
MODES = {
    "corrected": "Mode corrected: motion in time over one revolution, speeds relative to the eccentric, "
    "efficiency by energy.",
    "as_published": "Mode as_published: the paper's position and printed formulas; slip and spin too small "
    "by (Z2 + 1)/2, slip lowers the loss, efficiency is the product (23). A reference, not a prediction.",
}

#: The same for the verdict, and what to do.
_SHORT = {
    "corrected": ("Mode corrected: speeds relative to the eccentric, efficiency by energy.",),
    "as_published": (
        "Mode as_published: a paper's printed formulas, a reference and no prediction.",
        'To do: mode = "corrected" gives the motion with the right speeds and its efficiency.',
    ),
}

PANELS = ("normal_load", "slip_speed", "power_friction", "efficiency")


def verdict(record: Record) -> list[str]:
    """Say what the elements carry, how even the output is, what is lost, and whether it is a prediction."""
    summary, lines = numbers(record.summary), []
    if {"normal_load_max", "elements_loaded_min"} <= set(summary):
        load, fewest = (
            with_unit("normal_load_max", summary["normal_load_max"]),
            summary["elements_loaded_min"],
        )
        lines.append(
            f"At least {fewest:.0f} elements carry; the one that carries most is pressed with {load}."
        )
    if {"output_torque_mean", "output_torque_peak_to_peak"} <= set(summary):
        mean, swing = summary["output_torque_mean"], summary["output_torque_peak_to_peak"]
        even = f", {share(swing / abs(mean))} of it" if mean else ""
        torque = with_unit("output_torque_mean", mean)
        swings = with_unit("output_torque_peak_to_peak", swing)
        lines.append(f"The output gives {torque} on the mean and swings by {swings}{even}.")
    lines += lost(summary)
    return [*lines, *_SHORT[record.summary["mode"]]] if record.summary.get("mode") in _SHORT else lines


def sentences(record: Record) -> list[str]:
    """Say what the mode amounts to, and how well the energy balance closes."""
    summary = record.summary
    mode = [MODES[summary["mode"]]] if "mode" in summary else []
    return [*mode, *on_energy(summary)]


def mechanism(record: Record) -> Mechanism:
    """Cam, cage, rolling elements and crown about the shaft's axis; arrows are the loads on the cam.

    The crown stands still. The eccentric turns with the shaft, from the axis to the right; about it the cam
    turns by −2/(Z2 − 1) and the cage by −1/Z2 of the shaft's rotation. The cage is drawn as a plain ring.
    """
    size, elements = record.geometry, int(record.scenario["drive"]["elements"])
    shaft = np.asarray(record["input_angle"])
    offset, radius = float(size["eccentricity"]), float(size["element_radius"])
    reach, circle = float(size["centre_circle_radius"]), _circle(120)

    def about_eccentric(distance: float, turned: np.ndarray) -> np.ndarray:
        return np.stack([distance * np.cos(shaft), distance * np.sin(shaft), turned], axis=-1)

    still = np.zeros((len(shaft), 3))
    rim = 1.12 * float(np.hypot(*size["crown_outline"].T).max())
    cage = about_eccentric(0.5 * offset, -shaft / elements)
    angles = cage[:, 2:] + 2.0 * np.pi * np.arange(elements) / elements
    centres = cage[:, None, :2] + reach * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    spin = np.zeros((len(shaft), elements, 1))
    poses = np.concatenate([centres, spin], axis=-1)
    pitch_point = float(size["crown_pitch_radius"]) * np.stack([np.cos(shaft), np.sin(shaft)], axis=-1)
    normal = centres - pitch_point[:, None]
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    contacts = centres - radius * normal
    direction = np.arctan2(-normal[..., 1:], -normal[..., :1])
    loaded = record["normal_load"].shape[1]
    return Mechanism(
        "Cam, rolling elements, cage and crown",
        (
            Body(rim * circle, still, "gear"),
            Body(np.asarray(size["crown_outline"]), still, "paper"),
            Body(
                np.asarray(size["cam_outline"]),
                about_eccentric(offset, -2 * shaft / (elements - 1)),
                "pinion",
            ),
            Body(reach * circle, cage, "ring", 0.7 * radius),
            *(Body(radius * _circle(24), poses[:, number], "paper") for number in range(elements)),
        ),
        "normal_load",
        np.concatenate([contacts, direction], axis=-1)[:, :loaded],
        1.02 * rim,
        6.0 * radius,
    )


def _circle(points: int) -> np.ndarray:
    angle = np.linspace(0.0, 2.0 * np.pi, points, endpoint=False)
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)
