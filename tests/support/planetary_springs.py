"""Models of one planetary set of constant mesh stiffness, in its carrier's frame; no tooth geometry.

The tables of the meshes are those of external involutes with one spring along the line of action; radii and
directions are the set's, the ring's negative. Sun and carrier turn positively counter-clockwise, planets and
ring clockwise: as they do against the carrier.
"""

from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from tests.support.spring_trains import Gears, one_spring, scenario_of
from tests.support.train_matrices import Bearing, Body, Mesh, Train
from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics.parameters import DRIVE_SPEED, DRIVE_TORQUE, Model
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.studies.motion.prepare import prepare, tabulated
from tribodyn.train.layout import layout_of
from tribodyn.train.positions import frame_of, moves_of
from tribodyn.train.schedule import schedule_of
from tribodyn.train.structure import (
    GROUND,
    Bodies,
    Links,
)

SUN, RING, CARRIER, FIRST_PLANET = 0, 1, 2, 3


class Member(NamedTuple):
    """A body of the set: kg, kg m², and its bearing, N/m; of a planet its pin."""

    mass: float
    inertia: float
    bearing: float


class PlanetarySet(NamedTuple):
    """One set with its ring held against rotation."""

    sun: Member
    ring: Member
    carrier: Member
    planet: Member
    angles: tuple[float, ...]  # of the planets, counter-clockwise from x, rad
    teeth: tuple[int, int, int]  # of sun, planet and ring, all > 0
    module: float  # m
    pressure_angle: float  # rad
    mesh_stiffness: tuple[float, float]  # with the sun and with the ring, N/m
    ring_support: float  # against rotation, N m/rad
    damping_ratio: float = 0.0
    pin_offsets: tuple[tuple[float, float], ...] = ()  # of every pin in x and y, m


@lru_cache(maxsize=8)
def _pair(teeth: int, other: int, module: float, angle: float, stiffness: float, ratio: float) -> tuple:
    """A prepared pair of external gears, its model's mesh and its cycle."""
    radii = module * teeth / 2, module * other / 2
    train = Train(
        (Body(1.0, 1e-3), Body(1.0, 1e-3)),
        (Bearing(0, (1e8, 1e8)), Bearing(1, (1e8, 1e8))),
        (),
        (Mesh((0, 1), radii, 0.0, angle, 1, stiffness),),
    )
    speed = {"input_speed": "100 rad/s", "output_torque": "300 N*m"}
    case = case_of_table(scenario_of(train, [Gears((teeth, other), module)], ratio, speed))
    made = tuple(one_spring(each) for each in tabulated(case))
    return prepare(case, made).model, made[0].cycle


def planetary_springs(
    given: PlanetarySet,
    drive: int = DRIVE_TORQUE,
    speed: float = 100.0,
    torque: float = 0.0,
    turning: bool = False,
) -> tuple[Model, list[MeshCycle]]:
    """The model, sun driving at a speed (rad/s), carrier loaded by a torque (N m); cycles of its meshes.

    `turning`: with Coriolis and centrifugal forces.
    """
    count = len(given.angles)
    sun_teeth, planet_teeth, ring_teeth = given.teeth
    sun, planet, ring = (given.module * teeth / 2 for teeth in given.teeth)
    pins = sun + planet
    angle = given.pressure_angle
    first, sun_cycle = _pair(
        sun_teeth, planet_teeth, given.module, angle, given.mesh_stiffness[0], given.damping_ratio
    )
    second, ring_cycle = _pair(
        planet_teeth, ring_teeth, given.module, angle, given.mesh_stiffness[1], given.damping_ratio
    )
    carried = sun_teeth / (sun_teeth + ring_teeth)  # speed of the carrier over the sun's, ring held
    planet_ratio = (1.0 - carried) * sun_teeth / planet_teeth - carried
    planets = range(FIRST_PLANET, FIRST_PLANET + count)
    meshes, cycles, ends = [], [], []
    for body, azimuth in zip(planets, given.angles, strict=True):
        frame = frame_of(azimuth, 1)
        meshes.append(
            first.meshes[0]._replace(
                driver_radius=sun,
                driven_radius=planet,
                along_x=frame[0][0],
                along_y=frame[0][1],
                across_x=frame[1][0],
                across_y=frame[1][1],
                moves=moves_of(frame, (sun, planet)),
                driver_carried=carried,
                driven_carried=-carried,
                carrier_arm=sun + planet,
            )
        )
        cycles.append(sun_cycle)
        ends.append((SUN, body))
    for body, azimuth in zip(planets, given.angles, strict=True):
        frame = frame_of(azimuth, -1)
        meshes.append(
            second.meshes[0]._replace(
                driver_radius=planet,
                driven_radius=-ring,
                along_x=frame[0][0],
                along_y=frame[0][1],
                across_x=frame[1][0],
                across_y=frame[1][1],
                moves=moves_of(frame, (planet, -ring)),
                driver_carried=-carried,
                driven_carried=-carried,
                driven_sense=-1.0,
                carrier_arm=ring - planet,
            )
        )
        cycles.append(ring_cycle._replace(gear_pitch_radius=-ring))
        ends.append((body, RING))
    members = [given.sun, given.ring, given.carrier, *(given.planet for _ in planets)]
    links = [(SUN, GROUND), (RING, GROUND), (CARRIER, GROUND), *((body, CARRIER) for body in planets)]
    stiffness = np.array([[m.bearing, m.bearing, 0.0] for m in members])
    stiffness[RING, 2] = given.ring_support
    damping = 2.0 * given.damping_ratio * np.sqrt(stiffness * [[m.mass, m.mass, m.inertia] for m in members])
    lever, offset = np.zeros((len(links), 2, 2)), np.zeros((len(links), 2))
    for body, azimuth in zip(planets, given.angles, strict=True):
        lever[body, 1] = pins * np.array([-np.sin(azimuth), np.cos(azimuth)])
        if given.pin_offsets:
            offset[body] = given.pin_offsets[body - FIRST_PLANET]
    layout = layout_of(
        len(members),
        len(members),
        ends,
        links,
        SUN,
        CARRIER,
        pins=[k for k, (_, second_end) in enumerate(links) if second_end == CARRIER],
        holding={RING: 1} if given.ring_support else {},
        frames=1,
        carriers=[CARRIER] * len(meshes),
    )
    load = np.zeros(len(members))
    load[CARRIER] = torque
    bodies = Bodies(
        mass=np.array([m.mass for m in members]),
        inertia=np.array([m.inertia for m in members]),
        ratio=np.array([1.0, 0.0, carried, *(planet_ratio for _ in planets)]),
        load=load,
        load_damping=np.zeros(len(members)),
        carried=np.full(len(members), carried),
        frame_speed=np.full(len(members), carried * speed if turning else 0.0),
        hoop=np.array(
            [
                count * given.planet.mass * (carried * speed * pins) ** 2 * (m == CARRIER) * turning
                for m in range(len(members))
            ]
        ),
        place=np.array([*3 * [(0.0, 0.0)], *((pins * np.cos(a), pins * np.sin(a)) for a in given.angles)]),
    )
    operation = first.operation._replace(
        nominal_speed=speed,
        pitch_angle=2.0 * np.pi / sun_teeth / (1.0 - carried),
        drive_torque=torque * carried,
    )
    model = Model(
        tuple(meshes),
        bodies,
        Links(stiffness, damping, first.links.own, lever=lever, offset=offset),
        schedule_of(
            [np.asarray(mesh.table.boundary) for mesh in meshes],
            [Fraction(1)] * len(meshes),
            [0.0] * len(meshes),
        ),
        operation,
        first.options._replace(layout=layout, drive=drive),
    )
    assert drive in (DRIVE_SPEED, DRIVE_TORQUE)
    return model, cycles
