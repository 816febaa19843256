"""Load contact model: which pairs touch, and how they share the load, from finite elements and Hertz.

The pairs j that can touch have

    ξ cos α_j − g_j = Σ_k λ_jk F_k + u_1(F_j) + u_2(F_j),   F_j ≥ 0,
    Σ F_j [H_gj ± μ_j L_gj] = T_g   (− before the pitch point),

with ξ = r_p θ_p − r_g θ_g, the gap g of the tips' corners outside the path of contact and of modified
flanks, the compliances λ of both gears (own: below the surface; of neighbours: through the body) and
Weber-Banaschek's deflection u between there and the surface (A. Diez-Ibarbia et al.; A. Fernández del Rincón
et al., Mech. Mach. Theory 61 (2013) 30). Where gaps vary along the face, the same holds for every slice of
every pair (`slices`).
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.fem.cache import cached_gear_compliance
from tribodyn.compliance.fem.gear_compliance import ElasticGear, meshed_bore
from tribodyn.compliance.local import hertz_half_width, weber_banaschek
from tribodyn.compliance.sharing.active_set import press
from tribodyn.compliance.sharing.flank_gap import flank_gap, oblique_gap
from tribodyn.compliance.sharing.oblique import oblique_compliance
from tribodyn.compliance.sharing.pinned import check_even, on_pins
from tribodyn.compliance.sharing.section import (
    ObliqueFaces,
    elastic_section,
    is_helical,
    length_per_width,
    oblique_faces,
)
from tribodyn.compliance.sharing.slices import PairFlexibility, slice_compliance
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.corner_contact import PairGeometry, part_of
from tribodyn.geometry.drive import SIDES, MaterialData, Side, body_of
from tribodyn.geometry.helix import face_positions, pitch_slope, roll_shift
from tribodyn.geometry.modification import UNMODIFIED, Modifications
from tribodyn.geometry.path import pitch_point
from tribodyn.numerics.elementary import sense
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.processes.work import steps
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.tribology.contact import averaged_radius

#: Depth of the local region, in modules, and refinement of the mesh: together within 0.1 % of their limits
#: (test_load_contact).
DEPTH = 0.25
LEVEL = 2

#: Entries of the systems solved at a time: 16 MB, and a few times that while they are solved.
ENTRIES = 2_000_000


class SharedLoad(NamedTuple):
    """State of the mesh; arrays over (position, pair, slice) unless said otherwise."""

    slice_load: Float[Array, "position pair slice"]  # N, ≥ 0
    deflection: Float[Array, " position"]  # (position,), ξ = r_p θ_p − r_g θ_g, m
    #: m ξ cos α − g less what the other slices' loads deflect: what a slice's own load takes up where it is
    #: positive; the distance still open where negative.
    overlap: Float[Array, "position pair slice"]
    contact_deflection: Float[Array, "position pair slice"]  # m u_1 + u_2.
    stiffness: Float[Array, " position"]  # (position,), dT_g/dξ of what touches, N m/m

    @property
    def normal_load(self) -> Float[Array, "position pair"]:
        """Loads of the pairs (position, pair), N."""
        return np.sum(self.slice_load, axis=-1)


def flexibility(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    depth: float = DEPTH,
    level: int = LEVEL,
    lead: bool = False,
    held: bool = False,
) -> PairFlexibility:
    """Finite elements of both gears, from the cache where they have been solved before.

    The assembly is checked (`limits.checks`); the depth of the local region is in modules. With `lead` also
    for loads that vary along the teeth, with free end faces, and with root stress. Bodies are free, or `held`
    at their bores, which are > 0 then.
    """
    section = elastic_section(assembly)
    drive = section.drive
    width = float(assembly.common_width)
    if lead:
        check_even(assembly)
    gears = [
        cached_gear_compliance(
            elastic_gear(section, side, material, depth, level, held),
            width * length_per_width(assembly) if lead else None,
        )
        for side, material in steps(list(zip(SIDES, materials, strict=True)))
    ]
    for at, side in enumerate(SIDES):
        if body_of(drive, side).pins:
            gears[at] = on_pins(gears[at], section, side, materials[at], held)
    return PairFlexibility(assembly, materials, width, (gears[0], gears[1]))


def elastic_gear(
    section: Assembly,
    side: Side,
    material: MaterialData,
    depth: float = DEPTH,
    level: int = LEVEL,
    held: bool = True,
) -> ElasticGear:
    """What the finite elements of a gear are of, in its elastic section; else as `flexibility`."""
    body, tooth = body_of(section.drive, side), section.tooth(side)
    teeth, bore = round(float(body.teeth)), meshed_bore(body, tooth, held)
    near = depth * float(section.drive.module)
    return ElasticGear(tooth, teeth, bore, material.poisson_ratio, near, level, body.pins == 0, held)


def contact_deflection(
    flexible: PairFlexibility, curvature: Float[Array, "..."], line_load: Float[Array, "..."]
) -> tuple[Float[Array, "..."], Float[Array, "..."]]:
    """Local deflection u_1 + u_2 (m) under line loads (N/m, ≥ 0), and its derivative, m per N/m.

    The relative curvature of the flanks (1/m) broadcasts with the loads.
    """
    half = half_width(flexible, curvature, line_load)
    total, slope = np.zeros_like(half), np.zeros_like(half)
    for gear, material in zip(flexible.gears, flexible.materials, strict=True):
        value, rate = weber_banaschek(line_load, half, gear.depth, material)
        total, slope = total + value, slope + rate
    return total, slope


def half_width(
    flexible: PairFlexibility, curvature: Float[Array, "..."], line_load: Float[Array, "..."]
) -> Float[Array, "..."]:
    """Half width of the contact, m, under line loads (N/m); curvature as in `contact_deflection`."""
    # Where the flanks' radii vanish, at the pitch point of a cycloid, the contact's own width sees more of
    # them. The slope of the deflection is not quite Newton's there; the steps still settle.
    modulus = 2.0 / sum((1.0 - m.poisson_ratio**2) / m.youngs_modulus for m in flexible.materials)
    vanishing = pitch_point(flexible.assembly.path).length
    radius = averaged_radius(1.0 / curvature, line_load, modulus, vanishing)
    return hertz_half_width(line_load, 1.0 / radius, *flexible.materials)


def in_batches(shape: tuple[int, ...]) -> list[slice]:
    """Part positions of arrays (position, pair, slice) so that the systems of a part bound the memory."""
    positions, pairs, slices = shape
    most = max(1, ENTRIES // (pairs * slices) ** 2)
    return [slice(first, min(positions, first + most)) for first in range(0, positions, most)]


def press_slices(
    flexible: PairFlexibility,
    curvature: Float[Array, "position pair slice"],
    contact_length: Float[Array, "position pair slice"],
    compliance: Float[Array, "position pair slice pair slice"],
    arm: Float[Array, "position pair slice"],
    lever: Float[Array, "position pair slice"],
    gap: Float[Array, "position pair slice"],
    torque: Float[Array, " position"],
) -> SharedLoad:
    """Share torques (position,) among slices, each with its own geometry and length of contact (m)."""
    positions = len(gap)
    flat = [field.reshape(positions, -1) for field in (curvature, contact_length, arm, lever, gap)]
    bent, length, arms, levers, gaps = flat
    places = gaps.shape[1]

    def local(
        chosen: Int[Array, " row"], load: Float[Array, "row place"]
    ) -> tuple[Float[Array, "row place"], Float[Array, "row place"]]:
        value, slope = contact_deflection(flexible, bent[chosen], load / length[chosen])
        return value, slope / length[chosen]

    matrix = compliance.reshape(positions, places, places)
    load, deflection, overlap, stiffness = press(matrix, local, arms, levers, gaps, torque)
    load = load.reshape(gap.shape)
    approach, _ = contact_deflection(flexible, curvature, load / contact_length)
    return SharedLoad(load, deflection, overlap.reshape(gap.shape), approach, stiffness)


def extended_rolls(
    assembly: Assembly, limits: tuple[float, float], positions: int
) -> Float[Array, "position pair"]:
    """Roll angles (position, pair) over one pitch of all pairs between the limits."""
    pitch = assembly.pitch_angle
    count = int(np.ceil((limits[1] - limits[0]) / pitch))
    phase = (np.arange(positions) + 0.5) / positions
    return limits[0] + pitch * (phase[:, None] + np.arange(count - 1, -1, -1))


def effective_contact_ratio(roll: Float[Array, "position pair"], shared: SharedLoad, pitch: float) -> float:
    """Pinion angle over which one pair carries load, over the pitch.

    `roll` (position, pair) covers one pair's whole history once, as made by `extended_rolls`. Both ends are
    where the overlap passes zero, interpolated.
    """
    order: Any = np.argsort(roll, axis=None)
    angle, overlap = roll.ravel()[order], np.max(shared.overlap, axis=-1).ravel()[order]
    inside = np.flatnonzero(overlap > 0.0)
    ends = []
    for here, there in ((inside[0], inside[0] - 1), (inside[-1], inside[-1] + 1)):
        share = overlap[here] / (overlap[here] - overlap[there])
        ends.append(angle[here] + share * (angle[there] - angle[here]))
    return float((ends[1] - ends[0]) / pitch)


class LoadedFlanks(NamedTuple):
    """What the load contact model needs to know except position, load and friction."""

    flexible: PairFlexibility  # with `lead` where slices hold each other
    modifications: Modifications = UNMODIFIED  # of flanks and axes
    slices: int = 1  # equal slices of the face
    coupled: bool = True  # whether slices hold each other through the teeth and bodies

    def face(self) -> Float[Array, " slice"]:
        """Middles of the slices, m from the middle of the face."""
        return face_positions(self.flexible.width, self.slices)

    def gap(self, geometry: PairGeometry) -> Float[Array, "*pair slice"]:
        """What modifications and misalignment leave open, `flank_gap`, m; pitch errors apart.

        Of a helical pair the geometry is that at `rolls`.
        """
        if is_helical(self.flexible.assembly):
            slope = pitch_slope(assembly := self.flexible.assembly)
            return oblique_gap(assembly, self.modifications, geometry, self.face(), slope)
        return flank_gap(self.flexible.assembly, self.modifications, geometry, self.face())

    def rolls(self, roll: Float[Array, "*pair"]) -> Float[Array, "..."]:
        """Pinion angles at which pairs touch, rad: themselves; of helical pairs the slices', (…, slice).

        No further than a pitch outside the path, where nothing touches.
        """
        assembly = self.flexible.assembly
        if not is_helical(assembly):
            return roll
        (start, end), pitch = assembly.roll_limits, assembly.pitch_angle
        late = roll[..., None] - np.asarray(roll_shift(assembly, self.face()))
        return np.clip(late, start - pitch, end + pitch)

    def contacts(
        self, roll: Float[Array, "position pair"], friction_coefficient: Float[Array, "..."] | float = 0.0
    ) -> ObliqueFaces:
        """Where the slices of pairs touch; of spur gears all of a pair are alike, (position, pair, 1)."""
        rolls = self.rolls(roll)
        rolls = rolls if rolls.ndim == 3 else rolls[..., None]
        return oblique_faces(self.flexible.assembly, rolls, friction_coefficient)

    def geometry(self, faces: ObliqueFaces) -> PairGeometry:
        """What `gap` takes of `contacts`: of spur gears that of the pairs, (position, pair)."""
        if is_helical(self.flexible.assembly):
            return faces.geometry
        return part_of(faces.geometry, np.s_[..., 0])

    def compliance(self, faces: ObliqueFaces, rows: slice) -> Float[Array, "position pair slice pair slice"]:
        """Λ at some positions of `contacts`, m/N, without the slices' own local deflection."""
        if is_helical(self.flexible.assembly):
            return oblique_compliance(self.flexible, faces.at(rows), self.coupled)
        pairs = part_of(faces.geometry, (rows, ..., 0))
        return slice_compliance(self.flexible, pairs, self.slices, self.coupled)

    @one_blas_thread()
    def share(
        self,
        roll: Float[Array, "position pair"],
        gear_torque: float,
        friction_coefficient: Float[Array, "..."] | float = 0.0,
        gap: Float[Array, "..."] | None = None,
    ) -> SharedLoad:
        """Share the gear's torque among the pairs that can touch, and along their faces.

        Raises SimulationError if no state of contact is found.

        Parameters
        ----------
        roll : pinion angles of the pairs from the pitch point, rad, one pitch apart, the pair that entered
            first in front; enough of them on either side of the path for all that the load can make touch
        gear_torque : T_g > 0, N m
        friction_coefficient : μ of the pairs; < 0 where the gear drives, for the flanks then slide the other
            way
        gap : what is missing between the flanks beside the corners' gap, m; default: that of `gap`
        """
        faces = self.contacts(roll, friction_coefficient)
        extra = self.gap(self.geometry(faces)) if gap is None else np.asarray(gap, dtype=float)
        extra = extra if extra.ndim == 3 else extra[..., None]
        shape = (*roll.shape, self.slices)
        length = self.flexible.width / self.slices * faces.length
        gear_sense = sense(self.flexible.assembly.path.gear_pitch_radius)
        curvature, length, arm, lever, whole = (
            np.broadcast_to(field, shape)
            for field in (
                faces.curvature,
                length,
                faces.arm,
                gear_sense * faces.lever,
                faces.corner_gap + extra,
            )
        )
        parts = [
            press_slices(
                self.flexible,
                curvature[rows],
                length[rows],
                self.compliance(faces, rows),
                arm[rows],
                lever[rows],
                whole[rows],
                np.full(len(roll[rows]), float(gear_torque)),
            )
            for rows in in_batches(shape)
        ]
        return SharedLoad(*(np.concatenate(field) for field in zip(*parts, strict=True)))
