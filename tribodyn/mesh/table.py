"""What every tabulation shares: the case's mesh, where the pairs stand, their gaps, the table."""

from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from tribodyn.compliance.foundation import Foundation, Support
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, Drive, body_of
from tribodyn.geometry.modification import UNMODIFIED, Modifications
from tribodyn.geometry.path import Kinematics, pitch_point
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.numerics.curve import Table, check_cover, interpolate
from tribodyn.numerics.elementary import cos, is_jax, maximum, minimum, namespace, within
from tribodyn.numerics.shapes import Array, Float


@dataclass(frozen=True)
class MeshData:
    """How the teeth in contact deflect, damp, separate and err."""

    compliance: Literal["energy", "fem", "constant", "table"]  # where the single-pair stiffness comes from
    damping_ratio: float  # ζ of the mesh
    hertz: Literal["linear", "load-dependent"] = "linear"  # contact part of the energy method's compliance
    #: compliance of a gear body under its own tooth, with ``compliance = "energy"``
    foundation: Foundation = "sainsot-velex"
    foundation_coupling: bool = True  # whether two pairs on one body share its foundation
    body: Support = "free"  # what the deflection of a gear body counts from
    stiffness: float | None = None  # single-pair stiffness, N/m, with ``compliance = "constant"``
    #: single-pair stiffness over the pinion's roll angle from the pitch point (rad, N/m), with ``compliance =
    #: "table"``
    table: Table | None = None
    #: whether the torque −∂V/∂φ of the varying stiffness acts on the bodies
    formulation: Literal["classical", "energy-consistent"] = "classical"
    contact_width: float = 1e-7  # width in deflection over which contact sets in smoothly, m
    backlash: float | None = None  # normal backlash at the pitch point, m; None: back flanks never touch
    points: int = 65  # nodes of the table per segment of the mesh cycle
    #: (order of the mesh frequency, amplitude m, phase rad) of cosines in the static transmission error
    error_harmonics: tuple[tuple[int, float, float], ...] = ()
    error_table: Table | None = None  # static transmission error of a pair over roll angle (rad, m)
    #: what is missing on the flanks, and misalignment; with ``compliance = "fem"``, or of helical gears
    modifications: Modifications = UNMODIFIED
    #: slices along the face, with ``compliance = "fem"`` or of helical gears; these take as many as they need
    #: where it is 1 (`slice_number.slices_needed`)
    slices: int = 1
    slice_coupling: bool = True  # whether slices of one tooth hold each other
    #: by how much a tooth may stand out against the next, m: so much further out corners may touch, with
    #: ``compliance = "fem"``
    early: float = 0.0

    @property
    def at_load(self) -> bool:
        """Whether the compliance is that of finite elements, taken at the operating torque."""
        return self.compliance == "fem"

    @property
    def held(self) -> bool:
        """Whether bodies are held at their bores."""
        return self.body == "held"


class Slots(NamedTuple):
    """Where the pairs of the slots stand; as in `MeshCycle`, and `roll`: pinion angles (S, N, Q), rad.

    Angles of an internal pinion fall (`path`), and its pitch is negative.
    """

    boundary: Float[Array, " boundary"]
    phase: Float[Array, "segment node"]
    in_contact: Float[Array, "segment pair"]
    side: Float[Array, " pair"]
    roll: Float[Array, "segment node pair"]
    limits: tuple[Any, Any]


class Elasticity(NamedTuple):
    """What a compliance gives at the nodes, as in `MeshCycle`; gaps in the unloaded state included."""

    compliance: Float[Array, "segment node pair"]
    coupling: Float[Array, "segment node pair pair"]
    gap: Float[Array, "segment node pair"]
    hertz_coefficient: Any = 0.0
    line_load_friction: Any = 1.0
    line_load_peak: Any = 1.0


def back_entry(start: Any, pitch: Any) -> Any:
    """Phase at which a back pair enters, of pairs that enter at the pinion angle `start`."""
    return (0.5 - 2.0 * start / pitch) % 1.0


def slots(
    boundary: Float[Array, " boundary"],
    limits: tuple[Any, Any],
    pitch: Any,
    pairs: int,
    points: int,
    back: bool,
) -> Slots:
    """Pairs at the nodes of segments with these boundaries, in contact between the limits (rad).

    A back pair lives in the mirrored world, where the phase runs backwards: the back flank of a pinion tooth
    crosses the pitch point half a pitch after its front flank, so that its roll angle there is π/Z_p − φ.
    """
    start, end = limits
    xp = namespace(boundary, start, end)
    lower, upper = boundary[:-1, None], boundary[1:, None]
    phase = lower + (upper - lower) * np.linspace(0.0, 1.0, points)
    ages = np.arange(pairs - 1.0, -1.0, -1.0)
    position = phase[..., None] + ages  # pitches since entering
    if back:
        enter = back_entry(start, pitch)
        wrapped = xp.where((lower + upper) / 2 > enter, 1.0, 0.0)
        position = xp.concatenate([position, (enter - phase + wrapped)[..., None] + ages], axis=-1)
    centre = (position[:, 0] + position[:, -1]) / 2
    in_contact = xp.where(centre < (end - start) / pitch, 1.0, 0.0)
    side = np.where(np.arange(position.shape[-1]) < pairs, 1.0, -1.0)
    roll = within(start + pitch * position, minimum(start, end), maximum(start, end))
    return Slots(boundary, phase, in_contact, side, roll, limits)


def unloaded_gap(
    assembly: Assembly,
    mesh: MeshData,
    slots: Slots,
    pressure_angle: Float[Array, "segment node pair"],
    begin: float = 0.0,
) -> Float[Array, "segment node pair"]:
    """Transmission error of the front pairs and backlash of the back pairs along the normal, m.

    Harmonics are in step with the beginning of the path, at the phase `begin`; an error over roll angle stays
    at its ends beyond the path. Conjugate back flanks all touch after the same rotation: their distance along
    a normal goes like cos α.
    """
    roll, (start, end) = slots.roll, assembly.roll_limits
    gap = 0.0 * roll
    for order, amplitude, angle in mesh.error_harmonics:
        gap = gap + (amplitude * cos(2.0 * np.pi * order * (slots.phase - begin) + angle))[..., None]
    if mesh.error_table is not None:
        at, error = mesh.error_table
        low, high = minimum(start, end), maximum(start, end)
        check_cover(at, low, high, "mesh.transmission_error.table")
        gap = gap + interpolate(at, error, within(roll, maximum(at[0], low), minimum(at[-1], high)))
    if np.all(slots.side > 0):
        return gap
    backlash = (mesh.backlash or 0.0) * cos(pressure_angle) / cos(assembly.path.pressure_angle(0.0))
    return namespace(gap, backlash).where(slots.side > 0, gap, backlash)


def mesh_table(assembly: Assembly, slots: Slots, motion: Kinematics, elastic: Elasticity) -> MeshCycle:
    """Fill the mesh cycle from kinematics and elasticity at the nodes, (S, N, Q)."""
    start, end = slots.limits
    vanishing = pitch_point(assembly.path)
    return MeshCycle(
        boundary=slots.boundary,
        in_contact=slots.in_contact,
        side=slots.side,
        phase=slots.phase,
        pressure_angle=motion.pressure_angle,
        signed_distance=motion.signed_distance,
        equivalent_radius=1.0 / motion.relative_curvature,
        pinion_speed=motion.pinion_speed,
        gear_speed=motion.gear_speed,
        pinion_pitch_radius=assembly.path.pinion_pitch_radius,
        gear_pitch_radius=assembly.path.gear_pitch_radius,
        pinion_teeth=assembly.drive.pinion.teeth,
        face_width=assembly.common_width,
        contact_ratio=assembly.contact_ratio,
        pitch_point_phase=-start / assembly.pitch_angle,
        roll_start=start,
        roll_end=end,
        pitch_point_length=vanishing.length,
        pitch_point_rate=vanishing.speed_per_radius,
        **elastic._asdict(),
    )


def check_bores(drive: Drive, held: bool) -> None:
    """Raise InputError for a solid body that is held at its bore; traced radii are not checked."""
    for side in SIDES if held else ():
        body = body_of(drive, side)
        if not is_jax(body.bore_radius) and body.bore_radius * body.teeth <= 0:
            raise InputError(
                f"drive.{side}.bore_radius",
                body.bore_radius,
                'with mesh.body = "held" the elastic body is held at its bore',
                'give the radius at which the shaft holds it, or use "free"',
            )


def check_backlash(mesh: MeshData, back: bool) -> None:
    """Raise InputError for back flanks at no distance."""
    if back and mesh.backlash is None:
        raise InputError(
            "mesh.backlash", rule="is needed for the contact of back flanks", remedy="give a length"
        )
