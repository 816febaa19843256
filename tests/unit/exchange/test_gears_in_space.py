"""Gears, shafts and trains as triangles in space: closed, exact, in mesh, in their places; read back."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.path import Path as Outline

import tribodyn as td
from tests.support.binary_gltf import Node, read, volume_within
from tests.support.outlines import closed, distance, turned
from tests.support.verbs import complaint, invoke
from tribodyn.drawing.ears import triangles_of
from tribodyn.drawing.shapes import GearShape, PlacedPart, ShaftShape, parts_of_pair
from tribodyn.drawing.surface import surface_of
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.body import gear_polygon, section_area_and_inertia, tooth_outline
from tribodyn.geometry.drive import SIDES, BodyMass, body_of
from tribodyn.geometry.families import family
from tribodyn.studies.drive_file import load_drive
from tribodyn.studies.handed_over import placed_parts
from tribodyn.studies.protocol.load import load

TOLERANCE = 2e-6
PAIRS = ("liu-ni-crc-23-47", "helical-23-47", "ring-36-93", "cycloidal-ring-24-72")


def pair(name: str) -> Assembly:
    model = load_drive(name, {"drive.pinion.face_width": "8 mm"} if name == "helical-23-47" else None)
    return assemble(family(model.family), model.drive)


def parts_of(name: str) -> dict[str, PlacedPart]:
    return {part.name: part for part in placed_parts(load(name), TOLERANCE)}


@pytest.mark.parametrize("name", PAIRS)
def test_surfaces_are_closed_and_hold_area_times_width(name: str):
    """Whatever the helix is, by Cavalieri; chords leave so much of the surface's area at most."""
    assembly = pair(name)
    for side, part in zip(SIDES, parts_of_pair(assembly, TOLERANCE), strict=True):
        body, surface = body_of(assembly.drive, side), surface_of(part.shape)
        fine = tooth_outline(assembly.tooth(side), 1000, 1000)
        exact = float(section_area_and_inertia(fine, body.teeth, body.bore_radius)[0]) * body.face_width
        around = float(np.sum(np.hypot(*np.diff(part.shape.tooth, axis=0).T))) * part.shape.teeth
        around += 2 * np.pi * part.shape.radius
        found = volume_within(surface.point, surface.triangle)
        assert abs(found - exact) < TOLERANCE * around * body.face_width
        one, two, three = np.moveaxis(surface.point[surface.triangle], 1, 0)
        flat = np.cross(two - one, three - one)
        flat /= np.linalg.norm(flat, axis=1)[:, None]
        assert np.all(np.einsum("ni,ni->n", flat, surface.normal[surface.triangle[:, 1]]) > 0.99)


@pytest.mark.parametrize("name", PAIRS)
def test_triangles_lie_on_the_outline_at_their_height(name: str):
    """Corners on it, middles of triangles and edges within the tolerance, by a fine outline and circles."""
    assembly = pair(name)
    for side, part in zip(SIDES, parts_of_pair(assembly, TOLERANCE), strict=True):
        shape, surface = part.shape, surface_of(part.shape)
        assert isinstance(shape, GearShape)
        fine = turned(np.asarray(gear_polygon(assembly, side, 1500)), -part.angle)
        fine = fine[np.abs(np.arctan2(fine[:, 1], fine[:, 0])) < 2 * np.pi / shape.teeth]
        circles = np.abs([float(getattr(assembly.tooth(side), f"{end}_radius")) for end in ("root", "tip")])
        corners = surface.point[surface.triangle]
        swept = np.abs(surface.normal[surface.triangle[:, 0], 2]) < 0.9
        radius = np.hypot(*np.moveaxis(corners[..., :2], -1, 0))
        swept &= np.all(np.abs(radius - shape.radius) > 1e-9, axis=1) if shape.radius else True
        some = corners[swept][np.linspace(0, swept.sum() - 1, 150).astype(int)]
        for weights, allowed in (((1, 0, 0), 2e-8), ((1, 1, 1), TOLERANCE), ((1, 0, 1), TOLERANCE)):
            for point in np.einsum("tci,c->ti", some, np.array(weights) / sum(weights)):
                where = turned(point[None, :2], -shape.twist * point[2])
                about = 2 * np.pi / shape.teeth
                where = turned(where, -about * np.round(np.arctan2(where[0, 1], where[0, 0]) / about))
                off = np.append(np.abs(np.hypot(*where[0]) - circles), distance(where[0], fine))
                assert off.min() < allowed


def test_a_right_hand_helix_turns_as_a_screw_and_a_left_hand_one_mirrored():
    right = parts_of_pair(pair("helical-23-47"), TOLERANCE)[0].shape
    assert isinstance(right, GearShape)
    beta = load_drive("helical-23-47").drive.helix_angle
    assert beta > 0  # right-hand
    assert right.twist == pytest.approx(np.tan(beta) / (23 * load_drive("helical-23-47").drive.module / 2))
    left = surface_of(right._replace(twist=-right.twist))
    mirrored = surface_of(right).point * [1.0, 1.0, -1.0]
    assert np.allclose(np.sort(mirrored @ [1, 7, 49]), np.sort(left.point @ [1, 7, 49]), atol=1e-12)


def section(part: PlacedPart, z: float) -> np.ndarray:
    """Closed outline of a gear where it stands, at a height."""
    shape = part.shape
    assert isinstance(shape, GearShape)
    angles = (
        part.angle + shape.twist * (z - part.centre[2]) + 2 * np.pi / shape.teeth * np.arange(shape.teeth)
    )
    return closed(np.concatenate([turned(shape.tooth[:-1], angle) for angle in angles])) + part.centre[:2]


def depth(points: np.ndarray, outline: np.ndarray, internal: bool) -> float:
    """How deep any of the points lies in a gear's material; negative: how far off the nearest is."""
    within = Outline(outline).contains_points(points) != internal
    near = points[within] if within.any() else points
    off = [distance(point, outline) for point in near[:: 1 if within.any() else 3]]
    return max(off) if within.any() else -min(off)


@pytest.mark.parametrize(
    ("name", "pairs"),
    [
        ("crc-23-47", [("pinion", "gear")]),
        ("efficiency-helical-24-95", [("pinion", "gear")]),
        ("planetary-24-84", [("sun", "planet-2"), ("planet-3", "ring")]),
        (
            "ravigneaux",
            [("small", "short-1"), ("short-1", "long-1"), ("long-2", "large"), ("long-3", "ring")],
        ),
        ("industrial-reducer", [("pinion-1", "wheel-1"), ("pinion-2", "wheel-2")]),
    ],
)
def test_teeth_of_a_train_touch_and_do_not_overlap(name: str, pairs: list[tuple[str, str]]):
    """By what the chords leave: at the middle and near both ends of the face."""
    parts = parts_of(name)
    for one, two in ((parts[a], parts[b]) for a, b in pairs):
        assert isinstance(one.shape, GearShape)
        assert isinstance(two.shape, GearShape)
        low, high = (
            way
            * min(
                way * (part.centre[2] + way * part.shape.width / 2)
                for part in (one, two)
                if isinstance(part.shape, GearShape)
            )
            for way in (-1, 1)
        )
        assert high > low
        found = []
        for z in (low + 0.02 * (high - low), 0.5 * (low + high)):
            outlines = section(one, z), section(two, z)
            apart = np.array(two.centre[:2]) - one.centre[:2]
            pitch_point = np.array(one.centre[:2]) + apart * one.shape.teeth / (
                one.shape.teeth + (-1) ** two.shape.internal * two.shape.teeth
            )
            reach = 4 * np.pi * np.hypot(*(pitch_point - one.centre[:2])) / one.shape.teeth
            of_one, of_two = (line[np.hypot(*(line - pitch_point).T) < reach] for line in outlines)
            found.append(depth(of_one, outlines[1], two.shape.internal))
            found.append(depth(of_two, outlines[0], False))
        assert -2 * TOLERANCE < max(found) < TOLERANCE


def test_a_train_is_read_back_in_its_places(tmp_path: Path):
    file = tmp_path / "reducer.glb"
    printed = invoke("export", "industrial-reducer", "--to", "gltf", "-o", file, "--set", "tolerance=50 um")
    assert "13 parts: pinion-1, wheel-1" in printed
    nodes, parts = read(file), parts_of("industrial-reducer")
    assert list(nodes) == list(parts)
    for name, node in nodes.items():
        volume_within(node.points, node.triangles)
        assert np.allclose(node.centre, parts[name].centre, atol=1e-12)
    apart = np.hypot(*(nodes["wheel-1"].centre - nodes["pinion-1"].centre)[:2])
    sheet = td.drive("industrial-reducer", mesh="first").sheet
    assert apart == pytest.approx(sheet["centre distance"][0], rel=1e-9)
    # the drawing: 180 mm and 100 mm along the middle shaft
    assert nodes["wheel-1"].centre[2] - nodes["pinion-2"].centre[2] == pytest.approx(0.08)
    assert nodes["wheel-1"].centre[2] == pytest.approx(nodes["pinion-1"].centre[2])
    invoke("export", "industrial-reducer", "--to", "gltf", "-o", file, "--set", "part=middle")  # its own file


def test_a_gear_without_a_bore_and_one_that_is_undercut_are_closed():
    model = load_drive(
        "liu-ni-involute-23-47", {"drive.pinion.teeth": "9", "drive.pinion.bore_radius": "0 mm"}
    )
    pinion, gear = parts_of_pair(assemble(family(model.family), model.drive), TOLERANCE)
    assert isinstance(pinion.shape, GearShape)
    assert isinstance(gear.shape, GearShape)
    assert (len(pinion.shape.corners), len(gear.shape.corners)) == (4, 2)  # tips; and where undercut ends
    surface = surface_of(pinion.shape)
    assert np.any(np.all(surface.point[:, :2] == 0.0, axis=1))
    volume_within(surface.point, surface.triangle)


@pytest.mark.parametrize(("name", "bore"), [("liu-ni-crc-23-47", "25 mm"), ("helical-23-47", "0 mm")])
def test_between_rim_and_bore_there_is_a_web(name: str, bore: str):
    """What a disc has more is a ring on either side; normals are those of the triangles."""
    model = load_drive(name, {"drive.gear.bore_radius": bore, "drive.pinion.face_width": "8 mm"})
    assembly = assemble(family(model.family), model.drive)
    made = BodyMass(rim=12e-3, web=6e-3)
    disc, rim = (
        parts_of_pair(assembly, 4e-6, stated=(BodyMass(), each))[1].shape for each in (BodyMass(), made)
    )
    assert isinstance(rim, GearShape)
    surfaces = surface_of(disc), surface_of(rim)
    volumes = [volume_within(surface.point, surface.triangle) for surface in surfaces]
    inside = float(assembly.tooth("gear").root_radius) - 12e-3
    rings = np.pi * (inside**2 - rim.radius**2) * (rim.width - 6e-3)
    assert volumes[0] - volumes[1] == pytest.approx(rings, rel=1e-4)
    one, two, three = np.moveaxis(surfaces[1].point[surfaces[1].triangle], 1, 0)
    flat = np.cross(two - one, three - one)
    flat /= np.linalg.norm(flat, axis=1)[:, None]
    assert np.all(np.einsum("ni,ni->n", flat, surfaces[1].normal[surfaces[1].triangle[:, 1]]) > 0.99)


def test_a_shaft_is_its_cylinders(tmp_path: Path):
    shape = ShaftShape((0.05, 0.1, 0.03), (0.03, 0.045, 0.03), (0.0, 0.02, 0.02), 1e-6)
    surface = surface_of(shape)
    sections = zip(shape.length, shape.radius, shape.bore, strict=True)
    exact = np.pi * sum(length * (r**2 - b**2) for length, r, b in sections)
    assert volume_within(surface.point, surface.triangle) == pytest.approx(exact, rel=1e-4)


def test_bearings_are_rings_on_their_shafts():
    """As wide as their rollers, from the shaft to beyond the circle through their middles."""
    parts, shafts = parts_of("industrial-reducer"), load("industrial-reducer").case.system.shafts
    for shaft in shafts:
        drawn = parts[shaft.name]
        assert isinstance(drawn.shape, ShaftShape)
        for number, bearing in enumerate(shaft.drawing.bearing, 1):
            part = parts[f"bearing {shaft.name}-{number}"]
            ring = part.shape
            assert isinstance(ring, ShaftShape)
            assert part.turns == 0.0
            assert ring.length == (bearing.roller_length,)
            assert part.centre[:2] == drawn.centre[:2]
            assert part.centre[2] + ring.length[0] / 2 == pytest.approx(shaft.start + bearing.position)
            assert ring.bore[0] in drawn.shape.radius
            assert ring.bore[0] < bearing.pitch_diameter / 2 < ring.radius[0]
            surface = surface_of(ring)
            exact = np.pi * (ring.radius[0] ** 2 - ring.bore[0] ** 2) * bearing.roller_length
            assert volume_within(surface.point, surface.triangle) == pytest.approx(exact, rel=1e-3)


def test_equal_parts_share_a_mesh_and_records_are_taken_too(tmp_path: Path):
    run = td.run("crc-23-47", output=tmp_path / "run.h5")
    td.export(run, "gltf", tmp_path / "pair.glb")
    whole = read(tmp_path / "pair.glb")
    assert list(whole) == ["pinion", "gear"]
    td.export("planetary-24-84", "gltf", tmp_path / "set.glb", {"tolerance": "20 um"})
    nodes = read(tmp_path / "set.glb")
    assert len({node.mesh for name, node in nodes.items() if name.startswith("planet")}) == 1
    about = [np.hypot(*node.centre[:2]) for name, node in nodes.items() if name.startswith("planet")]
    assert about == pytest.approx([about[0]] * 3)
    td.export("planetary-24-84", "gltf", tmp_path / "planet.glb", {"part": "planet-2"})
    ((name, one),) = read(tmp_path / "planet.glb").items()
    assert name == "planet-2"
    assert isinstance(one, Node)
    assert np.allclose(one.centre, 0.0)
    assert one.placed[:, 2].min() == pytest.approx(-one.placed[:, 2].max())


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("crc-23-47", "part=sun"), "no such gear or shaft; there is: pinion, gear"),
        (("crc-23-47", "tolerance=2 mm"), "must be from 0.1 um to 1 mm"),
        (("crc-23-47", "tolerance=2"), "tolerance"),
        (("irefc", "part=gear"), "describes no gears"),
        (("crc-23-47", "drive.pinion.bore_radius=35 mm"), "the bore reaches the root circle"),
        (("efficiency-crc-23-47", "drive.pinion.bore_radius=35 mm"), "the bore reaches the root circle"),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_one_line(words: tuple[str, str], said: str, tmp_path: Path):
    name, setting = words
    assert said in complaint("export", name, "--to", "gltf", "--set", setting, folder=tmp_path)
    assert not list(tmp_path.iterdir())


def test_ears_of_a_polygon():
    random = np.random.default_rng(3)
    for _ in range(5):
        angle, radius = np.sort(random.uniform(0, 2 * np.pi, 60)), random.uniform(0.2, 1.0, 60)
        points = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        one, two, three = np.moveaxis(points[triangles_of(points)], 1, 0)
        (ax, ay), (bx, by) = (two - one).T, (three - one).T
        areas = (ax * by - ay * bx) / 2
        x, y = points.T
        assert np.all(areas > 0)
        assert areas.sum() == pytest.approx(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2)
    with pytest.raises(ValueError, match="crosses itself"):
        triangles_of(np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0], [-2.0, 0.5]]))
