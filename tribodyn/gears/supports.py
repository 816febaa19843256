"""Shafts as drawn, and matrices, under the mean load of the mesh: stiffness, tilts, loads of the bearings.

The load is that of the pitch point: F_t = T/r, F_r = F_t tan α_t, F_a = F_t tan β, all of it in the middle of
the face, whose load a misalignment shifts; that it does is left out, which overestimates the tilts.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.data import BearingData
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.helix import pitch_slope
from tribodyn.geometry.modification import Misalignment, Modifications, misalignment_of_tilts
from tribodyn.input.tables.bearings import Bearing, Bearings, bearing_of
from tribodyn.input.tables.drawn_bearings import BearingOfShaft, held_by
from tribodyn.input.tables.drawn_shafts import DrawnShaft
from tribodyn.input.tables.duty import duty_of
from tribodyn.input.tables.gears.drive_data import assembled_on_path
from tribodyn.input.tables.gears.model_files import DriveTable
from tribodyn.input.tables.shafts import drawn_shafts
from tribodyn.numerics.remembered import remembered
from tribodyn.train.elastic.beam import ShaftMetal, ShaftSection
from tribodyn.train.elastic.rolling_bearing import BearingState
from tribodyn.train.elastic.shaft import displacement_on, mesh_loads, under_load
from tribodyn.train.elastic.system import Matrix, NotHeld, PlacedBearing, PlacedShaft

#: Forces along x, y, z (N) and moments about x and y (N m), or displacements (m, rad).
Five = tuple[float, ...]
#: No displacement.
STILL: Five = (0.0,) * 5


class BearingUnderLoad(NamedTuple):
    """A bearing of a drawn shaft: where it is, what its table says, and what the shaft does to it."""

    position: float  # m
    table: BearingOfShaft
    force: Five
    #: of each rolling element, N: of a ball, or of the slices of a roller; () of springs and matrices
    loads: tuple[tuple[float, ...], ...] = ()


class GearSupport(NamedTuple):
    """What holds a gear, under the mean load of its mesh."""

    data: BearingData  # with the matrix about this load
    displacement: Five  # of the gear under it
    bearings: tuple[BearingUnderLoad, ...] = ()


class GearSupports(NamedTuple):
    """Those of pinion and gear; None: springs in the directions of the axes, which tilt no gear here."""

    pinion: GearSupport | None = None
    gear: GearSupport | None = None
    misalignment: Misalignment = Misalignment()  # by the tilts of both
    pressure_angle: float = 0.0  # of the transverse section at the pitch point, rad


def supports_of(scenario: Any) -> GearSupports:
    """What holds the gears of a scenario that breaks no rule: drawn shafts, and matrices of its bearings.

    Raises InputError where a shaft is not held under the load of its gear, or the teeth have no path.
    """
    if (prescribed := getattr(scenario, "supports", None)) is not None:  # of a mesh of several
        return prescribed
    if not has_supports(scenario):
        return GearSupports()
    bearings = getattr(scenario, "bearings", None)
    matrices = {side: _with_matrix(bearings, side) for side in SIDES}
    drawn = drawn_shafts(getattr(scenario, "shaft", None))
    drive: DriveTable = scenario.drive
    assembly = assembled_on_path(drive)
    torque = duty_of(scenario.operating, drive.pinion.teeth, drive.gear.teeth).gear_torque
    loads = mean_loads(assembly, torque)
    supports: dict[str, GearSupport | None] = dict.fromkeys(SIDES)
    for side, load in zip(SIDES, loads, strict=True):
        if side in drawn:
            supports[side] = drawn_support(*drawn[side], load)
        elif (matrix := matrices[side]) is not None:
            supports[side] = matrix_support(f"bearings.{side}.matrix", bearing_of(matrix), load)
    angle = float(assembly.path.pressure_angle(0.0))
    stand = misalignment_of_tilts(
        ((one.displacement if one else STILL)[3:] for one in supports.values()), angle
    )
    return GearSupports(supports["pinion"], supports["gear"], stand, angle)


def has_supports(scenario: Any) -> bool:
    """Whether a scenario draws a shaft or gives a matrix."""
    if (prescribed := getattr(scenario, "supports", None)) is not None:
        return prescribed.pinion is not None or prescribed.gear is not None
    bearings = getattr(scenario, "bearings", None)
    drawn = drawn_shafts(getattr(scenario, "shaft", None))
    return bool(drawn) or any(_with_matrix(bearings, side) for side in SIDES)


def mean_loads(assembly: Assembly, gear_torque: float) -> tuple[Five, Five]:
    """Load of the mesh on pinion and gear: forces along x, y, z and moments about x and y of their centres.

    A negative torque on the gear loads the back flanks; directions as of `mesh_loads`.
    """
    radii = float(assembly.path.pinion_pitch_radius), float(assembly.path.gear_pitch_radius)
    slopes = float(np.tan(assembly.path.pressure_angle(0.0))), float(pitch_slope(assembly))
    return mesh_loads(abs(gear_torque / radii[1]) * (1.0 if gear_torque >= 0.0 else -1.0), radii, *slopes)


def displaced(modifications: Modifications, held: GearSupports) -> Modifications:
    """Flanks whose gears stand as their shafts displace them."""
    further = held.misalignment
    if not any(further):
        return modifications
    stand = modifications.misalignment
    both = Misalignment(stand.in_plane + further.in_plane, stand.out_of_plane + further.out_of_plane)
    return modifications._replace(misalignment=both)


def _with_matrix(bearings: Any, side: str) -> Bearing | None:
    bearing = bearings.of(side) if isinstance(bearings, Bearings) else None
    return bearing if bearing is not None and bearing.matrix is not None else None


def matrix_support(key: str, data: BearingData, load: Five) -> GearSupport:
    """What a matrix holds a gear by under a load; InputError where it does not."""
    assert data.matrix is not None
    try:
        moved = displacement_on(np.array(data.matrix), np.array(load))
    except NotHeld as error:
        remedy = "give it stiffness there, of helical gears also along z"
        raise InputError(key, None, str(error), remedy) from None
    return GearSupport(data, tuple(moved.tolist()))


@contextmanager
def refusing(keys: Sequence[str]) -> Iterator[None]:
    """Refuse shafts that are not held; `keys` are those of the shafts of all points."""
    try:
        yield
    except NotHeld as error:
        rule = f"{error}, under the load of the mesh"
        remedy = (
            "give a load, less clearance, or bearings that hold it there; thrust of tapered ones both ways"
        )
        raise InputError(keys[error.point], None, rule, remedy) from error
    except np.linalg.LinAlgError as error:
        rule = "its sections and bearings differ so much in stiffness that no equilibrium can be computed"
        remedy = "check the units of lengths, diameters and stiffnesses"
        raise InputError(keys[0], None, rule, remedy) from error


def drawn_support(key: str, table: DrawnShaft, load: Five) -> GearSupport:
    """What a shaft as drawn holds its gear by under a load; InputError where it does not."""
    with refusing([key]):
        moved, stiffness, answers = _settled(placed_shaft(table, table.placed("gear").values()), load)
    bearings = tuple(
        BearingUnderLoad(bearing.position, bearing, *answer)
        for bearing, answer in zip(table.bearing, answers, strict=True)
    )
    data = BearingData.of_matrix(stiffness, table.damping_ratio)
    return GearSupport(data, moved, bearings)


@remembered(64)
def _settled(shaft: PlacedShaft, load: Five) -> tuple[Five, Matrix, tuple[tuple[Five, Matrix], ...]]:
    settled_shaft = under_load(shaft, load)
    return (
        tuple(settled_shaft.displacement.tolist()),
        tuple(map(tuple, settled_shaft.stiffness.tolist())),
        tuple((tuple(state.force.tolist()), element_loads(state)) for state in settled_shaft.bearings),
    )


def element_loads(state: BearingState) -> Matrix:
    """Loads of the rolling elements of a bearing, of their slices where they are rollers, N."""
    loads = state.element_load[:, None] if state.slice_load is None else state.slice_load
    return tuple(map(tuple, loads.tolist()))


def placed_shaft(
    table: DrawnShaft, points: Iterable[float], spin: float = 0.0, moving: bool = False
) -> PlacedShaft:
    """A drawing as the physics takes it, with the places of what it carries (m) and its spin, rad/s.

    `moving`: bearings whose forces are evaluated in time have no matrix.
    """
    return PlacedShaft(
        tuple(ShaftSection(*section.model_dump().values()) for section in table.section),
        ShaftMetal(table.youngs_modulus, table.poisson_ratio),
        table.density,
        tuple(points),
        tuple(
            PlacedBearing(one.position, held_by(one), one.seat, moving and one.force == "in-time")
            for one in table.bearing
        ),
        spin,
    )
