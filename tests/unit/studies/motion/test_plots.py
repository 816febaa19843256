"""Figures: what is drawn, in which units, with which marks; no picture is compared."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from tests.support import record_samples
from tests.support.involute_run import (
    PITCH_ANGLE,
    PITCH_RADII,
    PRESSURE_ANGLE,
    approach_and_recess,
    involute_run,
)
from tribodyn.errors import InputError
from tribodyn.gears.motion.recorded import SAMPLES
from tribodyn.mesh.record_arrays import as_arrays
from tribodyn.post.cycles import key_points, last_cycles, pair_curve
from tribodyn.post.figures import sensor_averages
from tribodyn.post.figures.path_of_contact import gears_in_mesh, key_positions
from tribodyn.record.reader import Record
from tribodyn.studies import STUDIES
from tribodyn.studies.pages import figure, overview


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Record:
    return Record(involute_run(tmp_path_factory.mktemp("record") / "run.h5"))


def curve(drawn: Figure, label: str, axes: int = 0) -> tuple[np.ndarray, np.ndarray]:
    line = next(line for line in drawn.axes[axes].lines if line.get_label() == label)
    return np.asarray(line.get_xdata()), np.asarray(line.get_ydata())


def test_units_are_converted(record: Record):
    _, error = curve(figure("transmission-error", [record]), "pair 1", axes=1)
    _, stiffness = curve(figure("mesh-stiffness", [record]), "pair 1")
    window = last_cycles(record)
    assert np.nanmax(error) == pytest.approx(
        1e6 * np.nanmax(record["transmission_error_normal"][window.part])
    )
    assert np.nanmax(stiffness) == pytest.approx(320, rel=1e-3)  # 3.2e8 N/m in N/µm


def test_key_points_stand_at_their_phases(record: Record):
    start, end = approach_and_recess()
    found = {point.names[1]: point.phase for point in key_points(record) if 1 in point.names}
    assert found["B_g"] == 0.0
    assert found["C_p"] == pytest.approx((end - start) / PITCH_ANGLE - 1)
    assert found["P"] == pytest.approx(-start / PITCH_ANGLE)
    drawn = figure("normal-load", [record], cycles=1)
    (marks,) = [line for line in drawn.axes[0].lines if line.get_linestyle() == ":"]
    assert np.asarray(marks.get_xdata())[::3] == pytest.approx([0.0, found["C_p"], found["P"], 1.0])


@pytest.mark.parametrize("scenario", ["high-contact-ratio", "parabolic-23-47", "crc-23-47"])
def test_key_points_name_the_pairs_that_the_table_shows_there(prepared, scenario: str):
    """A pair begins or ends contact, or passes the pitch point, in the slot that its number belongs to."""
    cycle = prepared(scenario).cycle
    table = as_arrays(cycle)
    fronts = int(np.sum(table["side"] > 0))
    teeth = round(2.0 * np.pi / float(cycle.pitch_angle))
    points = key_points(cast(Any, SimpleNamespace(mesh_cycle=table | {"pinion_teeth": teeth})))
    names = [name for point in points for name in point.names.values()]
    expected = {"B_g", "P", "B_p"} | ({"C_g", "C_p"} if cycle.contact_ratio <= 2.0 else set())
    assert sorted(names) == sorted(expected)
    phase, touching, distance = (table[name] for name in ("phase", "in_contact", "signed_distance"))
    for point in points:
        for pair, name in point.names.items():
            slot = pair + fronts - 2
            # a hair beside the point: a pair that is newest in one cycle goes on as the one before it
            before = (point.phase - 1e-6) % 1.0
            slot_before = slot + 1 if point.phase < 1e-6 else slot
            after = at_phase(phase, touching[:, slot], point.phase + 1e-6)
            was = at_phase(phase, touching[:, slot_before], before) if slot_before < fronts else 0.0
            if name in ("B_g", "B_p"):
                assert (was > 0.5, after > 0.5) == ((False, True) if name == "B_g" else (True, False))
            if name == "P":
                assert at_phase(phase, distance[:, slot], point.phase) == pytest.approx(0.0, abs=1e-6)


def at_phase(phase: np.ndarray, values: np.ndarray, where: float) -> float:
    """Value in the segment that holds a phase; nodes where segments meet stand twice."""
    left = int(np.searchsorted(phase, where, side="right")) - 1
    left = min(max(left, 0), len(phase) - 2)
    return float(np.interp(where, phase[left : left + 2], values[left : left + 2]))


def test_the_total_stiffness_is_told_from_that_of_pairs(record: Record):
    drawn = figure("mesh-stiffness", [record])
    _, total = curve(drawn, r"all pairs, $\Sigma\, k_i \cos^2 α_i$")
    part = last_cycles(record).part
    angle = np.nan_to_num(record["pressure_angle"][part])
    expected = np.sum(record["mesh_stiffness"][part] * np.cos(angle) ** 2, axis=1) * 1e-6
    np.testing.assert_allclose(total, expected, rtol=1e-12)


def test_each_pair_is_followed_to_the_end_of_its_cycle(record: Record):
    """The teeth that reach C_g as pair 1 go on as pair 0 from the very same value."""
    window = last_cycles(record)
    values = record["sliding_speed"]
    newest = pair_curve(record, values, 1, window, window.phase)
    before = pair_curve(record, values, 0, window, window.phase)
    at = np.flatnonzero(newest[0] == 1.0)[0]
    assert newest[1][at] == before[1][before[0] == 1.0][-1]
    assert np.isnan(newest[1][at + 1])
    # sliding grows with constant slope along an involute's path: no step inside a piece
    slope = np.diff(newest[1][: at + 1])
    np.testing.assert_allclose(slope, slope[0], rtol=1e-9)


def test_key_points_lie_on_the_path(record: Record):
    """Distances along the involute's straight path: whole pitches and the approach from the tip circles."""
    start, end = approach_and_recess()
    base = PITCH_RADII[0] * np.cos(PRESSURE_ANGLE)
    expected = {"B_g": start, "C_p": end - PITCH_ANGLE, "P": 0.0, "C_g": start + PITCH_ANGLE, "B_p": end}
    found = key_positions(record)
    assert list(found) == ["B_g", "C_p", "P", "C_g", "B_p"]
    for name, (x, y) in found.items():
        assert np.hypot(x, y) * np.sign(x) == pytest.approx(base * expected[name], abs=1e-9)
        assert y == pytest.approx(x * np.tan(PRESSURE_ANGLE), abs=1e-12)


@pytest.mark.parametrize("phase", [0.0, 0.3, 0.8])
def test_flanks_touch_where_the_contact_is(record: Record, phase: float):
    start, _ = approach_and_recess()
    base = PITCH_RADII[0] * np.cos(PRESSURE_ANGLE)
    distance = base * (start + phase * PITCH_ANGLE)
    angle = PRESSURE_ANGLE
    contact = distance * np.array([np.cos(angle), np.sin(angle)])
    for outline in gears_in_mesh(record, phase):
        outline = outline[np.any(np.diff(outline, axis=0, append=outline[:1]) != 0, axis=1)]
        along = np.roll(outline, -1, axis=0) - outline
        share = np.clip(np.sum((contact - outline) * along, axis=1) / np.sum(along**2, axis=1), 0, 1)
        gap = np.linalg.norm(outline + share[:, None] * along - contact, axis=1).min()
        assert gap < 15e-6  # chords of the outline, 12 points per flank


def test_the_overview_keeps_its_labels_in_the_figure_and_apart(record: Record):
    """Its margins are of fixed size."""
    drawn = overview(record)
    canvas = FigureCanvasAgg(drawn)
    canvas.draw()
    whole = drawn.bbox
    boxes = [axes.get_tightbbox(canvas.get_renderer()) for axes in drawn.axes]
    for box in [*boxes, *(legend.get_window_extent() for legend in drawn.legends)]:
        assert whole.x0 <= box.x0 < box.x1 <= whole.x1
        assert whole.y0 <= box.y0 < box.y1 <= whole.y1
    for upper, lower in zip(boxes[:3], boxes[3:], strict=True):
        assert upper.y0 >= lower.y1
    assert min(box.y0 for box in boxes) >= max(legend.get_window_extent().y1 for legend in drawn.legends)


def test_pyplot_is_never_imported(record: Record, tmp_path: Path):
    """It takes long to import and keeps figures alive in a global list."""
    drawing = (
        "import sys\n"
        "from tribodyn.studies.pages import figure, names\n"
        "from tribodyn.post.style import save\n"
        "from tribodyn.record.reader import Record\n"
        "with Record(sys.argv[1]) as record:\n"
        "    for name in names([record]):\n"
        "        drawn = figure(name, [record])\n"
        "    save(drawn, sys.argv[2])\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    picture = str(tmp_path / "picture.png")
    subprocess.run([sys.executable, "-c", drawing, str(record.path), picture], check=True, timeout=300)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"name": "normal-laod"}, "did you mean normal-load"),
        ({"name": "film", "against": "angle"}, "phase or time"),
        ({"name": "film", "cycles": 0}, "at least one"),
        ({"name": "film", "records": []}, "at least one record"),
    ],
)
def test_bad_wishes_are_refused(record: Record, arguments: dict, message: str):
    with pytest.raises(InputError, match=message):
        figure(**cast(Any, {"records": [record]} | arguments))


def failed_record(path: Path, samples: int, of: Record) -> Path:
    """The first samples of a record, whose run gave up; where the gears stand it does not say."""
    outlines = {name: value for name, value in of.geometry.items() if name != "centre"}
    with record_samples.gear_pair_writer(path, 201, table=of.mesh_cycle, outlines=outlines) as writer:
        if samples:
            writer.write(0, {name: of[name][:samples] for name in SAMPLES} | {"time": of["time"][:samples]})
        return writer.fail("gave up")


HELICAL = {"line-load", "in-space"}
#: Figures of what a run has where its scenario asks for it.
ASKED = {"revolutions", *sensor_averages.DRAWINGS}


@pytest.mark.parametrize(
    "name", sorted({*STUDIES["gear-pair"].drawings()} - {"spectrum", "orders"} - HELICAL - ASKED)
)
def test_a_run_that_failed_early_is_drawn(record: Record, tmp_path: Path, name: str):
    """In all figures of a pair; what it does not have is said."""
    with Record(failed_record(tmp_path / "run.h5", 60, record)) as failed:
        if STUDIES["gear-pair"].drawings()[name].fits(failed):
            figure(name, [failed]).draw_without_rendering()
        else:
            with pytest.raises(InputError, match=r"run\.partial\.h5"):
                figure(name, [failed])


@pytest.mark.parametrize(
    ("samples", "name", "message"), [(60, "spectrum", "no whole mesh cycle"), (0, "film", "no samples")]
)
def test_a_record_with_too_few_samples_is_refused(record, tmp_path: Path, samples, name, message):
    path = failed_record(tmp_path / "run.h5", samples, record)
    with Record(path) as failed, pytest.raises(InputError, match=message):
        figure(name, [failed])


def test_a_record_without_outlines_has_no_path_figure(tmp_path: Path):
    with record_samples.gear_pair_writer(tmp_path / "run.h5", 2) as writer:
        writer.write(0, record_samples.block(0, 2))
        path = writer.finish({})
    with Record(path) as record, pytest.raises(InputError, match="no tooth outlines"):
        figure("path-of-contact", [record])
