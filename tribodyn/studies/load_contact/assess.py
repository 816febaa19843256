"""The part in an assessment: loaded error, loads, pressures and root stresses on finite elements."""

from collections.abc import Mapping

import numpy as np

from tribodyn.record.reader import open_record
from tribodyn.studies.load_contact import STUDY
from tribodyn.studies.load_contact.rolled import over_roll
from tribodyn.studies.part import Answer, Asked, Curve, Done, Role, Task

_TASK = "loaded-contact"
_FIGURES = (
    "contact_ratio",
    "contact_ratio_effective",
    "stiffness_single_pair_at_pitch_point",
    "mesh_stiffness_mean",
    "loaded_transmission_error_mean",
    "loaded_transmission_error_peak_to_peak",
    "least_peak_to_peak",
    "least_peak_to_peak_torque",
    "face_load_factor",
    "line_load_max",
    "hertz_pressure_max",
    "pinion_root_tension_max",
    "gear_root_tension_max",
)


def tasks(asked: Asked) -> tuple[Task, ...]:
    """Teeth in slow rotation at the duty's torque, and the transmission error over all torques."""
    operating = {
        "gear_torque": f"{asked.gear_torque!r} N*m",
        "gear_torques": [f"{torque!r} N*m" for torque in asked.torques],
    }
    scenario = {
        "title": asked.title,
        "kind": STUDY.kind,
        "drive": asked.tables["drive"],
        "operating": operating,
        "mesh": dict(asked.tables.get("mesh", {})),
    }
    return (Task(_TASK, "loaded error, pressures, root stresses", scenario),)


def answer(asked: Asked, done: Mapping[str, Done]) -> Answer:
    """Figures, loads and pressures of one pair over its roll angle, and the error over the torque."""
    summary = done[_TASK].summary
    with open_record(done[_TASK].path) as record:
        roll, load = over_roll(record, record["normal_load"])
        _, pressure = over_roll(record, np.max(record["hertz_pressure"], axis=-1))
        torques, spread = record["torque"], record["map_peak_to_peak"]
    figures = {name: summary[name] for name in _FIGURES if name in summary}
    along = {"roll_angle": roll, "normal_load": load, "hertz_pressure": pressure}
    curve = Curve(
        "Loaded transmission error, peak to peak",
        "Torque on the gear (N m)",
        "Peak to peak (µm)",
        torques,
        {"": 1e6 * np.asarray(spread)},
        asked.gear_torque,
    )
    return Answer(figures, along, (curve,))


ROLE = Role(1, "Loaded contact", tasks, answer)
