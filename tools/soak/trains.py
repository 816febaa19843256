"""Random trains: a drive twice over, its gears on a shaft between, turned and placed at random."""

from typing import Any

from tools.soak import duties
from tools.soak.draw import Draw, quantity
from tools.soak.drives import size_of
from tools.soak.studies import OILS

#: Keys of a drive that a stage has.
OF_STAGE = ("family", "module", "pressure_angle", "shape", "centre_distance", "rack", "roughness")
#: Keys of a pair's duty by those of a train's.
RENAMED = {
    "pinion_speed": "input_speed",
    "gear_torque_harmonics": "output_torque_harmonics",
    "gear_torque_table": "output_torque_table",
}


def train(draw: Draw, drive: dict[str, Any]) -> dict[str, Any]:
    """Return the scenario of a train of two equal stages; its shaft is rigid or gives way."""
    pair = duties.gear_pair(draw, drive)
    given = dict(pair.pop("operating"))
    given.pop("pinion_torque", None)
    torque = float(given.pop("gear_torque").split()[0]) * drive["gear"]["teeth"] / drive["pinion"]["teeth"]
    operating = {RENAMED.get(key, key): value for key, value in given.items()}
    operating |= {"input": "a", "output": "d", "output_torque": quantity(torque, "N*m")}
    operating["sense"] = draw.choice(("clockwise", "counter-clockwise"))
    stage = {key: drive[key] for key in OF_STAGE if key in drive}
    shaft: dict[str, Any] = {"name": "between", "gears": ["b", "c"]}
    if draw.chance(0.5):
        module, _, gear, width = size_of(drive)
        rated = duties.RATED * width * module * gear
        shaft |= {"stiffness": quantity(rated * draw.decades(1.0, 1e3), "N*m/rad"), "damping_ratio": 0.05}
    bearing = {name: quantity(draw.decades(1e6, 1e12), "N/m") for name in ("stiffness_x", "stiffness_y")}
    turned = {**drive["pinion"], "tooth_angle": quantity(draw.between(0.0, 360.0), "deg")}
    return {
        **{key: value for key, value in pair.items() if key not in ("drive", "bearings")},
        "title": "A random train",
        "kind": "gear-train",
        **{key: drive[key] for key in ("material", "mean_roughness") if key in drive},
        "gear": {"a": drive["pinion"], "b": drive["gear"], "c": turned, "d": drive["gear"]},
        "stage": [
            {**stage, "gears": ["a", "b"]},
            {**stage, "gears": ["c", "d"], "azimuth": quantity(draw.between(0.0, 360.0), "deg")},
        ],
        "shaft": [shaft],
        "bearings": {"default": {**bearing, "damping_ratio": 0.05}},
        "operating": operating,
    }


def assessed(draw: Draw, drive: dict[str, Any]) -> dict[str, Any]:
    """Return the scenario of an assessment of such a train, with one further speed."""
    subject = train(draw, drive)
    subject |= {"quality": draw.whole(3, 10), "lubricant": draw.choice(OILS)}
    subject["operating"]["oil_temperature"] = quantity(draw.between(20.0, 120.0), "degC")
    return {
        "title": "A random assessment of a train",
        "kind": "train-assessment",
        "scenario": subject,
        "assessment": {
            "application_factor": draw.between(1.0, 2.0),
            "face_load_factor": draw.between(1.0, 2.0),
            "lubrication": draw.choice(("dip", "spray", "submerged")),
            "speed_range": [0.5, 1.5],
            "speeds": draw.choice((0, 2)),
            "samples": draw.choice((0, 1)),
        },
    }
