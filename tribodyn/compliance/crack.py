"""What a crack from the fillet adds to the compliance of a tooth, by the energy that opens it.

A crack of depth a releases the energy dU/da = G b under a load F, so that the tooth gains the compliance

    C = 2/(E' b) ∫ (K_I² + K_II²) da / F²,   E' = E/(1 − ν²)

(G. R. Irwin's relation; so A. D. Dimarogonas, Eng. Fract. Mech. 55 (1996) 831 makes a spring of a crack).
The energy method with a limit line through the crack's tip leaves out the material behind that line instead
(Chaari, Fakhfakh & Haddar, Eur. J. Mech. A 28 (2009) 461; Mohammed, Rantatalo & Aidanpää, Eng. Fail. Anal.
34 (2013) 235, with a parabola): against finite elements with the crack in their mesh a line along the tooth
gives 0.3 to 2.5 times the compliance, a parabola 0.3 to 5 times. No line knows where the tip's field ends.

At every depth the tooth is a strip cracked from its edge: crack a and ligament c, the shortest way from the
tip to the other side's outline, together H wide, under the load's moment M, force N (tension > 0) and shear V
on the ligament's middle. With F_b, F_t, F_II of the cracked strip (H. Tada, P. C. Paris & G. R. Irwin, The
Stress Analysis of Cracks Handbook, 2.10, 2.13, 2.14)

    K_I = [6 M/H² F_b(a/H) + N/H F_t(a/H)] √(πa),   K_II = V/H F_II(a/H) √(πa).

The fillet concentrates the stress. What its peak, by form and stress correction factor of ISO 6336-3 at the
crack's mouth, has more than the strip is a stress A [exp(−x/λ) − c_0 − c_1 x] without force or moment on the
section, which falls with the gradient of notches, 2/ρ of the peak (E. Siebel); its K_I follows from
Bueckner's weight function for the strip (Z. Angew. Math. Mech. 50 (1970) 529). Where the crack leaves the
ligament's direction by θ, G falls by cos⁴(θ/2) (B. Cotterell & J. R. Rice, Int. J. Fract. 16 (1980) 155);
where it leaves the normal of the fillet by η, the peak counts by cos² η.

Loads on the crack's own flank open it. A load on the other flank closes it, and the tooth is then sound.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.energy import LoadedTooth
from tribodyn.geometry.drive import MaterialData
from tribodyn.geometry.path import distance_at_radius
from tribodyn.geometry.tooth import fillet_point, fillet_tangent
from tribodyn.numerics.shapes import Array, Float

#: Depths, in shares of the crack's, over which its energy is summed.
_STEPS = 120
_OUTLINE = 1500
_GAUSS, _WEIGHTS = (0.5 * part for part in np.polynomial.legendre.leggauss(16))
_GAUSS = _GAUSS + 0.5
_HALVINGS = 60


class Crack(NamedTuple):
    """A straight crack in the section normal to the tooth, from the fillet of the loaded flank."""

    depth: float  # m, along the crack
    angle: float  # to the tooth's axis, rad; 0 would lead along it into the body
    #: angle between the tooth's axis and the fillet's tangent where it starts, rad
    tangent: float


class Mouth(NamedTuple):
    """Where a crack starts."""

    place: Float[Array, " 2"]  # in the tooth's frame, m
    radius: float  # of the fillet there, m


def tangent_limits(loaded: LoadedTooth) -> tuple[float, float]:
    """Smallest and largest angle (rad) between the tooth's axis and the tangent of its fillet."""
    _, leaning = _fillet_slopes(loaded)
    return float(leaning.min()), float(leaning.max())


def mouth(loaded: LoadedTooth, tangent: float) -> Mouth:
    """Place of the fillet that has this tangent."""
    normal, leaning = _fillet_slopes(loaded)
    order = np.argsort(leaning)
    at = np.interp(tangent, leaning[order], normal[order])
    x, y = fillet_point(loaded.tooth, at)
    slope, thin = fillet_tangent(loaded.tooth, at), thinning(loaded)
    speed = abs(slope.rate) * np.hypot(np.cos(slope.angle), thin * np.sin(slope.angle))
    radius = speed**3 / (thin * slope.rate**2 * abs(slope.turning))
    return Mouth(np.array([float(x), float(y) * thin]), float(radius))


def root_thickness(loaded: LoadedTooth, tangent: float) -> float:
    """Thickness of the tooth (m) where its fillet has this tangent; with 30 degrees ISO 6336-3's chord."""
    return 2.0 * float(mouth(loaded, tangent).place[1])


def ligament_to_bore(loaded: LoadedTooth, crack: Crack) -> float:
    """Distance (m) of the crack's tip from the bore; < 0 in it."""
    along = np.array([-np.cos(crack.angle), -np.sin(crack.angle)])
    tip = mouth(loaded, crack.tangent).place + crack.depth * along
    return float(np.sign(tip[0]) * np.hypot(*tip) - loaded.body.bore_radius)


def thinning(loaded: LoadedTooth) -> float:
    """Thickness of the section normal to the tooth over that of the transverse one."""
    return 1.0 if loaded.helix is None else float(loaded.helix[0])


def half_outline(loaded: LoadedTooth) -> tuple[Float[Array, "point 2"], Float[Array, "point 2"], Any]:
    """Fillet, from the root circle, and flank (point, 2) on the side y > 0, m; distances r of the latter.

    These are the body's own.
    """
    tooth, thin = loaded.tooth, np.array([1.0, thinning(loaded)])
    along = np.linspace(0.0, 1.0, _OUTLINE)
    fillet = fillet_point(tooth, np.pi / 2 + along * (tooth.form_angle - np.pi / 2))
    first, last = (float(distance_at_radius(loaded.path, r)) for r in (tooth.form_radius, tooth.tip_radius))
    distance = first + along * (last - first)
    at = loaded.contact(distance)
    return np.stack(fillet, axis=-1) * thin, np.stack([at.x, at.y], axis=-1), distance


def crack_compliance(
    loaded: LoadedTooth,
    material: MaterialData,
    width: float,
    r: Float[Array, " contact"],
    crack: Crack,
    depths: Float[Array, " depth"],
) -> Float[Array, "depth contact"]:
    """Compliance (m/N) along the normal that a crack over the whole width adds, at some of its depths.

    `r` are distances of the mesh (m), `width` (m) that over which the teeth touch. To half the root's
    thickness and over the upper half of the flank, the drop of a pair's stiffness lies within a tenth of that
    by finite elements, or 1.5 % of the stiffness, for a crack normal to the fillet, and within a quarter for
    one square to the tooth's axis; near the foot of the flank within 6 % of the stiffness
    (`tests/unit/compliance/test_crack.py`). Beyond that depth it is extrapolated.
    """
    start = mouth(loaded, crack.tangent)
    a = crack.depth * np.arange(_STEPS + 1) / _STEPS
    a[0] = 1e-6 * crack.depth
    along = np.array([-np.cos(crack.angle), -np.sin(crack.angle)])
    tip = start.place + a[:, None] * along
    across, ligament = _ligament(loaded, tip)
    width_h = a + ligament
    up = np.stack([-across[:, 1], across[:, 0]], axis=-1)  # towards the tooth's tip

    at = loaded.contact(np.asarray(r) if loaded.side == "pinion" else -np.asarray(r))
    load = np.stack([-np.sin(at.load_angle), -np.cos(at.load_angle)], axis=-1)
    normal, shear = load @ up.T, load @ across.T  # (contact, step)
    arm = np.stack([at.x, at.y], axis=-1)[:, None] - (tip + across * ligament[:, None] / 2.0)
    about_ligament = arm[..., 1] * load[:, None, 0] - arm[..., 0] * load[:, None, 1]
    moment = about_ligament - normal * a / 2.0

    share, root = a / width_h, np.sqrt(np.pi * a)
    strip = 6.0 * moment / width_h**2 * _bent(share) + normal / width_h * _pulled(share)
    nominal = 6.0 * moment[:, 0] / width_h[0] ** 2 + normal[:, 0] / width_h[0]
    peak = _peak(start, at) * np.cos(crack.angle - (np.pi / 2 - crack.tangent)) ** 2
    opening = strip * root + _notch(peak, nominal, start.radius, a, width_h)
    sliding = shear / width_h * _sheared(share) * root

    turned = np.arccos(np.clip(across @ along, -1.0, 1.0))
    released = (opening**2 + sliding**2) * np.cos(turned / 2.0) ** 4
    summed = np.cumsum(0.5 * (released[:, 1:] + released[:, :-1]) * np.diff(a), axis=1)
    summed = np.concatenate([np.zeros((len(summed), 1)), summed], axis=1)
    length = width / thinning(loaded)
    scale = 2.0 * (1.0 - material.poisson_ratio**2) / (material.youngs_modulus * length)
    return scale * np.stack([np.interp(depths, a, row) for row in summed], axis=-1)


def _fillet_slopes(loaded: LoadedTooth) -> tuple[Float[Array, " point"], Float[Array, " point"]]:
    """Angles of the tool's normal along the fillet, and of the fillet's tangent to the tooth's axis, rad."""
    normal = np.linspace(np.pi / 2, float(loaded.tooth.form_angle), _OUTLINE)
    angle = np.asarray(fillet_tangent(loaded.tooth, normal).angle)
    return normal, np.arctan2(thinning(loaded) * np.sin(angle), np.cos(angle))


def _ligament(
    loaded: LoadedTooth, tip: Float[Array, "step 2"]
) -> tuple[Float[Array, "step 2"], Float[Array, " step"]]:
    """Direction and length (m) of the shortest way from the crack's tip to the other side's outline."""
    fillet, flank, _ = half_outline(loaded)
    pitch, root = np.pi / loaded.body.teeth, float(loaded.tooth.root_radius)
    foot = np.arctan2(np.sign(root) * fillet[0, 1], np.sign(root) * fillet[0, 0])
    gap = np.linspace(pitch, foot, 200)
    circle = root * np.stack([np.cos(gap), np.sin(gap)], axis=-1)
    other = np.concatenate([circle, fillet, flank]) * np.array([1.0, -1.0])
    apart = np.linalg.norm(other - tip[:, None], axis=-1)
    nearest, distance = np.argmin(apart, axis=1), np.min(apart, axis=1)
    return (other[nearest] - tip) / distance[:, None], distance


def _peak(start: Mouth, at: Any) -> Float[Array, " contact"]:
    """Stress in the fillet per load and width, by Y_F and Y_S of ISO 6336-3 (9), (61), 1/m.

    Nearer than the section through the mouth the lever counts as none.
    """
    thickness = 2.0 * start.place[1]
    lever = np.maximum(at.x - at.y * np.tan(at.load_angle) - start.place[0], 0.0)
    notch = thickness / (2.0 * start.radius)
    correction = notch ** (1.0 / (1.21 + 2.3 * lever / thickness))
    return 6.0 * np.cos(at.load_angle) / thickness**2 * (1.2 * lever + 0.13 * thickness) * correction


def _notch(
    peak: Float[Array, " contact"],
    nominal: Float[Array, " contact"],
    radius: float,
    a: Float[Array, " step"],
    width: Float[Array, " step"],
) -> Float[Array, "contact step"]:
    """K_I of what the fillet's stress has more than the strip's."""
    excess = np.maximum(peak - nominal, 0.0)
    whole = width[0]
    gradient = 2.0 * peak / (radius * np.maximum(excess, 1e-300))  # over the excess, 1/m
    low, high = np.full(len(peak), np.log(1e-3 * radius)), np.full(len(peak), np.log(0.5 * whole))
    for _ in range(_HALVINGS):  # it falls as the length grows
        middle = (low + high) / 2.0
        constant, slope = _balance(np.exp(middle), whole)
        steep = (np.exp(-middle) + slope) / (1.0 - constant) > gradient
        low, high = np.where(steep, middle, low), np.where(steep, high, middle)
    length = np.exp((low + high) / 2.0)
    constant, slope = _balance(length, whole)
    height = excess / (1.0 - constant)

    q = np.minimum(a / width, 0.5)  # as far as the weight function is fitted
    first = 0.6147 + 17.1844 * q**2 + 8.7822 * q**6
    second = 0.2502 + 3.2889 * q**2 + 70.0444 * q**6
    behind = _GAUSS**2  # the tip, in shares of the depth
    x = a[:, None] * (1.0 - behind)
    weight = 4.0 * np.sqrt(a[:, None] / (2.0 * np.pi)) * _WEIGHTS
    weight = weight * (1.0 + first[:, None] * behind + second[:, None] * behind**2)
    shape = [part[:, None, None] for part in (length, constant, slope)]
    stress = np.exp(-x / shape[0]) - shape[1] - shape[2] * x
    return height[:, None] * np.sum(weight * stress, axis=-1)


def _balance(
    length: Float[Array, " contact"], whole: float
) -> tuple[Float[Array, " contact"], Float[Array, " contact"]]:
    """Constant and slope of the line that has the force and moment of exp(−x/length) on 0 … whole."""
    end = np.exp(-whole / length)
    force, moment = length * (1.0 - end), length**2 - (length**2 + length * whole) * end
    slope = 12.0 / whole**3 * (moment - force * whole / 2.0)
    return force / whole - slope * whole / 2.0, slope


def _tangent_over(share: Float[Array, " step"]) -> tuple[Any, Any]:
    angle = np.pi / 2.0 * share
    return np.sqrt(np.tan(angle) / angle) / np.cos(angle), 1.0 - np.sin(angle)


def _bent(share: Float[Array, " step"]) -> Float[Array, " step"]:
    """F_b of a strip in pure bending, within 0.5 % for any depth."""
    factor, remainder = _tangent_over(share)
    return factor * (0.923 + 0.199 * remainder**4)


def _pulled(share: Float[Array, " step"]) -> Float[Array, " step"]:
    """F_t of a strip in tension, within 0.5 %."""
    factor, remainder = _tangent_over(share)
    return factor * (0.752 + 2.02 * share + 0.37 * remainder**3)


def _sheared(share: Float[Array, " step"]) -> Float[Array, " step"]:
    """F_II of a strip in shear, within 2 %."""
    return (1.122 - 0.561 * share + 0.085 * share**2 + 0.18 * share**3) / np.sqrt(1.0 - share)
