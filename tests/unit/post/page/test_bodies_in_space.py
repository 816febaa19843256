"""Gears and shafts in space on a page: the same bodies as exported ones, small, turned as teeth demand."""

import base64
import gzip
import io
import json
from collections.abc import Iterator
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from tests.support.binary_gltf import volume_within
from tests.support.pages import data_of, needs_browser
from tribodyn.drawing.shapes import GearShape, PlacedPart
from tribodyn.drawing.surface import surface_of, volume
from tribodyn.exchange.cad.gltf import binary
from tribodyn.interface.run import open_run
from tribodyn.post.page import document
from tribodyn.record.sweep_reader import open_any
from tribodyn.studies.handed_over import placed_parts
from tribodyn.studies.pages import write_report
from tribodyn.studies.protocol.load import load

TOLERANCE = 2e-5


def parts_of(name: str) -> dict[str, PlacedPart]:
    return {part.name: part for part in placed_parts(load(name), TOLERANCE)}


@pytest.mark.parametrize("name", ["helical-23-47", "planetary-24-84", "industrial-reducer"])
def test_teeth_about_an_axis_are_the_whole_gear(name: str):
    """As trimesh reads them; neighbours meet within single precision, and close the surface."""
    parts = parts_of(name)
    content = binary(list(parts.values()), name, by_tooth=True)[0]
    scene = trimesh.load_scene(io.BytesIO(content), file_type="glb")
    assert len(base64.b64encode(gzip.compress(content))) < 2.5e5
    below = scene.graph.transforms.children
    for part_name, part in parts.items():
        nodes = below.get(part_name, [part_name])
        assert len(nodes) == (part.shape.teeth if isinstance(part.shape, GearShape) else 1)
        to_own = np.linalg.inv(scene.graph[part_name][0])
        pieces = [
            scene.geometry[mesh].copy().apply_transform(to_own @ place)
            for place, mesh in map(scene.graph.get, nodes)
        ]
        points = np.concatenate([piece.vertices for piece in pieces])
        starts = np.append(0, np.cumsum([len(piece.vertices) for piece in pieces])[:-1])
        triangles = np.concatenate([s + piece.faces for s, piece in zip(starts, pieces, strict=True)])
        first = np.array([min(near) for near in cKDTree(points).query_ball_point(points, 1e-7)])
        whole = trimesh.Trimesh(points, first[triangles], process=False)
        assert whole.is_watertight
        assert whole.is_winding_consistent
        exact = surface_of(part.shape)
        assert whole.volume == pytest.approx(volume(exact), rel=1e-6)
        assert volume_within(exact.point, exact.triangle) == pytest.approx(volume(exact), rel=1e-12)


@pytest.mark.parametrize(
    "name", ["crc-23-47", "ring-36-93", "planetary-24-84", "ravigneaux", "two-stage-reducer"]
)
def test_pitch_circles_roll_on_each_other(name: str):
    """Where pitch circles of two gears in mesh touch both move alike, whatever carries them."""
    gears = [part for part in parts_of(name).values() if isinstance(part.shape, GearShape)]
    found = 0
    for one in gears:
        for two in gears:
            if one is two or one.shape.internal:
                continue
            z1, z2 = one.shape.teeth, two.shape.teeth * (-1 if two.shape.internal else 1)
            apart = np.array(two.centre[:2]) - one.centre[:2]
            if not touch(one, two):
                continue
            found += 1
            point = np.array(one.centre[:2]) + apart * z1 / (z1 + z2)
            velocities = [moves(part, point) for part in (one, two)]
            assert np.allclose(*velocities, atol=1e-9 * np.hypot(*apart))
    assert found >= len(gears) - 1


def touch(one: PlacedPart, two: PlacedPart) -> bool:
    """Whether teeth of an external gear reach into the gaps of the other."""
    apart = float(np.hypot(*(np.array(two.centre[:2]) - one.centre[:2])))
    (root_1, tip_1), (root_2, tip_2) = (
        np.sort(np.hypot(*part.shape.tooth.T))[[0, -1]]
        for part in (one, two)
        if isinstance(part.shape, GearShape)
    )
    beside = abs(one.centre[2] - two.centre[2]) > 0.5 * (one.shape.width + two.shape.width)
    if beside:
        return False
    if two.shape.internal:
        return root_2 < apart + tip_1 < tip_2
    return apart < tip_1 + tip_2 and apart > root_1 + root_2


def moves(part: PlacedPart, point: np.ndarray) -> np.ndarray:
    """How a point of a body moves for each radian of the first one."""
    centre = np.array(part.centre[:2])
    arm, of_centre = point - centre, centre - part.axis
    return part.turns * np.array([-arm[1], arm[0]]) + part.orbits * np.array([-of_centre[1], of_centre[0]])


def test_of_a_sweep_the_page_has_the_scenario_that_is_varied(tmp_path: Path):
    with open_any(Path(__file__).parents[3] / "fixtures" / "records-0.1.0" / "sweep.h5") as sweep:
        data = data_of(write_report([sweep], tmp_path / "sweep.html"))
        teeth = sum(sweep.scenario["drive"][side]["teeth"] for side in ("pinion", "gear"))
    content = gzip.decompress(base64.b64decode(data["bodies"][data["records"][0]["bodies"]]))
    scene = trimesh.load_scene(io.BytesIO(content), file_type="glb")
    assert len(scene.graph.nodes_geometry) == teeth


#: A browser that cannot do what the page asks for first: draw by WebGL; unpack.
WITHOUT_WEBGL = """const context = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
  return kind === "webgl2" ? null : context.call(this, kind, ...more);
};"""
WITHOUT_UNPACKING = "delete window.DecompressionStream;"


class Shown:
    """The page in a browser."""

    def __init__(self, browser, file: Path, *, lacks: str = "", **how):
        self.page = browser.new_page(viewport={"width": 1280, "height": 900}, **how)
        self.errors: list[str] = []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.add_init_script(lacks)
        self.page.goto(file.as_uri())
        self.canvas = self.page.locator("#space")
        if lacks != WITHOUT_UNPACKING:
            self.page.wait_for_function("() => document.getElementById('space').dataset.view")
            self.canvas.scroll_into_view_if_needed()

    def state(self) -> np.ndarray:
        """Direction of sight, distance over that which fits, target, rotation of the first part."""
        self.page.evaluate("() => new Promise((done) => requestAnimationFrame(() => setTimeout(done)))")
        view, turned = self.page.evaluate(
            "(({ view, turned }) => [view, turned])(document.getElementById('space').dataset)"
        )
        return np.array([*json.loads(view), float(turned)])

    def colored(self) -> np.ndarray:
        """Where the picture is blue, and where orange: the pinion, the gear."""
        self.state()
        red, _, blue = np.moveaxis(plt.imread(io.BytesIO(self.canvas.screenshot()), "png")[..., :3], -1, 0)
        return np.array([blue > red + 0.15, red > blue + 0.15])


@pytest.fixture(scope="module")
def file(short_runs, tmp_path_factory) -> Path:
    return open_run(short_runs("gear-pair").path).report(tmp_path_factory.mktemp("space") / "pair.html")


@pytest.fixture(scope="module")
def browser() -> Iterator:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as running:
        opened = running.chromium.launch(executable_path=document.browser(), args=["--no-sandbox"])
        yield opened
        opened.close()


@pytest.fixture(scope="module")
def shown(browser, file) -> Shown:
    return Shown(browser, file, color_scheme="light")


@needs_browser
def test_keys_mouse_and_wheel_move_the_eye(shown):
    page, canvas = shown.page, shown.canvas
    fitted, cursor = shown.state(), page.evaluate("document.body.dataset.at")
    page.mouse.move(*middle(canvas))
    page.mouse.wheel(0, 40)  # of the page, as nobody looks at the picture
    page.wait_for_function("() => scrollY > 0")
    assert np.array_equal(shown.state(), fitted)
    canvas.focus()
    for key, place, way in (("ArrowRight", 0, 1), ("ArrowDown", 1, 1), ("-", 2, 1), ("+", 2, -1)):
        before = shown.state()
        canvas.press(key)
        assert np.flatnonzero(shown.state() != before).tolist() == [place]
        assert np.sign(shown.state() - before)[place] == way
    canvas.press("Shift+ArrowRight")
    assert np.array_equal(shown.state()[:3], before_pan := shown.state()[:3])
    assert np.any(shown.state()[3:6] != fitted[3:6])
    page.mouse.wheel(0, -300)
    assert shown.state()[2] < before_pan[2]
    x, y = middle(canvas)
    before = shown.state()
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 75, y + 30)
    page.mouse.up()
    assert np.allclose(shown.state()[:2] - before[:2], [0.5, 0.2])
    page.locator(".space-view").select_option("along the shafts")
    assert np.allclose(shown.state()[:3], [0.0, 0.0, 1.0])
    assert page.evaluate("document.body.dataset.at") == cursor  # arrows were not those of the run
    assert not shown.errors


@needs_browser
def test_two_fingers_that_part_twice_as_far_come_twice_as_near(shown):
    touches = shown.page.context.new_cdp_session(shown.page)
    shown.page.locator(".space-fit").click()
    x, y = middle(shown.canvas)
    for kind, apart in (("touchStart", 40), ("touchMove", 60), ("touchMove", 80), ("touchEnd", None)):
        points = [{"x": x + way * apart, "y": y, "id": way + 1} for way in (-1, 1)] if apart else []
        touches.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        shown.state()
    assert shown.state()[2] == pytest.approx(0.5, rel=0.02)


@needs_browser
def test_parts_are_listed_named_and_hidden(shown):
    page = shown.page
    rows = page.locator(".space-parts tbody tr")
    texts = [row.split("\t") for row in rows.all_inner_texts()]
    assert [[cell.strip() for cell in row] for row in texts] == [
        ["pinion", "25", "1"],
        ["gear", "51", "−0.4902"],
    ]
    assert "pinion, gear" in shown.canvas.get_attribute("aria-label")
    both = shown.colored()
    assert np.all(both.mean(axis=(1, 2)) > 0.02)
    page.locator(".space-named").check()
    shown.state()
    assert page.locator(".space-names span:visible").all_inner_texts() == ["pinion", "gear"]
    rows.nth(1).locator("input").uncheck()
    page.locator(".space-named").uncheck()
    alone = shown.colored()
    assert not alone[1].any()
    assert alone[0].sum() >= both[0].sum()
    assert not shown.errors


@needs_browser
def test_the_file_in_the_page_is_saved(shown, file):
    with shown.page.expect_download() as saved:
        shown.page.locator(".space-save").click()
    content = Path(saved.value.path()).read_bytes()
    assert content == gzip.decompress(base64.b64decode(data_of(file)["bodies"][0]))
    assert saved.value.suggested_filename.endswith(".glb")
    scene = trimesh.load_scene(io.BytesIO(content), file_type="glb")
    assert len(scene.graph.nodes_geometry) == 25 + 51


@needs_browser
def test_gears_turn_until_they_are_stopped(shown):
    button, still = shown.page.locator(".space-turn"), shown.state()
    button.click()
    shown.page.wait_for_function("() => Number(document.getElementById('space').dataset.turned) > 0.05")
    button.click()
    stopped = shown.state()
    assert stopped[6] > still[6]
    assert np.array_equal(shown.state(), stopped)
    assert not shown.errors


@needs_browser
def test_a_painter_draws_the_same_without_webgl_and_turns_by_teeth_for_who_wants_no_motion(
    shown, browser, file
):
    """Along the shafts silhouettes are those of the bodies."""
    painted = Shown(browser, file, lacks=WITHOUT_WEBGL, color_scheme="dark", reduced_motion="reduce")
    painted.canvas.press(" ")
    assert painted.state()[6] == pytest.approx(2 * np.pi / 25)
    assert np.array_equal(painted.state(), painted.state())
    pictures = []
    for one, by in ((shown, "by WebGL"), (painted, "by a painter")):
        one.page.reload()
        one.page.locator(".space-view").select_option("along the shafts")
        pictures.append(one.colored())
        assert one.canvas.get_attribute("data-drawn") == by
        assert not one.errors
    assert np.mean(pictures[0] != pictures[1]) < 0.01
    assert np.all(pictures[0].mean(axis=(1, 2)) > 0.02)


@needs_browser
def test_a_browser_that_cannot_unpack_says_so(browser, file):
    shown = Shown(browser, file, lacks=WITHOUT_UNPACKING)
    assert "can neither unpack nor draw" in shown.page.locator(".space").inner_text()
    assert not shown.canvas.is_visible()
    assert not shown.errors


def middle(canvas) -> tuple[float, float]:
    box = canvas.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
