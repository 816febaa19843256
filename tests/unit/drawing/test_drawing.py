"""Drawings of gears: DXF read back by ezdxf, profile points as CSV, the picture of the pair."""

import csv
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
from ezdxf import units

from tests.support.sample_drives import LIU_NI, SHIFTED, SOUND, STANDARD, bodies, root_radius
from tribodyn.drawing.cad import RACK_TEETH, tooth_profile, write_gear, write_pair, write_profile, write_rack
from tribodyn.drawing.picture import gears_in_mesh, pair_figure
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.body import section_area_and_inertia, tooth_outline
from tribodyn.geometry.drive import body_of, tip_radius
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.tooth import cut_tooth
from tribodyn.post.style import save

SHARP = STANDARD._replace(pinion=STANDARD.pinion._replace(fillet_radius=0.0, bore_radius=0.0))


def opened(path: Path) -> Any:
    drawing = ezdxf.readfile(path)
    assert not drawing.audit().errors
    assert drawing.header["$INSUNITS"] == units.MM == 4
    return drawing.modelspace()


def outlines(space: Any) -> list[np.ndarray]:
    """Points of the closed outlines, mm."""
    found = space.query('LWPOLYLINE[layer=="OUTLINE"]')
    assert all(line.closed for line in found)
    return [np.array(line.get_points("xy")) for line in found]


def area(points: np.ndarray) -> float:
    x, y = points.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def crossings(values: np.ndarray) -> int:
    """How often a closed sequence changes its sign."""
    return int(np.sum(np.sign(values) != np.sign(np.roll(values, 1))))


@bodies([*SOUND, (involute.FAMILY, SHARP)])
def test_gear_in_dxf(family, drive, side, tmp_path: Path):
    space = opened(write_gear(tmp_path / "gear.dxf", assemble(family, drive), side, flank_points=150))
    (points,) = outlines(space)
    body = body_of(drive, side)
    section, _ = section_area_and_inertia(
        tooth_outline(cut_tooth(family, drive, side), 400, 400), body.teeth, body.bore_radius
    )
    assert area(points) - 1e6 * np.pi * body.bore_radius**2 == pytest.approx(1e6 * section, rel=2e-5)
    distance = np.hypot(*points.T)
    assert distance.max() == pytest.approx(1e3 * tip_radius(drive, side), rel=1e-12)
    assert distance.min() == pytest.approx(1e3 * root_radius(drive, side), rel=1e-12)
    middle = (distance.max() + distance.min()) / 2
    assert crossings(distance - middle) == 2 * body.teeth
    steps = np.hypot(*(points - np.roll(points, 1, axis=0)).T)
    assert steps.min() > 0
    circles = {circle.dxf.layer: circle.dxf.radius for circle in space.query("CIRCLE")}
    assert circles.get("BORE", 0.0) == pytest.approx(1e3 * body.bore_radius)
    assert circles["TIP_CIRCLE"] == pytest.approx(distance.max())


@bodies(SOUND)
def test_rack_in_dxf(family, drive, side, tmp_path: Path):
    space = opened(write_rack(tmp_path / "rack.dxf", assemble(family, drive), side))
    (points,) = outlines(space)
    assert np.ptp(points[:, 0]) == pytest.approx(1e3 * RACK_TEETH * np.pi * drive.module, rel=1e-12)
    shift = body_of(drive, side).profile_shift
    assert points[:, 1].min() == pytest.approx(1e3 * drive.module * (shift - 1.25))
    assert crossings(points[:, 1]) == 2 * RACK_TEETH
    # as much tooth as gap at the reference line, which only the shift moves off the rolling line
    x, y = points[:, 0], points[:, 1] - 1e3 * drive.module * shift
    left = np.flatnonzero((y[:-1] > 0) & (y[1:] <= 0))
    right = np.flatnonzero((y[:-1] <= 0) & (y[1:] > 0))
    cuts = [x[i] - y[i] * (x[i + 1] - x[i]) / (y[i + 1] - y[i]) for i in (*left, *right)]
    np.testing.assert_allclose(np.diff(np.sort(cuts)), 1e3 * np.pi * drive.module / 2, rtol=1e-4)


def test_pair_in_dxf_has_both_gears_at_the_working_centre_distance(tmp_path: Path):
    space = opened(write_pair(tmp_path / "pair.dxf", assemble(involute.FAMILY, SHIFTED)))
    assert len(outlines(space)) == 2
    bores = [np.array(bore.dxf.center)[:2] for bore in space.query('CIRCLE[layer=="BORE"]')]
    # a_w = a cos α/cos α_w (ISO 21771)
    working = involute.working_pressure_angle(SHIFTED)
    distance = 0.004 * (17 + 41) / 2 * np.cos(SHIFTED.pressure_angle) / np.cos(working)
    assert np.hypot(*(bores[1] - bores[0])) == pytest.approx(1e3 * distance)
    (path,) = space.query('LWPOLYLINE[layer=="PATH_OF_CONTACT"]')
    slope = np.diff(np.array(path.get_points("xy")), axis=0)
    np.testing.assert_allclose(slope[:, 1] / slope[:, 0], np.tan(working), rtol=1e-6)


@pytest.mark.parametrize(("family", "drive"), [(crc.FAMILY, LIU_NI), (involute.FAMILY, STANDARD)])
def test_gears_in_mesh_touch_where_the_path_begins(family, drive):
    mesh = gears_in_mesh(assemble(family, drive))
    assert list(mesh.key_points) == ["B_g", "C_p", "P", "C_g", "B_p"]
    assert mesh.key_points["P"] == (0.0, 0.0)
    np.testing.assert_allclose(mesh.key_points["B_g"], mesh.path[0], atol=1e-12)
    # the older pair is a pitch ahead
    for gear in (mesh.pinion, mesh.gear):
        for name in ("B_g", "C_g"):
            nearest = np.hypot(*(gear - mesh.key_points[name]).T).min()
            assert nearest < 0.02 * drive.module


@bodies(SOUND)
def test_profile_as_csv(family, drive, side, tmp_path: Path):
    profile = tooth_profile(assemble(family, drive), side, flank_points=40)
    path = write_profile(tmp_path / "profile.csv", profile)
    with path.open(newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    assert header[0] == "part"
    assert len(header) == 5
    parts = [row[0] for row in rows]
    x, y, radius, angle = np.array([row[1:] for row in rows], dtype=float).T
    np.testing.assert_allclose(np.hypot(x, y), radius, rtol=1e-8)
    np.testing.assert_allclose(np.degrees(np.arctan2(y, x)), angle, atol=1e-6)
    # a whole pitch, symmetric, in order
    assert angle[0] == pytest.approx(-180 / body_of(drive, side).teeth)
    np.testing.assert_allclose(angle, -angle[::-1], atol=1e-7)
    assert list(dict.fromkeys(parts)) == ["root", "fillet", "flank", "tip"]
    for part, circle in (("root", root_radius(drive, side)), ("tip", tip_radius(drive, side))):
        np.testing.assert_allclose(radius[np.array(parts) == part], 1e3 * circle, rtol=1e-8)


@pytest.mark.parametrize("ending", ["png", "svg"])
def test_picture_of_the_pair(tmp_path: Path, ending: str):
    figure = pair_figure(assemble(crc.FAMILY, LIU_NI), "CRC drive", flank_points=20)
    whole, close = figure.axes
    assert whole.get_ylabel() == close.get_ylabel() == "Along the line of centres (mm)"
    names = [text.get_text() for text in close.texts]
    assert {"$B_g$", "$C_p$", "$P$", "$C_g$", "$B_p$", "gear", "pinion"} <= set(names)
    low, high = whole.get_ylim()
    assert low < -2 * 34.5 - 3
    assert high > 2 * 70.5 + 3
    assert save(figure, tmp_path / f"pair.{ending}").stat().st_size > 10_000


@bodies(SOUND)
def test_chords_stay_on_the_curve_as_the_page_promises(family, drive, side):
    """At the command's 100 points to a flank: 0.3 µm on the flank, 2 µm on the fillet, for 3 mm."""
    coarse, fine = (
        tooth_outline(cut_tooth(family, drive, side), 100, 50),
        tooth_outline(cut_tooth(family, drive, side), 199, 99),
    )
    for curve, most in (("flank", 0.3e-6), ("fillet", 2.0e-6)):
        x, y = getattr(coarse, f"{curve}_x"), getattr(coarse, f"{curve}_y")
        between_x, between_y = getattr(fine, f"{curve}_x")[1::2], getattr(fine, f"{curve}_y")[1::2]
        dx, dy = np.diff(x), np.diff(y)
        away = np.abs((between_x - x[:-1]) * dy - (between_y - y[:-1]) * dx) / np.hypot(dx, dy)
        assert away.max() < most * drive.module / 0.003
