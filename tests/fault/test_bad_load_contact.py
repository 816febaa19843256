"""Flanks, axes and loads that cannot be studied: one clear line each, exit status 2, nothing written."""

from collections.abc import Callable
from pathlib import Path

import pytest

Refused = Callable[..., tuple[int, list[str]]]

STUDY = "load-contact-18-36"
PINION = "drive.pinion.modification"
TIP = (f"{PINION}.tip_relief=20 um", f"{PINION}.tip_relief_length=4 mm")
PITCH_ERRORS = f"{PINION}.pitch_errors={['1 um'] * 18}"

#: Settings; the key that is named first, what the rule says and what the remedy.
MISTAKES = {
    "relief larger than the tooth": (
        (f"{PINION}.tip_relief=3 mm", f"{PINION}.tip_relief_length=4 mm"),
        f"{PINION}.tip_relief = 3 mm",
        "at most",
        "give",
    ),
    "crowning deeper than a modification": (
        (f"{PINION}.crowning=0.4 mm",),
        f"{PINION}.crowning = 0.4 mm",
        "at most 300 um, the tenth of the module",
        "give",
    ),
    "misalignment that lifts the face": (
        (
            "mesh.misalignment.in_plane=40 arcmin",
            "drive.gear.modification.crowning=4 um",
            "operating.gear_torque=20 N*m",
        ),
        "mesh.misalignment.in_plane = 40 arcmin",
        "lifts the flanks off each other",
        "give less, or more torque",
    ),
    "crowning that lifts the face": (
        ("drive.gear.modification.crowning=250 um", "mesh.misalignment.in_plane=1 arcmin", "mesh.slices=5"),
        "drive.gear.modification.crowning = 250 um",
        "of 5 slices carry the heaviest pair",
        "more mesh.slices",
    ),
    "relief longer than the path": (
        (f"{PINION}.tip_relief=20 um", f"{PINION}.tip_relief_length=30 mm"),
        f"{PINION}.tip_relief_length",
        "path of contact",
        "give",
    ),
    "crowning and end relief": (
        (f"{PINION}.crowning=8 um", f"{PINION}.lead_relief_end=8 um"),
        f"{PINION}.lead_relief_end = 8 um",
        "contradicts crowning",
        "the one or the other",
    ),
    "straight part longer than the face": (
        (f"{PINION}.lead_relief_end=8 um", f"{PINION}.lead_unmodified=30 mm"),
        f"{PINION}.lead_unmodified = 30 mm",
        "longer than the face of 26.7 mm",
        "less",
    ),
    "two slices": (("mesh.slices=2",), "mesh.slices = 2", "neither one slice nor enough", "at least 3"),
    "one slice of what varies": (
        ("mesh.slices=1", "mesh.misalignment.in_plane=1 arcmin"),
        "mesh.slices = 1",
        "too few for what varies",
        "at least 3",
    ),
    "too few pitch errors": (
        (f'{PINION}.pitch_errors=["1 um", "2 um"]',),
        f"{PINION}.pitch_errors = 2 values",
        "the gear has 18 teeth",
        "one value per tooth",
    ),
    "torques that fall": (
        ('operating.gear_torques=["100 N*m", "50 N*m"]',),
        "operating.gear_torques.1 = 50 N*m",
        "not greater than the 100 N*m before it",
        "increasing",
    ),
    "a map of one torque": (
        ('operating.gear_torques=["100 N*m"]',),
        "operating.gear_torques = 100 N*m",
        "a single torque makes no map",
        "at least two",
    ),
}


@pytest.mark.parametrize(("settings", "key", "rule", "remedy"), MISTAKES.values(), ids=list(MISTAKES))
def test_a_mistake(
    refused: Refused,
    tmp_path: Path,
    settings: tuple[str, ...],
    key: str,
    rule: str,
    remedy: str,
):
    sets = [word for setting in settings for word in ("--set", setting)]
    code, lines = refused("run", STUDY, *sets, "-o", str(tmp_path / "study.h5"))
    assert code == 2, lines
    assert key in lines[0]
    assert rule in lines[0]
    assert remedy in lines[0].partition("; ")[2]
    assert list(tmp_path.iterdir()) == []


#: Kinds of run that do not know the face: what is given, and which contradiction is reported.
ELSEWHERE = {
    "relief by the energy method": (
        "crc-23-47",
        TIP,
        f"{PINION}.tip_relief = 20 um",
        'compliance = "energy"',
    ),
    "slices by the energy method": ("crc-23-47", ("mesh.slices=5",), "mesh.slices = 5", "energy"),
    "pitch errors in an efficiency study": (
        "efficiency-involute-18-36",
        ("mesh.compliance=fem", PITCH_ERRORS),
        f"{PINION}.pitch_errors = 18 values",
        "repeats one mesh cycle",
    ),
}


@pytest.mark.parametrize(("name", "settings", "key", "rule"), ELSEWHERE.values(), ids=list(ELSEWHERE))
def test_runs_that_do_not_know_the_face_refuse_it(
    refused: Refused, name: str, settings: tuple[str, ...], key: str, rule: str
):
    code, lines = refused("check", name, *(word for setting in settings for word in ("--set", setting)))
    assert code == 2
    (line,) = lines
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
def test_a_mistake_in_a_list_of_errors(refused: Refused, tmp_path: Path, text: str, rule: str):
    scenario = tmp_path / "mine.toml"
    scenario.write_text(
        'title = "mine"\nkind = "load-contact"\n[drive]\nlike = "diez-ibarbia-18-36"\n'
        '[drive.pinion.modification]\npitch_errors = "pitch.csv"\n[operating]\ngear_torque = "318 N*m"\n',
        encoding="utf-8",
    )
    curve = tmp_path / "pitch.csv"
    curve.write_text(text, encoding="utf-8")
    code, lines = refused("check", str(scenario))
    assert code == 2
    assert lines[0].startswith(f"{curve}: {PINION}.pitch_errors")
    assert rule in lines[0]
