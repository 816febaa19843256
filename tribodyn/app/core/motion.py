"""The motion of a gearbox as ``tribodyn run`` computes it: its last mesh cycles, spectrum and summary."""

from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.app.core.shown import rows_of
from tribodyn.cases.results import Progress
from tribodyn.errors import SimulationError
from tribodyn.post.cycles import last_cycles, mesh_phases, shown_cycles
from tribodyn.quantities.quantity import SHOWN
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import Loaded

#: Quantities over time of a mesh and of its pairs -> the unit in which they are given.
OF_MESH = {"transmission_error_rotational": "µm"}
OF_PAIRS = {
    "normal_load": "N",
    "central_film_thickness": "µm",
    "film_parameter": "",
    "hertz_pressure": "MPa",
    "flash_temperature_rise": "K",
    "friction_coefficient": "",
    "friction_force": "N",
    "sliding_speed": "m/s",
}
WHOLE = {"power_friction": "W", "efficiency": ""}
#: Samples of a curve at most.
MOST = 1200
HARMONICS = 8


def motion_of(loaded: Loaded, path: Path, mesh: int, progress: Progress | None = None) -> dict[str, Any]:
    """Run a case to a record at a path, and take from it what a page shows of a mesh.

    `phase` (cycles of the mesh) and `time` (s) of the curves; `curves`, name -> values (n,) or (n, pairs),
    the pair that entered last first, in `units`; `harmonics` (µm) of the transmission error, and `spectrum`
    (Hz, µm); `rows` of the summary, with `heading`s, `mesh_rows` of the mesh, `verdict`, `trust`, `summary`,
    SI. Raises SimulationError where the run stops before its end.
    """
    result = loaded.study.run(loaded.case, path, force=True, progress=progress)
    if result.status != "complete":
        raise SimulationError(result.message)
    with Record(result.path) as record:
        return _of_record(loaded, record, mesh)


def _of_record(loaded: Loaded, record: Record, mesh: int) -> dict[str, Any]:
    window = last_cycles(record, shown_cycles(record))
    part, factor = window.part, {}
    step = max(1, -(-(part.stop - part.start) // MOST))
    chosen = slice(part.start, part.stop, step)
    order = [record.pairs.index(pair) for pair in sorted(record.pairs, reverse=True) if pair <= 1]
    curves: dict[str, np.ndarray] = {}
    for names, over_pairs in ((OF_MESH, False), (OF_PAIRS, True)):
        for name, unit in names.items():
            if name in record:
                values = record.over_meshes(name)[chosen, mesh]
                curves[name] = _in_unit(values[:, order] if over_pairs else values, unit)
                factor[name] = unit
    for name, unit in WHOLE.items():
        if name in record:
            curves[name], factor[name] = _in_unit(record[name][chosen], unit), unit
    phase = mesh_phases(record)[chosen, mesh]
    name = record.meshes[mesh]
    summary = dict(record.summary)
    of_mesh = dict(record.mesh_summaries.get(name, {}))
    reported, verdict = loaded.study.reported(), loaded.study.verdict(record)
    return {
        "phase": phase - np.floor(phase[0] + 1e-9),
        "time": record["time"][chosen],
        "curves": curves,
        "units": factor,
        "harmonics": np.asarray(of_mesh.get("transmission_error_harmonics", ())) * 1e6,
        "spectrum": [
            np.asarray(of_mesh.get("spectrum_frequencies", ())),
            np.asarray(of_mesh.get("spectrum_amplitudes", ())) * 1e6,
        ],
        "rows": rows_of(reported, summary),
        "mesh_rows": rows_of(reported, of_mesh),
        "verdict": list(verdict),
        "trust": record.trust,
        "summary": summary,
    }


def _in_unit(values: np.ndarray, unit: str) -> np.ndarray:
    _, factor, offset = SHOWN.get(unit, ("", 1.0, 0.0))
    return (np.asarray(values, float) + offset) * factor
