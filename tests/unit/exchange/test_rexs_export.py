"""REXS 2.0.0 of scenarios and records: valid by its schema, and the same gearbox when it is read."""

import dataclasses
import re
import tomllib
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import tomli_w

import tribodyn as td
from tests.support.rexs_models import sample
from tests.support.rexs_schema import schema
from tests.support.verbs import complaints, invoke
from tribodyn.exchange.format import Exported
from tribodyn.exchange.rexs.file.files import read_model
from tribodyn.exchange.rexs.file.units import unit_named
from tribodyn.exchange.rexs.rexs_format import read
from tribodyn.exchange.rexs.writing.export import write
from tribodyn.input.sources import shipped
from tribodyn.input.tables.drawn_bearings import BearingOfShaft
from tribodyn.studies.protocol.load import load

REDUCER, PLANETS, PAIR = "industrial-reducer", "planetary-24-84", "helical-car-27-71"
TURBINE, RING, TWO = "wind-turbine-gearbox", "ring-36-93", "two-stage-reducer"
#: What REXS does not know of scenarios that are compared: set in what comes back, left out of what goes.
OF_OURS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    REDUCER: ({}, {}),
    PLANETS: (
        {"mesh.foundation": "ring", "mesh.damping_ratio": 0.06, "gear.ring.outer_diameter": "290 mm"},
        {"stage.0.tangential_pin_errors": []},
    ),
}


def exported(name: str, folder: Path) -> Path:
    invoke("export", name, "--to", "rexs", "-o", folder / f"{name}.rexs", "--force")
    return folder / f"{name}.rexs"


def without_date(path: Path) -> str:
    text = re.sub(r'date="[^"]*"', "", path.read_text(encoding="utf-8"))
    return re.sub(r"<!--.*-->", "", text)


@pytest.mark.parametrize("name", [REDUCER, PLANETS, PAIR, TURBINE, RING, TWO])
def test_a_file_is_valid_by_the_tables_of_the_schema(name: str, tmp_path: Path):
    path = exported(name, tmp_path)
    assert schema().faults(path.read_text(encoding="utf-8")) == []
    assert read_model(path).version == "2.0.0"


@pytest.mark.parametrize("name", [REDUCER, TURBINE])
def test_a_file_is_valid_by_the_xsd(name: str, tmp_path: Path):
    xmlschema = pytest.importorskip("xmlschema")
    checked = xmlschema.XMLSchema(sample("rexs-file.xsd"))
    assert [str(error) for error in checked.iter_errors(str(exported(name, tmp_path)))] == []


@pytest.mark.parametrize("name", [REDUCER, PLANETS, PAIR, TURBINE, RING, TWO])
def test_what_is_read_and_written_again_is_the_same_file(name: str, tmp_path: Path):
    first = exported(name, tmp_path)
    back = tmp_path / "back.toml"
    invoke("import", first, "-o", back)
    again = tmp_path / "again"
    invoke("export", back, "--to", "rexs", "-o", again)
    assert without_date(again.with_suffix(".rexs")) == without_date(first)


def compared(first: Any, second: Any, where: str) -> list[str]:
    """Where two things of a case differ by more than rounding."""
    if isinstance(first, (int, float, Fraction)) and not isinstance(first, bool):
        return (
            []
            if second == pytest.approx(float(first), rel=1e-7, abs=1e-12)
            else [f"{where}: {first} {second}"]
        )
    if dataclasses.is_dataclass(first):
        names = [field.name for field in dataclasses.fields(first) if field.compare]
        pairs = [(name, getattr(first, name), getattr(second, name)) for name in names]
    elif isinstance(first, dict):
        pairs = [(str(key), first[key], second[key]) for key in first]
    elif hasattr(first, "model_fields_set"):
        pairs = [(key, getattr(first, key), getattr(second, key)) for key in type(first).model_fields]
    elif isinstance(first, (list, tuple)):
        if len(first) != len(second):
            return [f"{where}: {len(first)} and {len(second)}"]
        names = getattr(first, "_fields", range(len(first)))
        pairs = [(str(name), *both) for name, *both in zip(names, first, second, strict=True)]
    else:
        return [] if first == second or callable(first) else [f"{where}: {first} {second}"]
    return [line for name, *both in pairs for line in compared(*both, f"{where}.{name}")]


@pytest.mark.parametrize("name", OF_OURS)
def test_the_gearbox_that_comes_back_is_the_one_that_went(name: str, tmp_path: Path):
    """Bodies, gears, shafts with bearings, links, teeth and loads, to rounding."""
    back = tmp_path / "back.toml"
    invoke("import", exported(name, tmp_path), "-o", back)
    added, left = OF_OURS[name]
    first, second = load(name, left).case, load(back, added).case
    for part in ("bodies", "gears", "links", "sets", "source", "loads", "supports"):
        assert compared(getattr(first, part), getattr(second, part), part) == []
    if first.system is not None:
        assert compared(first.system.shafts, second.system.shafts, "shafts") == []
    for one, other in zip(first.pairs, second.pairs, strict=True):
        told = other.drive if one.drive.centre_distance else other.drive._replace(centre_distance=None)
        assert compared(one.drive, told, "drive") == []


ANGULAR = {"type": "angular-contact-ball", "contact_angle": "40 deg", "row_distance": "18 mm"}
TAPERED = {"type": "tapered-roller", "contact_angle": "14 deg"}
#: Bearings of a drawn shaft: what is written is what comes back.
BEARINGS: dict[str, dict[str, Any]] = {
    "ball": {"type": "deep-groove-ball", "clearance": "12 um", "static_rating": "19 kN", "locating": False},
    "O": ANGULAR | {"arrangement": "O"},
    "X": TAPERED | {"arrangement": "X", "row_distance": "20 mm"},
    "sliding": TAPERED | {"arrangement": "O", "row_distance": "20 mm", "locating": False},
    "thrust": TAPERED | {"thrust": "-z", "preload_force": "300 N"},
    "rows": {"type": "cylindrical-roller", "rows": 2, "row_distance": "15 mm"},
    "barrels": {"type": "spherical-roller", "contact_angle": "9 deg"},
    "springs": dict.fromkeys(("stiffness_x", "stiffness_y", "stiffness_axial"), "3e8 N/m")
    | {"stiffness_tilt": "5e4 N*m/rad"},
}


def with_bearing(folder: Path, bearing: dict[str, Any]) -> Path:
    """The reducer with another first bearing; of rolling bearings by their catalogue."""
    tables = tomllib.loads(load(REDUCER, {}).case.toml)
    sizes = {
        "bore": "50 mm",
        "outside_diameter": "90 mm",
        "static_rating": "60 kN",
        "dynamic_rating": "70 kN",
    }
    own = (sizes if "type" in bearing else {}) | {"position": "16 mm"} | bearing
    tables["shaft"][0]["drawn"]["bearing"][0] = own
    (folder / "own.toml").write_text(tomli_w.dumps(tables), encoding="utf-8")
    return folder / "own.toml"


@pytest.mark.parametrize("name", BEARINGS)
def test_every_type_of_bearing_comes_back(name: str, tmp_path: Path):
    path = with_bearing(tmp_path, BEARINGS[name])
    tables = write(Exported(path, tomllib.loads(path.read_text(encoding="utf-8"))), "own", {}).files
    (tmp_path / "own.rexs").write_text(str(tables[".rexs"]), encoding="utf-8")
    back = read(tmp_path / "own.rexs").scenario["shaft"][0]["drawn"]["bearing"][0]
    one, other = (
        BearingOfShaft.model_validate({"position": "16 mm", **BEARINGS[name]}),
        BearingOfShaft.model_validate(back),
    )
    said = {key: value for key, value in one if value is not None}
    assert compared(said, {key: getattr(other, key) for key in said}, name) == []


@pytest.mark.parametrize(
    ("bearing", "said"),
    [
        ({"type": "toroidal-roller", "raceway_radius": "150 mm"}, "is a toroidal-roller bearing"),
        ({"matrix": [[1.0] * 6] * 6, "matrix_units": "N, m, rad"}, "is a matrix"),
    ],
)
def test_bearings_that_rexs_has_not_are_refused(bearing: dict[str, Any], said: str, tmp_path: Path):
    path = with_bearing(tmp_path, bearing)
    with pytest.raises(td.InputError, match=f"bearing high-speed-1: {said}, which REXS has not"):
        write(Exported(path, tomllib.loads(path.read_text(encoding="utf-8"))), "own", {})


def test_results_stand_with_their_units(tmp_path: Path):
    short = {"solver.cycles": 2, "friction.law": "coulomb", "friction.coefficient": 0.05}
    run = td.run(PAIR, short, output=tmp_path / "run.h5")
    invoke("export", tmp_path / "run.h5", "--to", "rexs", "-o", tmp_path / "run")
    model = read_model(tmp_path / "run.rexs")
    stage = next(model.of_type("cylindrical_stage"))
    mesh = run.summary
    for name, unit, size in (
        ("film_min", "mum", 1e-6),
        ("hertz_pressure_max", "MPa", 1e6),
        ("contact_ratio", "none", 1.0),
    ):
        attribute = stage.attributes[f"custom_tribodyn_{name}"]
        assert attribute.unit == unit
        assert unit_named(attribute.unit) is not None
        assert float(str(attribute.value)) * size == pytest.approx(mesh[name], rel=1e-8)
    unit = next(model.of_type("gear_unit"))
    assert float(str(unit.attributes["custom_tribodyn_efficiency"].value)) == pytest.approx(
        mesh["efficiency"], rel=1e-8
    )


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("crc-23-47", 'stage.0.family = "crc": REXS has involute gears alone'),
        ("clutch-flywheel", 'clutch = "main": a friction clutch: REXS has none'),
        ("two-pinions-bull-gear", "a [[load]] beside the output: REXS has none"),
        ("ravigneaux", "REXS has planetary sets of sun, planets, ring and carrier"),
        ("backlash-oscillator", "is no scenario of gears"),
    ],
)
def test_a_train_that_rexs_cannot_hold_is_refused_by_name(name: str, said: str, tmp_path: Path):
    (line,) = complaints("export", name, "--to", "rexs", "-o", tmp_path / "out")
    assert said in line
    assert list(tmp_path.iterdir()) == []


def test_what_was_left_out_is_listed(tmp_path: Path):
    printed = invoke("export", PLANETS, "--to", "rexs", "-o", tmp_path / "set")
    for said in (
        "REXS has nothing of [mesh], [friction], [solver], [output]",
        "gear.ring: REXS has no attribute of outer_diameter",
        "stage.set: REXS has no attribute of tangential_pin_errors",
        "lubricant: REXS has no attribute of fzg_scuffing_stage, fzg_micropitting_stage",
    ):
        assert said in printed


def test_a_zip_that_is_not_written_is_refused(tmp_path: Path):
    (line,) = complaints("export", PLANETS, "--to", "rexs", "-o", tmp_path / "set.rexsz")
    assert "rexs writes .rexs alone" in line
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_every_shipped_scenario_goes_and_comes_back_or_is_refused(tmp_path: Path):
    went = []
    for file in sorted(shipped("scenarios").glob("*.toml")):
        path = tmp_path / file.name
        try:
            tables = tomllib.loads(load(file.stem, {}).case.toml)
            text = str(write(Exported(file, tables), file.stem, {}).files[".rexs"])
        except td.InputError:
            continue
        assert schema().faults(text) == []
        path.with_suffix(".rexs").write_text(text, encoding="utf-8")
        path.write_text(read(path.with_suffix(".rexs")).toml, encoding="utf-8")
        assert load(path, {}).case.kind == "gear-train"
        went.append(file.stem)
    assert {"dtu-10mw-gearbox", "idler-train", "spur-25-51", REDUCER, PLANETS, TURBINE} < set(went)
    assert len(went) > 30


def test_hostile_titles_and_names_of_files_stay_text(tmp_path: Path):
    tables = tomllib.loads(load(PLANETS, {}).case.toml) | {"title": '<!-- & "]]> --> \u202e\x07 <model>'}
    path = tmp_path / "set---<a>&.toml"
    written = str(write(Exported(path, tables), "set", {}).files[".rexs"])
    (tmp_path / "set.rexs").write_text(written, encoding="utf-8")
    model = read_model(tmp_path / "set.rexs")
    assert next(model.of_type("gear_unit")).name == '<!-- & "]]> --> \\u202e\\x07 <model>'
    (tmp_path / "back.toml").write_text(read(tmp_path / "set.rexs").toml, encoding="utf-8")
    assert load(tmp_path / "back.toml", {}).case.title.startswith('<!-- & "]]> -->')


def test_what_holds_a_ring_against_rotation_comes_back(tmp_path: Path):
    """As stiff as in a wind turbine; what is rigid is said to be changed."""
    for value, kept in ((2e11, True), (1e15, False)):
        path = tmp_path / f"{value:g}.rexs"
        td.export(PLANETS, "rexs", path, {"stage.0.support_stiffness": f"{value:g} N*m/rad"})
        found = td.import_scenario(path)
        (stage,) = found.scenario["stage"]
        assert (stage.get("support_stiffness") == "2e+11 N*m/rad") == kept
        assert any("is rigid against rotation" in each for each in found.details["changed"]) != kept


def test_a_link_that_is_rigid_is_said_to_be_changed(tmp_path: Path):
    path = tmp_path / "rigid.rexs"
    td.export("dtu-10mw-gearbox", "rexs", path, {"link.0.stiffness": "2e11 N*m/rad"})
    found = td.import_scenario(path)
    assert found.scenario["link"][0]["stiffness"] == "1e+09 N*m/rad"
    assert sum("is rigid against twist" in each for each in found.details["changed"]) == 1
