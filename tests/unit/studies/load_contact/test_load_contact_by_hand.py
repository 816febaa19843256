"""Figures, datasets and maps of the load contact study, from made-up contacts followed by hand."""

import math
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure

from tests.support import synthetic_load_contact
from tests.support.synthetic_load_contact import PITCH, START, TEETH, WIDTH
from tribodyn.errors import InputError, SimulationError
from tribodyn.record.reader import Record, open_record
from tribodyn.studies.load_contact import assess, film, maps, rolled, run

POSITIONS, PAIRS, SLICES = 5, 3, 4
TORQUE = 320.0


def loaded_with(**changed: Any) -> Any:
    rng = np.random.default_rng(11)
    line = rng.uniform(1e5, 4e5, (POSITIONS, PAIRS, SLICES))
    line[:, 0] = 0.0
    values = {
        "phase": 3.4 + np.arange(POSITIONS) / POSITIONS,
        "roll": START + PITCH * (0.4 + np.arange(POSITIONS)[:, None] / POSITIONS + np.array([2.0, 1.0, 0.0])),
        "slice_position": np.linspace(-0.01, 0.01, SLICES),
        "deflection": rng.uniform(1e-5, 2e-5, POSITIONS),
        "unloaded": rng.uniform(0.0, 1e-6, POSITIONS),
        "normal_load": line.mean(axis=2) * WIDTH,
        "line_load": line,
        "pressure": 1e6 * np.sqrt(line),
        "half_width": 2e-7 * np.sqrt(line),
        "root_tension": rng.uniform(1e8, 2e8, (2, POSITIONS, PAIRS, SLICES)),
        "root_compression": -rng.uniform(1e8, 3e8, (2, POSITIONS, PAIRS, SLICES)),
        "face_load_factor": rng.uniform(1.0, 1.5, (POSITIONS, PAIRS)),
        "mesh_stiffness": rng.uniform(4e8, 5e8, POSITIONS),
        "contact_ratio": 1.71,
    }
    return SimpleNamespace(**values | changed)


def study_with(**changed: Any) -> Any:
    drive = SimpleNamespace(pinion=SimpleNamespace(teeth=TEETH), module=4.5e-3)
    settings: dict[str, Any] = {
        "gear_torque": TORQUE,
        "gear_torques": (),
        "friction_coefficient": 0.07,
        "slices": SLICES,
        "drive": drive,
        "oiled": None,
    }
    assembly = SimpleNamespace(roll_limits=(START, 0.28), contact_ratio=1.6, drive=drive)
    flexible = SimpleNamespace(assembly=assembly, width=WIDTH)
    return SimpleNamespace(case=SimpleNamespace(**settings | changed), flexible=flexible)


def motion_of(roll: np.ndarray) -> Any:
    return SimpleNamespace(
        signed_distance=roll * 0.05,
        gear_normal_arm=0.07 + 0.01 * roll,
        gear_friction_arm=0.03 - 0.04 * roll,
        pressure_angle=0.35 + 0.1 * roll,
        relative_curvature=100.0 + 50.0 * roll,
        pinion_speed=0.01 + 0.03 * roll,
        gear_speed=0.012 - 0.02 * roll,
    )


def geometry(_: Any, roll: np.ndarray) -> Any:
    return SimpleNamespace(motion=motion_of(roll))


def test_figures_are_extremes_and_means(monkeypatch: pytest.MonkeyPatch):
    loaded = loaded_with()
    residual = np.array([0.01, -0.03, 0.02, 0.0, 0.0])
    monkeypatch.setattr(run, "single_pair_stiffness", lambda _: 5e8)
    monkeypatch.setattr(run, "torque_residual", lambda *_: residual)
    found = run.loaded_figures(study_with(), loaded)
    place = max(
        ((t, p, s) for t in range(POSITIONS) for p in range(PAIRS) for s in range(SLICES)),
        key=lambda at: loaded.line_load[at],
    )
    near = min(((t, p) for t in range(POSITIONS) for p in range(PAIRS)), key=lambda at: abs(loaded.roll[at]))
    beside = [  # two pairs are on their paths
        t for t in range(POSITIONS) if sum(START - 1e-9 <= one <= 0.28 + 1e-9 for one in loaded.roll[t]) >= 2
    ]
    expected = {
        "contact_ratio_effective": 1.71,
        "stiffness_single_pair_at_pitch_point": 5e8,
        "mesh_stiffness_mean": sum(loaded.mesh_stiffness) / POSITIONS,
        "mesh_stiffness_peak_to_peak": max(loaded.mesh_stiffness) - min(loaded.mesh_stiffness),
        "loaded_transmission_error_mean": sum(loaded.deflection) / POSITIONS,
        "loaded_transmission_error_peak_to_peak": max(loaded.deflection) - min(loaded.deflection),
        "unloaded_transmission_error_peak_to_peak": max(loaded.unloaded) - min(loaded.unloaded),
        "normal_load_max": loaded.normal_load.max(),
        "shared_load_max": max(max(loaded.normal_load[t]) for t in beside),
        "line_load_max": loaded.line_load[place],
        "face_load_factor": loaded.face_load_factor[place[:2]],
        "face_load_factor_pitch_point": loaded.face_load_factor[near],
        "hertz_pressure_max": loaded.pressure.max(),
        "pinion_root_tension_max": loaded.root_tension[0].max(),
        "gear_root_tension_max": loaded.root_tension[1].max(),
        "pinion_root_compression_max": loaded.root_compression[0].min(),
        "gear_root_compression_max": loaded.root_compression[1].min(),
        "torque_residual": 0.03,
        "gear_torque": TORQUE,
        "slices": SLICES,
    }
    for name, value in expected.items():
        assert found[name] == pytest.approx(value), name
    assert set(found) - set(expected) <= {"trust", "trust_reasons"}
    alone = loaded_with(roll=np.full((POSITIONS, PAIRS), -5.0))
    assert "shared_load_max" not in run.loaded_figures(study_with(), alone)


def test_too_much_deflection_is_outside_the_model(monkeypatch: pytest.MonkeyPatch):
    """Of the load alone, in modules: a kinematic error is none."""
    seen: list[Any] = []

    class Judge:
        def take(self, values: Any, *rest: Any) -> None:
            seen.extend([(values, *rest)] if values else [])

        def figures(self) -> dict[str, Any]:
            return {"trust": "said"}

    monkeypatch.setattr(run, "Judge", Judge)
    loaded = loaded_with()
    assert run._judged(study_with(), loaded, {}) == {"trust": "said"}
    ((values, places, pairs),) = seen
    np.testing.assert_allclose(values["deflection"], (loaded.deflection - loaded.unloaded) / 4.5e-3)
    np.testing.assert_allclose(places["phase"], np.arange(POSITIONS) / POSITIONS, atol=1e-12)
    assert pairs == [-1, 0, 1]


def test_torque_of_loads_and_friction(monkeypatch: pytest.MonkeyPatch):
    """Friction turns its side at the pitch point; one position balances, one has a tenth too much."""
    monkeypatch.setattr(run, "pair_geometry", geometry)
    roll = np.array([[0.2, -0.1], [0.3, -0.05]])
    arms = [
        [0.07 + 0.01 * one + math.copysign(0.07, one) * (0.03 - 0.04 * one) for one in row] for row in roll
    ]
    loads = np.array([[1500.0, 0.0], [700.0, 0.0]])
    for row, factor in ((0, 1.0), (1, 1.1)):
        loads[row, 1] = (factor * TORQUE - loads[row, 0] * arms[row][0]) / arms[row][1]
    found = run.torque_residual(study_with(), loaded_with(roll=roll, normal_load=loads))
    np.testing.assert_allclose(found, [0.0, 0.1], atol=1e-12)


def test_stiffness_of_a_pair_alone_is_along_its_normal(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(run, "pair_geometry", geometry)
    asked: list[Any] = []

    def share(flexible: Any, roll: Any, torque: float) -> Any:
        asked.append((roll.tolist(), torque))
        return SimpleNamespace(normal_load=np.array([[4000.0]]), deflection=np.array([8e-6]))

    monkeypatch.setattr(run, "share_load", share)
    found = run.single_pair_stiffness(study_with())
    assert found == pytest.approx(4000.0 / (8e-6 * math.cos(0.35)))
    assert asked == [([[0.0]], TORQUE)]


def test_pairs_are_numbered_by_when_they_entered():
    study = study_with()
    assert run.pair_numbers(study, loaded_with()).tolist() == [-1, 0, 1]
    later = loaded_with(phase=np.array([0.9, 1.0]), roll=START + PITCH * (0.9 + np.array([[1.0, 0.0, -1.0]])))
    assert run.pair_numbers(study, later).tolist() == [0, 1, 2]
    # the first position counts, whatever the next one is
    coarse = loaded_with(
        phase=np.array([0.1, 0.8]), roll=START + PITCH * (0.1 + np.array([[1.0, 0.0, -1.0]]))
    )
    assert run.pair_numbers(study, coarse).tolist() == [0, 1, 2]
    scales = run._scales(study_with(gear_torques=(1.0, 2.0)), loaded_with())
    assert (list(scales["pair"]), list(scales["torque"])) == ([-1, 0, 1], [1.0, 2.0])
    np.testing.assert_allclose(scales["slice"], np.linspace(-0.01, 0.01, SLICES))
    nothing = run._scales(study, None)
    assert "torque" not in nothing
    assert nothing["pair"].size == nothing["slice"].size == 0


def test_datasets_begin_at_phase_zero(monkeypatch: pytest.MonkeyPatch):
    loaded = loaded_with()
    monkeypatch.setattr(run, "torque_residual", lambda *_: np.zeros(POSITIONS))
    arrays = run.record_arrays(study_with(), loaded)
    np.testing.assert_allclose(arrays["phase"], np.arange(POSITIONS) / POSITIONS, atol=1e-12)
    np.testing.assert_allclose(arrays["pinion_angle"], PITCH * np.arange(POSITIONS) / POSITIONS, atol=1e-12)
    assert np.all(np.isnan(arrays["face_load_factor"][:, 0]))
    np.testing.assert_array_equal(arrays["face_load_factor"][:, 1:], loaded.face_load_factor[:, 1:])
    for body in (0, 1):
        for at in range(POSITIONS):
            np.testing.assert_array_equal(arrays["root_tension"][at, body], loaded.root_tension[body, at])
            np.testing.assert_array_equal(
                arrays["root_compression"][at, body], loaded.root_compression[body, at]
            )


def test_a_map_of_torques_has_its_least_error(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    """Progress is told after the torque itself and after each of the map."""
    loaded, written = loaded_with(), []

    class Writer:
        def write(self, at: int, arrays: Any) -> None:
            written.append(("samples", at, arrays))

        def put(self, row: int, values: Any) -> None:
            written.append((row, values["map_peak_to_peak"]))

        def finish(self, summary: Any) -> Path:
            return tmp_path

        def fail(self, failure: str, summary: Any) -> Path:
            written.append(failure)
            return tmp_path

    @contextmanager
    def writer(*rest: Any, **_: Any) -> Any:
        written.append(rest[3])
        yield Writer()

    errors = {100.0: [1.0, 4.0, 2.0], 200.0: [3.0, 2.5, 4.0], 300.0: [2.0, 4.0, 1.5]}
    monkeypatch.setattr(run, "target", lambda *_: tmp_path)
    monkeypatch.setattr(run, "prepare", lambda case: study_with(**vars(case)))
    monkeypatch.setattr(run, "roll", lambda *_: loaded)
    monkeypatch.setattr(run, "_numbers", lambda _: {})
    monkeypatch.setattr(run, "geometry_arrays", lambda _: {})
    monkeypatch.setattr(run, "writer", writer)
    monkeypatch.setattr(run, "record_arrays", lambda *_: {"a": 1})
    monkeypatch.setattr(run, "loaded_figures", lambda *_: {"own": 2.0})
    monkeypatch.setattr(run, "_contact", lambda _study, torque: (torque,))
    monkeypatch.setattr(run, "loaded_error", lambda torque: np.array(errors[torque]))
    told: list[float] = []
    case: Any = SimpleNamespace(gear_torque=TORQUE, gear_torques=(100.0, 200.0, 300.0), oiled=None)
    found = run.run(case, progress=told.append)
    assert found.summary["least_peak_to_peak"] == 1.5
    assert found.summary["least_peak_to_peak_torque"] == 200.0
    assert (found.summary["contact_ratio"], found.summary["own"]) == (1.6, 2.0)
    assert 0.0 <= found.summary["wall_time"] < 10.0
    np.testing.assert_allclose(told, [0.25, 0.5, 0.75, 1.0])
    assert written == [POSITIONS, ("samples", 0, {"a": 1}), (0, 3.0), (1, 1.5), (2, 2.5)]

    def failing(torque: float) -> Any:
        if torque == 200.0:
            raise SimulationError("nothing touches")
        return np.array(errors[torque])

    monkeypatch.setattr(run, "loaded_error", failing)
    failed = run.run(case)
    assert failed.message == "at operating.gear_torques.1 = 200 N*m: nothing touches"
    assert "least_peak_to_peak" not in failed.summary
    alone: Any = SimpleNamespace(gear_torque=TORQUE, gear_torques=(), oiled=None)
    assert "least_peak_to_peak" not in run.run(alone).summary


def test_film_of_every_slice(monkeypatch: pytest.MonkeyPatch):
    """At its own line load, with radius and speeds of its pair; the least of all is named."""
    loaded = loaded_with()
    seen: list[Any] = []

    def contact(
        _closure: Any, load: Any, radius: Any, first: Any, second: Any, length: Any, rate: Any
    ) -> Any:
        seen.append((first, second, length, rate))
        thick = 1e-6 * radius * (first + second) / load
        surface = SimpleNamespace(central_film_thickness=thick, closure_in_range=load < 2e5)
        return SimpleNamespace(surface=surface, contact=None)

    monkeypatch.setattr(film, "pair_geometry", geometry)
    monkeypatch.setattr(
        film, "closure_of", lambda _: SimpleNamespace(surfaces=SimpleNamespace(roughness=2e-7))
    )
    monkeypatch.setattr(film, "pitch_point", lambda _: SimpleNamespace(length=0.5, speed_per_radius=0.25))
    monkeypatch.setattr(film, "contact_friction", contact)
    monkeypatch.setattr(film, "range_shares", lambda *_: (None, None))
    monkeypatch.setattr(
        film, "exceeded_limits", lambda *_: {"closure_exceeded": "much", "friction_exceeded": "no"}
    )
    monkeypatch.setattr(film, "law_figures", lambda _: {"film_law": "own", "friction_law": "none"})
    oiled: Any = SimpleNamespace(operating=SimpleNamespace(pinion_speed=30.0))
    assembly: Any = SimpleNamespace(path=None)
    found = film.film_over_face(assembly, loaded, oiled)
    expected = np.full((POSITIONS, PAIRS, SLICES), np.nan)
    inside = expected.copy()
    for t, p, s in np.ndindex(expected.shape):
        if (load := loaded.line_load[t, p, s]) > 0.0:
            motion = motion_of(loaded.roll[t, p])
            speeds = 30.0 * (motion.pinion_speed + motion.gear_speed)
            expected[t, p, s] = 1e-6 / motion.relative_curvature * speeds / load
            inside[t, p, s] = load < 2e5
    np.testing.assert_allclose(found.arrays["central_film_thickness"], expected)
    np.testing.assert_array_equal(found.arrays["closure_in_range"], inside)
    least = np.unravel_index(np.nanargmin(expected), expected.shape)
    assert found.figures["film_min"] == pytest.approx(expected[least])
    assert found.figures["film_parameter_min"] == pytest.approx(expected[least] / 2e-7)
    assert found.figures["film_parameter_min_roll_angle"] == loaded.roll[least[0], least[1]]
    assert found.figures["closure_in_range_fraction"] == pytest.approx(np.nanmean(inside))
    assert found.figures["closure_exceeded"] == "much"
    assert found.figures["film_law"] == "own"
    assert not {"friction_exceeded", "friction_law"} & set(found.figures)
    assert seen[0][2:] == (0.5, 30.0 * 0.25)


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> list[Record]:
    folder = tmp_path_factory.mktemp("maps")
    return [
        open_record(synthetic_load_contact.write(folder / f"{tilt}.h5", tilt=tilt, slices=5))
        for tilt in (0.0, 0.5)
    ]


def test_heads_and_columns_of_maps(records: list[Record]):
    assert [maps._columns(count) for count in range(1, 8)] == [1, 2, 3, 2, 3, 3, 3]
    one, two = Figure(), Figure()
    maps._head(one, records[:1], maps.FILM)
    maps._head(two, records, maps.FILM)
    assert two.get_suptitle().startswith("Film of one pair from entry to exit.\nCross: minimum.")
    assert "18/36" in one.get_suptitle()
    assert [(q.factor, q.top) for q in (maps.LINE_LOAD, maps.PRESSURE, maps.FILM)] == [
        (1e-3, 100.0),
        (1e-9, 100.0),
        (1e6, 98.0),
    ]


def test_steps_over_the_face(records: list[Record]):
    axes = Figure().subplots()
    maps.draw_across_face(axes, records[1], maps.PRESSURE, "k")
    (steps,) = axes.patches
    values, edges, _ = steps.get_data()  # pyright: ignore[reportAttributeAccessIssue]
    np.testing.assert_allclose(values, 1e-9 * rolled.at_pitch_point(records[1], "hertz_pressure"))
    np.testing.assert_allclose(edges, 1e3 * rolled.face_edges(records[1]))


def test_a_pair_follows_its_roll_angle(records: list[Record]):
    """Put together here from the closed form of the record; one place more at both ends."""
    record = records[1]
    values = synthetic_load_contact.samples(24, 5, 0.5)
    roll, load = values["roll_angle"].ravel(), values["normal_load"].ravel()
    order = np.argsort(roll)
    found_roll, found_load = rolled.over_roll(record, record["normal_load"])
    np.testing.assert_allclose(found_roll, roll[order])
    np.testing.assert_allclose(found_load, load[order])
    carrying = np.flatnonzero(load[order] > 0.0)
    face = rolled.face_map(record, "line_load")
    first, last = max(carrying[0] - 1, 0), carrying[-1] + 1
    np.testing.assert_allclose(face.roll, roll[order][first : last + 1])
    line = values["line_load"].reshape(-1, 5)[order]
    np.testing.assert_allclose(face.values, line[first : last + 1])
    np.testing.assert_allclose(rolled.face_edges(record), WIDTH * (np.arange(6) / 5 - 0.5))
    near = np.argmin(np.abs(roll))
    np.testing.assert_allclose(
        rolled.at_pitch_point(record, "line_load"), values["line_load"].reshape(-1, 5)[near]
    )


def test_a_map_has_a_cross_where_it_varies_over_the_face(records: list[Record]):
    """Colours to the edges of the face, on one scale for both records; a cross at the maximum."""
    even, tilted = records
    tops = [np.max(one["line_load"]) for one in records]
    axes = Figure().subplots(1, 2)
    for one, record in zip(axes, records, strict=True):
        mesh = maps.draw_map(one, records, record, maps.LINE_LOAD)
        assert mesh.get_clim() == (0.0, pytest.approx(1e-3 * max(tops)))
        places = mesh.get_coordinates()
        face = rolled.face_map(record, "line_load")
        np.testing.assert_allclose(places[0, :, 0], np.degrees(face.roll))
        ends = 1e3 * WIDTH / 2.0
        np.testing.assert_allclose(places[:, 0, 1], [-ends, *(1e3 * face.face), ends])
        colours = np.asarray(mesh.get_array())
        np.testing.assert_allclose(colours[1:-1].T, 1e-3 * face.values)
        np.testing.assert_allclose(colours[[0, -1]].T, 1e-3 * face.values[:, [0, -1]])
    assert [len(one.lines) for one in axes] == [1, 3]
    face = rolled.face_map(tilted, "line_load")
    at = np.unravel_index(np.argmax(face.values), face.values.shape)
    for cross in axes[1].lines[:2]:
        assert cross.get_xdata()[0] == pytest.approx(math.degrees(face.roll[at[0]]))
        assert cross.get_ydata()[0] == pytest.approx(1e3 * face.face[at[1]])
    assert [axes[1].lines[2].get_xdata()[0], len(axes[0].figure.axes)] == [0.0, 2]
    alone = Figure().subplots()
    maps.draw_map(alone, [even], even, maps.LINE_LOAD)
    assert alone.figure.axes[1].get_ylabel() == "Line load (N/mm)"


def test_a_tooth_stands_ahead_of_all_others_in_an_assessment():
    drive = {"pinion": {"teeth": 4, "modification": {"tip_relief": "1 um"}}, "gear": {}}
    found = assess._with_deviating_tooth(drive, 3e-6)
    assert found["pinion"]["modification"] == {
        "tip_relief": "1 um",
        "pitch_errors": ["-3e-06 m", "0 m", "0 m", "0 m"],
    }
    assert "pitch_errors" not in drive["pinion"]["modification"]


@pytest.mark.parametrize(("share", "crosses"), [(3e-7, 0), (3e-6, 2)])
def test_only_what_varies_over_the_face_has_a_cross(
    monkeypatch: pytest.MonkeyPatch, share: float, crosses: int
):
    """From a millionth of the maximum on."""
    values = 200.0 * (
        1.0 + np.array([[0.0, -0.5], [0.0, -1.0], [-0.5, -0.5]]) * np.array([[0.5], [share], [0.5]])
    )
    face = SimpleNamespace(roll=np.array([-0.1, 0.0, 0.1]), face=np.array([-0.01, 0.01]), values=values)
    monkeypatch.setattr(maps, "face_map", lambda record, dataset: face)
    monkeypatch.setattr(maps, "face_edges", lambda record: np.array([-0.02, 0.0, 0.02]))
    record: Any = {"line_load": values}
    axes = Figure().subplots()
    maps.draw_map(axes, [record, record], record, maps.LINE_LOAD._replace(worst=lambda _: 2, factor=1.0))
    assert len(axes.lines) == crosses + 1


@pytest.mark.parametrize("count", [1, 2, 5])
def test_maps_stand_in_a_grid_with_labels_at_its_edges(monkeypatch: pytest.MonkeyPatch, count: int):
    """Face at the left, roll angle at the bottom of every column; one colour bar for several maps."""
    columns = {1: 1, 2: 2, 5: 3}[count]
    drawn: list[Any] = []

    def one(axes: Any, records: Any, record: Any, quantity: Any) -> Any:
        axes.set_xlabel("roll angle")
        axes.set_ylabel("face")
        drawn.append((axes, record))
        return ScalarMappable()

    monkeypatch.setattr(maps, "draw_map", one)
    monkeypatch.setattr(maps, "record_label", lambda record: record)
    names: Any = [f"record {number}" for number in range(count)]
    figure = Figure()
    maps._maps(figure, names, maps.FILM)
    assert [record for _, record in drawn] == names
    for number, (axes, _) in enumerate(drawn):
        place = axes.get_subplotspec()
        assert (place.rowspan.start, place.colspan.start) == divmod(number, columns)
        bottom = number + columns >= count
        assert bool(axes.get_ylabel()) == (number % columns == 0)
        assert bool(axes.get_xlabel()) == bottom
        assert axes.xaxis.get_tick_params()["labelbottom"] == bottom
        assert (axes.get_xlabel() == "roll angle") == (bottom and columns <= 2)
    bars = [axes for axes in figure.axes if axes not in [axes for axes, _ in drawn]]
    assert len(bars) == (1 if count > 1 else 0)
    assert all(bar.get_ylabel() == maps.FILM.label for bar in bars)


@pytest.mark.parametrize(("count", "rows"), [(1, 1), (2, 1), (5, 2)])
def test_figures_have_room_for_their_maps(monkeypatch: pytest.MonkeyPatch, count: int, rows: int):
    """The course over the face stands below them, from zero, a colour per record."""

    def steps(axes: Any, record: Any, quantity: Any, color: str) -> None:
        axes.plot([0, 1], [3.0, 9.0], color=color, label=record)

    names: Any = [f"record {number}" for number in range(count)]
    monkeypatch.setattr(maps, "_head", lambda *_: None)
    monkeypatch.setattr(maps, "_maps", lambda *_: None)
    monkeypatch.setattr(maps, "draw_across_face", steps)
    alone, below = maps.face_map_figure(names, maps.FILM), maps.line_load_figure(names)
    assert alone.get_figheight() == pytest.approx(rows * maps.PANEL_HEIGHT + 0.6)
    assert below.get_figheight() == pytest.approx((rows + 1) * maps.PANEL_HEIGHT + 0.4)
    (across,) = below.axes
    assert across.get_ylim()[0] == 0.0
    assert len({line.get_color() for line in across.lines}) == len(across.lines) == count
    assert (across.get_legend() is not None) == (count > 1)


def test_a_study_of_one_cycle_is_shown_twice_and_of_more_once():
    for cycles, copies in ((1, 2), (3, 1)):
        once = np.cos(np.arange(cycles * 6.0))
        record: Any = {"phase": np.arange(cycles * 6) / 6.0, "error": once}
        x, values = rolled.over_phase(record, "error")
        np.testing.assert_allclose(x, np.arange(copies * cycles * 6 + 1) / 6.0)
        np.testing.assert_array_equal(values, [*np.tile(once, copies), once[0]])
    rolled.require_positions(SimpleNamespace(samples=2))  # pyright: ignore[reportArgumentType]
    with pytest.raises(InputError, match="no samples"):
        rolled.require_positions(SimpleNamespace(samples=1, path="r.h5"))  # pyright: ignore[reportArgumentType]


@pytest.mark.parametrize(("cycles", "first"), [(2, False), (4, True)])
def test_of_several_cycles_the_first_pair_that_is_seen_whole(tmp_path: Path, cycles: int, first: bool):
    """It is pair 1 in cycle 0, pair 0 in cycle 1, pair −1 in cycle 2; of fewer cycles all pairs are alike."""
    with open_record(
        synthetic_load_contact.write(tmp_path / "several.h5", slices=2, cycles=cycles, positions=6)
    ) as record:
        values = np.arange(cycles * 6 * 3.0).reshape(cycles * 6, 3)
        roll, found = rolled.over_roll(record, values)
        rows = [(2 - slot if first else 0, slot) for slot in range(3)]
        expected = [
            (record["roll_angle"][6 * cycle + k, slot], values[6 * cycle + k, slot])
            for cycle, slot in rows
            for k in range(6)
        ]
        expected.sort(key=lambda one: one[0])
        np.testing.assert_allclose(roll, [one[0] for one in expected])
        np.testing.assert_array_equal(found, [one[1] for one in expected])
        x, pair = rolled.pair_over_phase(record, "normal_load", 0)
        load = record["normal_load"]
        for at, value in zip(x, pair, strict=True):
            if np.isfinite(at) and np.isfinite(value):
                k = round(float(at) * 6)
                # at the end of a cycle it is what is pair −1 then
                assert value in (load[k % len(load), 1], load[k % len(load), 0])
        assert np.sum(np.isnan(x)) == (2 if cycles == 1 else cycles)


@pytest.mark.parametrize(
    ("carrying", "first", "last"), [((3, 4, 5), 2, 6), ((0, 1), 0, 2), ((6, 7), 5, 7), ((), 0, 7)]
)
def test_a_map_has_one_place_more_than_carries(
    monkeypatch: pytest.MonkeyPatch, carrying: tuple[int, ...], first: int, last: int
):
    load = np.array([1.0 if number in carrying else 0.0 for number in range(8)])
    over = np.arange(8.0)
    monkeypatch.setattr(rolled, "over_roll", lambda record, values: (over, values))
    record: Any = {"normal_load": load, "slice": "face", "line_load": 10.0 * over}
    found = rolled.face_map(record, "line_load")
    np.testing.assert_array_equal(found.roll, over[first : last + 1])
    np.testing.assert_array_equal(found.values, 10.0 * over[first : last + 1])
    assert found.face == "face"
