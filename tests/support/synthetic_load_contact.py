"""A record of a load contact study with the looks of a real one, in closed form; nothing in it is exact."""

from pathlib import Path

import numpy as np

from tests.support.synthetic_record import geometry
from tribodyn.record.writer import RecordWriter
from tribodyn.studies.load_contact.layout import BODIES, LAYOUT

TEETH, WIDTH, START, END = 18, 0.0267, -0.27, 0.28
PITCH = 2 * np.pi / TEETH
LOAD = 6300.0


def samples(positions: int, slices: int, tilt: float = 0.5, cycles: int = 1) -> dict[str, np.ndarray]:
    """All datasets over `cycles` mesh cycles; `tilt` is how much more one end of the face carries."""
    phase = np.arange(positions * cycles) / positions
    roll = START + PITCH * (phase[:, None] % 1.0 + np.array([2.0, 1.0, 0.0]))
    weight = np.where(roll < END, np.sin(np.pi * np.clip((roll - START) / (END - START), 0, 1)) ** 0.5, 0.0)
    share = weight / weight.sum(axis=1, keepdims=True)
    face = ((np.arange(slices) + 0.5) / slices - 0.5) * WIDTH
    along = 1 + tilt * 2 * face / WIDTH
    load = LOAD * share
    line = load[..., None] / WIDTH * along
    stress = 3e2 * line[:, None] * np.array([1.0, 0.9])[:, None, None]
    return {
        "phase": phase,
        "pinion_angle": phase * PITCH,
        "roll_angle": roll,
        "loaded_transmission_error": 1.2e-5 + 2e-6 * np.cos(2 * np.pi * phase),
        "unloaded_transmission_error": 4e-6 * (np.cos(2 * np.pi * phase) > 0),
        "normal_load": load,
        "line_load": line,
        "hertz_pressure": 2e6 * np.sqrt(line),
        "half_width": 2e-7 * np.sqrt(line),
        "face_load_factor": np.where(load > 0, np.max(along), np.nan),
        "root_tension": stress,
        "root_compression": -1.2 * stress,
        "mesh_stiffness": 4e8 + 5e7 * np.cos(2 * np.pi * phase),
        "torque_residual": 0.0 * phase,
    }


def write(
    path: Path,
    *,
    positions: int = 24,
    slices: int = 9,
    tilt: float = 0.5,
    cycles: int = 1,
    torques: tuple[float, ...] = (100.0, 200.0, 300.0),
) -> Path:
    """Write the record and return its path."""
    values = samples(positions, slices, tilt, cycles)
    face = ((np.arange(slices) + 0.5) / slices - 0.5) * WIDTH
    scales = {"pair": np.array([-1, 0, 1]), "slice": face, "body": np.array(BODIES)}
    with RecordWriter(
        path,
        scenario_toml='title = "Involute drive, 18/36 teeth"\nkind = "load-contact"\n',
        sha256="0" * 64,
        samples=values["phase"].size,
        layout=LAYOUT,
        kind="load-contact",
        groups={
            "mesh_cycle": {"face_width": WIDTH, "pinion_teeth": float(TEETH), "contact_ratio": 1.6},
            "geometry": geometry(),
        },
        scales=scales | ({"torque": np.array(torques)} if torques else {}),
    ) as record:
        record.write(0, values)
        for row, torque in enumerate(torques):
            error = values["loaded_transmission_error"] * (torque / 200.0 - 1.05)
            record.put(row, {"map_transmission_error": error, "map_peak_to_peak": np.ptp(error)})
        return record.finish(
            {
                "contact_ratio": 1.6,
                "contact_ratio_effective": 1.74,
                "gear_torque": 318.0,
                "loaded_transmission_error_peak_to_peak": 4e-6,
                "face_load_factor": 1.5,
                "torque_residual": 1e-14,
            }
        )
