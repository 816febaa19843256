"""What a drive file says of its family's shape, and what is refused."""

import tomllib

import numpy as np
import pytest
import tomli_w

from tribodyn.errors import InputError
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

# scenario, overrides, key, what the message says, what it advises
REFUSED = {
    "pressure angle given": (
        "parabolic-23-47",
        {"drive.pressure_angle": "20 deg"},
        "pressure_angle",
        'contradicts family = "parabolic"',
        "leave it out",
    ),
    "k too great": (
        "parabolic-23-47",
        {"drive.shape.k1": 0.496},
        "shape.k1",
        "or the working flank of the gear is undercut",
        "use 0.3",
    ),
    "exponent": ("s-gear-23-47", {"drive.shape.exponent": 0.9}, "shape.exponent", "above 1", "use 1.9"),
    "rack turns back": (
        "s-gear-23-47",
        {"drive.shape.form_factor": 1.1},
        "shape.form_factor",
        "turns back",
        "larger",
    ),
    "S too high": (
        "s-gear-23-47",
        {"drive.pinion.addendum": 1.1, "drive.gear.dedendum": 1.4},
        "pinion.addendum",
        "up to one module",
        "use at most 1",
    ),
    "shape missing": ("crc-23-47", {"drive.family": "s-gear"}, "pressure_angle", "contradicts", ""),
}


def made(scenario, overrides):
    return prepare(load_scenario(scenario, overrides))


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name):
    scenario, overrides, key, rule, advice = REFUSED[name]
    with pytest.raises(InputError) as caught:
        made(scenario, overrides)
    said = str(caught.value)
    assert f"drive.{key}" in said
    assert rule in said
    assert advice in said


@pytest.mark.parametrize(
    ("key", "name", "value"), [("k1", "parabolic", "0.32"), ("form_factor", "s-gear", "1.6")]
)
def test_what_is_missing_is_named_with_what_to_add(key, name, value):
    with pytest.raises(InputError, match=f"drive.shape.{key}.*missing") as caught:
        load_scenario("crc-23-47", {"drive.family": name})
    assert f"add {key} = {value} to [shape]" in str(caught.value)


X = [-6.0, -4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0, 6.0]
Y = [x * np.tan(np.radians(20)) for x in X]


def points(x=X, y=Y, angle="20 deg"):
    column = {"unit": "mm", "values": list(x)}, {"unit": "mm", "values": list(y)}
    return load_scenario(
        "points-23-47",
        {"drive.shape.points": dict(zip("xy", column, strict=True)), "drive.pressure_angle": angle},
    )


def test_points_on_a_straight_line_make_an_involute():
    from tribodyn.geometry.assembly import assemble
    from tribodyn.geometry.families import family
    from tribodyn.geometry.limits.checks import check

    x = np.linspace(-12, 12, 25)
    case = points(x, x * np.tan(np.radians(20)))
    check(family("points"), case.pair.drive)
    ours = assemble(family("points"), case.pair.drive)
    involute = load_scenario("involute-23-47")
    theirs = assemble(family("involute"), involute.pair.drive)
    assert ours.contact_ratio == pytest.approx(theirs.contact_ratio, rel=1e-12)
    assert ours.r_start == pytest.approx(theirs.r_start, rel=1e-12)


def moved(values, index, value):
    return [*values[:index], value, *values[index + 1 :]]


BAD_POINTS = {
    "doubles back": (
        {"x": moved(X, 6, 0.5)},
        "0.7279) mm: point 7: the path doubles back",
        "sort or correct",
    ),
    "misses P": ({"y": [y + 0.4 for y in Y]}, "misses the pitch point", "make the point 0,0 one of them"),
    "wrong quadrant": ({"y": moved(Y, 5, -0.2)}, "point 6: the pressure angle", "sign of x"),
    "too few": ({"x": X[3:], "y": Y[3:]}, "fewer than 3 before the pitch point", "give more"),
    "too short": ({}, "the path ends", "points further out"),
    "wrong angle": ({"angle": "25 deg"}, "does not go on from the path's points", 'use about "20 deg"'),
    "lengths": ({"x": X[:-1]}, "8 values of x and 9 of y", "as many of each"),
}


@pytest.mark.parametrize("name", BAD_POINTS)
def test_points_that_are_no_path(name):
    change, rule, advice = BAD_POINTS[name]
    with pytest.raises(InputError) as caught:
        prepare(points(**change))
    assert rule in str(caught.value)
    assert advice in str(caught.value)
    assert "drive." in str(caught.value)


def test_a_file_of_points_may_be_missing(tmp_path):
    with pytest.raises(InputError, match="no such file") as caught:
        load_scenario("points-23-47", {"drive.shape.points": str(tmp_path / "none.csv")})
    assert "x [unit],y [unit]" in str(caught.value)


def test_a_search_opens_the_points_of_its_scenario(tmp_path):
    """The file of points is named by the drive's file, which is named by the scenario within the scenario."""
    design = {
        "free": [{"key": "operating.gear_torque", "from": "100 N*m", "to": "200 N*m"}],
        "minimise": "film_min",
    }
    path = tmp_path / "search.toml"
    search = {"title": "A search", "kind": "design", "scenario": "points-23-47", "design": design}
    path.write_text(tomli_w.dumps(search), encoding="utf-8")
    inner = load_scenario("points-23-47")
    assert load_scenario(path).base["drive"] == tomllib.loads(inner.toml)["drive"]
    named = {"scenario.drive.shape.points": "none.csv"}
    with pytest.raises(InputError, match=r"scenario\.drive\.shape\.points.*no such file"):
        load_scenario(path, named)
