"""A published design report of a helical stage (KISSsoft 2017), factor by factor: ISO 6336 and its parts.

The report prints its load factors, which follow from a tolerance class that it does not print: they are given
here as they stand there.
"""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from tribodyn.geometry.drive import SIDES
from tribodyn.studies.gears.prepare import assembled
from tribodyn.studies.gears.rated.capacity import capacity_of, life_bins
from tribodyn.studies.gears.rated.standard import iso_part, rated_duty, standard_of
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.validation.rows import Row, compare, published

PAPER = "helical-report-2017"
#: As printed.
GIVEN = {
    "assessment.application_factor": 1.25,
    "assessment.dynamic_factor": 1.092,
    "assessment.face_load_factor": 1.15,
    "assessment.transverse_load_factor": 1.069,
    "assessment.required_life": "175200 h",
    "assessment.peak_roughness": "4.8 um",
    "assessment.root_roughness": "20 um",
    "drive.material.thermal_conductivity": "50 W/(m*K)",  # thermal contact coefficient B_M 13.78
}
#: Tip diameters at the middle of a tolerance of 0.1 mm below the printed ones.
SMALLER_TIPS = {"drive.pinion.tip_diameter": "380.697 mm", "drive.gear.tip_diameter": "1395.326 mm"}
OTHERWISE = "tip diameters 0.05 mm smaller"
#: What depends on where single pair contact ends on the tooth, which the mate's tip circle decides.
_OF_LOADED_POINT = ("h_F", "Y_F", "Y_S", "sigma_F0", "sigma_F")
#: Units of the report -> value of 1 in SI units, where the catalogue shows another one.
_UNITS = {"1e6": 1e6, "(N/mm2)^0.5": 1e3, "N/mm2": 1e6, "mm": 1e-3, "um": 1e-6}


def rows(folder: Path, progress: Callable[[float], None] | None = None) -> list[Row]:
    """All rows; nothing needs a run, and nothing is written into `folder`."""
    own, other = _values(GIVEN), _values(GIVEN | SMALLER_TIPS)
    if progress:
        progress(1.0)
    found = []
    for key, row in published(PAPER).items():
        name, unit = key.partition("/")[2], _UNITS.get(row["unit"], 1.0)
        computed, smaller = own[name] / unit, other[name] / unit
        of_root = name.partition("-")[0] in _OF_LOADED_POINT
        found.append(compare(row, computed, "", (OTHERWISE, smaller) if of_root else None))
    return found


def _values(changes: Mapping[str, Any]) -> dict[str, float]:
    """What is printed by the names of the rows, SI units and °C."""
    case = load_scenario("assessment-helical-24-95", changes)
    assembly = assembled(case)
    duty = rated_duty(case.settings, case.oil_temperature, face=1.0)
    standard = standard_of(case, assembly, duty)
    bins = life_bins(case, assembly, standard.factors)
    capacity = capacity_of(case, assembly, standard.factors, bins, case.settings)
    assert capacity is not None, "the drive's material has a heat treatment"
    found = {
        "contact-ratio": standard.path.contact_ratio,
        "overlap-ratio": standard.path.overlap_ratio,
    }
    for name, value in (iso_part(case, standard) | capacity.by_name()).items():
        if not isinstance(value, Mapping):
            found[name] = float(value)
        elif SIDES[0] in value:
            found |= {f"{name}-{side}": float(value[side]) for side in SIDES}
        else:  # along the path: at A, where the film is thinnest
            found[name] = float(value["A"])
    return found
