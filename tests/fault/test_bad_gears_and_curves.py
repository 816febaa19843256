"""Gears that cannot be made or cannot run, and CSV files that cannot be read: one clear line each."""

from pathlib import Path

import pytest

from tests.support.verbs import complaint, complaints, sets

GEOMETRY = {
    "tip in the fillet": ("drive.pinion.profile_shift=-1.0", "drive.gear.addendum", "cuts", "use at most"),
    "pointed tip": ("drive.pinion.profile_shift=1.4", "drive.pinion.", "pointed", "at most"),
    "contact ratio": (
        "drive.pinion.addendum=0.05",
        "drive.pinion.addendum",
        "contact ratio",
        "larger addenda",
    ),
    "bore": ("drive.pinion.bore_radius=34 mm", "drive.pinion.bore_radius", "", ""),
    "tip below the root": ("drive.gear.tip_radius=60 mm", "drive.gear.tip_radius", "", ""),
    "cutter's corner": ("drive.pinion.fillet_radius=0.9", "drive.pinion.fillet_radius", "", ""),
    "pressure angle": ("drive.pressure_angle=60 deg", "drive.pressure_angle", "45°", ""),
}


@pytest.mark.parametrize(("setting", "key", "rule", "remedy"), GEOMETRY.values(), ids=list(GEOMETRY))
def test_gears_that_cannot_be(scenario: Path, setting: str, key: str, rule: str, remedy: str):
    file, _, rest = complaint("check", scenario, "--set", setting).partition(": ")
    assert file == "--set" or Path(file).is_file()
    assert rest.startswith(key)
    assert rule in rest
    assert remedy in rest


HELIX = ("the key of a helix is helix_angle", 'write helix_angle = "20 deg" in [drive]')
HELIX_OF_STAGE = (HELIX[0], 'write helix_angle = "20 deg" in its [[stage]]')
INTERNAL = ("the key of an internal gear is internal", "write internal = true in [drive.gear]")
NOT_MODELLED = "gears are not modelled: this version computes spur and helical gears"
PLANETS = (
    "planetary gears are a stage of a train",
    'write a [[stage]] of type = "planetary" in a scenario of the kind for trains',
)
STAGES = "several stages are of another kind of study; write [gear.NAME] and [[stage]]"
TRAIN = "two-stage-reducer"
#: As users ask for gears that have other keys, other kinds of study or none: scenario, setting, what is said.
ASKED = [
    ("", "drive.pinion.helix=15", HELIX),
    ("", 'drive.beta="15 deg"', HELIX),
    ("", "drive.family=helical", HELIX),
    (TRAIN, "stage.0.beta=0.3", HELIX_OF_STAGE),
    (TRAIN, 'stage.0.helix="15 deg"', HELIX_OF_STAGE),
    (TRAIN, "gear.wheel-1.helix_angle=0.3", HELIX_OF_STAGE),
    ("", "drive.gear.teeth=-60", INTERNAL),
    ("", "drive.gear.type=internal", INTERNAL),
    ("", "drive.ring.teeth=80", INTERNAL),
    (TRAIN, "gear.wheel-1.teeth=-82", ("write internal = true in [gear.wheel-1]",)),
    ("", "drive.type=herringbone", (": drive.type = ", f"double helical {NOT_MODELLED}")),
    ("", "drive.type=bevel", (": drive.type = ", f"bevel, worm and hypoid {NOT_MODELLED}")),
    ("", "kind=planetary", PLANETS),
    ("", "drive.planets=3", PLANETS),
    ("", "drive.carrier.speed=1", PLANETS),
    (TRAIN, "planets=3", PLANETS),
    (TRAIN, "carrier.speed=1", PLANETS),
    ("", "stages=2", (": stages = ", STAGES)),
    ("", "shafts.input=1", (": shafts = ", STAGES)),
    ("", "drive.gear2.teeth=40", (": drive.gear2 = ", STAGES)),
    ("", "idler.teeth=30", (": idler = ", STAGES)),
    ("", "gear.wheel-1.teeth=40", (": gear = ", STAGES)),
    ("", "body=[]", (": body = ", STAGES)),
    ("", "kind=gearbox", (": kind = ", STAGES)),
    ("", "operating.input=pinion-1", (": operating.input = ", STAGES)),
]


@pytest.mark.parametrize(("name", "setting", "said"), ASKED)
def test_gears_asked_for_otherwise(scenario: Path, name: str, setting: str, said: tuple[str, ...]):
    line = complaint("check", name or scenario, "--set", setting)
    assert all(part in line for part in said), line


@pytest.mark.parametrize("setting", ["operating.shaft_stifness=1", "drive.ringg=1", "drive.gear.teeth=-1"])
def test_other_mistakes_are_none_of_them(scenario: Path, setting: str):
    assert "not modelled" not in complaint("check", scenario, "--set", setting)


def test_a_planetary_gearbox_is_refused_once(scenario: Path):
    stage = '[[stage]]\ntype = "planetary"\nplanets = 3\n[stage.ring]\nteeth = -80\n'
    scenario.write_text(f'title = "a wheel hub"\nkind = "gear-pair"\n{stage}', encoding="utf-8")
    line = complaint("run", scenario)
    assert line.startswith(f"{scenario}: stage = ")
    assert "kind for trains (tribodyn list kinds)" in line


WIDE = ['helix_angle="30 deg"', 'pinion.face_width="0.9 m"', 'gear.face_width="0.9 m"']
LEFT = ['helix_angle="15 deg"', "hand=left", "gear.hand=left"]
#: A helix that cannot be: settings, key of the message, rule, remedy.
HELICES = {
    "too steep": (['helix_angle="61 deg"'], "helix_angle = 61 deg", "60 deg at most", "8 to 35 deg"),
    "negative": (['helix_angle="-15 deg"'], "helix_angle = -15 deg", "not be negative", 'hand = "left"'),
    "one hand": (LEFT, 'gear.hand = "left"', "opposite hands", 'write "right"'),
    "no angle": (["pinion.hand=left"], 'pinion.hand = "left"', "spur gears", 'helix_angle = "20 deg"'),
    "no such hand": (['helix_angle="15 deg"', "hand=up"], 'hand = "up"', "not one of", '"right" or "left"'),
    "wide": (WIDE, "helix_angle = 30 deg", "an overlap ratio of", "at most"),
}


@pytest.mark.parametrize(("settings", "key", "rule", "remedy"), HELICES.values(), ids=list(HELICES))
def test_a_helix_that_cannot_be(scenario: Path, settings: list[str], key: str, rule: str, remedy: str):
    line = complaint("check", scenario, *sets(*(f"drive.{setting}" for setting in settings)))
    assert f": drive.{key}: " in line
    assert rule in line
    assert remedy in line


#: What a study says of an internal gear: scenario, settings, key, and a part of the message.
INTERNAL_GEARS = [
    ("ehl-involute-23-47", ["drive.gear.internal=true"], "drive.gear.internal", "external gears alone"),
    ("ring-36-93", ["drive.pinion.internal=true"], "drive.pinion.internal", "[drive.gear]"),
    ("involute-18-36", ["drive.gear.internal=true"], "drive.gear.bore_radius", "outer_diameter"),
    ("ring-36-93", ["drive.gear.rim=pins"], "drive.gear.pins", "give pins"),
    ("ring-36-93", ["drive.gear.pins=12"], "drive.gear.pins", 'write rim = "pins"'),
    ("ring-36-93", ["drive.gear.rim=pins", "drive.gear.pins=2"], "drive.gear.pins", "3"),
    ("ring-36-93", ["drive.pinion.pins=12"], "drive.pinion.pins", "add internal = true"),
    ("ring-36-93", ["mesh.compliance=fem", "mesh.slices=7"], "mesh.slices", "even along the face"),
    ("ring-36-93", ["losses.windage=dawson"], "losses.windage", "external gears"),
    ("ring-36-93", ["temperature.model=iso"], "temperature.model", 'use "network"'),
]


@pytest.mark.parametrize(("name", "settings", "key", "says"), INTERNAL_GEARS)
def test_studies_say_what_they_have_not_of_internal_gears(
    name: str, settings: list[str], key: str, says: str
):
    assert any(key in line and says in line for line in complaints("check", name, *sets(*settings)))


CURVES = {
    "empty": ("# nothing\n", "line 1", "the file is empty"),
    "no units": ("time,torque\n0,1\n1,2\n", "line 1", 'no column "time [unit]"'),
    "no column": ("time [s],load [N*m]\n0,1\n1,2\n", "line 1", 'no column "torque [unit]"'),
    "not a number": ("time [s],torque [N*m]\n0,1\n1,x\n", "line 3", '"x" is not a number (torque)'),
    "not finite": ("time [s],torque [N*m]\n0,1\n1,nan\n", "torque.values.1 = nan", "not a finite number"),
    "wrong unit": ("time [s],torque [N]\n0,1\n1,2\n", "operating.gear_torque_table", "not a unit of torque"),
    "not sorted": ("time [s],torque [N*m]\n0,1\n0,2\n", "operating.gear_torque_table", "does not increase"),
    "line break in quotes": ('time [s],torque [N*m]\n0,"1\n2"\n3,4\n', "line 2", ""),
    "long field": ("time [s],torque [N*m]\n0," + "1" * 200_000 + "\n", "line 2", ""),
    "long heading": ("time [s],torque [" + "N" * 200_000 + "]\n0,1\n", "line 1", ""),
    "long unit": ("time [s],torque [" + "N*" * 9_000 + "m]\n0,1\n1,2\n", "", "a unit of 18001 characters"),
    "tower of powers": ("time [s**9**9**9],torque [N*m]\n0,1\n1,2\n", "", "not a unit"),
    "unit with a bang": ("time [s!],torque [N*m]\n0,1\n1,2\n", "", "not a unit"),
    "times of 1e308": ("time [s],torque [N*m]\n0,1\n1e308,2\n", "", "not between 1e-30 and 1e+30"),
    "nothing but a quote": ('time [s],torque [N*m]\n"', "line 2", ""),
}


@pytest.mark.parametrize(("text", "place", "rule"), CURVES.values(), ids=list(CURVES))
def test_a_mistake_in_a_csv_file(scenario: Path, text: str, place: str, rule: str):
    curve = scenario.with_name("load.csv")
    curve.write_text(text, encoding="utf-8")
    lines = complaints("check", scenario, "--set", "operating.gear_torque_table=load.csv")
    assert all(line.startswith(f"{curve}: operating.gear_torque_table") for line in lines)
    assert place in lines[0]
    assert rule in lines[0]
    assert len(lines[0]) < 1000
