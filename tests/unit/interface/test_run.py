"""Runs, sweeps and gears as objects in Python."""

import gc
import pydoc
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure, SubFigure

import tribodyn as td
from tribodyn.cli.app import app
from tribodyn.errors import InputError
from tribodyn.interface.result import Run
from tribodyn.interface.sweep import Sweep

SHORT = {"solver.cycles": 1, "output.samples_per_cycle": 40}


@pytest.fixture(scope="module")
def crc() -> Run:
    return td.run("crc-23-47", SHORT)


def test_the_interface_is_what_is_listed():
    assert set(dir(td)) == set(td.__all__)
    for name in td.__all__:
        assert getattr(td, name) is not None


def test_help_names_types_that_a_reader_knows():
    shown = "".join(pydoc.plain(pydoc.render_doc(part)) for part in (td.Differentiable, td.signals.rms))
    assert "rms(values: numpy.ndarray) -> float" in shown
    assert not re.findall(r"(?:tribodyn\.[\w.]*\._\w+|numerics\.shapes\.\w+)", shown)


def test_a_run_has_the_verdict_that_is_printed(crc, capsys):
    app(["show", str(crc.path)], standalone_mode=False)
    printed = " ".join(capsys.readouterr().out.split())
    assert len(crc.verdict) > 2
    for sentence in crc.verdict:
        assert sentence in printed


def test_functions_keep_their_names_whatever_is_imported():
    check = """
import tribodyn.grid.grid, tribodyn.input.units, tribodyn as td
from tribodyn import scenario, sweep
assert callable(td.sweep) and td.sweep is sweep
assert callable(td.scenario) and td.scenario is scenario
import tribodyn.grid.run
assert td.sweep is sweep
"""
    subprocess.run([sys.executable, "-c", check], check=True)


def test_a_run_has_data_with_units_and_a_summary(crc):
    assert (crc.status, crc.message) == ("complete", "")
    load = crc.data["normal_load"]
    assert load.dims == ("time", "pair")
    assert load.attrs == {"units": "N", "long_name": "normal load of the pair"}
    assert crc.data["time"].attrs["units"] == "s"
    assert crc.data.sizes["time"] == 41
    assert 0.9 < crc.summary["efficiency"] < 1.0
    assert crc.mesh_cycle["pinion_teeth"] == 23
    assert crc.scenario["operating"]["gear_torque"] == "500 N*m"
    assert "CRC drive" in repr(crc)
    shown = crc._repr_html_()
    assert "Efficiency" in shown
    assert 'src="data:image/png;base64,' in shown


def test_an_unknown_quantity_names_those_near_it(crc):
    for name, near in (("eff", "efficiency"), ("efficency", "efficiency"), ("film min", "film_min")):
        with pytest.raises(KeyError, match=rf"did you mean [^?]*\b{near}\b"):
            crc.summary[name]
    with pytest.raises(KeyError, match=r"there is: .*contact_ratio"):
        crc.summary["zzz"]
    assert crc.summary.get("eff") is None


def test_its_record_goes_with_it_unless_it_is_kept(tmp_path: Path):
    result = td.run("backlash-oscillator", {"frequency": [0.5]})
    path = result.path
    assert path.is_file()
    kept = result.save(tmp_path / "kept.h5")
    with pytest.raises(td.InputError, match="exists"):
        result.save(kept)
    assert result.save(kept, force=True) == kept
    del result
    gc.collect()
    assert not path.parent.exists()
    assert isinstance(td.open(kept), Run)


def test_pictures_stand_by_themselves_or_among_others(crc):
    assert {"overview", "film"} <= set(crc.plots)
    assert isinstance(crc.plot("film"), Figure)
    whole = Figure()
    left, right = whole.subplots(1, 2)
    part = crc.plot("film", crc, ax=left)
    assert isinstance(part, SubFigure)
    assert part in whole.subfigs
    assert whole.axes[0] is right
    assert len(part.axes) >= 2
    whole.canvas.draw()
    with pytest.raises(td.InputError, match="in no grid"):
        crc.plot("film", ax=Figure().add_axes((0, 0, 1, 1)))
    with pytest.raises(td.InputError, match="did you mean film"):
        crc.plot("fil")
    assert isinstance(crc.plot(), Figure)  # nothing is left of what failed


def test_a_sweep_is_a_dataset_over_its_grid(tmp_path: Path):
    damping = np.array([0.05, 0.1])
    vary = {"damping": damping, "mean_force": [0.1, 0.2]}
    given = {"frequency": [0.5, 0.6]}
    data = td.sweep("backlash-oscillator", vary, given, output=tmp_path / "sweep.h5")
    name = "rms_max"
    assert data[name].dims == ("damping", "mean_force")
    np.testing.assert_array_equal(data["damping"], damping)
    case = td.scenario("backlash-oscillator", {**given, "damping": 0.1, "mean_force": 0.2})
    assert float(data[name][1, 1]) == td.run(case).summary[name]
    by_case = td.sweep(td.scenario("backlash-oscillator", given), vary)
    np.testing.assert_array_equal(by_case[name], data[name])
    opened = td.open(tmp_path / "sweep.h5")
    assert isinstance(opened, Sweep)
    assert opened.data.identical(data)
    assert isinstance(opened.plot(opened.plots[0]), Figure)
    shown = opened._repr_html_()
    assert "xarray" in shown
    assert "4 cases" in shown
    assert 'src="data:image/png;base64,' in shown


@pytest.mark.parametrize(
    ("vary", "said"),
    [
        ({}, "nothing is varied"),
        ({"damping": 0.1}, "expected a list, an array or a text of values"),
        ({"damping": []}, "expected a list, an array or a text of values"),
        ({"dampign": [0.1]}, "damping"),
    ],
)
def test_a_grid_that_is_none(vary, said):
    with pytest.raises(td.InputError, match=said):
        td.sweep("backlash-oscillator", vary)


def test_a_gear_pair_has_teeth_sheet_and_stiffness():
    pair = td.drive("liu-ni-involute-23-47", {"drive.pinion.profile_shift": 0.1})
    assert pair.sheet["contact ratio"][0] == pytest.approx(pair.contact_ratio)
    pinion = pair.sheet["pinion"]
    units = {
        unit
        for part in (pair.sheet, pinion)
        for _, unit in filter(lambda line: len(line) == 2, part.values())
    }
    assert units == {"", "m", "rad", "m/rad", "kg", "kg*m2"}
    x, y = pair.outlines["pinion"].T
    tip = 2 * np.hypot(x, y + pinion["working pitch diameter"][0] / 2).max()
    assert tip == pytest.approx(pinion["tip diameter"][0])
    (start, end), outline = pair.path[[0, -1]], pair.outlines["pinion"]
    # a straight path: every point of contact lies on the line through its ends, and teeth reach it
    along = (end - start) / np.linalg.norm(end - start)
    away = (pair.path - start) @ np.array([-along[1], along[0]])
    assert np.max(np.abs(away)) < 1e-9
    assert np.min(np.linalg.norm(outline - start, axis=1)) < 1e-3
    stiffness = pair.stiffness("500 N*m")
    assert stiffness.attrs["units"] == "N/m"
    assert 1.5e8 < float(stiffness.min()) < float(stiffness.max()) < 6e8
    np.testing.assert_allclose(pair.stiffness(500.0), stiffness)
    assert isinstance(pair.plot(), Figure)
    shown = pair._repr_html_()
    assert "contact ratio" in shown
    assert 'src="data:image/png;base64,' in shown
    with pytest.raises(td.InputError, match="torque"):
        pair.stiffness("5 mm")


def test_a_comparison_with_a_paper():
    rows = td.validate("efremenkov-2024")
    assert rows
    assert {row.verdict for row in rows} <= {"pass", "fail", "direction", "reported"}
    shown = rows._repr_html_()
    assert rows.choices.startswith("as published")
    assert rows.choices in shown.replace("&#x27;", "'")
    assert shown.count("<tr>") == len(rows) + 1
    assert f"{len(rows)} rows: " in shown


def test_keys_are_varied_as_on_the_command_line(tmp_path: Path):
    """A text and a list of texts, as --vary takes them, in place of a mapping."""
    short = {"output.samples_per_cycle": 20}
    written = "operating.gear_torque=100:200:100 N*m"
    torques = {"operating.gear_torque": ["100 N*m", "200 N*m"]}
    many = [
        td.sweep("efficiency-involute-18-36", vary, short, output=tmp_path / f"{number}.h5")
        for number, vary in enumerate((torques, written, [written]))
    ]
    for one in many[1:]:
        assert (one.efficiency.values == many[0].efficiency.values).all()
    with pytest.raises(InputError, match=r"operating\.gear_torqe"):
        td.sweep("efficiency-involute-18-36", "operating.gear_torqe=1:2/2 N*m", output=tmp_path / "x.h5")
