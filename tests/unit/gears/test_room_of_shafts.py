"""A shaft on the axis of another's gear: refused where it runs into it, not in a hollow shaft."""

import pytest

import tribodyn as td
from tribodyn.gears.drawn_system import ShaftData, check_room_of_shafts
from tribodyn.input.tables.drawn_shafts import DrawnShaft

SPRINGS = [
    {"position": place, "stiffness_x": "3e8 N/m", "stiffness_y": "3e8 N/m", "stiffness_axial": "1e8 N/m"}
    for place in ("5 mm", "90 mm")
]


def shaft(name: str, body: int, start: float, sections: list[dict[str, str]]) -> ShaftData:
    drawing = DrawnShaft.model_validate({"section": sections, "gear_position": "30 mm", "bearing": SPRINGS})
    return ShaftData(name, f"shaft.{name}.drawn", drawing, ((body, 0.03),), (0.0, 0.0), start, 1, 10.0)


def room(bore: str, reach: float) -> None:
    """A hollow shaft from z = 0, bored over 20 mm, its face 10 to 50 mm; another ends at `reach`."""
    bored = {"length": "20 mm", "diameter": "70 mm", "bore": bore}
    hollow = shaft("hollow", 1, 0.0, [bored, {"length": "80 mm", "diameter": "70 mm"}])
    inner = shaft("inner", 0, reach - 0.1, [{"length": "100 mm", "diameter": "50 mm"}])
    check_room_of_shafts((hollow, inner), [("gear", 1, 0.12, 0.04)], [(0.3, 0.0), (0.0, 0.0)])


def test_a_shaft_may_end_in_the_bore_under_the_gear_of_another():
    room("58 mm", 0.018)
    room("58 mm", 0.009)


@pytest.mark.parametrize(("bore", "reach"), [("48 mm", 0.018), ("58 mm", 0.025), ("0 mm", 0.018)])
def test_it_may_not_run_into_its_material(bore: str, reach: float):
    with pytest.raises(td.InputError, match="penetrates gear on the shaft hollow by 145 mm"):
        room(bore, reach)
