"""FMUs of a pair of gears: valid, the same motion as a run's, alone without Python, states bit by bit."""

import json
import subprocess
import zipfile
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import tribodyn as td
from tests.support.fmus import (
    FROM_REST,
    PAIR,
    Unit,
    against_run,
    compiled_harness,
    fmpy,
    fmu_of,
    pair_fmu,
)
from tests.support.verbs import complaint, sets
from tribodyn.exchange.fmu.build import both_processors
from tribodyn.exchange.fmu.oil import TOLERANCE, oil_table
from tribodyn.exchange.format import TORQUE
from tribodyn.studies.motion.drivetrain.in_time import in_time
from tribodyn.studies.protocol.load import load_scenario

BOTH = [("3.0", "torque"), ("2.0", "speed")]


@pytest.mark.parametrize(("version", "kind"), BOTH)
def test_an_fmu_is_valid(version: str, kind: str):
    from fmpy.validation import validate_fmu

    assert validate_fmu(str(pair_fmu(version, kind))) == []


def test_a_transient_from_rest_is_that_of_a_run_by_time(tmp_path: Path):
    """With another program as the master, and steps of another length than the run's."""
    run = td.run(PAIR, FROM_REST, output=tmp_path / "run.h5")
    off = against_run(pair_fmu("3.0", "torque"), run, {"mesh": None})
    assert max(off.values()) <= 1e-5, off


def test_speeds_that_are_prescribed_are_kept_and_the_torques_balance_the_energy():
    """The angle is the integral of a speed that changes linearly in each step."""
    unit, size, turned = Unit(pair_fmu("2.0", "speed"), input_speed=100.0), 1e-4, 0.0
    ratio = 23.0 / 47.0
    names = "power_in", "power_out", "friction_loss", "damping_loss", "parametric_power", "stored_energy"
    before, works = unit.get(*names), np.zeros(5)
    begun = before[5]
    speeds = 100.0 + 20.0 * np.sin(np.arange(400) * 0.02)
    for start, end in pairwise(speeds.tolist()):
        unit.set(input_speed=end, output_shaft_speed=end * ratio)
        for _ in range(4):  # of linear change in each step only the first has any
            unit.step(size / 4)
            now = unit.get(*names)
            works += (before + now)[:5] * size / 8
            before = now
        turned += (start + end) * size / 8 + end * size * 3 / 4
    assert unit.get("input_angle", "input_speed") == pytest.approx([turned, speeds[-1]], rel=1e-9)
    assert unit.get("output_speed")[0] == pytest.approx(speeds[-1] * ratio, rel=0.02)
    put_in, taken, friction, damping, parametric = works
    left = put_in + parametric - taken - friction - damping - (before[5] - begun)
    assert abs(left) < 1e-3 * np.max(np.abs(works))


@pytest.mark.parametrize(("version", "kind"), BOTH)
def test_a_state_takes_an_instance_back_bit_by_bit(version: str, kind: str):
    """Also one that was written to bytes, and in another instance."""
    path = pair_fmu(version, kind)
    unit = Unit(path).step(1e-4, 20)
    state, time = unit.slave.getFMUState(), unit.time
    kept = unit.slave.serializeFMUState(state)
    there = unit.step(3e-5, 40).get()
    unit.slave.setFMUState(state)
    unit.time = time
    assert unit.step(3e-5, 40).get().tobytes() == there.tobytes()
    other = Unit(path)
    other.slave.setFMUState(other.slave.deserializeFMUState(kept))
    other.time = time
    assert other.step(3e-5, 40).get().tobytes() == there.tobytes()
    unit.slave.reset()


def test_other_communication_steps_give_the_same_motion():
    path = pair_fmu("3.0", "torque")
    names = "input_angle", "input_speed", "mesh.transmission_error"
    even = Unit(path).step(1e-4, 200).get(*names)
    uneven = Unit(path).step(1e-4, 100).step(3.7e-4, 20).step(2.6e-5, 100).get(*names)
    assert uneven == pytest.approx(even, rel=1e-6)


def test_communication_steps_may_be_short():
    """More of them in a mesh cycle than the scenario allows steps."""
    assert FROM_REST["solver.max_steps"] < 9000
    path, names = pair_fmu("3.0", "torque"), ("input_speed", "mesh.transmission_error")
    short, long = Unit(path).step(1e-7, 9000).get(*names), Unit(path).step(9e-4).get(*names)
    assert short == pytest.approx(long, rel=1e-6)


def test_ten_instances_at_once_without_python(tmp_path: Path):
    """A program in C, with an empty environment, loads the library alone."""
    program, path = compiled_harness(tmp_path), pair_fmu("3.0", "torque")
    folder = Path(fmpy.extract(path))
    described = fmpy.read_model_description(path)
    library = folder / "binaries" / "x86_64-linux" / "unit.so"
    words = [str(program), str(library), described.guid, "1e-4", "200", "10", "80.0"]
    count = len(described.modelVariables)
    ran = subprocess.run([*words, str(count)], env={}, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    found = json.loads(ran.stdout)
    assert found["equal"]
    assert found["different"]
    assert any(name.endswith("unit.so") for name in found["loaded"])
    assert not [name for name in found["loaded"] if "python" in name.lower() or "tribodyn" in name]
    # and the same as with Python around it
    assert Unit(path).step(1e-4, 200).get() == pytest.approx(found["values"], rel=1e-12, abs=1e-12)


def test_calls_that_cannot_be_are_errors_that_say_why():
    unit = Unit(pair_fmu("3.0", "torque"))

    def refused(call, *values) -> str:
        with pytest.raises(Exception, match=r"fmi3|status"):
            call(*values)
        return unit.messages[-1]

    assert "input_speed is an output" in refused(lambda: unit.set(input_speed=1.0))
    assert "fixed" in refused(lambda: unit.set(start_speed=1.0))
    assert "input_torque = nan: must be from" in refused(lambda: unit.set(input_torque=float("nan")))
    assert "no variable with value reference 99" in refused(unit.slave.getFloat64, [99])
    assert "the instance is at 0 s" in refused(unit.slave.doStep, 1.0, 1e-4)
    assert "must be above 0" in refused(unit.slave.doStep, 0.0, 0.0)
    assert "of type Float64" in refused(unit.slave.getInt32, [0])
    assert "does not have it" in refused(unit.slave.enterEventMode)
    assert "not allowed in step mode" in refused(unit.slave.exitInitializationMode)
    state = unit.slave.getFMUState()
    bytes_of = unit.slave.serializeFMUState(state)
    changed = bytes([*bytes_of[:-1], bytes_of[-1] ^ 1])
    for wrong in (bytes_of[1:], changed):
        assert "no state of this FMU" in refused(unit.slave.deserializeFMUState, wrong)
    unit.set(input_torque=1e12)
    assert "simulation stopped at" in refused(unit.step, 1e-3, 100)
    assert "after an error" in refused(unit.slave.doStep, unit.time, 1e-3)
    unit.slave.setFMUState(state)  # takes it on
    unit.time = 0.0
    unit.set(input_torque=80.0)
    unit.step(1e-4)


def test_the_importer_chooses_tolerance_and_what_is_logged():
    """Errors at a looser tolerance are larger, and every step is logged where that is asked for."""
    path, names = pair_fmu("3.0", "torque"), ("input_speed", "mesh.transmission_error")
    loose, usual, tight = (
        Unit(path, tolerance).step(2e-3, 10).get(*names) for tolerance in (1e-3, None, 1e-11)
    )
    assert np.all(np.abs(usual - tight) < 1e-5 * np.abs(tight))
    assert np.any(np.abs(loose - tight) > 10.0 * np.abs(usual - tight))
    unit = Unit(path)
    unit.slave.setDebugLogging(True, ["logStep"])
    unit.step(1e-3, 2)
    assert [message[:9] for message in unit.messages] == ["step from"] * 2


def test_every_function_of_the_standards_is_there(tmp_path: Path):
    """By the headers that fmpy has of them."""
    headers = Path(fmpy.__file__).parent / "c-code"
    for version, kind in BOTH:
        path = pair_fmu(version, kind)
        number = version[0]
        text = (headers / f"fmi{number}Functions.h").read_text(encoding="utf-8")
        wanted = {
            line.split()[-1].rstrip(";")
            for line in text.splitlines()
            if "TYPE " in line and line.rstrip().endswith(";") and "typedef" not in line
        }
        assert len(wanted) > 30
        with zipfile.ZipFile(path) as archive:
            (library,) = (name for name in archive.namelist() if name.startswith("binaries/"))
            content = archive.read(library)
        assert not [name for name in wanted if name.encode() not in content]


def test_the_same_scenario_gives_the_same_bytes_and_another_one_another_token():
    """With sources that say how they are built, a licence, a page."""
    none = {"platforms": "none"}

    def read(path: Path) -> dict[str, bytes]:
        with zipfile.ZipFile(path) as archive:
            assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
            return {name: archive.read(name) for name in archive.namelist()}

    first, again, other = (
        fmu_of(PAIR, {**none, "operating.gear_torque": torque})
        for torque in ("500 N*m", "500 N*m", "499 N*m")
    )
    assert first.read_bytes() == again.read_bytes()
    td.export(PAIR, "fmu", first, none)  # replaces it without a word: it is ours
    files, others = read(first), read(other)
    tokens = [
        ElementTree.fromstring(each["modelDescription.xml"]).get("instantiationToken")
        for each in (files, others)
    ]
    assert tokens[0] != tokens[1]
    assert tokens[0] in files["sources/simulation.c"].decode()
    built = ElementTree.fromstring(files["sources/buildDescription.xml"])
    schema = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3BuildDescription.xsd"
    etree = pytest.importorskip("lxml.etree")
    assert etree.XMLSchema(etree.parse(schema)).validate(
        etree.fromstring(files["sources/buildDescription.xml"])
    )
    named = {f"sources/{file.get('name')}" for file in built.iter("SourceFile")}
    assert named == {"sources/fmi3.c", "sources/model.c"} & files.keys()
    assert b"Apache" in files["documentation/licenses/license.txt"]
    assert b"input_torque" in files["documentation/index.html"]


def test_names_with_hyphens_quotes_and_other_letters_are_text_in_every_file(tmp_path: Path):
    """In XML, in its comments, in C, and where names become identifiers."""
    from fmpy.validation import validate_fmu

    title = 'Zähne "a" <b>&amp; */ --- \\ 齿'
    scenario = tmp_path / "a---b \"ü'&.toml"
    scenario.write_text(load_scenario(PAIR, {}).toml, encoding="utf-8")
    # the second is also what functions of the sources are named after
    for version, name in (("3.0", "1 <é>---"), ("2.0", "simulation")):
        path = tmp_path / f"{name}.fmu"
        td.export(scenario, "fmu", path, {"platforms": "x86_64-linux", "fmi": version, "title": title})
        assert validate_fmu(str(path)) == []
        described = fmpy.read_model_description(path)
        assert (described.description, described.modelName) == (title, path.stem)


def test_teeth_without_backlash_stay_apart_as_is_said(tmp_path: Path):
    """Torques in the other direction then move either body for itself."""
    said = "without mesh.backlash back flanks never touch"
    settings = {key: value for key, value in FROM_REST.items() if key != "mesh.backlash"}
    path = tmp_path / "unit.fmu"
    remarks = td.export(PAIR, "fmu", path, {**settings, "platforms": "x86_64-linux"}).remarks
    assert any(said in remark for remark in remarks)
    with zipfile.ZipFile(path) as archive:
        assert said in archive.read("documentation/index.html").decode()
    none = {"platforms": "none"}
    remarks = td.export(PAIR, "fmu", tmp_path / "other.fmu", FROM_REST | none).remarks
    assert not any(said in remark for remark in remarks)
    unit = Unit(path, start_speed=0.0)
    unit.set(input_torque=-80.0, output_torque=-100.0)
    speeds = unit.step(1e-4, 10).get("input_speed", "output_speed")
    later = unit.step(1e-4, 10).get("input_speed", "output_speed")
    one, two = in_time(load_scenario(PAIR, settings), TORQUE, TORQUE).model.bodies.inertia
    assert later - speeds == pytest.approx([-80e-3 / one, 100e-3 / two], rel=1e-6)


def test_laws_over_the_temperature_of_the_oil_are_those_of_the_scenario_there():
    """The whole scenario at another temperature has the numbers of the table, and nothing else changes."""
    settings = {"film.law": "dowson-higginson", "friction.law": "xu"}

    def at(temperature: str):
        case = load_scenario("two-stage-reducer", {**settings, "operating.oil_temperature": temperature})
        return in_time(case, TORQUE, TORQUE)

    gearbox = at("70 degC")
    assert gearbox.at_temperature is not None
    table = oil_table(gearbox.at_temperature, 343.15, (293.15, 373.15), gearbox.model)
    assert table.error <= TOLERANCE
    warm = at("83.3 degC").model
    for path, number in zip(table.paths, table.at(273.15 + 83.3), strict=True):
        value = warm
        for part in path:
            value = value[part] if isinstance(part, int) else getattr(value, part)
        assert number == pytest.approx(value, rel=1e-5)
    parts = ("meshes", "options")
    own, other = (each._replace(**dict.fromkeys(parts)) for each in (gearbox.model, warm))
    assert repr(own) == repr(other)


def test_without_a_compiler_it_is_said_how_to_get_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    (tmp_path / "ziglang").mkdir()
    (tmp_path / "ziglang" / "__init__.py").touch()
    monkeypatch.syspath_prepend(str(tmp_path))
    said = complaint("export", PAIR, "--to", "fmu", folder=tmp_path)
    assert "pip install tribodyn[fmu]" in said
    assert "platforms = none" in said


def test_a_library_for_both_processors_holds_both():
    whole = both_processors(b"intel" * 1000, b"arm" * 10)
    assert whole[:8] == bytes.fromhex("cafebabe00000002")
    numbers = np.frombuffer(whole[8:48], ">u4").reshape(2, 5)
    for (kind, _, offset, size, alignment), content in zip(
        numbers.tolist(), (b"intel" * 1000, b"arm" * 10), strict=True
    ):
        assert whole[offset : offset + size] == content
        assert offset % 2**alignment == 0
        assert kind in (0x01000007, 0x0100000C)


@pytest.mark.parametrize(
    ("scenario", "settings", "said"),
    [
        (PAIR, {"fmi": "1.0"}, "must be 3.0 or 2.0"),
        (PAIR, {"platforms": "amiga"}, "no such platform"),
        (PAIR, {"input_kind": "angle"}, "must be torque or speed"),
        (PAIR, {"oil_temperature_min": "20 degC"}, "known at one temperature only"),
        (PAIR, {"mesh.formulation": "energy-consistent"}, "takes energy from the rotation"),
        ("planetary-24-84", {}, "counts the forces of the nominal speed"),
        ("idler-train", {"gear.idler.eccentricity": "5 um"}, "leave out what single teeth have of their own"),
        ("efficiency-crc-23-47", {}, "has no motion in time"),
        ("two-stage-reducer-hunting", {"solver.max_period": "10"}, "are at their phases again after 61"),
    ],
)
def test_what_no_fmu_can_hold_is_refused_in_one_line(
    scenario: str, settings: dict[str, str], said: str, tmp_path: Path
):
    assert said in complaint("export", scenario, "--to", "fmu", *sets(settings), folder=tmp_path)
