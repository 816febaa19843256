"""Compliance of a pair of teeth by the energy method, on the outline that the rack really cuts.

A tooth is a beam of varying depth from the root circle, over the generated fillet and the flank, to the
point of contact, bent, sheared and pressed by the normal load (D. C. H. Yang, J. Y. Lin, J. Mech. Trans.
Autom. Des. 109 (1987) 189-196; X. Tian, MSc thesis, Univ. of Alberta 2004, added the shear). Under it the
body deflects (`foundation`), between the teeth the Hertz contact does. Plane stress, small deflections.

Widths: the teeth and the contact carry over the common face width only, which leaves out the help of a
tooth's free ends (on the soft side); each body deflects with its own face width.

Helical teeth: the same in the section normal to the tooth. A tooth bends as a plate about its own slanted
axis: its thickness is cos β times that of the transverse section, its length the face width over cos β, and
the load leans to the radius by its own angle, sin α_n1 = cos β_n sin α_1. (Bent in the transverse plane alone
it would be too stiff, in bending by 1/cos⁴ β, since the axial displacement is free.) β is that on the
reference circle; compliances are along the true normal. Bodies are taken in the normal section too.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.foundation import (
    HARMONICS,
    SELF_HARMONICS,
    Foundation,
    foundation_compliance,
    free_foundation,
    ring_compliance,
    ring_foundation,
)
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import GearBody, MaterialData, Side, body_of
from tribodyn.geometry.helix import pitch_slope
from tribodyn.geometry.path import PerContact, distance_at_radius
from tribodyn.geometry.tooth import (
    Tooth,
    ToothContact,
    contact_in_tooth_frame,
    fillet_point,
    thickness_half_angle,
)
from tribodyn.numerics.elementary import arctan2, cos, is_jax, maximum, namespace, sin, sqrt, tan, within
from tribodyn.numerics.iteration import chebyshev_basis
from tribodyn.numerics.shapes import Array, Float

SHEAR_FACTOR = 1.2  # rectangular section (Timoshenko)
#: Modules by which the teeth thicken the rim of an internal gear where it bends: fitted to finite elements,
#: 0.22 to 0.26 over rims of 2 to 6 modules and 60 to 120 teeth.
RIM_OF_TEETH = 0.24

# Bore over root radius: a smaller one does not change what finite elements answer (test_helical_coupling).
_LEAST_UNEVEN_BORE = 0.3

# Outline pieces are sampled at Chebyshev points and integrated as Chebyshev series. 1/y³ is singular where
# the flanks would meet beyond the tip, so the points of the upper flank crowd towards there: this degree
# leaves 1e-7 or less however thin the tip (test_energy).
_DEGREE = 24
_POINTS = -np.cos(np.pi * np.arange(_DEGREE + 1) / _DEGREE)
_TO_SERIES = np.linalg.inv(np.polynomial.chebyshev.chebvander(_POINTS, _DEGREE))
_EYE = np.eye(_DEGREE + 1)
_SLOPE = np.polynomial.chebyshev.chebvander(_POINTS, _DEGREE - 1) @ np.polynomial.chebyshev.chebder(
    _TO_SERIES
)
_INTEGRAL = np.polynomial.chebyshev.chebint(_EYE, lbnd=-1) @ _TO_SERIES
# The flanks meet no further beyond the tip, it is assumed, than this many lengths of the upper flank.
_FURTHEST_MEETING = 10.0


class ToothCompliance(NamedTuple):
    """Deflection of one tooth and its body along the load, per newton; arrays like r."""

    #: bending, shear, axial: strain energy of the beam, m/N
    bending: PerContact
    shear: PerContact
    axial: PerContact
    foundation: PerContact  # body under the tooth, alone on it, m/N
    #: (..., 3); load on the root circle per unit normal load, (N, T, M/root radius) in the sense of
    #: `foundation`, up to a common sign, with the body turned over so that the loaded flank lies counter-
    #: clockwise
    root_load: Float[Array, "*contact 3"]

    @property
    def total(self) -> PerContact:
        """Sum of the parts, m/N."""
        return self.bending + self.shear + self.axial + self.foundation


def section_integrals(
    x: Float[Array, " point"], y: Float[Array, " point"], origin: Any
) -> Float[Array, "series 4"]:
    """Series (26, 4) of the beam's integrals from the start of a piece of outline up to a point of it.

    Chebyshev coefficients of ∫ (1, s, s²)/(2y³/3) dx and ∫ dx/(2y), s = x − origin: second moment and area of
    the section per width. Their sum is the integral over the whole piece. x and y (25,) are the position
    along the tooth's axis and the half thickness at the piece's Chebyshev points, m.
    """
    xp = namespace(x, y)
    s = x - origin
    moment = 1.5 / y**3
    integrand = xp.stack([moment, moment * s, moment * s**2, 0.5 / y], axis=-1)
    return _INTEGRAL @ (integrand * (_SLOPE @ x)[:, None])


def beam_compliance(
    integrals: Float[Array, "*contact 4"], lever: PerContact, load_angle: PerContact, poisson_ratio: Any
) -> tuple[Any, Any, Any]:
    """Bending, shear and axial compliance of a tooth, times Young's modulus and width.

    The bending moment at s is F cos α_1 (u − s): the line of the load cuts the tooth's axis at u, the lever,
    from the same origin as s, under the angle α_1 (rad) to the perpendicular of the axis. The integrals
    (..., 4) of `section_integrals` are those from the root to the contact.
    """
    across, along = cos(load_angle) ** 2, sin(load_angle) ** 2
    area = integrals[..., 3]
    bending = across * (lever**2 * integrals[..., 0] - 2.0 * lever * integrals[..., 1] + integrals[..., 2])
    return bending, SHEAR_FACTOR * 2.0 * (1.0 + poisson_ratio) * across * area, along * area


class LoadedTooth(NamedTuple):
    """A tooth with what its compliance needs to know of the drive; made once by `loaded_tooth`."""

    tooth: Tooth  # as its rack cuts it
    path: Any  # working path, seen from the body
    #: pitch_half_angle, root_half_angle: half thickness angle on the working pitch circle and on the root
    #: circle, rad
    pitch_half_angle: Any
    root_half_angle: Any
    body: GearBody  # bore and face width
    side: Side  # {"pinion", "gear"} Which of the two.
    #: cosine of β on the reference circle and tan β_w on the pitch circle; None for a spur gear
    helix: tuple[Any, Any] | None = None
    held: bool = False  # whether the body is held at its bore (`foundation.Support`)

    def contact(self, r: PerContact) -> ToothContact:
        """Contact on the tooth at signed distances r in the body's own view, in the normal section."""
        at = contact_in_tooth_frame(self.path, self.pitch_half_angle, r)
        if self.helix is None:
            return at
        thinning, pitch_slope = self.helix
        leaning = pitch_slope * cos(self.path.pressure_angle(r))
        along = sin(at.load_angle) / sqrt(1.0 + leaning**2)
        return ToothContact(at.x, at.y * thinning, arctan2(along, sqrt(1.0 - along**2)))


def loaded_tooth(assembly: Assembly, side: Side, held: bool = False) -> LoadedTooth:
    """Put a tooth to work on the drive's working path, on a free body or one that is held at its bore."""
    tooth, path, beta = assembly.tooth(side), assembly.path_of(side), assembly.drive.helix_angle
    return LoadedTooth(
        tooth=tooth,
        path=path,
        pitch_half_angle=thickness_half_angle(tooth, path.pinion_pitch_radius),
        root_half_angle=tooth.half_angle + tooth.corner_x / tooth.path.pinion_pitch_radius,
        body=body_of(assembly.drive, side),
        side=side,
        helix=(cos(beta), pitch_slope(assembly)) if is_jax(beta) or beta else None,
        held=held,
    )


def under_uneven_load(loaded: LoadedTooth) -> LoadedTooth:
    """The tooth as loads meet it that vary along it and sum up to nothing: whatever accelerates, held.

    The bore that the body is held at then counts little (`coupled_slices`): a smaller one as if it were
    0.3 root radii.
    """
    bore, root = loaded.body.bore_radius, loaded.tooth.root_radius
    if is_jax(loaded.body.teeth) or loaded.body.teeth > 0:
        bore = maximum(bore, _LEAST_UNEVEN_BORE * root)
    return loaded._replace(held=True, body=loaded.body._replace(bore_radius=bore))


def tooth_compliance(
    loaded: LoadedTooth, material: MaterialData, width: Any, r: PerContact, by: Foundation = "sainsot-velex"
) -> ToothCompliance:
    """Compliance of one tooth that is loaded at the signed distances r (m) of the drive.

    `width` (m) is that over which the teeth touch.
    """
    tooth, path, root = loaded.tooth, loaded.path, loaded.tooth.root_radius
    unit = 0.5 + 0.5 * _POINTS
    fillet = fillet_point(tooth, np.pi / 2 + unit * (tooth.form_angle - np.pi / 2))
    root_angle, length, body_length = loaded.root_half_angle, width, loaded.body.face_width
    if loaded.helix is not None:
        thinning = loaded.helix[0]
        fillet = fillet[0], fillet[1] * thinning
        root_angle, length, body_length = root_angle * thinning, width / thinning, body_length / thinning
    first = distance_at_radius(path, tooth.form_radius)
    last = distance_at_radius(path, tooth.tip_radius)
    place = r if loaded.side == "pinion" else -r
    x, y, load_angle = loaded.contact(place)
    lever = x - y * tan(load_angle) - root
    # s counts from the tip: a load near a thin one has a small arm there, where 1/y³ is large
    origin = loaded.contact(last).x
    integrals = section_integrals(*fillet, origin).sum(axis=0)
    # Two pieces of flank, for the paths of some families have a corner at the pitch point.
    middle = within(0.0, first + 0.01 * (last - first), last - 0.01 * (last - first))
    lower = first + unit * (middle - first), 2.0 * (within(place, first, middle) - first) / (middle - first)
    for at, along in (lower, *_towards_tip(loaded, middle, last, place)):
        flank = loaded.contact(at)
        integrals = integrals + chebyshev_basis(along - 1.0, _DEGREE + 1) @ section_integrals(
            flank.x, flank.y, origin
        )
    arm = lever + (root - origin)
    bending, shear, axial = beam_compliance(integrals, arm, load_angle, material.poisson_ratio)
    across = cos(load_angle)
    root_load = namespace(x, lever).stack([sin(load_angle), across, across * lever / root], axis=-1)
    ring = root, loaded.body.bore_radius, root_angle, material.youngs_modulus
    elastic, tip = (material.poisson_ratio, body_length), tooth.tip_radius / root
    if not is_jax(loaded.body.teeth) and loaded.body.teeth < 0:  # the polynomials are of bodies inside
        rim = rim_compliance(loaded, material.poisson_ratio)
        foundation = (root_load @ rim * root_load).sum(-1) / (material.youngs_modulus * body_length)
    elif by == "ring":
        foundation = ring_foundation(root_load, *ring, *elastic, loaded.held, tip)
    elif loaded.held:
        foundation = foundation_compliance(load_angle, lever, *ring, body_length)
    else:
        foundation = free_foundation(root_load, load_angle, lever, *ring, *elastic, tip_ratio=tip)
    scale = 1.0 / (material.youngs_modulus * length)
    return ToothCompliance(scale * bending, scale * shear, scale * axial, foundation, root_load)


def rim_compliance(
    loaded: LoadedTooth, poisson_ratio: float, pitches: int = 0, fitted: bool = False
) -> Float[Array, "3 3"]:
    """Compliance (3, 3) of an internal gear's rim between the root loads of teeth `pitches` apart, times E b.

    As `foundation.ring_compliance`. A rim that bends is thicker by what the teeth stiffen it; `fitted`: the
    same rim with its outside held.
    """
    tooth, body = loaded.tooth, loaded.body
    inside = tooth.root_radius
    if body.pins is not None:
        module = 2.0 * tooth.path.pinion_pitch_radius / body.teeth
        inside = inside + RIM_OF_TEETH * module
    return ring_compliance(
        2.0 * np.pi * pitches / body.teeth,
        loaded.root_half_angle,
        body.bore_radius / inside,
        poisson_ratio,
        HARMONICS if pitches else SELF_HARMONICS,
        None if fitted else body.pins,
        around=True,
        held=loaded.held,
        tip_ratio=tooth.tip_radius / tooth.root_radius,
    )


def _towards_tip(
    loaded: LoadedTooth, start: Any, end: Any, place: PerContact
) -> list[tuple[Float[Array, " point"], PerContact]]:
    """Distances r of the points of the upper flank, and where the contacts stand between them, 0 … 2.

    The distance from where the flanks would meet, by the slope at the tip, falls exponentially, so that 1/y³
    grows so: a series of low degree for a thin tip too. In two pieces, because a series is exact to a share
    of its maximum.
    """
    xp = namespace(place, start, end)
    length = end - start
    step = 1e-3 * length
    near = contact_in_tooth_frame(loaded.path, loaded.pitch_half_angle, xp.stack([end - step, end])).y
    falling = (near[0] - near[1]) / step
    beyond = near[1] / maximum(falling, near[1] / (_FURTHEST_MEETING * length))
    meeting = end + maximum(beyond, 1e-9 * length)
    decay = 0.5 * xp.log((meeting - start) / (meeting - end))
    fall = xp.exp(-decay * (0.5 + 0.5 * _POINTS))
    passed = 2.0 * xp.log((meeting - start) / (meeting - within(place, start, end))) / decay
    furthest = meeting - start
    return [
        (meeting - furthest * fall, within(passed, 0.0, 2.0)),
        (meeting - furthest * fall[-1] * fall, within(passed - 2.0, 0.0, 2.0)),
    ]


def polynomials_over_ring(loaded: LoadedTooth, material: MaterialData) -> float:
    """Body's compliance at the pitch point by Sainsot & Velex's polynomials over that by the exact ring."""
    at = np.zeros(1)
    fitted, ring = (
        tooth_compliance(loaded, material, loaded.body.face_width, at, by).foundation[0]
        for by in ("sainsot-velex", "ring")
    )
    return float(fitted / ring)


def neighbour_coupling(loaded: LoadedTooth, material: MaterialData, pitches: int) -> Float[Array, "3 3"]:
    """Compliance (3, 3) between the root loads of two teeth of one body, per newton.

    Entry [i, j]: displacement i of the tooth that entered later from load j on the one that entered `pitches`
    pitches before it; in the units of `ToothCompliance.root_load`. The pinion drives: its loaded flanks face
    ahead; those of the gear face back, so that the earlier tooth stands on the other side.
    """
    if loaded.body.teeth < 0:
        ring = rim_compliance(loaded, material.poisson_ratio, pitches)
    else:
        ring = ring_compliance(
            2.0 * np.pi * pitches / loaded.body.teeth,
            loaded.root_half_angle,
            loaded.body.bore_radius / loaded.tooth.root_radius,
            material.poisson_ratio,
            held=loaded.held,
            tip_ratio=loaded.tooth.tip_radius / loaded.tooth.root_radius,
        )
    earlier_to_later = ring if loaded.side == "pinion" else ring.T
    return earlier_to_later / (material.youngs_modulus * loaded.body.face_width)


def hertz_linear(first: MaterialData, second: MaterialData, width: Any) -> Any:
    """Linear compliance of a line contact, m/N: Σ 2(1 − ν²)/(π E b), independent of load and curvature.

    For one material 4(1 − ν²)/(π E b) (Yang & Lin 1987, after Hertz); here each body brings its half of it.
    """
    return sum(2.0 * (1.0 - m.poisson_ratio**2) / (np.pi * m.youngs_modulus * width) for m in (first, second))


def hertz_coefficient(first: MaterialData, second: MaterialData, width: Any) -> Any:
    """Coefficient A = 1.275/(E^0.9 b^0.8), m/N^0.9, of the load-dependent deflection δ = A F^0.9.

    Palmgren's power law for rollers in the form usual with the energy method; for two materials E is their
    harmonic mean.
    """
    modulus = 2.0 / (1.0 / first.youngs_modulus + 1.0 / second.youngs_modulus)
    return 1.275 / (modulus**0.9 * width**0.8)
