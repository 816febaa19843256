"""Bodies with modified flanks: what is missing, by formulas; on which flank, at which end."""

import tomllib

import numpy as np
import pytest

from tests.support.binary_gltf import volume_within
from tests.support.outlines import distance, turned
from tribodyn.drawing.shapes import GearShape, parts_of_pair
from tribodyn.drawing.surface import surface_of
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.body import tooth_outline
from tribodyn.geometry.drive import SIDES, Side, reference_radius
from tribodyn.geometry.families import family
from tribodyn.geometry.modification import FlankModification, LeadRelief, Modifications, Relief
from tribodyn.geometry.path import position
from tribodyn.studies.drive_file import load_drive
from tribodyn.studies.handed_over import placed_parts
from tribodyn.studies.protocol.load import load, load_data

MICROMETRE = 1e-6
MADE = Modifications(
    FlankModification(
        tip=Relief(20e-6, 2e-3),
        root=Relief(5e-6, 1e-3, 2.0),
        lead=LeadRelief(crowning=6e-6, slope=4e-6),
        bias=3e-6,
    ),
    FlankModification(
        tip=Relief(15e-6, 1.5e-3),
        lead=LeadRelief(start=10e-6, end=3e-6, unmodified=2e-3),
        both_flanks=True,
    ),
)


def pair(name: str) -> Assembly:
    model = load_drive(name)
    return assemble(family(model.family), model.drive)


def missing(assembly: Assembly, side: Side, r: float, z: float, width: float) -> float:
    """Along the normal of a flank by the formulas of the documentation, m."""
    made, start, end = getattr(MADE, side), float(assembly.r_start), float(assembly.r_end)
    to_tip, to_root = (end - r, r - start) if side == "pinion" else (r - start, end - r)
    total = made.tip.amount * max(0.0, 1.0 - to_tip / made.tip.length)
    if made.root.amount:
        total += made.root.amount * max(0.0, 1.0 - to_root / made.root.length) ** 2
    lead, straight = made.lead, made.lead.unmodified / 2.0
    beyond = max(abs(z) - straight, 0.0) / (width / 2.0 - straight)
    total += (lead.start if z < 0.0 else lead.end) * beyond**2
    total += lead.crowning * (2.0 * z / width) ** 2 + lead.slope * z / width
    corner = ((to_root - to_tip) / (end - start)) * 2.0 * z / width
    return total + made.bias * corner


@pytest.mark.parametrize("name", ["liu-ni-crc-23-47", "helical-23-47", "ring-36-93"])
def test_contact_points_stand_off_modified_flanks_by_what_is_missing(name: str):
    """Along the path of contact and the face; the path's points lie on the unmodified flanks."""
    assembly = pair(name)
    path, parts = assembly.path, parts_of_pair(assembly, 2e-7, MADE)
    radii = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    helix = np.tan(assembly.drive.helix_angle) * radii[0] / reference_radius(assembly.drive, "pinion")
    for part, side in zip(parts, SIDES, strict=True):
        shape = part.shape
        assert isinstance(shape, GearShape)
        teeth = 2.0 * np.pi / shape.teeth * np.arange(shape.teeth)
        for z in np.array([-0.49, 0.15, 0.48]) * shape.width:
            for share in (0.02, 0.3, 0.71, 0.97):
                r = float(assembly.r_start + share * (assembly.r_end - assembly.r_start))
                roll = float(path.rotation(r)) * (-1.0 if side == "pinion" else radii[0] / radii[1])
                centre = [0.0, -radii[0] if side == "pinion" else radii[1]]
                place = turned((np.array(position(path, np.array(r))) - centre)[None], -roll - part.angle)[0]
                (tooth,) = shape.section(np.array([z]))
                tooth = turned(tooth, -shape.twist * z)  # a slice at z as it is at 0
                off = min(distance(turned(place[None], angle)[0], tooth) for angle in teeth)
                leaning = helix * np.cos(float(path.pressure_angle(r)))
                normal = off / np.hypot(1.0, leaning)
                assert normal == pytest.approx(
                    missing(assembly, side, r, z, shape.width), abs=0.25 * MICROMETRE
                )


def test_what_crowning_takes_off_a_gear():
    """A third of it, over the flank and, as it goes back to nothing there, half of the fillet."""
    assembly, crowning = pair("liu-ni-crc-23-47"), 30e-6
    made = Modifications(pinion=FlankModification(lead=LeadRelief(crowning=crowning)))
    (before, *_), (after, *_) = (parts_of_pair(assembly, 2e-6, each) for each in (Modifications(), made))
    volumes = [volume_within(*surface_of(part.shape)[::2]) for part in (before, after)]
    outline, body = tooth_outline(assembly.tooth("pinion"), 500, 500), assembly.drive.pinion
    flank, fillet = (
        np.sum(np.hypot(np.diff(x), np.diff(y)))
        for x, y in ((outline.flank_x, outline.flank_y), (outline.fillet_x, outline.fillet_y))
    )
    taken = 23 * crowning / 3.0 * body.face_width * (flank + fillet / 2.0)
    assert volumes[0] - volumes[1] == pytest.approx(taken, rel=0.05)


def test_drivers_are_relieved_in_front_and_driven_gears_behind():
    """In a train whose second driver turns the other way; the start of the face is seen from its pair."""
    made = {"tip_relief": "20 um", "tip_relief_length": "1 mm", "lead_relief_start": "10 um"}
    keys = {"mesh.compliance": "fem"} | {
        f"gear.{name}.modification.{key}": value
        for name in ("pinion-1", "pinion-2", "wheel-2")
        for key, value in made.items()
    }
    parts = {part.name: part for part in placed_parts(load("two-stage-reducer", keys), 2e-6)}
    for name, drives in (("pinion-1", True), ("pinion-2", True), ("wheel-2", False)):
        shape, turns = parts[name].shape, parts[name].turns
        assert isinstance(shape, GearShape)
        half = shape.width / 2.0
        start, _, end = shape.thinned(np.array([-half, 0.0, half]))
        lower, upper = start[: shape.ends[2] + 1], start[shape.ends[3] :]
        assert bool(upper.any()) == (not lower.any()) == ((turns > 0.0) == drives)
        driver = turns if drives else -turns
        assert (np.abs(start).sum() > np.abs(end).sum()) == (driver < 0.0)


def test_planets_have_what_both_meshes_take_off():
    data = tomllib.loads(load("planetary-24-84").case.toml)
    data["mesh"] = {"compliance": "fem", "damping_ratio": 0.05}
    data["gear"]["planet"]["modification"] = {"tip_relief": "20 um", "tip_relief_length": "1 mm"}
    parts = {part.name: part for part in placed_parts(load_data(data, "set"), 2e-6)}
    planet, sun = parts["planet-1"].shape, parts["sun"].shape
    assert isinstance(planet, GearShape)
    assert isinstance(sun, GearShape)
    assert (len(planet.modified), len(sun.modified)) == (2, 0)
    assert parts["planet-2"].shape is planet
    (turns,) = planet.thinned(np.array([planet.width / 2.0]))
    assert np.allclose(turns, -turns[::-1], atol=1e-12)
    assert turns[planet.ends[2]] > 0.0 > turns[planet.ends[3]]
