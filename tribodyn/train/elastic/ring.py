"""A rim that bends in its plane: Fourier amplitudes of a curved beam, in a frame that the rim turns in.

At the angle θ the rim moves by u outwards, its outside by v along the circle, and the section turns by φ,
all counter-clockwise. Of every order n ≥ 2 there are two families, as cos nθ and as sin nθ:

    u = a cos nθ + a' sin nθ,   v = b sin nθ − b' cos nθ,   φ = c sin nθ − c' cos nθ.

With v_c = v − φ h/2 of the centre line and the radius R + η of a fibre, hoop strain and shear are
(v_cθ + u + η φ_θ)/(R + η) and (u_θ − v_c + R φ)/(R + η): extension, bending with the shift of the neutral
line (Winkler), shear of a Timoshenko beam (Rao & Sundararajan, J. Appl. Mech. 36 (1969) 620). φ follows u and
v as at rest, its inertia with them; what a load inside turns the section by while the outside is held is left
to the mesh, which has the rim's deflection in such a fit. Of order 0 the rotation, and of order 1 the shift,
are those of the body; what else these have, that the rim widens and stretches, is left out.

N pins of the stiffness k each, evenly spaced from β on, hold a wave as a fit of the stiffness N k does and,
where n + m = N, couple two orders: Σ cos nψ_k cos mψ_k = N/2 [δ(n, m) + δ(n + m, N) cos Nβ], with − of two
sines, and N/2 δ(n + m, N) sin Nβ of one of each. That is exact for orders up to N − 2; the order N − 1 they
would couple with the shift of the body. Orders below N/2 alone do not see single pins: how the rim sags
between two of them are higher ones.

Material that passes the frame with the speed s moves by D = ∂_t + s ∂_θ: M q'' + 2 s M J q' + s² M J² q, J
being ∂_θ of the amplitudes. What a rim's own rotation against the housing adds, as its hoop tension, is left
out: it counts as the square of that speed over a natural frequency of the rim.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: Shear coefficient of a rectangle.
SHEAR = 5.0 / 6.0
#: The first order that is not the body's.
FIRST_ORDER = 2
#: Amplitudes of every order: u, v of one family, and of the other.
PER_ORDER = 4


class Rim(NamedTuple):
    """A ring of rectangular section: 2 % from plane stress up to a thickness of 0.15 of its radius."""

    inside: float  # radius, m
    outside: float  # radius, m
    width: float  # m
    youngs_modulus: float  # Pa
    poisson_ratio: float
    density: float  # kg/m³

    @property
    def radius(self) -> float:
        """Radius of the centre line, m."""
        return (self.inside + self.outside) / 2.0

    @property
    def thickness(self) -> float:
        """In radial direction, m."""
        return self.outside - self.inside


@dataclass(frozen=True)
class RimData:
    """What a scenario says of a ring whose rim bends."""

    orders: int  # waves around the rim, from 2
    held: tuple[float, float]  # stiffness of all pins together or of the fit, radial and tangential, N/m
    damping_ratio: float  # of every mode of the rim alone
    pins: int = 0  # that hold it, evenly spaced, one of them at x where all angles are 0; 0: a fit
    pin_rate: Fraction = Fraction(0)  # of them that pass a planet in a cycle of the reference mesh, signed

    @property
    def pins_pass(self) -> bool:
        """Whether its waves are so short that they see single pins."""
        return 2 * self.orders >= self.pins > 0


class RimMatrices(NamedTuple):
    """Over the amplitudes (a, b, a', b') of the orders 2, 3, …; m, so that all entries are kg, N s/m, N/m."""

    mass: Float[Array, "amplitude amplitude"]
    gyroscopic: Float[Array, "amplitude amplitude"]  # skew: takes no power
    stiffness: Float[Array, "amplitude amplitude"]


def rim_matrices(
    rim: Rim, orders: int, held: tuple[float, float] = (0.0, 0.0), passing: float = 0.0
) -> RimMatrices:
    """Matrices of the orders 2 … `orders`.

    `held` is the stiffness of the whole fit, or of all pins together, at the outside of the rim, radial and
    tangential, N/m; `passing` the speed of the rim against the frame, rad/s counter-clockwise.
    """
    parts = [_of_order(rim, n, held) for n in range(FIRST_ORDER, orders + 1)]
    size = PER_ORDER * len(parts)
    mass, gyroscopic, stiffness = np.zeros((3, size, size))
    for number, (inertia, elastic, _) in enumerate(parts):
        n = FIRST_ORDER + number
        at = slice(PER_ORDER * number, PER_ORDER * (number + 1))
        twice = np.kron(np.eye(2), inertia)
        turned = n * np.kron(np.array([[0.0, 1.0], [-1.0, 0.0]]), inertia)
        mass[at, at] = twice
        gyroscopic[at, at] = 2.0 * passing * turned
        stiffness[at, at] = np.kron(np.eye(2), elastic) - (passing * n) ** 2 * twice
    return RimMatrices(mass, gyroscopic, stiffness)


def pin_coupling(
    orders: int, pins: int, held: tuple[float, float]
) -> tuple[Float[Array, "amplitude amplitude"], Float[Array, "amplitude amplitude"]]:
    """What evenly spaced pins add to the stiffness of a fit: C cos Nβ + S sin Nβ, β the angle of one of them.

    `held` is as in `rim_matrices`; orders up to `pins` − 2.
    """
    size = PER_ORDER * (orders + 1 - FIRST_ORDER)
    cosine, sine = np.zeros((2, size, size))
    radial, tangential = np.divide(held, 2.0)
    for n in range(max(FIRST_ORDER, pins - orders), orders + 1):
        one, other = PER_ORDER * (n - FIRST_ORDER), PER_ORDER * (pins - n - FIRST_ORDER)
        if pins - n < FIRST_ORDER:
            continue
        # a goes with cos nθ and a' with sin nθ, b with sin nθ and b' with −cos nθ
        for first, second, stiffness, way in ((0, 2, radial, 1.0), (3, 1, tangential, -1.0)):
            cosine[one + first, other + first] = stiffness
            cosine[one + second, other + second] = -stiffness
            sine[one + first, other + second] = sine[one + second, other + first] = way * stiffness
    return cosine, sine


def rows_at(rim: Rim, orders: int, angle: float, radius: float) -> Float[Array, "2 amplitude"]:
    """How the amplitudes move a point of the rim outwards and along the circle, counter-clockwise.

    It stands at an angle (rad) in the frame of the amplitudes, and at a radius (m), by which the rotation of
    its section moves it too. The transpose gives the forces on the amplitudes from those at the point.
    """
    rows = np.zeros((2, PER_ORDER * (orders + 1 - FIRST_ORDER)))
    for n in range(FIRST_ORDER, orders + 1):
        _, _, turned = _of_order(rim, n, (0.0, 0.0))
        along = np.array([0.0, 1.0]) + (radius - rim.outside) * turned
        cosine, sine = np.cos(n * angle), np.sin(n * angle)
        first = PER_ORDER * (n - FIRST_ORDER)
        rows[0, first], rows[0, first + 2] = cosine, sine
        rows[1, first : first + 2], rows[1, first + 2 : first + 4] = sine * along, -cosine * along
    return rows


def _of_order(
    rim: Rim, n: int, held: tuple[float, float]
) -> tuple[Float[Array, "2 2"], Float[Array, "2 2"], Float[Array, " 2"]]:
    """Mass and stiffness of u, v of a family, and what they make of φ at rest, 1/m."""
    radius, height, width = rim.radius, rim.thickness, rim.width
    modulus, shear_modulus = rim.youngs_modulus, rim.youngs_modulus / (2.0 * (1.0 + rim.poisson_ratio))
    stretch = width * np.log(rim.outside / rim.inside)  # ∫ dA/(R + η), and of η and η² below
    first = width * height - radius * stretch
    hoop, bend = np.array([1.0, n, 0.0]), np.array([0.0, 0.0, n])
    mixed = np.outer(hoop, bend)
    stiffness = modulus * (
        stretch * np.outer(hoop, hoop) + first * (mixed + mixed.T) - radius * first * np.outer(bend, bend)
    )
    shear = np.array([-n, -1.0, radius])
    stiffness += SHEAR * shear_modulus * width * height / radius * np.outer(shear, shear)
    static, rotary = rim.density * width * height, rim.density * width * height**3 / 12.0
    mass = np.diag([static * radius, static * radius, rotary * radius])
    mass[1, 2] = mass[2, 1] = rotary
    of_outside = np.eye(3)
    of_outside[1, 2] = -height / 2.0
    mass, stiffness = (of_outside.T @ of @ of_outside for of in (mass, stiffness))
    stiffness[[0, 1], [0, 1]] += np.divide(held, 2.0 * np.pi)
    turned = -stiffness[2, :2] / stiffness[2, 2]
    to_all = np.vstack([np.eye(2), turned])
    return np.pi * to_all.T @ mass @ to_all, np.pi * to_all.T @ stiffness @ to_all, turned
