"""A gearbox of one helical stage as REXS, written by hand, and pieces of it that tests replace."""

from pathlib import Path
from typing import Any

import pytest

#: Gearboxes of other programs, where they are at hand.
SAMPLES = Path(__file__).parents[3] / "shared" / "reference" / "rexs"

_FRAME = """
      <attribute id="support_vector" unit="mm"><array><c>{0}</c><c>{1}</c><c>{2}</c></array></attribute>
      <attribute id="u_axis_vector" unit="mm"><array><c>1</c><c>0</c><c>0</c></array></attribute>
      <attribute id="w_axis_vector" unit="mm"><array><c>0</c><c>0</c><c>1</c></array></attribute>
      <attribute id="reference_component_for_position">1</attribute>"""


def sample(name: str) -> Path:
    """The file of a gearbox of another program; the test is skipped where it is not at hand."""
    path = SAMPLES / name
    if not path.is_file():
        pytest.skip(f"{path} is not there")
    return path


def part(number: int, sort: str, name: str = "", **values: Any) -> str:
    """A component; a value is a number with a unit, "3 mm", or a text."""
    lines = []
    for key, value in values.items():
        if key == "at":
            lines.append(_FRAME.format(*value))
            continue
        amount, _, unit = str(value).partition(" ")
        lines.append(f'\n      <attribute id="{key}" unit="{unit or "none"}">{amount}</attribute>')
    return f'\n    <component id="{number}" type="{sort}" name="{name}">{"".join(lines)}\n    </component>'


def relation(number: int, sort: str, **roles: int) -> str:
    """A relation."""
    refs = "".join(f'<ref role="{role}" id="{each}"/>' for role, each in roles.items())
    return f'\n    <relation id="{number}" type="{sort}">{refs}</relation>'


#: Parts of the gearbox by id: pinion of 20 and wheel of 41 teeth on shafts with deep groove ball bearings.
PARTS = {
    1: part(1, "gear_unit", "One stage"),
    2: part(2, "gear_casing", "Casing", temperature_lubricant="70 C"),
    3: part(3, "shaft", "input", at=(0, 0, 0), rotational_speed="-1500 1 / min", defines_speed="true"),
    4: part(4, "shaft", "output", at=(10, 0, 93), mean_operating_temperature="60 C"),
    5: part(
        5, "shaft_section", "", u_coordinate_on_shaft="0 mm", length="120 mm", outer_diameter_begin="35 mm"
    ),
    6: part(
        6, "shaft_section", "", u_coordinate_on_shaft="0 mm", length="100 mm", outer_diameter_begin="50 mm"
    ),
    7: part(
        7,
        "cylindrical_gear",
        "pinion",
        at=(60, 0, 0),
        u_coordinate_on_shaft="60 mm",
        number_of_teeth=20,
        normal_module="2.9 mm",
        helix_angle_reference_diameter="-18 deg",
        face_width="32 mm",
        arithmetic_mean_roughness_flank_iso_4287_1997="0.4 mum",
        global_tolerance_class_iso_1328_2013=6,
    ),
    8: part(
        8,
        "cylindrical_gear",
        "wheel",
        at=(60, 0, 93),
        u_coordinate_on_shaft="50 mm",
        number_of_teeth=41,
        normal_module="2.9 mm",
        helix_angle_reference_diameter="18 deg",
        face_width="30 mm",
        bore_without_meaning="3 mm",
    ),
    9: part(
        9, "cylindrical_gear_flank", "", normal_pressure_angle="20 deg", addendum_modification_coefficient=0.1
    ),
    10: part(
        10,
        "cylindrical_gear_flank",
        "",
        normal_pressure_angle="20 deg",
        addendum_modification_coefficient=-0.08,
    ),
    11: part(
        11, "cylindrical_stage", "stage", center_distance="93 mm", rotating_angle_around_neg_u_axis="0 deg"
    ),
    12: part(
        12,
        "external_load",
        "motor",
        u_coordinate_on_shaft="0 mm",
        torque_around_u_axis="-80 N m",
        transmits_torque="true",
    ),
    13: part(13, "external_load", "machine", u_coordinate_on_shaft="100 mm", transmits_torque="true"),
    **{
        number: part(
            number,
            "rolling_bearing_with_catalog_geometry",
            f"bearing {number}",
            bearing_type="radial_grooved_ball_bearing",
            axial_force_absorption=held,
            u_coordinate_on_shaft_inner_side=place,
            inner_diameter="35 mm",
            outer_diameter="72 mm",
            radial_static_load_rating="15.3 kN",
            radial_dynamic_load_rating="25.5 kN",
        )
        for number, place, held in (
            (14, "10 mm", "both_directions"),
            (15, "110 mm", "no_direction"),
            (16, "10 mm", "both_directions"),
            (17, "90 mm", "no_direction"),
        )
    },
    18: part(
        18,
        "lubricant",
        "oil",
        viscosity_at_40_degree_celsius="150 mm^2 / s",
        viscosity_at_100_degree_celsius="14.5 mm^2 / s",
        density_at_15_degree_celsius="0.88 kg / dm^3",
        lubricant_type_iso_6336_2019="polyalfaolefin",
    ),
}
RELATIONS = [
    relation(1, "stage", stage=11, gear_1=7, gear_2=8),
    *(relation(n, "assembly", assembly=a, part=p) for n, a, p in (
        (2, 3, 5), (3, 4, 6), (4, 3, 7), (5, 4, 8), (6, 3, 12), (7, 4, 13), (8, 1, 11),
    )),
    relation(9, "flank", gear=7, left=9, right=9),
    relation(10, "flank", gear=8, left=10, right=10),
    *(relation(n, "side", assembly=b, inner_part=s, outer_part=2) for n, b, s in (
        (11, 14, 3), (12, 15, 3), (13, 16, 4), (14, 17, 4),
    )),
    relation(15, "reference", origin=2, referenced=18),
]  # fmt: skip


def one_stage(version: str = "2.0.0", parts: dict[int, str] | None = None, more: str = "") -> str:
    """The gearbox; `parts` take the place of its own, `more` stands behind its relations."""
    components = "".join((PARTS | (parts or {})).values())
    made = 'applicationId="by hand" applicationVersion="1" date="2026-01-01T00:00:00+00:00"'
    head = f'<model version="{version}" {made}>'
    body = f"<relations>{''.join(RELATIONS)}{more}</relations><components>{components}</components>"
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{head}{body}</model>\n'
