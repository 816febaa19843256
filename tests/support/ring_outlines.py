"""Outlines of a planet and its ring, rolled together."""

import math

import numpy as np
from scipy.interpolate import CubicSpline

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.tooth import Tooth, fillet_point, flank_point, thickness_half_angle


def _half_outline(tooth: Tooth) -> np.ndarray:
    """Radii (m, > 0) and half thickness angles (rad, > 0) of fillet and flank."""
    x, y = np.concatenate(
        [
            np.array(fillet_point(tooth, np.linspace(np.pi / 2, float(tooth.form_angle), 4000))),
            np.array(flank_point(tooth, np.linspace(tooth.form_distance, tooth.tip_distance, 4000))),
        ],
        axis=1,
    )
    return np.array([np.hypot(x, y), np.arctan2(y, np.abs(x))])


def penetration(pair: Assembly) -> np.ndarray:
    """How deep any point of the planet's outline lies in the ring's material at every roll of a pitch, m.

    Negative: how far off the nearest is. At the point's radius about the ring's axis the ring's half
    thickness, by spline of its outline, is compared with the angle of the point from the tooth's axis.
    """
    planet, ring = pair.pinion, pair.gear
    teeth = pair.drive.pinion.teeth
    pitch = 2 * math.pi / -pair.drive.gear.teeth
    r_p, r_g = float(pair.path.pinion_pitch_radius), -float(pair.path.gear_pitch_radius)
    size, angle = _half_outline(planet)
    size, angle = np.append(size, size), np.append(angle, -angle)
    at_pitch = float(thickness_half_angle(planet, r_p))
    ring_size, ring_angle = _half_outline(ring)
    order = np.argsort(ring_size)
    half = CubicSpline(*_distinct(ring_size[order], ring_angle[order]))
    ring_at_pitch = -float(thickness_half_angle(ring, -r_g))
    deepest, farthest, apart = np.full(81, -np.inf), float(size.max()), r_g - r_p
    for place, roll in enumerate(np.linspace(-0.5, 0.5, 81) * 2 * math.pi / teeth):
        for tooth in range(-9, 10):
            # clockwise from the line of centres, towards the ring; the planet's tooth lies left of P
            axis = roll - at_pitch + tooth * 2 * math.pi / teeth
            nearest = max(0.0, math.cos(max(0.0, abs(axis) - float(angle.max()))))
            if math.hypot(farthest, apart) ** 2 + 2 * farthest * apart * nearest < ring.tip_radius**2:
                continue  # inside the ring's tips
            turned = axis + angle
            x, y = size * np.sin(turned), size * np.cos(turned) - r_p + r_g
            at, where = np.hypot(x, y), np.arctan2(x, y)
            # the ring's tooth to the right of P: its axis at the half thickness
            from_axis = where - roll * r_p / r_g - ring_at_pitch
            from_axis -= pitch * np.round(from_axis / pitch)
            inside = (at > -ring.tip_radius) & (at < -ring.root_radius)
            if inside.any():
                depth = (half(at[inside]) - np.abs(from_axis[inside])) * at[inside]
                deepest[place] = max(deepest[place], float(depth.max()))
            assert at.max() < -ring.root_radius
    return deepest


def _distinct(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    kept = np.append(True, np.diff(x) > 1e-9)
    return x[kept], y[kept]
