"""A stage whose pinion overhangs its bearings, which are springs, as a train's scenario in tables."""

from typing import Any

_SPRINGS = {"stiffness_x": "4e8 N/m", "stiffness_y": "4e8 N/m", "stiffness_axial": "3e8 N/m"}


def overhung_train(
    *, mirrored: bool = False, hand: str = "right", helix: float = 15.0, width: float = 30.0, **more: Any
) -> dict[str, Any]:
    """25/50 teeth of module 3 mm at 300 N m; `mirrored`: looked at from the other end.

    `helix` in degrees, `width` in mm; `more` tables stand in place of its own.
    """

    def drawn(gear: str, place: float, length: float, bearings: tuple[float, float]) -> dict[str, Any]:
        places = sorted(length - at if mirrored else at for at in bearings)
        return {
            "positions": {gear: f"{length - place if mirrored else place} mm"},
            "section": [{"length": f"{length} mm", "diameter": "40 mm"}],
            "bearing": [_SPRINGS | {"position": f"{at} mm"} for at in places],
        }

    gears = {
        "one": {"teeth": 25, "hand": hand, "face_width": f"{width} mm", "bore_diameter": "40 mm"},
        "two": {"teeth": 50, "face_width": f"{width} mm", "bore_diameter": "40 mm"},
    }
    stage = {"name": "only", "gears": ["one", "two"], "module": "3 mm", "pressure_angle": "20 deg"}
    return {
        "title": "An overhung pinion",
        "kind": "gear-train",
        "lubricant": "iso-vg-220-mineral",
        "material": "16MnCr5",
        "mean_roughness": "0.4 um",
        "gear": gears,
        "stage": [stage | {"helix_angle": f"{helix} deg"}],
        "shaft": [
            {"name": "a", "gears": ["one"], "drawn": drawn("one", 130.0, 150.0, (20.0, 85.0))},
            {"name": "b", "gears": ["two"], "drawn": drawn("two", 60.0, 120.0, (15.0, 105.0))},
        ],
        "bearings": {},
        "operating": {
            "input": "one",
            "output": "two",
            "input_speed": "1000 rpm",
            "output_torque": "300 N*m",
            "oil_temperature": "70 degC",
        },
        "mesh": {"damping_ratio": 0.05, "slices": 11},
        "friction": {"law": "none"},
        "solver": {"cycles": 1},
        "output": {"samples_per_cycle": 16},
    } | more
