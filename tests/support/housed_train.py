"""A helical stage on two shafts in a box of plates: files and tables as a user has them."""

from functools import lru_cache
from pathlib import Path
from typing import Any

import tomli_w

import tribodyn as td
from tribodyn.train.elastic.superelement import SuperElement

#: Places of both axes in the box, m: 75 teeth of a normal module of 4 mm and 15°.
SIZE, THICKNESS = (0.4, 0.3, 0.2), 0.025
AXES = ((0.12, 0.15), (0.12 + 0.1552914, 0.15))
SEATS = {"fast-1": "A", "fast-2": "B", "slow-1": "C", "slow-2": "D"}
_SPRINGS = {"stiffness_x": "3e8 N/m", "stiffness_y": "3e8 N/m"}
_SPAN = 175.0  # mm, between the middles of the walls


@lru_cache
def box() -> SuperElement:
    """A coarse box of four seats, bolted down, with a point on top."""
    bores = {
        seat: (*axis, wall, 0.04)
        for axis, names in zip(AXES, ("AB", "CD"), strict=True)
        for seat, wall in zip(names, ("front", "back"), strict=True)
    }
    points = {"top": (0.2, 0.3, 0.1)}
    return td.plate_housing(SIZE, THICKNESS, bores, points=points, highest=2500.0, element_size=0.4)


def housed_train(**more: Any) -> dict[str, Any]:
    """25/50 teeth at 800 N m, 1000 rpm; `more` tables stand in place of its own."""

    def drawn(gear: str, seats: str) -> dict[str, Any]:
        held = ({"stiffness_axial": "2e8 N/m"}, {})
        return {
            "positions": {gear: f"{_SPAN / 2.0} mm"},
            "section": [{"length": f"{_SPAN} mm", "diameter": "50 mm"}],
            "damping_ratio": 0.0,
            "bearing": [
                _SPRINGS | along | {"position": f"{place} mm", "seat": seat}
                for along, place, seat in zip(held, (0.0, _SPAN), seats, strict=True)
            ],
        }

    stage = {"name": "only", "gears": ["pinion", "wheel"], "module": "4 mm", "pressure_angle": "20 deg"}
    return {
        "title": "Two shafts in a box of plates",
        "kind": "gear-train",
        "lubricant": "iso-vg-220-mineral",
        "material": "18CrNiMo7-6",
        "mean_roughness": "0.6 um",
        "gear": {
            "pinion": {"teeth": 25, "hand": "left", "face_width": "30 mm"},
            "wheel": {"teeth": 50, "face_width": "30 mm"},
        },
        "stage": [stage | {"helix_angle": "15 deg", "azimuth": "0 deg"}],
        "shaft": [
            {"name": "fast", "gears": ["pinion"], "drawn": drawn("pinion", "AB")},
            {"name": "slow", "gears": ["wheel"], "drawn": drawn("wheel", "CD")},
        ],
        "bearings": {},
        "housing": {"matrices": "housing.h5"},
        "operating": {
            "input": "pinion",
            "output": "wheel",
            "input_speed": "1000 rpm",
            "output_torque": "800 N*m",
            "oil_temperature": "60 degC",
        },
        "mesh": {"compliance": "constant", "stiffness": "4e8 N/m", "damping_ratio": 0.05, "slices": 3},
        "friction": {"law": "niemann"},
        "solver": {"cycles": 12},
        "output": {"samples_per_cycle": 64},
    } | more


def written(folder: Path, **more: Any) -> Path:
    """The housing and the scenario as files in a folder."""
    td.write_matrices(box(), folder / "housing.h5")
    scenario = folder / "gearbox.toml"
    scenario.write_text(tomli_w.dumps(housed_train(**more)), encoding="utf-8")
    return scenario
