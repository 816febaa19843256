"""Input that no simulation needs is refused at once: towers of powers, endless texts, numbers of no use."""

from pathlib import Path

import pytest

from tests.support.verbs import complaints
from tests.support.work import at_most
from tribodyn.errors import InputError
from tribodyn.input.bounds import DEEPEST, TooMuch, parsed
from tribodyn.input.csv_files import MOST_POINTS, read_curve
from tribodyn.input.sources import MOST_CSV, MOST_TOML, read_toml
from tribodyn.input.unit_grammar import is_unit
from tribodyn.input.units import ANGULAR_SPEED, LENGTH, TIME, NotAQuantity, factor_to_si, to_si
from tribodyn.studies.protocol.load import load_scenario

UNITS = (
    "m N*m kg*m**2 kg*m^2 W/(m*K) J/(kg*K) 1/Pa mPa*s Nm N·m m² s⁻¹ m**-1 m**(-1) m^0.5 ° °C % (m/s)**2"
    " 1/(m*s) inch"
).split()
NO_UNITS = [
    *("m**1e3", "m%m", "rad//s", "rad/s!", "rad/s**9**9**9", "m**10", "m*", "*m", "/m", "m)", "(m", "()"),
    *("((m))", "m**(9**9)", "m**", "2 m", "m 2", "m;", "m#x", "_m", "m²²", "m⁻", "m^m", "m(s)", "1.5", "11"),
    *("a" * 81, "m" * 100_000, "m*" * 50_000 + "m", "(" * 50_000, "m\n**9**9", "__import__('os')"),
]


@pytest.mark.parametrize("unit", [*UNITS, "N m", "m per s", "N/(mm um)", "kg m²", " mm "])
def test_what_is_a_unit(unit: str):
    assert is_unit(unit)


@pytest.mark.parametrize("unit", NO_UNITS, ids=lambda unit: unit[:20])
def test_what_is_none(unit: str):
    assert not is_unit(unit)
    with at_most(4e7):
        with pytest.raises(NotAQuantity):
            to_si(f"10 {unit}", ANGULAR_SPEED)
        with pytest.raises(NotAQuantity):
            factor_to_si(unit, ANGULAR_SPEED)  # as it may stand in the header of a CSV file


@pytest.mark.parametrize(
    "text", ["1e-323 m", "1e308 m", "9e60 m", "1 (Ym*Ym/m)**9/m**8", "-1e300 um", "9" * 400 + " m"]
)
def test_magnitudes_beyond_all_use(text: str):
    with pytest.raises(NotAQuantity):
        to_si(text, LENGTH)
    assert to_si("1e-29 m", LENGTH) == 1e-29
    assert to_si("0 s", TIME) == 0.0


LONG_KEY = ".".join("a" * 2000)
TOO_MUCH = {
    "lists": "a = " + "[" * 100_000,
    "inline tables": "a = " + "{a = " * 100_000,
    "one too deep": "a = " + "[" * (DEEPEST + 1) + "]" * (DEEPEST + 1),
    "dotted key": f"{LONG_KEY} = 1",
    "header": f"[{LONG_KEY}]",
    "dotted key inside": f"a = {{{LONG_KEY} = 1}}",
    "quoted parts": "a." + ".".join(['"\\""', "''"] * 1000) + " = 1",
    "digits": "a = " + "9" * 5000,
    "digits with points of their own": "a = 1" + "_000" * 2000,
}


@pytest.mark.parametrize("name", TOO_MUCH)
def test_toml_that_no_scenario_needs(name: str, tmp_path: Path):
    path = tmp_path / "much.toml"
    path.write_text(TOO_MUCH[name], encoding="utf-8")
    with at_most(4e7):
        with pytest.raises(TooMuch):
            parsed(TOO_MUCH[name])
        with pytest.raises(InputError) as error:
            read_toml(path)
    assert error.value.file == str(path)
    assert parsed("a = " + "[" * (DEEPEST - 1) + "]" * (DEEPEST - 1))
    assert parsed('title = "' + "a.b" * 5 + '"')


def test_files_that_are_too_large(tmp_path: Path):
    path = tmp_path / "large.toml"
    with path.open("wb") as file:
        file.truncate(MOST_TOML + 1)
    with pytest.raises(InputError, match="larger than 16 MiB"):
        read_toml(path)
    with path.open("wb") as file:
        file.truncate(MOST_CSV + 1)
    with pytest.raises(InputError, match="larger than 4 MiB"):
        read_curve(path, "key", ["time"])
    path.write_text("time [s]\n" + "1\n" * (MOST_POINTS + 1), encoding="utf-8")
    with pytest.raises(InputError, match="line 100002: more than 100000 points"):
        read_curve(path, "key", ["time"])


NUMBERS = {
    "solver.cycles": [str(2**63), "9" * 400, "9" * 5000],
    "mesh.damping_ratio": ["1e-323", "1e308", "9" * 400],
    "drive.pinion.teeth": ["10001", str(10**18)],
    "operating.pinion_speed": ["1e-323 rad/s", "1e308 rad/s", "1 rad//s", "1 " + "rad*" * 9999],
    "title": ["x" * 20_001],
    "solver.max_steps": [str(10**10)],
    "operating.gear_torque": ["[" * 5000, "{a=" * 5000],
    "a." * 60 + "b": ["1"],
    "k" * 201: ["1"],
    "9" * 150 + ".9": ["1"],
}


@pytest.mark.parametrize("key", NUMBERS, ids=lambda key: key[:24])
def test_values_beyond_all_use(key: str, scenario: Path):
    for value in NUMBERS[key]:
        assert max(map(len, complaints("check", scenario, "--set", f"{key}={value}"))) < 1000


VARIED = [
    "operating.pinion_speed=1:1e999999999:1rad/s",
    "operating.pinion_speed=1:2:1e-999999999rad/s",
    "operating.pinion_speed=1e99:2e99:1e-99rad/s",
    "operating.pinion_speed=1:2/99999999999999999999rad/s",
    "operating.pinion_speed=1:2/3rad/s**9**9**9",
    "operating.pinion_speed=1,2rad//s",
    f"operating.pinion_speed={'9' * 5000}:1:1rad/s",
    f"operating.pinion_speed=1:2{' ' * 60_000}",
    f"solver.cycles=1,{'9' * 400}",
    f"mesh.damping_ratio=0.1,{'9' * 5000}",
    "mesh.damping_ratio=0.1,1e-323",
    f"{'a.' * 5000}b=1,2",
    " --vary ".join(f"drive.pinion.{'a' * i}=1,2" for i in range(1, 40)),
    f"drive.shape.radius=1,2{'m*' * 5000}m",
]


@pytest.mark.parametrize("vary", VARIED, ids=lambda vary: vary[:40])
def test_axes_beyond_all_use(vary: str, scenario: Path):
    words = [word for axis in vary.split(" --vary ") for word in ("--vary", axis)]
    with at_most(1e8):
        lines = complaints("sweep", scenario, *words, "-o", scenario.parent / "s.h5")
    assert max(map(len, lines)) < 1000
    assert not list(scenario.parent.glob("*.h5"))


def test_the_name_of_an_unknown_key_is_cut(tmp_path: Path):
    (tmp_path / "long.toml").write_text(f"{'a' * 5000} = 1\n", encoding="utf-8")
    with pytest.raises(InputError) as error:
        load_scenario(tmp_path / "long.toml")
    assert all(len(line) < 1000 + len(str(tmp_path)) for line in str(error.value).splitlines())
    assert "aaa..." in str(error.value)
