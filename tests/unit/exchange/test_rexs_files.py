"""REXS files that are broken, hostile or of another schema, or contradict themselves; units, containers."""

import base64
import io
import json
import random
import re
import struct
import tracemalloc
import zipfile
from contextlib import suppress
from pathlib import Path

import pytest

import tribodyn as td
from tests.support.rexs_models import PARTS, one_stage, part, relation, sample
from tribodyn.exchange.rexs.file.files import read_model
from tribodyn.exchange.rexs.file.units import UNITS, RexsUnit, shown, unit_named
from tribodyn.exchange.rexs.reading.scenario import scenario_of
from tribodyn.exchange.rexs.rexs_format import read
from tribodyn.input import units


def refusal(tmp_path: Path, content: str | bytes, name: str = "gearbox.rexs") -> str:
    """What is said of a file, in one line, and that nothing else was made."""
    path = tmp_path / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    with pytest.raises(td.InputError) as caught:
        scenario_of(path)
    assert [each.name for each in tmp_path.iterdir()] == [name]
    text = str(caught.value)
    assert text.startswith(f"{path}: ")
    assert "\n" not in text
    return text.removeprefix(f"{path}: ")


def packed(**files: bytes) -> bytes:
    """A ZIP; __ in a name stands for a dot."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name.replace("__", "."), content)
    return stream.getvalue()


BOMB = '<!DOCTYPE model [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'
OUTSIDE = '<!DOCTYPE model SYSTEM "file:///etc/passwd">'
ENTITY = '<!DOCTYPE model [<!ENTITY x SYSTEM "file:///etc/passwd">]>'


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("", "file: neither XML nor JSON nor ZIP"),
        ("\x00\x01\x02", "file: neither XML nor JSON nor ZIP"),
        ("<model", "line 1: not XML"),
        ("<model version='2.0.0'><relations/>", "line 1: not XML"),
        (BOMB + "<model/>", "line 1: declares a document type or entities"),
        (OUTSIDE + "<model/>", "line 1: declares a document type or entities"),
        (ENTITY + "<model/>", "line 1: declares a document type or entities"),
        (one_stage().replace("70", "&undefined;"), "not XML: undefined entity"),
        ('<?xml version="1.0" encoding="x-nobody"?><model/>', "not XML: unknown encoding"),
        ("<rexsSchema version='2.0.0'/>", 'its first element is "rexsSchema": the schema, not a gearbox'),
        ("<gearbox/>", 'its first element is "gearbox": no file of REXS'),
        ("<model version='2.0.0'><model/></model>", "<model> does not belong in <model>"),
        (one_stage("3.0"), 'model.version = "3.0": another schema than REXS 1.0 to 2.0.0'),
        (one_stage("0.9"), 'model.version = "0.9": another schema'),
        (one_stage("two"), 'model.version = "two": another schema'),
        ("{", "file: not JSON"),
        ("{}", "model: missing"),
        ('{"model": {"version": "1.4", "components": 3}}', "components: is no list of tables"),
        ("[" * 100_000, "file: neither XML nor JSON nor ZIP"),
        ('{"model":' + "[" * 100_000, "file: tables too deep inside each other"),
        (one_stage(more=relation(99, "assembly", part=77)), "relation 99 (assembly): names the component 77"),
        (one_stage(parts={5: PARTS[5].replace('id="5"', 'id="6"')}), "the id 6 is that of"),
        (one_stage(parts={5: PARTS[5].replace('id="5"', 'id="x"')}), 'id = "x": is no whole number'),
    ],
)  # fmt: skip
def test_what_is_no_gearbox_is_refused_in_a_line(tmp_path: Path, content: str, said: str):
    assert said in refusal(tmp_path, content)


def test_broken_and_hostile_zips_are_refused(tmp_path: Path):
    good = packed(model__rexs=one_stage().encode())
    cases = {
        good[: len(good) // 2]: "file: a broken ZIP",
        good.replace(b"model.rexs", b"model.txtt"): "a ZIP with no model",
        packed(a__rexs=b"<model/>", b__rexs=b"<model/>"): "a ZIP with several models",
        packed(**{"../model__rexs": b"<model/>"}): 'file = "../model.rexs": a path that leads out of the ZIP',
        packed(**{"/etc/model__rexs": b"<model/>"}): "a path that leads out of the ZIP",
        packed(**{"C:\\model__rexs": b"<model/>"}): "a path that leads out of the ZIP",
        packed(model__rexs=packed(model__rexs=b"<model/>")): "neither XML nor JSON nor ZIP",
    }
    for content, said in cases.items():
        assert said in refusal(tmp_path, content, "gearbox.rexsz")


def test_a_bomb_is_refused_before_it_fills_the_memory(tmp_path: Path):
    content = packed(model__rexs=b"<model>" + b" " * 2**28)
    tracemalloc.start()
    said = refusal(tmp_path, content, "gearbox.rexsz")
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert "model.rexs: unpacked larger than 64 MiB" in said
    assert peak < 3 * 64 * 2**20


@pytest.mark.parametrize(
    ("number", "change", "said"),
    [
        (7, {"helix_angle_reference_diameter": "18 deg"}, "right-handed: parallel axes need opposite hands"),
        (8, {"helix_angle_reference_diameter": "17 deg"}, "= 17 deg: differs from that of cylindrical_gear"),
        (8, {"normal_module": "3 mm"}, "normal_module = 3 mm: differs"),
        (8, {"normal_module": "3 deg"}, 'normal_module = 3 deg: in "deg", but it is a length'),
        (8, {"normal_module": "three mm"}, "normal_module = three mm: is no number that counts"),
        (8, {"number_of_teeth": "nan"}, "number_of_teeth = nan: is no number that counts"),
        (8, {"number_of_teeth": "20.5"}, "number_of_teeth = 20.5: is no whole number"),
        (8, {"face_width": None}, "cylindrical_gear 'wheel' (id 8): face_width missing"),
        (8, {"at": (60, 0, 94)}, "center_distance = 93 mm: but the axes of"),
        (4, {"at": (10, 0.5, 93)}, "is 0.5 mm beside the axis of shaft 'output' (id 4)"),
        (8, {"at": (10, 0, 93), "u_coordinate_on_shaft": "0 mm"}, "are 50 mm apart along their axes"),
        (8, {"u_coordinate_on_shaft": "40 mm"}, "= 40 mm: but support_vector puts it at 50 mm"),
        (11, {"rotating_angle_around_neg_u_axis": "90 deg"}, "= 90 deg: but the axes of"),
        (6, {"length": "0 mm"}, "shaft_section (id 6): has no length"),
        (12, {"torque_around_u_axis": None}, "no torque_around_u_axis is given"),
        (3, {"rotational_speed": None}, "no rotational_speed is given"),
        (13, {"transmits_torque": "false"}, "torque is transmitted at 1 shafts, two are taken"),
        (18, {"kind": "grease"}, "lubricant 'oil' (id 18): kind = grease: is a grease"),
    ],
)  # fmt: skip
def test_a_gearbox_that_contradicts_itself_is_refused(
    tmp_path: Path, number: int, change: dict[str, object], said: str
):
    text = PARTS[number]
    for key, value in change.items():
        if key == "at":
            vector = re.compile(r'<attribute id="support_vector".*?</attribute>')
            cells = "".join(f"<c>{each}</c>" for each in value)  # type: ignore[attr-defined]
            text = vector.sub(
                f'<attribute id="support_vector" unit="mm"><array>{cells}</array></attribute>', text
            )
            continue
        text = re.sub(rf'\n *<attribute id="{key}".*', "", text)
        if value is not None:
            written = re.search(r"<attribute.*", part(0, "x", "", **{key: value}))
            assert written is not None
            text = text.replace("\n    </component>", f"\n      {written[0]}\n    </component>")
    assert said in refusal(tmp_path, one_stage(parts={number: text}))


@pytest.mark.parametrize("sort", ["worm_stage", "bevel_stage"])
def test_gears_on_other_axes_are_refused_by_name(tmp_path: Path, sort: str):
    said = refusal(tmp_path, one_stage(parts={30: part(30, sort, "the other stage")}))
    assert said.startswith(f"{sort} 'the other stage' (id 30): cylindrical gears on parallel axes alone")


def test_the_worm_of_another_program_is_refused_by_name():
    with pytest.raises(td.InputError, match=r"worm_stage 'Schneckenstufe \[3\]' \(id 3\)"):
        scenario_of(sample("FVA_worm_stage_1.4.rexs"))


def test_a_frame_that_refers_to_itself_is_refused(tmp_path: Path):
    reference = '<attribute id="reference_component_for_position">1<'
    parts = {
        3: PARTS[3].replace(reference, reference.replace("1<", "4<")),
        4: PARTS[4].replace(reference, reference.replace("1<", "3<")),
    }
    assert "its place refers to itself" in refusal(tmp_path, one_stage(parts=parts))


def as_json(path: Path) -> str:
    """An XML file as JSON, its arrays packed, as the format allows."""
    model = read_model(path)

    def attribute(name: str, unit: str | None, value: object) -> dict[str, object]:
        if isinstance(value, tuple):
            data = base64.b64encode(struct.pack("<3d", *map(float, value))).decode()
            return {
                "id": name,
                "unit": unit,
                "floating_point_array_coded": {"code": "float64", "value": data},
            }
        try:
            return {"id": name, "unit": unit, "floating_point": float(str(value))}
        except ValueError:
            return {"id": name, "unit": unit, "string": value}

    components = [
        {
            "id": each.number,
            "type": each.type,
            "name": each.name,
            "attributes": [attribute(*one) for one in each.attributes.values()],
        }
        for each in model.parts.values()
    ]
    relations = [
        {
            "id": each.number,
            "type": each.type,
            "refs": [{"id": ref.number, "role": ref.role} for ref in each.refs],
        }
        for each in model.relations
    ]
    head = {"version": model.version, "applicationId": model.application}
    return json.dumps({"model": head | {"relations": relations, "components": components}})


def test_xml_json_and_zip_are_one_gearbox(tmp_path: Path):
    xml = tmp_path / "gearbox.rexs"
    xml.write_text(one_stage(), encoding="utf-8")
    (tmp_path / "gearbox.rexsj").write_text(as_json(xml), encoding="utf-8")
    (tmp_path / "gearbox.rexsz").write_bytes(packed(model__rexs=xml.read_bytes()))
    (tmp_path / "packed.rexsz").write_bytes(
        packed(model__rexsj=as_json(xml).encode("utf-8-sig"), drawing__png=b"x")
    )
    first, *others = (scenario_of(path).toml.splitlines()[1:] for path in sorted(tmp_path.iterdir()))
    assert all(other == first for other in others)


@pytest.mark.parametrize(
    "unit", [unit for unit in UNITS.values() if unit.toml and unit.quantity != "temperature"]
)
def test_every_unit_is_the_one_of_the_scenario(unit: RexsUnit):
    """A number with a REXS unit, and what a scenario writes for it, are one quantity."""
    kinds = [kind for kind in vars(units).values() if isinstance(kind, units.Kind)]
    found = []
    for kind in kinds:
        with suppress(units.NotAQuantity):
            found.append(units.to_si(shown(12.5, unit).strip('"'), kind))
    assert found == pytest.approx([12.5 * unit.si] * len(found), rel=1e-11)
    assert found


def test_shares_and_temperatures_are_read_as_they_are():
    percent, celsius = unit_named("%"), unit_named("C")
    assert percent is not None
    assert celsius is not None
    assert (shown(20.0, percent), shown(70.0, celsius)) == ("0.2", '"70 degC"')
    assert unit_named("furlong") is None


def test_a_relation_to_what_is_not_read_does_no_harm(tmp_path: Path):
    path = tmp_path / "gearbox.rexs"
    parts = {30: part(30, "display", "", hue="3 none"), 31: part(31, "assembly_group", "group")}
    path.write_text(
        one_stage(parts=parts, more=relation(99, "assembly", assembly=31, part=30)), encoding="utf-8"
    )
    assert [(each.number, each.attribute) for each in scenario_of(path).not_used][-1] == (30, "hue")


def broken(text: str, draw: random.Random) -> str:
    """A file in which lines are lost, doubled, swapped, or hold other numbers, units, types or roles."""
    lines = text.split("\n")
    for _ in range(draw.randint(1, 3)):
        place, other = (draw.randrange(len(lines)) for _ in range(2))
        number = draw.choice(["0", "-1", "1e308", "nan", "1e-300", "9" * 20, "abc", "", "-0.0", "7"])
        sort = draw.choice(["shaft", "ring_gear", "coupling", "planetary_stage", "gear_unit", "nonsense"])
        lines[place] = draw.choice(
            [
                lines[other],
                "",
                re.sub(r"-?\d+(\.\d+)?", number, lines[place], count=1),
                lines[place].replace("mm", draw.choice(["deg", "kg", "furlong", ""])),
                re.sub(r'type="\w+"', f'type="{sort}"', lines[place]),
                re.sub(r'role="\w+"', 'role="assembly"', lines[place], count=1),
            ]
        )
    return "\n".join(lines)


@pytest.mark.filterwarnings("error")
def test_files_broken_at_random_are_read_or_refused_in_a_line(tmp_path: Path):
    draw, path = random.Random(5), tmp_path / "gearbox.rexs"
    text = one_stage().replace("><", ">\n<")
    refused: list[str] = []
    for _ in range(300):
        path.write_text(broken(text, draw), encoding="utf-8")
        try:
            scenario_of(path)
        except td.InputError as error:
            refused.append(str(error))
    assert 20 < len(refused) < 280
    assert all(each.startswith(f"{path}: ") and "\n" not in each for each in refused)


def test_hours_of_load_cases_are_shares_of_time(tmp_path: Path):
    """And speeds and torques of load cases go before those of the components."""
    path = tmp_path / "gearbox.rexs"
    cases = [
        part(1, "gear_unit", operating_time=f"{hours} h")
        + part(3, "shaft", rotational_speed=f"{speed} 1 / min")
        + part(12, "external_load", torque_around_u_axis=f"{torque} N m")
        for hours, speed, torque in ((300, -1200, -90), (700, -600, -40))
    ]
    spectrum = "".join(f'<load_case id="{number}">{case}</load_case>' for number, case in enumerate(cases, 1))
    text = one_stage().replace("</model>", f'<load_spectrum id="1">{spectrum}</load_spectrum></model>')
    path.write_text(text, encoding="utf-8")
    duties = read(path).scenario["duty"]
    assert [(each["share"], each["input_speed"], each["input_torque"]) for each in duties] == [
        (300, "1200 rpm", "90 N*m"),
        (700, "600 rpm", "40 N*m"),
    ]
    path.write_text(text.replace('"N m">-40', '"N m">40'), encoding="utf-8")
    with pytest.raises(td.InputError, match=r"motor' .*: its torque or speed reverses in load case 2"):
        read(path)
