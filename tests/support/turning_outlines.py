"""Outlines of gears in mesh, turned: whether teeth touch where they are said to, and nowhere overlap."""

from collections.abc import Sequence
from math import pi
from typing import NamedTuple

import numpy as np
import pytest

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import half_profile, tooth_outline
from tribodyn.geometry.drive import Side, body_of
from tribodyn.geometry.path import position
from tribodyn.studies.motion.assembly import assemblies, phases
from tribodyn.studies.motion.case import Gearbox

#: Chords of the outlines' points leave less, m.
TOLERANCE = 0.1e-6


class Outline(NamedTuple):
    """A tooth as half thickness angle over rising radius, from root to tip; of a ring from tip to root."""

    radius: np.ndarray
    half_angle: np.ndarray
    teeth: int
    ring: bool

    def clearance(self, points: np.ndarray, tooth: float) -> np.ndarray:
        """Distance along the circle (m) of points (n, 2) from the nearest tooth; negative inside it.

        A tooth's axis points in the direction `tooth`, counter-clockwise from x; infinite beyond the tip.
        """
        radius, angle = np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])
        pitch = 2 * pi / self.teeth
        beside = np.abs((angle - tooth + pitch / 2) % pitch - pitch / 2)
        gap = (beside - np.interp(radius, self.radius, self.half_angle)) * radius
        return np.where(radius > self.radius[0] if self.ring else radius < self.radius[-1], gap, np.inf)


def outline_of(assembly: Assembly, side: Side) -> Outline:
    shape, teeth = tooth_outline(assembly.tooth(side), 2000, 800), body_of(assembly.drive, side).teeth
    both = np.array(half_profile(shape, teeth))[:, 3:-3]  # less the points of the tip circle
    ring = float(teeth) < 0
    radius, angle = -both[:, ::-1] if ring else both
    return Outline(radius, angle, abs(round(float(teeth))), ring)


def flanks(outline: Outline, tooth: float, centre: np.ndarray) -> np.ndarray:
    """Points of both flanks of all teeth, (n, 2) m, of a gear with its axis at `centre`."""
    index = np.arange(outline.teeth)[:, None] * 2 * pi / outline.teeth
    angles = np.concatenate([index + outline.half_angle, index - outline.half_angle]) + tooth
    radii = np.broadcast_to(outline.radius, angles.shape)
    return centre + np.stack([(radii * np.cos(angles)).ravel(), (radii * np.sin(angles)).ravel()], axis=-1)


class Turning(NamedTuple):
    """A mesh as it is drawn at turn 0."""

    assembly: Assembly  # its pinion drives
    azimuth: float  # of the driven axis as seen from the driver's, rad
    sense: int  # of the driver
    teeth: tuple[float, float]  # direction of a tooth of the driver and of the driven gear, rad
    phase: float  # of the mesh, cycles


def assert_touching(mesh: Turning, turns: Sequence[float]) -> None:
    """Turn the outlines of a mesh: they touch where its pairs are by its phase, and overlap nowhere.

    `turns` are angles of the driver in its own sense, rad, from turn 0.
    """
    path, drive = mesh.assembly.path, mesh.assembly.drive
    radii = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    z_1, z_2 = float(drive.pinion.teeth), float(drive.gear.teeth)
    across = np.array([np.cos(mesh.azimuth), np.sin(mesh.azimuth)])
    along = mesh.sense * np.sign(radii[0]) * np.array([-across[1], across[0]])  # motion at the pitch point
    centre = (radii[0] + radii[1]) * across
    one, two = outline_of(mesh.assembly, "pinion"), outline_of(mesh.assembly, "gear")
    for turn in turns:
        at_1 = mesh.teeth[0] + mesh.sense * turn
        at_2 = mesh.teeth[1] - mesh.sense * turn * z_1 / z_2
        points = flanks(two, at_2, centre)
        points = points[np.hypot(*(points - radii[0] * across).T) < 4 * drive.module]
        clearance = one.clearance(points, at_1)
        assert np.min(clearance) > -TOLERANCE, "teeth overlap"
        start, end = mesh.assembly.roll_limits
        phase = (mesh.phase + abs(z_1) * turn / (2 * pi)) % 1.0
        rolls = start + (phase + np.arange(4)) * 2 * pi / z_1
        rolls = rolls[(rolls - end) * z_1 < 0]  # angles of a driving ring fall
        assert rolls.size
        for r in np.asarray(path.signed_distance(rolls)):
            x, y = position(path, r)
            contact = radii[0] * across + x * along + y * across
            near = np.hypot(*(points - contact).T) < 0.01 * drive.module
            assert np.min(clearance[near]) == pytest.approx(0.0, abs=TOLERANCE), "no contact where it is due"


def assert_teeth_touch(case: Gearbox) -> None:
    """Turn all outlines of a train in their places, by the same time."""
    pairs = assemblies(case)
    put = phases(case, pairs)
    centres = np.array([body.centre for body in case.bodies])
    for number, (mesh, pair) in enumerate(zip(case.meshes, pairs, strict=True)):
        apart = centres[mesh.driven] - centres[mesh.driver]
        distance = float(pair.path.pinion_pitch_radius + pair.path.gear_pitch_radius)
        across = np.array([np.cos(mesh.azimuth), np.sin(mesh.azimuth)])
        np.testing.assert_allclose(apart, distance * across, atol=1e-9)
        teeth = put.teeth[mesh.gears[0]], put.teeth[mesh.gears[1]]
        sense, ratio = case.toothed_shafts[mesh.gears[0]].sense, float(case.bodies[mesh.driver].ratio)
        turning = Turning(pair, mesh.azimuth, sense, teeth, put.meshes[number])
        assert_touching(turning, [ratio * turn for turn in (0.0, 0.07, 1.9)])
        # after the common period every mesh is where it was
        assert mesh.rate * case.period == int(mesh.rate * case.period)
