"""Pages of records: what they hold, that they harm nobody, and what a browser makes of them."""

import html
import re
from pathlib import Path

import h5py
import numpy as np
import pytest

import tribodyn as td
from tests.support.outlines import closed, distance, turned
from tests.support.pages import data_of, needs_browser, shown, unpacked
from tests.support.verbs import invoke
from tribodyn.interface.result import Run
from tribodyn.post.page.data import MOST_SAMPLES, extrapolated, packed, thinned
from tribodyn.post.page.motion import rolling_teeth
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import open_any
from tribodyn.studies.pages import write_report


@pytest.fixture(scope="module")
def crc() -> Run:
    return td.run("efficiency-crc-23-47")


@pytest.fixture(scope="module")
def page(crc, tmp_path_factory) -> Path:
    return crc.report(tmp_path_factory.mktemp("page") / "crc.html")


def test_it_needs_no_other_file_and_is_small(page):
    text = page.read_text(encoding="utf-8")
    assert len(text.encode()) < 6e6
    assert not re.findall(r"<(?:script|link|img|iframe)[^>]+(?:src|href)=", text.split("<script>")[0])
    assert "default-src 'none'" in text


def test_it_holds_what_was_sampled(crc, page):
    (record,) = data_of(page)["records"]
    series = {series["name"]: series for series in record["series"]}
    load = series["normal_load"]
    assert load["unit"] == "N"
    assert [curve["label"] for curve in load["curves"]] == ["pair 1", "pair 0"]
    np.testing.assert_allclose(
        unpacked(load["curves"][0]["y"]), crc.data["normal_load"].sel(pair=1), rtol=1e-6
    )
    np.testing.assert_allclose(unpacked(record["axis"], "<f8"), crc.data["time"] * 1e3)


def test_the_last_cycles_of_a_record_that_keeps_a_part_of_its_run(tmp_path):
    """Half a turn of two is kept; two cycles of 23 teeth last 2/23 of a turn."""
    keys = {"solver.revolutions": 2, "output.window": [1.5, 2.0], "output.samples_per_cycle": 16}
    kept = td.run("crc-23-47", {**keys, "friction.law": "none", "operating.pinion_speed": "1380 rpm"})
    (record,) = data_of(kept.report(tmp_path / "kept.html"))["records"]
    axis, (start, end) = unpacked(record["axis"], "<f8"), record["window"]
    milliseconds = 1e3 * 2.0 * 60.0 / 1380.0 / 23.0
    assert end - start == pytest.approx(milliseconds, rel=1e-2)
    assert record["cycle"] == pytest.approx(milliseconds / 2.0, rel=1e-2)
    assert np.sum(axis >= start - 1e-9) == 33


@pytest.mark.parametrize(
    "scenario", ["efficiency-crc-23-47", "efficiency-involute-18-36", "load-contact-18-36"]
)
def test_contact_points_lie_on_both_flanks_and_on_the_path(scenario):
    """To a micrometre, at random positions; the flanks as the page has them, turned as it turns them."""
    result = td.run(scenario)
    with Record(result.path) as record:
        teeth = rolling_teeth(record)
    assert teeth is not None
    pairs, (rp, rg) = teeth["pairs"], teeth["radii"]
    x, y = (unpacked(teeth[name]).astype(float).reshape(-1, pairs) for name in "xy")
    pinion, gear, path = (unpacked(teeth[n]).astype(float).reshape(-1, 2) for n in ("pinion", "gear", "path"))
    roll = unpacked(teeth["roll"], "<f8")
    rng, found = np.random.default_rng(3), 0
    for frame in rng.choice(len(roll), 25):
        places = turned(pinion, -roll[frame]), turned(gear, roll[frame] * rp / rg)
        places[0][:, 1] -= rp
        places[1][:, 1] += rg
        for point in np.stack([x[frame], y[frame]], axis=1):
            if np.isfinite(point[0]):
                found += 1
                flanks = [distance(point, closed(place)) for place in places]
                assert min(flanks) < 1e-6
                # elastic teeth touch a little beyond the path: a corner that would stand in the flank
                corner = scenario.startswith("load-contact") and distance(point, path) > 1e-6
                assert max(flanks) < (1e-4 if corner else 1e-6)
                assert corner or distance(point, path) < 1e-6
    assert found > 25


def test_what_is_thinned_keeps_its_extremes_and_its_gaps(rng):
    values = rng.normal(size=100_001)
    values[[777, 50_000]] = 9.0, -9.0
    values[30_000:40_000] = np.nan
    index, kept = thinned(values)
    assert len(index) < 2 * MOST_SAMPLES
    assert (np.nanmax(kept), np.nanmin(kept)) == (9.0, -9.0)
    np.testing.assert_array_equal(kept, values[index])
    assert np.isnan(kept[(index >= 30_000) & (index < 40_000)]).all()
    assert np.any((index >= 30_000) & (index < 40_000))
    assert (index[0], index[-1]) == (0, 100_000)
    short = np.arange(5.0)
    np.testing.assert_array_equal(thinned(short)[1], short)


def test_extrapolated_intervals_cover_what_the_flags_say(crc):
    with Record(crc.path) as record:
        found = extrapolated(record)
        outside = np.any((record["closure_in_range"] == 0) & (record["normal_load"] > 0.0), axis=1)
    covered = np.zeros(len(outside), dtype=bool)
    for first, last in found.get("film_parameter", []):
        covered[first : last + 1] = True
    np.testing.assert_array_equal(covered, outside)


def test_a_load_contact_page_has_maps_to_the_edges_of_the_face(tmp_path: Path):
    result = td.run("load-contact-18-36")
    (record,) = data_of(result.report(tmp_path / "map.html"))["records"]
    load, pressure = record["maps"]
    assert (load["name"], pressure["name"]) == ("line_load", "hertz_pressure")
    x, y, z = (unpacked(load[name]) for name in "xyz")
    assert z.size == x.size * y.size
    assert load["unit"] == "N/mm"
    line = result.data["line_load"].to_numpy() * 1e-3
    assert z.max() == pytest.approx(line.max(), rel=1e-6)
    with Record(result.path) as opened:
        assert y[-1] - y[0] == pytest.approx(1e3 * opened.mesh_cycle["face_width"], rel=1e-6)


def test_a_sweep_has_a_page(tmp_path: Path):
    swept = tmp_path / "sweep.h5"
    invoke("sweep", "efficiency-crc-23-47", "--vary", "operating.pinion_speed=100,200,300rpm", "-o", swept)
    with open_any(swept) as record:
        page = write_report([record], tmp_path / "sweep.html")
        (data,) = data_of(page)["records"]
        series = {series["name"]: series for series in data["series"]}
        np.testing.assert_allclose(
            unpacked(series["efficiency"]["curves"][0]["y"]), 100 * record["efficiency"], rtol=1e-6
        )
        np.testing.assert_allclose(unpacked(data["axis"], "<f8"), [100.0, 200.0, 300.0])
        with pytest.raises(td.InputError, match="a page of its own"):
            write_report([record, record], tmp_path / "both.html")
    assert data["teeth"]["turning"]
    np.testing.assert_allclose(unpacked(data["rates"]), [1 / 3, 2 / 3, 1.0], rtol=1e-6)
    assert 'class="pictures"' not in page.read_text(encoding="utf-8"), "curves of the page, once more"


def test_a_page_replaces_pages_only(crc, tmp_path: Path):
    other = tmp_path / "mine.html"
    other.write_text("my own", encoding="utf-8")
    for target, said in ((other, "tribodyn did not make it"), (tmp_path / "x.toml", "ends in .html")):
        with pytest.raises(td.InputError, match=said):
            crc.report(target)
    assert other.read_text(encoding="utf-8") == "my own"
    for _ in range(2):
        assert crc.report(tmp_path / "again.html").is_file()
    with pytest.raises(td.InputError, match="No such file"):
        crc.report(tmp_path / "none" / "x.html")


HOSTILE = (
    '<script>document.body.dataset.hit="yes"</script></script>'
    '<img src=x onerror="document.body.dataset.hit=1">'
)


@pytest.fixture(scope="module")
def hostile(crc, tmp_path_factory) -> Path:
    """The page of a record with a hostile title, dataset, unit and summary."""
    folder = tmp_path_factory.mktemp("hostile")
    path = crc.save(folder / "hostile.h5")
    with h5py.File(path, "r+") as file:
        scenario = str(file.attrs["scenario"])
        title = re.search(r'^title = ".*"$', scenario, re.MULTILINE)
        assert title
        file.attrs["scenario"] = scenario.replace(title.group(), f"title = '''{HOSTILE}'''")
        file["normal_load"].attrs["long_name"] = HOSTILE
        file["efficiency"].attrs["units"] = HOSTILE
        file["summary"].attrs["compliance_remark"] = HOSTILE
    opened = td.open(path)
    assert isinstance(opened, Run)
    return opened.report(folder / "hostile.html")


def test_texts_of_a_record_are_texts(hostile):
    text = hostile.read_text(encoding="utf-8")
    assert HOSTILE not in text
    assert html.escape(HOSTILE) in text


@needs_browser
@pytest.mark.slow
@pytest.mark.parametrize("at", [3.0, 11.0])
def test_one_cursor_moves_everything(at, crc, page):
    dom = shown(f"{page.as_uri()}#at={at}")
    assert 'data-ready="yes"' in dom
    assert f'data-at="{at:g}"' in dom
    time = crc.data["time"].to_numpy() * 1e3
    sample = int(np.argmin(np.abs(time - at)))
    for pair in (1, 0):
        load = float(crc.data["normal_load"].sel(pair=pair)[sample])
        (printed,) = re.findall(rf"<td>normal load, pair {pair}</td><td>([^<]*) N</td>", dom)
        assert float(printed) == pytest.approx(load, rel=1e-4)
    assert re.search(r'data-line="[1-9][0-9.]*px"', dom)


@needs_browser
@pytest.mark.slow
def test_a_hostile_record_does_nothing(hostile):
    dom = shown(hostile.as_uri())
    assert 'data-ready="yes"' in dom
    assert "data-hit" not in dom.split("<script")[0]


def test_numbers_that_single_precision_does_not_hold_are_gaps():
    np.testing.assert_array_equal(unpacked(packed(np.array([1e300, 1.0, -1e300]))), [np.inf, 1.0, -np.inf])
