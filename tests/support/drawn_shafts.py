"""Shafts as drawn for tests, as a scenario's tables: an overhung pinion, a gear between its bearings."""

from typing import Any

TAPERED = {
    "type": "tapered-roller",
    "elements": 20,
    "element_diameter": "9.5 mm",
    "roller_length": "13 mm",
    "pitch_diameter": "66 mm",
    "contact_angle": "15 deg",
    "preload": "5 um",
    "dynamic_rating": "67 kN",
}
BALL = {
    "type": "deep-groove-ball",
    "elements": 9,
    "element_diameter": "12 mm",
    "pitch_diameter": "60 mm",
    "clearance": "10 um",
}
ROLLER = {
    "type": "cylindrical-roller",
    "elements": 14,
    "element_diameter": "11 mm",
    "roller_length": "11 mm",
    "pitch_diameter": "60 mm",
}
OVERHUNG: dict[str, Any] = {
    "gear_position": "130 mm",
    "section": [{"length": "145 mm", "diameter": "45 mm"}],
    "bearing": [
        TAPERED | {"position": "15 mm", "thrust": "-z"},
        TAPERED | {"position": "85 mm", "thrust": "+z"},
    ],
}
BETWEEN: dict[str, Any] = {
    "gear_position": "60 mm",
    "section": [{"length": "120 mm", "diameter": "42 mm", "bore": "10 mm"}],
    "bearing": [BALL | {"position": "15 mm"}, ROLLER | {"position": "105 mm"}],
}
SHAFTS = {"pinion": OVERHUNG, "gear": BETWEEN}
