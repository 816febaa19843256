"""Flanks, axes, loads and wear that cannot be studied: one clear line each, exit status 2, no file."""

from pathlib import Path

import pytest

from tests.support.verbs import complaint, complaints, sets
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

LOAD, WEAR = "load-contact-18-36", "wear-18-36"
PINION, TURNED = "drive.pinion.modification", "mesh.misalignment.in_plane"
TIP = (f"{PINION}.tip_relief=20 um", f"{PINION}.tip_relief_length=4 mm")
PITCH_ERRORS = f"{PINION}.pitch_errors={['1 um'] * 18}"
CROWNED = "drive.gear.modification.crowning"

#: Of a study: settings; the key that is named first, what the rule says and what the remedy.
FLANKS = [
    ((f"{PINION}.tip_relief=3 mm", TIP[1]), f"{PINION}.tip_relief = 3 mm", "at most", "give"),
    ((f"{PINION}.crowning=0.4 mm",), f"{PINION}.crowning = 0.4 mm", "at most 300 um, the tenth of", "give"),
    (
        (f"{TURNED}=40 arcmin", f"{CROWNED}=4 um", "operating.gear_torque=20 N*m"),
        *(f"{TURNED} = 40 arcmin", "lifts the flanks off each other", "give less, or more torque"),
    ),
    (
        (f"{CROWNED}=250 um", f"{TURNED}=1 arcmin", "mesh.slices=5"),
        *(f"{CROWNED} = 250 um", "of 5 slices carry the heaviest pair", "more mesh.slices"),
    ),
    ((TIP[0], f"{PINION}.tip_relief_length=30 mm"), f"{PINION}.tip_relief_length", "path of contact", "give"),
    (
        (f"{PINION}.crowning=8 um", f"{PINION}.lead_relief_end=8 um"),
        *(f"{PINION}.lead_relief_end = 8 um", "contradicts crowning", "the one or the other"),
    ),
    (
        (f"{PINION}.lead_relief_end=8 um", f"{PINION}.lead_unmodified=30 mm"),
        *(f"{PINION}.lead_unmodified = 30 mm", "longer than the face of 26.7 mm", "less"),
    ),
    (("mesh.slices=2",), "mesh.slices = 2", "neither one slice nor enough", "at least 3"),
    (("mesh.slices=1", f"{TURNED}=1 arcmin"), "mesh.slices = 1", "too few for what varies", "at least 3"),
    (
        (f'{PINION}.pitch_errors=["1 um", "2 um"]',),
        *(f"{PINION}.pitch_errors = 2 values", "the gear has 18 teeth", "one value per tooth"),
    ),
    (
        ('operating.gear_torques=["100 N*m", "50 N*m"]',),
        *("operating.gear_torques.1 = 50 N*m", "not greater than the 100 N*m before it", "increasing"),
    ),
    (
        ('operating.gear_torques=["100 N*m"]',),
        *("operating.gear_torques = 100 N*m", "a single torque makes no map", "at least two"),
    ),
]
K = "wear.coefficient"
WORN = [
    ((f"{K}=0 m**2/N",), f"{K} = ", "must be greater than zero", "write"),
    ((f"{K}=-1e-18 m**2/N",), f"{K} = ", "greater than zero", "write"),
    ((f"{K}=1e-18",), f"{K} = ", "without a unit", "m**2/N"),
    ((f"{K}=1e-18 m/N",), K, "not a unit", "m**2/N"),
    (("wear.revolutions=0",), "wear.revolutions = 0", "greater than 0", ""),
    (("wear.law=archimedes",), "wear.law = ", "no such wear law", "archard"),
    (("wear.hardness=3",), "wear.hardness = 3", "unknown key", "coefficient"),
    (
        ("wear.energy_coefficient=1e-8 mm**3/J",),
        *("wear.energy_coefficient", 'it is a key of law = "energy"', "leave energy_coefficient out"),
    ),
    (("wear.law=energy",), "wear.energy_coefficient", "missing", "add"),
    (
        ("wear.separating_film_parameter=0.3",),
        *("wear.separating_film_parameter = 0.3", "must be above boundary_film_parameter, 0.5"),
        "write a larger number",
    ),
    (("wear.load_change=0.5",), "wear.load_change = 0.5", "0.2", ""),
    (("output.every=1",), "output.every = 1", "more than 100000 records", "larger"),
    ((PITCH_ERRORS,), f"{PINION}.pitch_errors", 'contradicts wear.teeth = "alike"', 'wear.teeth = "each"'),
    (
        ("operating.gear_torque=-100 N*m",),
        *("operating.gear_torque = -100 N*m", "must be greater than zero", "write a torque"),
    ),
]


@pytest.mark.parametrize(
    ("name", "settings", "key", "rule", "remedy"),
    [(name, *mistake) for name, mistakes in ((LOAD, FLANKS), (WEAR, WORN)) for mistake in mistakes],
)
def test_a_mistake(tmp_path: Path, name: str, settings: tuple[str, ...], key: str, rule: str, remedy: str):
    lines = complaints("run", name, *sets(*settings), "-o", tmp_path / "study.h5")
    assert name == LOAD or len(lines) == 1
    assert key in lines[0]
    assert rule in lines[0]
    assert remedy in lines[0].partition("; ")[2]
    assert list(tmp_path.iterdir()) == []


TIP_RELIEF = (TIP, f"{PINION}.tip_relief = 20 um", 'compliance = "energy"')
#: Kinds of run that do not know the face: what is given, and which contradiction is reported.
ELSEWHERE = [
    ("crc-23-47", *TIP_RELIEF),
    ("crc-23-47", ("mesh.slices=5",), "mesh.slices = 5", "energy"),
    (
        *("efficiency-involute-18-36", ("mesh.compliance=fem", PITCH_ERRORS)),
        *(f"{PINION}.pitch_errors = 18 values", "repeats one mesh cycle"),
    ),
]


@pytest.mark.parametrize(("name", "settings", "key", "rule"), ELSEWHERE)
def test_runs_that_do_not_know_the_face_refuse_it(name: str, settings: tuple[str, ...], key: str, rule: str):
    line = complaint("check", name, *sets(*settings))
    assert line.startswith(f"--set: {key}")
    assert rule in line
    assert "; leave it out" in line


CSV = {
    "another column": ("mistake [um]\n1\n", 'no column "error [unit]"'),
    "not a number": ("error [um]\n1\nx\n", '"x" is not a number (error)'),
    "not a length": ("error [deg]\n" + "1\n" * 18, '"deg" is not a unit of length'),
    "too long": ("error [um]\n" + "1\n" * 19, "19 values"),
}


@pytest.mark.parametrize(("text", "rule"), CSV.values(), ids=list(CSV))
def test_a_mistake_in_a_list_of_errors(tmp_path: Path, text: str, rule: str):
    scenario, curve = tmp_path / "mine.toml", tmp_path / "pitch.csv"
    scenario.write_text(
        'title = "mine"\nkind = "load-contact"\n[drive]\nlike = "diez-ibarbia-18-36"\n'
        '[drive.pinion.modification]\npitch_errors = "pitch.csv"\n[operating]\ngear_torque = "318 N*m"\n',
        encoding="utf-8",
    )
    curve.write_text(text, encoding="utf-8")
    line = complaints("check", scenario)[0]
    assert line.startswith(f"{curve}: {PINION}.pitch_errors")
    assert rule in line


DRY = """title = "Dry"
kind = "wear"
drive = "diez-ibarbia-18-36"
[operating]
pinion_speed = "150 rpm"
gear_torque = "300 N*m"
[wear]
revolutions = 1e6
"""
ENERGY = 'energy"\nenergy_coefficient = "1e-8 mm**3/J'
#: Of flanks without a lubricant: law, further tables; the key that is named and what the rule says.
WITHOUT_OIL = {
    "a law of the film": ("priest-taylor", "", "wear.law", "there is no lubricant"),
    "asperities under a film": ("archard-asperities", "", "wear.law", "there is no lubricant"),
    "a film law": ("archard", '[film]\nlaw = "moes"\n', "film", "without a lubricant there is no film"),
    "a law of oil": ("archard", '[friction]\nlaw = "xu"\n', "friction.law", "of lubricated flanks"),
    "energy without friction": (ENERGY, "", "wear.law", "goes by friction, and there is none"),
}


@pytest.mark.parametrize(("law", "more", "key", "rule"), WITHOUT_OIL.values(), ids=list(WITHOUT_OIL))
def test_without_a_lubricant(law: str, more: str, key: str, rule: str, tmp_path: Path):
    path = tmp_path / "dry.toml"
    path.write_text(f'{DRY}law = "{law}"\n{more}', encoding="utf-8")
    line = complaint("run", path, "-o", tmp_path / "worn.h5")
    assert line.startswith(f"{path}: {key}")
    assert rule in line


def test_another_scenario_does_not_go_on(tmp_path: Path):
    path = tmp_path / "worn.h5"
    keys = {"wear.revolutions": 1e6, "output.every": 1e6, "output.positions_per_cycle": 12}
    run(load_scenario(WEAR, keys), path)
    line = complaint("run", WEAR, "--set", "operating.gear_torque=200 N*m", "--resume", "-o", path)
    assert "--resume" in line
    assert "made from another scenario" in line
