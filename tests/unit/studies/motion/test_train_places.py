"""The train as it is drawn: contacts lie on both outlines, teeth overlap nowhere, curves follow one pair."""

from pathlib import Path

import numpy as np
import pytest
import tomli_w

from tests.support.outlines import distance, turned
from tests.support.train_scenarios import REDUCER, train_case
from tribodyn.post.cycles import last_cycles, mesh_rates, pair_curve, shown_cycles
from tribodyn.post.page.data import series_of
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.gear_positions import contacts, gear_outlines, poses
from tribodyn.studies.motion.report import mechanism
from tribodyn.studies.motion.run import run

#: Chords of the outlines' points leave less, m; beside it the teeth give and the bearings yield by so much.
CHORD, YIELD = 1e-6, 150e-6
SAMPLES = range(0, 600, 37)


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Record:
    folder: Path = tmp_path_factory.mktemp("train")
    path = folder / "reducer.toml"
    tables = {"solver": {"cycles": 12}, "output": {"samples_per_cycle": 50}}
    bearings = {"default": {"stiffness_x": "6e8 N/m", "stiffness_y": "6e8 N/m", "damping_ratio": 0.05}}
    path.write_text(tomli_w.dumps(REDUCER | tables | {"bearings": bearings}), encoding="utf-8")
    return Record(run(train_case(path), folder / "reducer.h5").path)


def nominal(record: Record, m: int, sample: int) -> np.ndarray:
    """Centre and rotation of the bodies of a mesh without loads: both turned by its phase."""
    places, mesh = record.geometry, record["mesh"][m]
    radii, angle = record.of_mesh(mesh, "geometry"), np.zeros(len(places["sense"]))
    cycles = record["mesh_phase"][sample, m] - places["phase"][m]
    driver = cycles * 2 * np.pi / record.of_mesh(mesh, "mesh_cycle")["pinion_teeth"]
    ratio = radii["pinion_pitch_radius"] / radii["gear_pitch_radius"]
    for end, turn in (("driver", driver), ("driven", driver * ratio)):
        angle[int(places["gear_body"][int(places[f"{end}_gear"][m])])] = turn
    return np.column_stack([places["centre"], places["sense"] * angle])


def ends(record: Record, m: int) -> list:
    """Outlines of driver and driven gear of a mesh."""
    gears = {gear.number: gear for gear in gear_outlines(record)}
    return [gears[int(record.geometry[f"{end}_gear"][m])] for end in ("driver", "driven")]


@pytest.mark.parametrize(("actual", "tolerance"), [(False, CHORD), (True, YIELD)])
def test_contacts_lie_on_both_outlines(record: Record, actual: bool, tolerance: float):
    found, moved = contacts(record, displaced=actual), poses(record)
    for m in range(len(record["mesh"])):
        for gear in ends(record, m):
            for sample in SAMPLES:
                x, y, turn = (moved[:, sample] if actual else nominal(record, m, sample))[gear.body]
                outline = turned(gear.outline, turn) + np.array([x, y])
                touching = found[sample, m][np.isfinite(found[sample, m, :, 0])]
                assert len(touching) >= 1
                assert max(distance(contact[:2], outline) for contact in touching) < tolerance


def test_teeth_overlap_nowhere(record: Record):
    from matplotlib.path import Path as Closed

    for m, mesh in enumerate(record["mesh"]):
        (driver, driven), shape = ends(record, m), record.of_mesh(mesh, "geometry")
        for sample in SAMPLES:
            stand = nominal(record, m, sample)
            one, two = (turned(g.outline, stand[g.body, 2]) + stand[g.body, :2] for g in (driver, driven))
            near = one[np.hypot(*(one - stand[driver.body, :2]).T) > 0.9 * shape["pinion_root_radius"]]
            inside = near[Closed(two).contains_points(near)]
            assert max((distance(point, two) for point in inside), default=0.0) < CHORD


def test_teeth_point_where_the_record_says(record: Record):
    for gear in gear_outlines(record):
        tip = gear.outline[np.hypot(*gear.outline.T) > gear.tip_radius * (1 - 1e-9)]
        beside = np.angle(np.exp(1j * (np.arctan2(tip[:, 1], tip[:, 0]) - tooth(record, gear.number))))
        both = np.sort(beside[np.argsort(np.abs(beside))[:2]])  # corners of that tooth
        assert both.sum() == pytest.approx(0.0, abs=1e-9)
        assert both[1] > 0.0


def tooth(record: Record, gear: int) -> float:
    return float(record.geometry["tooth_direction"][gear])


def test_loads_push_the_driven_gears_on(record: Record):
    """The direction of a load has a moment about the driven axis in its sense of rotation."""
    found, places = contacts(record), record.geometry
    for m in range(len(record["mesh"])):
        driven = ends(record, m)[1]
        arms = found[:, m, :, :2] - places["centre"][driven.body]
        way = found[:, m, :, 2]
        moment = arms[..., 0] * np.sin(way) - arms[..., 1] * np.cos(way)
        assert np.nanmin(places["sense"][driven.body] * moment) > 0.0


def test_arrows_of_the_page_belong_to_the_curves_of_the_load(record: Record):
    (loads,) = [series for series in series_of(record) if series.name == "normal_load"]
    labels = [f"{mesh}, pair {pair}" for mesh in record["mesh"] for pair in (1, 0)]
    assert [curve.label for curve in loads.curves] == labels
    moved = mechanism(record)
    assert moved.contacts.shape[1] == len(labels)
    for place, curve in enumerate(loads.curves):
        shown = np.isfinite(moved.contacts[curve.places, place, 0])
        np.testing.assert_array_equal(shown, curve.values > 0.0)


def test_series_are_named_by_mesh_and_body(record: Record):
    curves = {series.name: [curve.label for curve in series.curves] for series in series_of(record)}
    assert curves["mesh_power_friction"] == ["pinion-1-wheel-1", "pinion-2-wheel-2"]
    assert curves["x"] == ["pinion-1", "middle", "wheel-2"]
    assert curves["power_in"] == [""]


def test_a_curve_breaks_where_its_number_passes_on(record: Record):
    """In cycles of that mesh, which is slower and begins in the middle of the run."""
    window = last_cycles(record, None)
    phase = record["mesh_phase"][window.part, 1]
    x, load = pair_curve(record, record["normal_load"][:, 1], 1, window, phase, 1)
    gaps = np.flatnonzero(np.isnan(x))
    pieces = [piece[~np.isnan(piece)] for piece in np.split(x, gaps)]
    pieces = [piece for piece in pieces if len(piece)]
    assert len(pieces) == np.ptp(np.floor(phase)) + 1
    step = phase[1] - phase[0]
    for piece in pieces:
        assert np.floor(piece[0] + 1e-9) >= np.floor(piece[-1] - step + 1e-9)
    assert np.nanmin(load) > 0.0


def test_a_figure_shows_two_cycles_of_the_slowest_mesh(record: Record):
    assert mesh_rates(record) == pytest.approx([1.0, 1 / 3])
    assert shown_cycles(record) == 6
