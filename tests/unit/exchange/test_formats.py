"""The registry of formats, what verbs and functions say of them, and the map as a table of values."""

import csv
from pathlib import Path

import numpy as np
import pytest

import tribodyn as td
from tests.support import loss_maps
from tests.support.verbs import complaint, ended, invoke
from tribodyn.exchange import FORMATS
from tribodyn.record.loss_map import loss_map
from tribodyn.record.reader import Record


@pytest.fixture
def losses(tmp_path: Path) -> Path:
    return loss_maps.write_map(tmp_path / "map.h5")


def test_a_map_is_read_in_any_order_of_axes_and_interpolated(losses: Path):
    with Record(losses) as record:
        read = loss_map(record)
    where = 340.0, np.array([120.0, 350.0]), np.array([70.0, 199.0])
    exact = loss_maps.mesh_drag(*where) + loss_maps.seal_drag(*where)
    assert np.allclose(read.at(*where), exact, rtol=1e-12)  # bilinear over torque and speed, but at 0
    assert np.allclose(read.at(1e3, 1e6, 1e6), read.total[-1, -1, -1], rtol=1e-12)


def test_power_flows_back_with_two_less_the_inverse(tmp_path: Path):
    """Where the loss is a share of the load; and not at all where that share is 1 or more."""
    path = loss_maps.write_map(tmp_path / "map.h5", {("P_VZP", "a", "b"): loss_maps.mesh_drag})
    with Record(path) as record:
        read = loss_map(record).efficiency()[0]
    forward, backward = read[-1], read[0]
    assert np.allclose(forward, 1 / (1 + loss_maps.SHARE), rtol=1e-12)
    assert np.allclose(backward, 2 - 1 / forward, rtol=1e-12)


def test_a_folder_is_no_name_of_a_file(losses: Path):
    said = complaint("export", losses, "--to", "csv", "-o", losses.parent)
    assert "is a folder" in said
    assert str(losses.parent / "map.csv") in said


def test_values_in_a_table_are_those_of_the_map(losses: Path):
    done = td.export(losses, "csv", losses.with_name("out"), force=True)
    table, statics = done.files
    assert table == losses.with_name("out.csv")
    assert all(each.maximum < 1e-9 * each.largest for each in done.deviations)
    lines = [line for line in table.read_text(encoding="utf-8").splitlines() if line[0] != "#"]
    rows = list(csv.DictReader(lines))
    row = rows[-1]
    where = [float(row[key]) for key in ("oil_temperature [K]", "torque [N*m]", "speed [rad/s]")]
    assert float(row["P_VD input; seal: closed form [N*m]"]) == pytest.approx(loss_maps.seal_drag(*where))
    assert float(row["P_VZP high: closed form [N*m]"]) == pytest.approx(loss_maps.mesh_drag(*where))
    assert {row["efficiency [1]"] for row in rows if float(row["torque [N*m]"]) == 0.0} == {""}
    assert "stiffness_at_output [N*m/rad]" in statics.read_text(encoding="utf-8")


def test_a_file_says_by_whom_and_how_exactly_it_was_made_and_is_replaced(losses: Path):
    printed = invoke("export", losses, "--to", "csv", "-o", losses.with_name("t.csv"))
    text = losses.with_name("t.csv").read_text(encoding="utf-8")
    error = next(line for line in printed.splitlines() if "maximum error" in line)
    assert f"# {error}" in text.splitlines()
    assert "at most 0.8 %" in text
    invoke("export", losses, "--to", "csv", "-o", losses.with_name("t.csv"))
    losses.with_name("t.csv").write_text("mine", encoding="utf-8")
    assert "did not make it" in complaint("export", losses, "--to", "csv", "-o", losses.with_name("t.csv"))


def test_a_file_is_named_after_its_source(losses: Path):
    losses.rename(losses.with_name("map.v2.h5"))
    invoke("export", "map.v2.h5", "--to", "c", folder=losses.parent)
    assert {"map.v2.c", "map.v2.h"} <= {file.name for file in losses.parent.iterdir()}


def test_verbs_list_what_they_know():
    printed = invoke("export")
    assert all(name in printed for name, each in FORMATS.items() if each.write)
    assert "Formats" in invoke("import")
    assert "csv" in invoke("list", "formats")


def test_what_cannot_be_exported_is_refused_in_one_line(losses: Path):
    def refused(*words: object) -> str:
        return complaint("export", *words, folder=losses.parent)

    assert "one of csv" in refused("map.h5", "--to", "csw")
    assert "one of csv" in refused("map.h5")
    assert "is a scenario, and csv takes the record of a map" in refused("crc-23-47", "--to", "csv")
    assert "no such choice" in refused("map.h5", "--to", "csv", "--set", "a=1")
    assert '"t.csv"' in refused("map.h5", "--to", "csv", "-o", "t.mat").replace("write ", "")
    assert "folder is not there" in refused("map.h5", "--to", "csv", "-o", "no/t.csv")
    (losses.parent / "text.h5").write_text("text", encoding="utf-8")
    assert "not an HDF5 file" in refused("text.h5", "--to", "csv")
    assert "no format" in complaint("import", losses, folder=losses.parent)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"torque": np.array([0.0, 10.0, 10.0])}, "torque does not increase"),
        ({"ratio": 0.0}, "the ratio is missing"),
        ({"status": "partial"}, "is partial"),
    ],
)
def test_a_map_that_cannot_be_used_is_refused(changes, said, tmp_path: Path):
    path = loss_maps.write_map(tmp_path / "map.h5", changes=changes)
    assert said in complaint("export", path, "--to", "csv", folder=tmp_path)


PLUGIN = """
from tribodyn.exchange.format import MAP, ExchangeFormat, Imported, Written

FORMAT = ExchangeFormat(
    "own", "a format from outside", (".own",), (MAP,),
    write=lambda exported, name, choices: Written({".own": name}),
    read=lambda path: Imported('title = "' + path.read_text() + '"', ("bore was not used",)),
)
"""


def test_a_package_adds_a_format_in_both_directions(losses: Path, monkeypatch: pytest.MonkeyPatch):
    package = losses.parent / "site"
    (package / "own_format-1.0.dist-info").mkdir(parents=True)
    (package / "own_format.py").write_text(PLUGIN, encoding="utf-8")
    about = "Metadata-Version: 2.1\nName: own-format\nVersion: 1.0\n"
    (package / "own_format-1.0.dist-info" / "METADATA").write_text(about, encoding="utf-8")
    entry = "[tribodyn.formats]\nown = own_format:FORMAT\n"
    (package / "own_format-1.0.dist-info" / "entry_points.txt").write_text(entry, encoding="utf-8")
    monkeypatch.syspath_prepend(str(package))
    vars(FORMATS).pop("_outside", None)
    try:
        invoke("export", losses, "--to", "own", "-o", losses.with_name("reducer"))
        assert losses.with_name("reducer.own").read_text(encoding="utf-8") == "reducer"
        imported = td.import_scenario(losses.with_name("reducer.own"))
        assert imported.scenario == {"title": "reducer"}
        came = ended("import", "reducer.own", folder=losses.parent)
        assert "bore was not used" in came.stdout
        assert losses.with_name("reducer.toml").read_text(encoding="utf-8") == imported.toml
    finally:
        vars(FORMATS).pop("_outside", None)
        FORMATS._loaded.pop("own", None)
