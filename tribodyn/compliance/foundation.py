"""The gear body under its teeth: fillet-foundation compliance and the coupling of two teeth of one body.

A tooth loads its body over the arc of the root circle on which it stands. Sainsot & Velex treat the body as
a plane elastic ring (plane stress) that is held at its bore and loaded there by a uniform axial, a uniform
shear and a linear normal traction, and fit polynomials to the answer for one tooth. `sainsot_velex`
evaluates those; `ring_compliance` solves the same ring exactly, as a Fourier series in Michell's plane
solutions, which gives what the polynomials leave out: how far a load on one tooth moves its neighbour.

The ring held at its bore winds up and shifts as a whole. In motion that is no compliance of a mesh: the
inertia sits in the rim, and torque and force accelerate it. Of a body that is not `held` orders 0 and 1 of
the series are those of `rim.free_shift`, balanced by inertia; all others are the same.

Root loads of a tooth are ordered (N, T, M): N along the tooth's axis, positive outwards; T across it,
positive counter-clockwise; M a counter-clockwise moment about the point where the tooth's axis meets the
root circle.
"""

from typing import Any, Literal

import numpy as np

from tribodyn.compliance.rim import free_shift, free_torsion, pinned_receptance
from tribodyn.numerics.elementary import cos, is_jax, log, maximum, namespace, sin, within
from tribodyn.numerics.shapes import Array, Float

# Sainsot & Velex (2004), table 1: X = A/θ² + B h² + C h/θ + D/θ + E h + F
_POLYNOMIALS = np.array(
    [
        [-5.574e-5, -1.9986e-3, -2.3015e-4, 4.7702e-3, 0.0271, 6.8045],  # L*
        [60.111e-5, 28.100e-3, -83.431e-4, -9.9256e-3, 0.1624, 0.9086],  # M*
        [-50.952e-5, 185.50e-3, 0.0538e-4, 53.300e-3, 0.2895, 0.9236],  # P*
        [-6.2042e-5, 9.0889e-3, -4.0964e-4, 7.8297e-3, -0.1472, 0.6904],  # Q*
    ]
)
#: Ranges over which the polynomials were fitted: root radius over bore radius, half angle of the root, rad.
RADIUS_RATIO_RANGE = (1.4, 7.0)
ROOT_HALF_ANGLE_RANGE = (0.01, 0.12)
#: Where the compliance of a body under its own tooth comes from: the polynomials, or the ring that they fit.
Foundation = Literal["sainsot-velex", "ring"]
#: What a body's deflection counts from: its own mean motion, or the bore, which is held.
Support = Literal["free", "held"]
SELF_HARMONICS = 2048  # a tooth's own compliance: error below 0.3 % for up to 250 teeth (test_foundation)
HARMONICS = 256  # neighbours: error below 1e-3 of the own compliance for up to 150 teeth (test_foundation)
#: Root radius over bore radius at which the polynomials count for a free body. Less its wind-up and shift a
#: body does not depend on larger ones, but the polynomials do, by their error: 1 to 5 % of the ring's
#: deflection at 2.5, up to 60 % at 7 (test_free_body).
FREE_RATIO_RANGE = (1.4, 2.5)
# Bore over root radius below which orders from 2 on do not change any more, by 1e-8 of order 2.
_SMALLEST_BORE = 1e-4


def sainsot_velex(
    radius_ratio: Float[Array, "..."], root_half_angle: Float[Array, "..."]
) -> tuple[Float[Array, "..."], Float[Array, "..."], Float[Array, "..."], Float[Array, "..."]]:
    """Coefficients L*, M*, P*, Q* of the fillet-foundation deflection, dimensionless.

    Of h, root radius over bore radius, and θ (rad), half the angle that the tooth's root takes up on the root
    circle. Fitted for 1.4 ≤ h ≤ 7 and 0.01 ≤ θ ≤ 0.12: P. Sainsot, P. Velex, O. Duverger, "Contribution of
    gear body to tooth deflections: a new bidimensional analytical formula", J. Mech. Des. 126 (2004) 748-752,
    eq. (5) and table 1.
    """
    h, angle = radius_ratio, root_half_angle
    terms = (1.0 / angle**2, h**2, h / angle, 1.0 / angle, h, 1.0)
    values = [sum(c * term for c, term in zip(row, terms, strict=True)) for row in _POLYNOMIALS.tolist()]
    return values[0], values[1], values[2], values[3]


def outside_fitted_range(radius_ratio: float | None, root_half_angle: float) -> list[str]:
    """Say which arguments of `sainsot_velex` lie outside the range of the fit; none: it is inside.

    Without a radius ratio: of a free body, whose polynomials never leave its range.
    """
    ranges = (
        ("root radius over bore radius", radius_ratio or RADIUS_RATIO_RANGE[0], RADIUS_RATIO_RANGE, ""),
        ("half angle of the root", root_half_angle, ROOT_HALF_ANGLE_RANGE, " rad"),
    )
    return [
        f"{name} {value:.3g}{unit}, fitted from {low:g} to {high:g}"
        for name, value, (low, high), unit in ranges
        if not low <= value <= high
    ]


def foundation_compliance(
    load_angle: Float[Array, "*contact"],
    lever: Float[Array, "*contact"],
    root_radius: Float[Array, ""],
    bore_radius: Float[Array, ""],
    root_half_angle: Float[Array, ""],
    youngs_modulus: Float[Array, ""],
    width: Float[Array, ""],
) -> Float[Array, "*contact"]:
    """Deflection of the loaded tooth along the load against the bore, m/N: the polynomials.

    Sainsot & Velex (2004), eq. (4), with S = 2 θ r_root. The load angle (rad) is that between the force and
    the perpendicular of the tooth's axis, the lever u (m) the distance along this axis from the root circle
    to the line of the force.
    """
    l_star, m_star, p_star, q_star = sainsot_velex(root_radius / bore_radius, root_half_angle)
    ratio = lever / (2.0 * root_half_angle * root_radius)
    across, along = cos(load_angle) ** 2, sin(load_angle) ** 2
    shape = across * (l_star * ratio**2 + m_star * ratio + p_star) + along * p_star * q_star
    return shape / (youngs_modulus * width)


def ring_foundation(
    root_load: Float[Array, "*contact 3"],
    root_radius: Float[Array, ""],
    bore_radius: Float[Array, ""],
    root_half_angle: Float[Array, ""],
    youngs_modulus: Float[Array, ""],
    poisson_ratio: Float[Array, ""],
    width: Float[Array, ""],
    held: bool = False,
    tip_ratio: Float[Array, ""] = 1.0,
) -> Float[Array, "*contact"]:
    """Deflection of the loaded tooth along the load by the exact ring, m/N; for any bore < root radius.

    The root load (..., 3) is (N, T, M/root radius) per unit normal load.
    """
    ratio = bore_radius / root_radius
    ring = ring_compliance(
        0.0, root_half_angle, ratio, poisson_ratio, SELF_HARMONICS, None, None, held, tip_ratio
    )
    shape = namespace(root_load, ring).einsum("...i,ij,...j->...", root_load, ring, root_load)
    return shape / (youngs_modulus * width)


def free_foundation(
    root_load: Float[Array, "*contact 3"],
    load_angle: Float[Array, "*contact"],
    lever: Float[Array, "*contact"],
    root_radius: Float[Array, ""],
    bore_radius: Float[Array, ""],
    root_half_angle: Float[Array, ""],
    youngs_modulus: Float[Array, ""],
    poisson_ratio: Float[Array, ""],
    width: Float[Array, ""],
    *,
    tip_ratio: Float[Array, ""] = 1.0,
) -> Float[Array, "*contact"]:
    """Deflection of the loaded tooth along the load against its free body's mean motion, m/N: polynomials.

    `foundation_compliance` less what orders 0 and 1 of the ring that it fits have in it, and more by those of
    the free ring. Radius ratios outside FREE_RATIO_RANGE count as its ends in the polynomials.
    """
    fitted = within(bore_radius / root_radius, *(1.0 / ratio for ratio in reversed(FREE_RATIO_RANGE)))
    against_bore = foundation_compliance(
        load_angle, lever, root_radius, fitted * root_radius, root_half_angle, youngs_modulus, width
    )
    free, bound = (
        ring_compliance(0.0, root_half_angle, ratio, poisson_ratio, 1, None, None, held, tip_ratio)
        for ratio, held in ((bore_radius / root_radius, False), (fitted, True))
    )
    change = namespace(root_load, free).einsum("...i,ij,...j->...", root_load, free - bound, root_load)
    return against_bore + change / (youngs_modulus * width)


def ring_compliance(
    angle: Float[Array, ""],
    root_half_angle: Float[Array, ""],
    bore_ratio: Float[Array, ""],
    poisson_ratio: Float[Array, ""],
    harmonics: int = HARMONICS,
    pins: float | None = None,
    around: bool | None = None,
    held: bool = False,
    tip_ratio: Float[Array, ""] = 1.0,
) -> Float[Array, "3 3"]:
    """Compliance between the root loads of two teeth of one body.

    Exact for a ring in plane stress from the bore radius, over the root radius, `bore_ratio`. Its shape is
    fixed at the bore, or around the teeth (a ratio above 1) at its outside, on `pins` there (`rim`) or, with
    0, free as `_ring_receptance` has it (`around` says so where the ratio is traced). As a whole it is `held`
    there (the ratio is not 0), or else free (`rim.free_shift`), whatever the rim, with teeth up to the tip
    radius, over the root radius, `tip_ratio`. Each tooth loads its arc of the root circle with uniform (N, T)
    and linear (M) traction along its own axes; displacements are the work conjugates (means over the arc).
    Truncated after `harmonics` terms: the self term (angle 0) converges like (harmonics · root_half_angle)^−2
    and needs about 40/root_half_angle of them, the term between two teeth converges faster.

    c[i, j] E b is displacement i of the tooth at 0 from load j on the tooth at `angle` (rad, counter-
    clockwise), times Young's modulus and width, in units of the root radius: loads (N, T, M/r_root),
    displacements (m, m, rad · r_root). The transpose is the compliance at −angle (reciprocity).

    N. I. Muskhelishvili, Some Basic Problems of the Mathematical Theory of Elasticity, §§ 41, 59 (potentials
    φ, ψ; the ring); J. R. Barber, Elasticity, ch. 8 (the same as Michell's series).
    """
    xp = namespace(angle, root_half_angle, bore_ratio, poisson_ratio)
    order = np.arange(harmonics + 1.0)
    if pins:
        receptance = pinned_receptance(order, bore_ratio, poisson_ratio, round(pins))
        receptance = receptance * (1.0 + poisson_ratio)
    else:
        bore = maximum(bore_ratio, _SMALLEST_BORE)
        receptance = _ring_receptance(order, bore, poisson_ratio, pins == 0, around)
    if not held:
        radial = receptance[0, 0, 0]
        torsion = free_torsion(bore_ratio, tip_ratio) * (1.0 + poisson_ratio)
        turned = xp.stack([xp.stack([radial, 0.0 * radial]), xp.stack([0.0 * radial, torsion])])
        moved = free_shift(bore_ratio, poisson_ratio, tip_ratio) * (1.0 + poisson_ratio)
        receptance = xp.concatenate([xp.stack([turned, moved]), receptance[2:]])
    loads = _root_loads(order, root_half_angle)
    weight = np.where(order == 0, 0.5, 1.0) * np.pi
    products = xp.einsum("jna,nab,inb->nji", loads, receptance, loads) * weight[:, None, None]
    even, odd = xp.cos(order * angle), xp.sin(order * angle)
    same_parity = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 1.0, 1.0]])
    opposite = np.array([[0.0, -1.0, -1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    return (
        xp.einsum("n,nji->ji", even, products) * same_parity
        + xp.einsum("n,nji->ji", odd, products) * opposite
    )


def _root_loads(order: Float[Array, " order"], angle: Float[Array, ""]) -> Float[Array, "3 order 2"]:
    """Fourier amplitudes (3, n, 2) of unit root loads on |θ| < angle of a circle of radius 1.

    N is even, (radial cos nθ, tangential sin nθ); T and M are odd, (radial sin nθ, −tangential cos nθ), so
    that one receptance serves both. The traction of M is normal to the tooth's base, proportional to the
    distance from its axis; T is moved from the centroid of the arc, sin θ/θ, to the root circle by a moment.
    """
    xp = namespace(angle)

    def integral(n: Float[Array, " order"]) -> Float[Array, " order"]:  # ∫ cos nθ over half the arc
        return angle * xp.sinc(n * angle / np.pi)

    below, above = integral(order - 1.0), integral(order + 1.0)
    uniform = 0.5 / (np.pi * angle)
    axial = xp.stack([uniform * (below + above), -uniform * (below - above)], axis=-1)
    across = xp.stack([uniform * (below - above), -uniform * (below + above)], axis=-1)
    low, middle, high = integral(order - 2.0), integral(order), integral(order + 2.0)
    linear = 0.5 / (np.pi * (angle - xp.sin(angle) * xp.cos(angle)))
    moment = xp.stack([-linear * (low - high), -linear * (2.0 * middle - low - high)], axis=-1)
    across = across + (1.0 - xp.sin(angle) / angle) * moment
    return xp.stack([axial, across, moment])


def _ring_receptance(
    order: Float[Array, " order"],
    bore: Float[Array, ""],
    poisson_ratio: Float[Array, ""],
    free: bool = False,
    around: bool | None = None,
) -> Float[Array, "order 2 2"]:
    """Displacement amplitudes (n, 2, 2) at radius 1 per traction amplitude, for E = 1, ring fixed at `bore`.

    Four plane solutions for each order: two that grow outwards, written in r, and two that decay, written in
    bore/r, so that no power overflows; the fixed bore gives the latter in terms of the former. A ring around
    the circle, bore > 1, is fixed at its outside, or free there but for what orders 0 and 1 move as a whole;
    then those are written in r/bore and 1/r, and the traction acts on its inside.
    """
    xp = namespace(bore, poisson_ratio)
    kappa = (3.0 - poisson_ratio) / (1.0 + poisson_ratio)
    ones = np.ones_like(order)
    first = order == 1
    n = np.where(order < 1, 2.0, order)  # order 0 is put in at the end
    grow, fade = n + 1.0, 1.0 - n  # exponents of φ = z^m; ψ has m = n − 1 and −n − 1

    outward = _columns(xp, (kappa - grow, kappa + grow), (-ones, ones))
    outward_stress = _columns(xp, (grow * (3.0 - grow), grow * (grow - 1.0)), (1.0 - n, n - 1.0))
    # for n = 1, φ = ln z, ψ = −κ ln z take the place of φ = z^0: the net force
    bent = 2.0 * kappa * log(bore)
    near = (xp.where(first, bent - 1.0, kappa - fade), xp.where(first, -bent - 1.0, -kappa - fade))
    far = (xp.where(first, -1.0, kappa - fade), xp.where(first, -1.0, -kappa - fade))
    far_stress = (
        xp.where(first, 3.0 + kappa, fade * (3.0 - fade)),
        xp.where(first, 1.0 - kappa, -fade * (fade - 1.0)),
    )
    inward_bore = _columns(xp, near, (-ones, -ones))
    inward = _columns(xp, far, (-ones, -ones))
    inward_stress = _columns(xp, far_stress, (n + 1.0, n + 1.0))
    if around is None:
        around = not is_jax(bore) and float(bore) > 1.0
    size = 1.0 / bore if around else bore
    slow, fast = size ** (n - 1.0), size ** (n + 1.0)
    inwards, outwards = (
        xp.stack([slow, fast], axis=-1)[:, None, :],
        xp.stack([fast, slow], axis=-1)[:, None, :],
    )
    if around:
        held_in, held_out = inward_bore, outward
        if free:  # stresses take the place of displacements; of solutions in r over those at its own scale
            by = (first | (order < 1))[:, None, None]
            held_in = xp.where(by, inward_bore, inward_stress)
            held_out = xp.where(by, outward, outward_stress)
        follow = -_inverse(xp, held_out) @ (held_in * inwards)
        outward, outward_stress = outward * outwards, outward_stress * outwards
        receptance = -(inward + outward @ follow) @ _inverse(xp, inward_stress + outward_stress @ follow)
    else:
        inward, inward_stress = inward * inwards, inward_stress * inwards
        follow = -_inverse(xp, inward_bore) @ (outward * outwards)
        receptance = (outward + inward @ follow) @ _inverse(xp, outward_stress + inward_stress @ follow)
    radial = (kappa - 1.0) * (1.0 - bore**2) / (2.0 + (kappa - 1.0) * bore**2)
    torsion = 1.0 / bore**2 - 1.0
    if around:
        radial, torsion = -radial, -torsion
    breathing = xp.stack([xp.stack([radial, 0.0 * radial]), xp.stack([0.0 * torsion, torsion])])
    receptance = xp.where((order == 0)[:, None, None], breathing, receptance)
    return receptance * (1.0 + poisson_ratio)  # 2 G = E/(1 + ν)


def _columns(
    xp: Any,
    first: tuple[Float[Array, " order"], Float[Array, " order"]],
    second: tuple[Float[Array, " order"], Float[Array, " order"]],
) -> Float[Array, "order 2 2"]:
    """Matrices (n, 2, 2) from two columns, each (radial, tangential)."""
    return xp.stack(
        [xp.stack([first[0], second[0]], axis=-1), xp.stack([first[1], second[1]], axis=-1)], axis=-2
    )


def _inverse(xp: Any, matrix: Float[Array, "order 2 2"]) -> Float[Array, "order 2 2"]:
    """Inverses of 2 × 2 matrices, written out: cheaper than LAPACK in a batch of drives."""
    a, b, c, d = matrix[:, 0, 0], matrix[:, 0, 1], matrix[:, 1, 0], matrix[:, 1, 1]
    determinant = (a * d - b * c)[:, None, None]
    return _columns(xp, (d, -c), (-b, a)) / determinant
