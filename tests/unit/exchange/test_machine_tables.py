"""Tables of measuring machines: one measurement written in many ways, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

import tribodyn as td
from tests.support.verbs import complaint, complaints, invoke
from tribodyn.exchange.measured_gear import HELIX, LEFT, PROFILE, RIGHT, ROLL_ANGLE
from tribodyn.gears.measured.machine_tables import read

TRACES = """\
tooth,flank,trace,position [mm],deviation [um]
1,left,profile,5.0,-1.25
1,left,profile,7.5,0.0
1,left,profile,10.0,2.5
9,right,helix,2.0,1.0
9,right,helix,10.0,0.5
9,right,helix,18.0,-3.0
"""
GERMAN = (
    TRACES.replace(",", ";")
    .replace(".", ",")
    .replace("left", "Links")
    .replace("right", "rechts")
    .replace("profile", "Profil")
    .replace("helix", "Flankenlinie")
    .replace(
        "tooth;flank;trace;position [mm];deviation [um]", "Zahn;Flanke;Messung;position;Abweichung\n;;;mm;µm"
    )
)


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "measured.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "text", [TRACES, GERMAN, TRACES.replace(",", "\t"), "# of a machine\nsep=,\n" + TRACES]
)
def test_traces_as_programs_write_them(text: str, tmp_path: Path):
    found = read(written(tmp_path, text))
    profile, helix = found.traces
    assert (profile.kind, profile.tooth, profile.flank) == (PROFILE, 1, LEFT)
    assert (helix.kind, helix.tooth, helix.flank) == (HELIX, 9, RIGHT)
    assert profile.place == pytest.approx([5e-3, 7.5e-3, 10e-3])
    assert profile.deviation == pytest.approx([-1.25e-6, 0.0, 2.5e-6], abs=1e-15)
    assert helix.place == pytest.approx([2e-3, 10e-3, 18e-3])
    assert helix.deviation == pytest.approx([1e-6, 5e-7, -3e-6])
    assert found.remarks == ()


def test_profiles_alone_by_angle_at_places_along_the_face(tmp_path: Path):
    rows = [f"3,r,{angle},{face},{angle}" for face in (4, 16) for angle in (10, 20, 30)]
    text = "\n".join(["tooth,side,roll_angle [deg],face [mm],deviation [um]", *rows])
    with pytest.raises(td.InputError, match='add a column "trace"'):
        read(written(tmp_path, text))
    text = text.replace("side,", "side,trace,").replace(",r,", ",r,profile,")
    one, two = read(written(tmp_path, text)).traces
    assert (one.at, two.at, one.over) == (pytest.approx(4e-3), pytest.approx(16e-3), ROLL_ANGLE)
    assert one.place == pytest.approx(np.radians([10.0, 20.0, 30.0]))


INDEX = {LEFT: [2e-6, -1e-6, 3e-6], RIGHT: [0.0, 4e-6, -2e-6]}
LONG = "tooth,flank,F_p [um],f_p [um],Fr [um]\n1,left,2,9,5\n2,left,-1,9,6\n3,left,3,9,4\n" + (
    "3,right,-2,9,0\n1,right,0,9,0\n2,right,4,9,0\n"
)
WIDE = "tooth;F_p_left;F_p_right;r\n;um;um;mm\n1;2;0;0,005\n2;-1;4;0,006\n3;3;-2;0,004\n"


@pytest.mark.parametrize("text", [LONG, WIDE], ids=["a row for each flank", "a column for each flank"])
def test_pitch_and_runout_tooth_by_tooth(text: str, tmp_path: Path):
    found = read(written(tmp_path, text))
    for flank, index in INDEX.items():
        assert found.pitch[flank] == pytest.approx(index, abs=1e-15)
    assert found.radial == pytest.approx([5e-6, 6e-6, 4e-6])


def test_single_pitch_deviations_close_round_the_gear(tmp_path: Path):
    """Of 3, −1 and 1 µm a third of what is left over, 1 µm, is taken off each."""
    found = read(written(tmp_path, "tooth,f_p_left [um]\n1,3\n2,-1\n3,1\n"))
    assert found.pitch[LEFT] == pytest.approx([2e-6, 0.0, 0.0], abs=1e-15)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("tooth,flank,deviation [um]\n", "it has no rows"),
        ("a [mm],b [mm]\n1,2\n", "no column says the tooth"),
        ("tooth,b [mm]\n1,2\n", "neither traces nor pitch deviations"),
        (TRACES.replace("left", "top"), '"top" in the column "flank"'),
        (TRACES.replace("helix", "gap"), '"gap" in the column "trace"'),
        (TRACES.replace("9,right", "9.5,right"), "tooth 9.5"),
        (TRACES.replace(",0.0", ",nan"), 'the column "deviation" has a value that no gear has'),
        (TRACES.replace("9,right", "nan,right"), "tooth nan"),
        (TRACES.replace(" [um]", ""), 'the column "deviation" has no unit'),
        (TRACES.replace("[um]", "[deg]"), "deviation"),
        (TRACES.replace("7.5", "11"), "the profile of tooth 1, left flank goes forth and back"),
        (TRACES.replace("1,left,profile,10.0,2.5\n", ""), "has 2 points"),
        (TRACES.replace("trace", "what"), '"profile" is not a number (what)'),
        (TRACES.replace(",-1.25", ",x"), "is not a number"),
        (TRACES.replace("5.0,-1.25", "5,0,-1,25"), "7 values under a header of 5"),
        (TRACES.replace("flank", "tooth"), '"tooth" names more than one column'),
        (TRACES.replace("trace", "flanke"), "the columns flank and flanke say the same"),
        ("tooth,F_p [um]\n1,2\n2,3\n", 'the flank of the column "F_p" is not said'),
        ("tooth,F_p_left [um]\n1,2\n3,3\n", "tooth 2 is missing"),
        ("tooth,F_p_left [um]\n1,2\n1,3\n", "a tooth stands twice"),
    ],
)
def test_what_is_refused(text: str, said: str, tmp_path: Path):
    path = written(tmp_path, text)
    with pytest.raises(td.InputError) as caught:
        read(path)
    assert said in str(caught.value)
    assert str(path) in str(caught.value)


def test_a_wrong_unit_is_said_of_the_measurement_and_leaves_no_files(tmp_path: Path):
    path = written(tmp_path, TRACES.replace("[um]", "[mm]"))
    into = "--into", "involute-23-47", "--gear", "pinion", "-o", "m.toml"
    for said in complaints("import", path, *into, folder=tmp_path):
        assert f"{path}: " in said
        assert "more than a quarter of the module" in said
    assert list(tmp_path.iterdir()) == [path]


def test_several_files_of_one_gear_go_into_a_scenario_together(tmp_path: Path):
    """With decimal commas; the profile is as deep at the tip as it was measured against the pitch point."""
    z = 23
    profile = "\n".join(
        f"{tooth};{flank};profile;{10 + i / 2};{str(-i / 10).replace('.', ',')}".replace(".", ",")
        for tooth in (1, 9)
        for flank in ("left", "right")
        for i in range(41)
    )
    (tmp_path / "a.csv").write_text(f"tooth;flank;trace;position [mm];deviation [um]\n{profile}\n")
    pitch = "\n".join(f"{n};{flank};{n % 3}" for flank in "lr" for n in range(1, z + 1))
    (tmp_path / "b.csv").write_text(f"tooth;flank;F_p [um]\n{pitch}\n")
    into = "--into", "involute-23-47", "--gear", "pinion", "-o", "m.toml"
    printed = invoke("import", "a.csv", "b.csv", *into, folder=tmp_path)
    assert "traces of 2 of 23 teeth; the others get their mean" in printed
    # 4 µm over 20 mm, of which 95 % are evaluated: the mean line over the whole of it
    assert "profile slope f_Hα: left -4.0 µm, right -4.0 µm" in printed
    assert "total profile F_α: left 3.8 µm, right 3.8 µm" in printed
    assert "single pitch f_p: left -2.0 µm, right -2.0 µm" in printed
    assert "total pitch F_p: left 2.0 µm" in printed
    case = td.scenario(tmp_path / "m.toml", {"solver.cycles": 1081})
    (pitched, measured, back) = case.pair.teeth[0]
    # left flanks carry; F_p clockwise for who looks at them is backwards there: along the normal × cos α
    assert pitched.errors == pytest.approx([(n % 3) * 1e-6 * np.cos(np.radians(20)) for n in range(1, z + 1)])
    assert np.ptp(measured.errors[0]) == pytest.approx(np.ptp(back.errors[0]), rel=1e-9)
    assert measured.errors[5] == pytest.approx(measured.errors[0])
    assert "no format" in complaint("import", "a.cvs", *into, folder=tmp_path)
