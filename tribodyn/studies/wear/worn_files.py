"""Worn profiles as CSV files that `drive.pinion.modification.profile_error` and the gear's read."""

from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.numerics.files.output_files import WRITTEN, check_output, write_output
from tribodyn.studies.wear.case import BODIES
from tribodyn.studies.wear.passage import Wearing


def profile_path(record: Path, body: str) -> Path:
    """Name of the file with the worn profile of a gear, beside its record."""
    return record.with_name(f"{record.stem}-{body}.csv")


def check_profiles(record: Path, force: bool = False) -> None:
    """Raise InputError where a file is in the way that no run wrote, see `check_output`."""
    for body in BODIES:
        check_output(profile_path(record, body), force)


def profile_text(roll: Any, depth: Any, about: str) -> str:
    """Depth (m) over roll angle (rad) as a table, with a comment before it."""
    columns = np.degrees(roll).tolist(), (1e6 * np.asarray(depth)).tolist()
    lines = [f"{angle!r},{worn!r}" for angle, worn in zip(*columns, strict=True)]
    return "\n".join([f"{WRITTEN['.csv'].decode()}: {about}", "roll_angle [deg],error [um]", *lines, ""])


def write_profiles(study: Wearing, row: dict[str, Any], record: Path, force: bool = False) -> list[Path]:
    """Write what is worn off both gears, the mean over teeth and face, with the profile error that they had.

    Raises as `write_output`.
    """
    roll, files = study.places.node, []
    for body, depth in zip(BODIES, row["worn_depth"], strict=True):
        profile_error = getattr(study.case.mesh.modifications, body).profile_error
        total = np.mean(depth, axis=-1)
        if profile_error is not None:
            total = total + np.interp(roll, *profile_error)
        about = f"profile error of the {body} after {float(row['revolutions']):g} revolutions of the pinion"
        text = profile_text(roll, total, about)
        files.append(write_output(profile_path(record, body), text, force=force))
    return files
