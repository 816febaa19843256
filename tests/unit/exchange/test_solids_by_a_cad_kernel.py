"""STEP files as OpenCASCADE reads them: valid solids, their volumes, flanks within a micrometre of the exact.

Needs `pip install cadquery-ocp` (8.0.1 was tried; 1.2 GB), which nothing else here does.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.outlines import distance, turned
from tribodyn.drawing.shapes import GearShape, PlacedPart, ShaftShape
from tribodyn.drawing.surface import surface_of, volume
from tribodyn.exchange.cad.step import FORMAT
from tribodyn.exchange.format import Exported
from tribodyn.studies.handed_over import placed_parts
from tribodyn.studies.protocol.load import load

pytest.importorskip("OCP", reason="no OpenCASCADE: pip install cadquery-ocp")

MICROMETRE = 1e-6
CROWNED = {
    f"drive.{side}.modification.{key}": value
    for side in ("pinion", "gear")
    for key, value in {
        "tip_relief": "20 um",
        "tip_relief_length": "1 mm",
        "crowning": "8 um",
        "helix_slope": "5 um",
    }.items()
}

WEB = {"drive.gear.rim_thickness": "12 mm", "drive.gear.web_thickness": "6 mm"}


def solids(file: Path) -> Iterator[Any]:
    """Shapes of a file, as the kernel has them."""
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer

    reader = STEPControl_Reader()
    assert reader.ReadFile(str(file)).name == "IFSelect_RetDone"
    reader.TransferRoots()
    found = TopExp_Explorer(reader.OneShape(), TopAbs_SOLID)
    while found.More():
        yield found.Current()
        found.Next()


def volume_of(solid: Any) -> float:
    """By the kernel, m³."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid, properties, 1e-5)
    return 1e-9 * properties.Mass()


def points_on_faces(solid: Any, count: int) -> Iterator[np.ndarray]:
    """Places on the first faces of a solid that are splines, m."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_BSplineSurface
    from OCP.TopAbs import TopAbs_FACE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    faces = TopExp_Explorer(solid, TopAbs_FACE)
    while faces.More() and count:
        face = TopoDS.Face(faces.Current())
        faces.Next()
        surface = BRepAdaptor_Surface(face)
        if surface.GetType() != GeomAbs_BSplineSurface:
            continue
        count -= 1
        ends = surface.FirstUParameter(), surface.LastUParameter(), surface.FirstVParameter()
        last = surface.LastVParameter()
        for u, v in ((0.03, 0.02), (0.37, 0.5), (0.61, 0.81), (0.97, 0.99)):
            place = surface.Value(ends[0] + u * (ends[1] - ends[0]), ends[2] + v * (last - ends[2]))
            yield 1e-3 * np.array([place.X(), place.Y(), place.Z()])


def off_the_tooth(shape: GearShape, place: np.ndarray) -> float:
    """How far a point in a gear's own frame is from its exact outline at that height, m."""
    (tooth,) = shape.section(place[2:])
    return min(
        distance(turned(place[None, :2], 2.0 * np.pi / shape.teeth * k)[0], tooth) for k in range(shape.teeth)
    )


@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("crc-23-47", CROWNED | WEB | {"mesh.compliance": "fem"}),
        ("helical-23-47", CROWNED),
        ("planetary-24-84", {}),
        ("industrial-reducer", {}),
    ],
)
def test_bodies_are_valid_solids_with_their_flanks(name: str, keys: dict[str, str], tmp_path: Path):
    from OCP.BRepCheck import BRepCheck_Analyzer

    loaded = load(name, keys)
    exported = Exported(loaded.path, {}, parts=lambda tolerance: placed_parts(loaded, tolerance))
    assert FORMAT.write is not None
    (text,) = FORMAT.write(exported, "parts", {}).files.values()
    (tmp_path / "parts.step").write_text(text if isinstance(text, str) else text.decode(), encoding="ascii")
    parts = placed_parts(loaded, 4e-7)
    found = list(solids(tmp_path / "parts.step"))
    assert len(found) == len(parts)
    for solid, part in zip(found, parts, strict=True):
        assert BRepCheck_Analyzer(solid).IsValid()
        assert volume_of(solid) == pytest.approx(exact_volume(part), rel=1e-4)
        if isinstance(part.shape, GearShape):
            for place in points_on_faces(solid, 6):
                own = place - part.centre
                own[:2] = turned(own[None, :2], -part.angle)[0]
                assert off_the_tooth(part.shape, own) < MICROMETRE


def exact_volume(part: PlacedPart) -> float:
    """Of a shaft by its cylinders, of a gear by fine triangles, m³."""
    if isinstance(part.shape, ShaftShape):
        sections = zip(part.shape.length, part.shape.radius, part.shape.bore, strict=True)
        return np.pi * sum(length * (radius**2 - bore**2) for length, radius, bore in sections)
    return volume(surface_of(part.shape._replace(tolerance=4e-6)))
