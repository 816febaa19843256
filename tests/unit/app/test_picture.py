"""What the browser draws gears from."""

import numpy as np
import pytest

pytest.importorskip("tomlkit")
from tribodyn.app.core.document import Document
from tribodyn.app.core.live import Live, LiveRequest
from tribodyn.app.picture import gearbox_picture, pair_picture


@pytest.fixture(scope="module")
def live(tmp_path_factory):
    return Live(tmp_path_factory.mktemp("live"))


def drawn(body) -> np.ndarray:
    """The outline as the browser makes it of one tooth."""
    tooth = np.asarray(body["tooth"]).reshape(-1, 2) @ [1.0, 1.0j]
    points = (np.exp(1j * body["pitch"] * np.arange(body["teeth"]))[:, None] * tooth).ravel()
    return np.stack([points.real, points.imag], axis=-1)


@pytest.mark.parametrize("name", ["spur-25-51", "helical-23-47", "planetary-24-84"])
def test_a_tooth_turned_about_the_axis_is_the_outline(live, name):
    document = Document.open(name)
    found = live.compute("geometry", LiveRequest(document.text, str(document.path)))
    for gear, body in zip(found["gears"], pair_picture(found)["bodies"], strict=True):
        assert drawn(body) == pytest.approx(np.asarray(gear["outline"])[:-1], abs=1e-3)  # mm
    if found["train"] is None:
        return
    gears = {gear["name"]: gear for gear in found["train"]["gears"]}
    for body in gearbox_picture(found["train"])["bodies"]:
        assert drawn(body) == pytest.approx(np.asarray(gears[body["name"]]["outline"])[:-1], abs=1e-2)


def test_a_ring_in_mesh_is_drawn_from_its_tooth(live):
    document = Document.open("planetary-24-84")
    mesh = next(
        name
        for name in live.compute("geometry", LiveRequest(document.text, str(document.path)))["meshes"]
        if "ring" in name
    )
    found = live.compute("geometry", LiveRequest(document.text, str(document.path), mesh))
    ring = next(body for body in pair_picture(found)["bodies"] if body["role"] == "ring")
    outline = next(gear["outline"] for gear in found["gears"] if gear["internal"])
    assert drawn(ring) == pytest.approx(np.asarray(outline)[:-1], abs=1e-3)
