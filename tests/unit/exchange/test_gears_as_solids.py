"""Gears, shafts and trains as STEP files: solids that are closed, splines on the exact teeth, assemblies."""

from pathlib import Path

import numpy as np
import pytest

import tribodyn as td
from tests.support.outlines import distance, turned
from tests.support.step_reader import Solids
from tests.support.verbs import complaint, invoke
from tribodyn.drawing.shapes import parts_of_pair
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.body import gear_polygon, section_area_and_inertia, tooth_outline
from tribodyn.geometry.drive import SIDES, Side, body_of
from tribodyn.geometry.families import family
from tribodyn.studies.handed_over import placed_parts
from tribodyn.studies.protocol.load import load

MICROMETRE = 1e-6


@pytest.mark.parametrize("name", ["crc-23-47", "helical-23-47", "ring-36-93"])
def test_solids_are_closed_with_the_area_of_their_teeth_and_flanks_on_them(name: str, tmp_path: Path):
    """Any height of a flank against the outline by points; the area between splines against its formula."""
    file = tmp_path / "pair.step"
    (off,) = td.export(name, "step", file).deviations
    assert off.maximum < MICROMETRE
    solids, pair = Solids(file), load(name).case.pair
    assembly = assemble(family(pair.family), pair.drive)
    parts = dict(zip(SIDES, parts_of_pair(assembly, 1e-5), strict=True))
    solids_by_name = solids.faces()
    assert tuple(solids_by_name) == SIDES
    for side, faces in solids_by_name.items():
        part, body, tooth = parts[side], body_of(pair.drive, side), assembly.tooth(side)
        count, internal = part.shape.teeth, bool(body.teeth < 0)
        swept = [face for face in faces if solids[face[0]][0] == "B_SPLINE_SURFACE_WITH_KNOTS"]
        assert (len(swept), len(faces)) == (6 * count, 6 * count + 4)  # bore in halves, two ends
        assert {same for _, same, _ in swept} == {not internal}
        assert area_within(solids, faces) == pytest.approx(exact_area(assembly, side), rel=1e-5)
        line = turned(np.asarray(gear_polygon(assembly, side, 1500)), -part.angle)
        line = line[np.abs(np.arctan2(line[:, 1], line[:, 0])) < 2 * np.pi / count]
        circles = np.abs([float(tooth.tip_radius), float(tooth.root_radius)])
        for surface, _, _ in swept[:6]:
            for u, along in ((0.03, 0.1), (0.31, 0.5), (0.55, 0.77), (0.97, 0.98)):
                *place, z = solids.surface_at(surface, u, along)
                assert z == pytest.approx((along - 0.5) * float(body.face_width), abs=1e-9)
                (x, y) = where = turned(np.array([place]), -part.shape.twist * z)[0]
                if np.arctan2(y, x) > np.pi / count:  # the land to the next tooth
                    where = turned(where[None], -2 * np.pi / count)[0]
                off_circles = np.abs(np.hypot(x, y) - circles)
                assert min(*off_circles, distance(where, line)) < MICROMETRE


def area_within(solids: Solids, faces: list) -> float:
    """Area of the end face at the bottom between its splines and its circle, m²; counter-clockwise."""
    _, _, loops = next(
        face for face in faces if solids[face[0]][0] == "PLANE" and height(solids, face[2][0][0][0]) < 0
    )
    total, along = 0.0, np.linspace(0.0, 1.0, 101)
    for loop in loops:
        sign = -1.0  # seen from below
        if solids[solids[loop[0][0]][1][3]][0] == "CIRCLE":
            radius = 1e-3 * solids[solids[loop[0][0]][1][3]][1][2]
            total += sign * np.pi * radius**2 * (1.0 if loop[0][1] else -1.0)
            continue
        for edge, forward in loop:
            x, y, _ = solids.curve(edge)(along).T
            total += sign * (1.0 if forward else -1.0) * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) / 2)
    return total


def height(solids: Solids, edge: str) -> float:
    """z of the start of an edge, m."""
    return solids.point(solids[solids[edge][1][1]][1][1])[2]


def exact_area(assembly: Assembly, side: Side) -> float:
    """Area of the section of a gear, m²."""
    body, outline = body_of(assembly.drive, side), tooth_outline(assembly.tooth(side), 1000, 1000)
    return float(section_area_and_inertia(outline, body.teeth, body.bore_radius)[0])


def test_a_train_is_an_assembly_of_its_parts(tmp_path: Path):
    """Gears and shafts stand where they are; planets are one product, used three times."""
    reducer = tmp_path / "reducer.step"
    printed = invoke("export", "industrial-reducer", "--to", "step", "-o", reducer, "--set", "tolerance=5 um")
    assert "13 parts" in printed
    solids = Solids(reducer)
    parts = {part.name: part for part in placed_parts(load("industrial-reducer"), 1e-4)}
    assert list(solids.faces()) == list(parts)
    uses = [use[1] for use in solids.every("NEXT_ASSEMBLY_USAGE_OCCURRENCE").values()]
    assert uses == list(parts)
    for moved, part in zip(solids.every("ITEM_DEFINED_TRANSFORMATION").values(), parts.values(), strict=True):
        _, origin, _, x = solids[moved[3]][1]
        assert np.allclose(solids.point(origin), part.centre, atol=1e-12)
        assert np.allclose(solids[x][1][1], [np.cos(part.angle), np.sin(part.angle), 0.0])
    with pytest.raises(td.InputError, match="step writes"):
        td.export("planetary-24-84", "step", tmp_path / "set.glb")
    td.export("planetary-24-84", "step", tmp_path / "set.step", {"tolerance": "5 um"})
    planets = Solids(tmp_path / "set.step")
    assert list(planets.faces()) == ["sun", "ring", "planet-1"]
    assert [use[1] for use in planets.every("NEXT_ASSEMBLY_USAGE_OCCURRENCE").values()][2:] == [
        f"planet-{number}" for number in (1, 2, 3)
    ]


def test_what_is_no_gear_is_refused(tmp_path: Path):
    refused = complaint("export", "irefc", "--to", "step", folder=tmp_path)
    assert "describes no gears" in refused
    assert not list(tmp_path.iterdir())
