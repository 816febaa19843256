"""The profile of a tooth as a table of points."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Side, body_of
from tribodyn.geometry.tooth.body import ROOT_POINTS, TIP_POINTS, half_profile, tooth_outline
from tribodyn.numerics.output_files import MARKS, write_output

#: Columns of the file.
HEADER = tuple(MARKS[".csv"].decode().strip().split(","))


class ToothProfile(NamedTuple):
    """One tooth from the middle of a gap to the middle of the next."""

    #: curve that each point belongs to: root, fillet, flank or tip; a point where two meet belongs to the
    #: fillet, or to the flank at the tip
    part: list[str]
    #: radius, angle: polar coordinates about the axis from the tooth's axis of symmetry, m and rad; the angle
    #: grows
    radius: np.ndarray
    angle: np.ndarray


def tooth_profile(assembly: Assembly, side: Side, flank_points: int = 60) -> ToothProfile:
    """Points of one tooth of a body, of plain numbers; the gear repeats it `teeth` times."""
    fillet_points = max(flank_points // 2, 8)
    shape = tooth_outline(assembly.tooth(side), flank_points, fillet_points)
    radius, angle = half_profile(shape, body_of(assembly.drive, side).teeth)
    part = [
        *["root"] * ROOT_POINTS,
        *["fillet"] * fillet_points,
        *["flank"] * (flank_points - 1),
        *["tip"] * TIP_POINTS,
    ]
    return ToothProfile(
        part + part[::-1],
        np.concatenate([radius, radius[::-1]]),
        np.concatenate([-angle, angle[::-1]]),
    )


def write_profile(path: Path, profile: ToothProfile, *, force: bool = False) -> Path:
    """Write a profile as CSV: x along the tooth's axis outwards, y across, mm; raises as `write_output`."""
    x, y = profile.radius * np.cos(profile.angle), profile.radius * np.sin(profile.angle)
    columns = (1e3 * x, 1e3 * y, 1e3 * profile.radius, np.degrees(profile.angle))
    lines = [
        ",".join([part, *(f"{number:.9g}" for number in numbers)])
        for part, *numbers in zip(profile.part, *columns, strict=True)
    ]
    return write_output(path, MARKS[".csv"].decode() + "\n".join(lines) + "\n", force=force)
