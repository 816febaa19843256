"""Rings of planetary sets whose rim bends: their waves as coordinates of no body, pushed by their meshes.

The waves stand in the frame of the carrier, where the planets are: what the meshes push them by is constant,
and the rim passes with the ring's speed against the carrier, as do the pins that hold it. The mesh keeps the
tooth and the rim deflected in a fit that holds its outside (`rim = "fixed"` of the gear); the waves are those
of the outside.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.gears.tabulated import Tabulated
from tribodyn.geometry.drive import Side
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.case import Gearbox, SetData
from tribodyn.studies.motion.planetary.frames import carried_ratio
from tribodyn.train.coupling import CoupledMatrices, PassingStiffness
from tribodyn.train.elastic.ring import (
    FIRST_ORDER,
    PER_ORDER,
    Rim,
    RimData,
    pin_coupling,
    rim_matrices,
    rows_at,
)
from tribodyn.train.elastic.superelement import modal_damping
from tribodyn.train.layout import TrainLayout
from tribodyn.train.planetary import CARRIER, RING
from tribodyn.train.structure import ACROSS, TOWARDS, GearMesh


class _PlacedRim(NamedTuple):
    """A set's rim, its meshes, and the place of its first coordinate among those of no body."""

    gearset: SetData
    data: RimData
    meshes: tuple[int, ...]
    first: int

    @property
    def size(self) -> int:
        """Number of its coordinates."""
        return PER_ORDER * (self.data.orders + 1 - FIRST_ORDER)


def _placed(case: Gearbox) -> list[_PlacedRim]:
    rims: list[_PlacedRim] = []
    for gearset in case.sets:
        if gearset.rim is not None:
            ring = gearset.members[RING]
            meshes = tuple(m for m, mesh in enumerate(case.meshes) if ring in (mesh.driver, mesh.driven))
            rims.append(_PlacedRim(gearset, gearset.rim, meshes, sum(rim.size for rim in rims)))
    return rims


def rim_coordinates(case: Gearbox) -> int:
    """Coordinates of all rims of a case."""
    return sum(rim.size for rim in _placed(case))


def waves_of(case: Gearbox, bodies: Sequence[int]) -> dict[str, Float[Array, " wave"]]:
    """Of every coordinate of the rims the body by its place among `bodies`, the order, the number of pins."""
    rims = _placed(case)
    rings = [bodies.index(rim.gearset.members[RING]) for rim in rims]
    return {
        "wave_ring": np.repeat(rings, [rim.size for rim in rims]),
        "wave_order": np.concatenate(
            [np.repeat(np.arange(FIRST_ORDER, rim.data.orders + 1), PER_ORDER) for rim in rims]
        ),
        "wave_pins": np.repeat([rim.data.pins for rim in rims], [rim.size for rim in rims]),
    }


def with_rims(case: Gearbox, layout: TrainLayout) -> TrainLayout:
    """The layout with the places of rims, which are the first of no body."""
    rims = _placed(case)
    if not rims:
        return layout
    first, count = ([0] * layout.meshes for _ in range(2))
    for rim in rims:
        for m in rim.meshes:
            first[m], count[m] = layout.half - layout.modes + rim.first, rim.size
    kind = type(layout.rim_first)
    return layout._replace(rim_first=kind(first), rim_count=kind(count))


def rims_of(case: Gearbox, tables: Sequence[Tabulated], layout: TrainLayout) -> Iterator[CoupledMatrices]:
    """Matrices of all rims. Raises InputError where a rim turns so fast that its waves do not stand."""
    for placed in _placed(case):
        gearset, data = placed.gearset, placed.data
        rim = _rim(case, tables, placed.meshes[0], gearset)
        speed = _passing(case, gearset)
        matrices = rim_matrices(rim, data.orders, data.held, speed)
        if np.min(np.linalg.eigvalsh(matrices.stiffness)) <= 0.0:
            rule = f"the rim turns against the carrier faster than its waves of order {data.orders} run"
            raise InputError(f"{gearset.key}.ring_rim.orders", data.orders, rule, "give fewer orders")
        damped = modal_damping(matrices.mass, matrices.stiffness, data.damping_ratio, rounding=0.0)
        damping = matrices.gyroscopic + damped
        places = layout.half - layout.modes + placed.first + np.arange(placed.size)
        passing = ()
        if data.pins_pass:
            coupling = pin_coupling(data.orders, data.pins, data.held)
            passing = (PassingStiffness(float(data.pin_rate), *coupling),)
        yield CoupledMatrices(
            places, matrices.stiffness, damping, matrices.mass, np.zeros(placed.size), passing
        )


def pushing_rims(
    case: Gearbox, tables: Sequence[Tabulated], meshes: Sequence[GearMesh]
) -> tuple[GearMesh, ...]:
    """The meshes with what the rims move them by."""
    rims = _placed(case)
    rows = np.zeros((len(meshes), ACROSS + 1, max((rim.size for rim in rims), default=0)))
    for placed in rims:
        for m in placed.meshes:
            mesh, ring = meshes[m], placed.gearset.members[RING]
            driven = case.meshes[m].driven == ring
            radius = abs(float(mesh.driven_radius if driven else mesh.driver_radius))
            planet = case.meshes[m].driver if driven else case.meshes[m].driven
            angle = placed.gearset.angles[placed.gearset.planets.index(planet)]
            rim = _rim(case, tables, m, placed.gearset)
            moved = rows_at(rim, placed.data.orders, angle, radius)
            radial = np.array([np.cos(angle), np.sin(angle)])
            onwards = np.array([-radial[1], radial[0]])
            for which, way in (
                (TOWARDS, (mesh.along_x, mesh.along_y)),
                (ACROSS, (mesh.across_x, mesh.across_y)),
            ):
                row = np.dot(way, radial) * moved[0] + np.dot(way, onwards) * moved[1]
                rows[m, which, : placed.size] = -row if driven else row
    return (
        tuple(mesh._replace(rim=row) for mesh, row in zip(meshes, rows, strict=True)) if rims else (*meshes,)
    )


def _passing(case: Gearbox, gearset: SetData) -> float:
    """Speed of the ring against the carrier, rad/s counter-clockwise; 0 without forces of the frame."""
    if not gearset.frame_forces:
        return 0.0
    ring = gearset.members[RING]
    body = case.bodies[ring]
    speed = case.source.speed / float(case.bodies[case.source.body].ratio)
    return body.sense * speed * (float(body.ratio) - carried_ratio(case, ring, gearset.members[CARRIER]))


def _rim(case: Gearbox, tables: Sequence[Tabulated], m: int, gearset: SetData) -> Rim:
    """The rim between the root circle and the outside of the ring."""
    driven = int(case.meshes[m].driven == gearset.members[RING])
    assembly, pair = tables[m].assembly, case.meshes[m].pair
    # of the pair's gears the one with negative teeth
    side: Side = "pinion" if float(assembly.drive.pinion.teeth) < 0.0 else "gear"
    body, material = getattr(assembly.drive, side), pair.materials[driven]
    return Rim(
        abs(float(assembly.tooth(side).root_radius)),
        abs(float(body.bore_radius)),
        float(body.face_width),
        float(material.youngs_modulus),
        float(material.poisson_ratio),
        float(material.density),
    )
