"""What laws read: surfaces, a local contact (Hertz, flash temperature, Moes' numbers), a mesh's duty."""

import math
from typing import Any, Literal, NamedTuple, get_args

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import absolute, cos, exp, law, log, maximum, sin, sqrt

# Asperities of two flanks by Greenwood & Tripp's two constants: given, or typical of the flanks' finish.
#
# Height σ of the rms roughness, radius β and number per area n enter as σβn and σ/β. No drawing gives them,
# and friction of a mixed contact follows them: of one pair 0.008 to 0.045 (docs/ehl.md).


FinishName = Literal["ground", "superfinished", "hobbed"]
FINISHES: tuple[FinishName, ...] = get_args(FinishName)


class Asperities(NamedTuple):
    """Greenwood & Tripp's constants of both surfaces as one."""

    density: float = 0.05  # σβn: 0.03 to 0.05 of ground steel (Greenwood & Tripp 1970)
    slope: float = 0.01  # σ/β


#: Finish -> constants and their source. Ground is what no finish counts as.
BY_FINISH: dict[FinishName, tuple[Asperities, str]] = {
    "ground": (
        Asperities(),
        "σβn: Greenwood & Tripp (1970), 0.03 to 0.05 of ground steel; σ/β: assumption, σ 0.5 µm and β 50 µm",
    ),
    "superfinished": (
        Asperities(0.03, 0.001),
        "assumption: the lowest σβn of ground steel; tops flattened, σ 0.1 µm and β 100 µm",
    ),
    "hobbed": (
        Asperities(0.05, 0.03),
        "assumption: σβn of ground steel; feed marks and burrs, σ 3 µm and β 100 µm",
    ),
}


def asperities_of(finish: FinishName | None, density: float | None, slope: float | None) -> Asperities:
    """Return the constants that are given, else those of the finish, else those of ground flanks."""
    typical, _ = BY_FINISH[finish or "ground"]
    return Asperities(
        typical.density if density is None else density, typical.slope if slope is None else slope
    )


#: Minimum line load (N/m) and entrainment speed (m/s) at which laws are evaluated: they diverge at zero.
MINIMUM_LINE_LOAD = 1.0
MINIMUM_ENTRAINMENT = 1e-6
#: Of the pressure in a Hertz line contact.
MAXIMUM_OVER_MEAN = 4.0 / math.pi
ROOT_PI = math.sqrt(math.pi)


class Surfaces(NamedTuple):
    """The two surfaces and the lubricant between them, whatever the laws; floats, SI."""

    effective_modulus: Any  # E', 1/E' = ½[(1 − ν1²)/E1 + (1 − ν2²)/E2], Pa
    hardness: Any  # Vickers hardness H_v of the softer surface, Pa
    roughness: Any  # composite rms roughness σ, m
    mean_roughness: Any  # arithmetic mean roughness Ra of the flanks, m
    inlet_viscosity: Any  # η0, Pa·s
    pressure_viscosity: Any  # α_PV, 1/Pa
    #: pinion_conductivity, gear_conductivity: W/(m K)
    pinion_conductivity: Any
    gear_conductivity: Any
    #: pinion_heat_capacity, gear_heat_capacity: per volume ρ_s c_p of the solids, J/(m³ K)
    pinion_heat_capacity: Any
    gear_heat_capacity: Any


class LocalContact(NamedTuple):
    """Load and motion of one contact, as film and friction laws see it; SI. Made by `local_contact`."""

    line_load: Any  # w' = F_n/b, N/m, ≥ `MINIMUM_LINE_LOAD`
    curvature: Any  # 1/ρ, 1/m, positive
    entrainment: Any  # |u| = |u_p + u_g|/2, m/s, ≥ `MINIMUM_ENTRAINMENT`
    sliding: Any  # v_s = u_p − u_g, m/s, any sign
    #: pinion_speed, gear_speed: speeds u_p, u_g of the contact along the flanks, m/s, any sign
    pinion_speed: Any
    gear_speed: Any


@law
def local_contact(line_load, curvature, entrainment, sliding, pinion_speed, gear_speed):
    """Return a `LocalContact`, with line load and entrainment held above the minimum of the laws."""
    return LocalContact(
        maximum(line_load, MINIMUM_LINE_LOAD),
        curvature,
        maximum(absolute(entrainment), MINIMUM_ENTRAINMENT),
        sliding,
        pinion_speed,
        gear_speed,
    )


@law
def hertz_half_width(line_load, curvature, effective_modulus):
    """Half width a_H = √(8 w' ρ/(π E')) of a line contact, m (Johnson, Contact Mechanics, ch. 4)."""
    return sqrt(8.0 * line_load / (math.pi * effective_modulus * curvature))


@law
def moes_numbers(contact, surfaces):
    """Moes' M = W U_Σ^−1/2 and L = G U_Σ^1/4, U_Σ = 2 η0 u/(E' ρ), W = w'/(E' ρ), G = α_PV E'."""
    modulus = surfaces.effective_modulus
    sum_speed = 2.0 * contact.entrainment * contact.curvature * surfaces.inlet_viscosity / modulus
    load = contact.line_load * contact.curvature / modulus / sqrt(sum_speed)
    return load, surfaces.pressure_viscosity * modulus * sqrt(sqrt(sum_speed))


@law
def inlet_heating(contact, surfaces):
    """η0 u², W/m: what shear heats the oil by at the inlet, K_T η0 u²/k of a contact's heat number."""
    return surfaces.inlet_viscosity * contact.entrainment * contact.entrainment


@law
def hertz_pressure(line_load, curvature, effective_modulus):
    """Maximum Hertz pressure p_H = √(w' E'/(2π ρ)), Pa."""
    return sqrt(line_load * effective_modulus * curvature / (2.0 * math.pi))


@law
def averaged_radius(radius, line_load, effective_modulus, pitch_point_length):
    """Equivalent radius averaged over the half width a of its own contact, m; for one that vanishes at P.

    The exact mean at P is ρ̄² = M a (`geometry.pitch_point`). A contact beside P covers P while that is nearer
    than a; for it there is no closed form, but ρ⁴ = ρ̄⁴ + 14 (M a)² − 15 (M a)⁴/ρ̄⁴ is exact at P and where the
    contact's edge is at P, goes over to ρ̄ = ρ far away, and between meets the mean over a flank of curvature
    k/√s to 10 %. With a² = 8 w' ρ̄/(π E') it is a polynomial in ρ̄, to whose root Newton's steps come down.
    A load below 1 N/m counts as that; with M = 0 the radius stays as it is.
    """
    scale = pitch_point_length * pitch_point_length * 8.0 * maximum(line_load, 1.0)
    scale = exp(log(maximum(scale / (math.pi * effective_modulus), 1e-60)) / 3.0)  # ρ̄ at P
    fourth = (radius / scale) * (radius / scale) * (radius / scale) * (radius / scale)
    root = sqrt(1.0 + (radius / scale) * (radius / scale))
    for _ in range(6):
        square = root * root
        cube = square * root
        value = cube * cube + 14.0 * cube - 15.0 - fourth * square
        root = root - value / (6.0 * cube * square + 42.0 * square - 2.0 * fourth * root)
    return scale * root


@law
def flash_temperature_rise(heat_flux, half_width, pinion_speed, gear_speed, solids):
    """Average temperature rise ΔT in the contact, K.

    ΔT = 2 a_H q/{√π [K_1 √(1 + Pe_1) + K_2 √(1 + Pe_2)]}, Pe_j = a_H |u_j| (ρ_s c_p)_j/(2 K_j): Tian &
    Kennedy (1994); Liu & Ni (22), who leave the solid's heat capacity per volume ρ_s c_p out of Pe.

    Heat flux q in W/m², half width a_H in m, speeds u_j of the heat sources along the surfaces in m/s, any
    sign; `solids` are `Surfaces`, or any record with their conductivities and heat capacities.
    """
    # K √(1 + Pe) with K drawn into the root, which saves two divisions
    pinion_flow = 0.5 * half_width * absolute(pinion_speed) * solids.pinion_heat_capacity
    gear_flow = 0.5 * half_width * absolute(gear_speed) * solids.gear_heat_capacity
    conducted = sqrt(solids.pinion_conductivity * (solids.pinion_conductivity + pinion_flow)) + sqrt(
        solids.gear_conductivity * (solids.gear_conductivity + gear_flow)
    )
    return heat_flux * (2.0 / ROOT_PI * half_width / conducted)


class NominalConditions(NamedTuple):
    """Load, motion and oil of a mesh at its pitch point, whatever the tooth family; SI."""

    tangential_load: Any  # F_t on the pitch circles, N
    #: pinion_pitch_radius, gear_pitch_radius: working pitch radii, m
    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    pressure_angle: Any  # α at the pitch point, rad, > 0
    pinion_speed: Any  # rad/s
    face_width: Any  # m
    viscosity: Any  # η at the temperature of the oil, Pa·s
    density: Any  # of the oil, kg/m³
    mean_roughness: Any  # Ra, arithmetic mean roughness of the flanks, m
    #: load_exponent, lubricant_factor: d and X_L of Niemann's factor X_L (w mm/N)^−d
    load_exponent: Any
    lubricant_factor: Any = 1.0
    schlenk_factor: Any = 0.846  # X_L of Schlenk's formula

    @property
    def line_load(self) -> Any:
        """Normal load of a single pair over the face width, w = F_t/(b cos α), N/m."""
        return self.tangential_load / self.face_width / cos(self.pressure_angle)

    @property
    def curvature(self) -> Any:
        """Relative curvature 1/ρ_C at the pitch point, 1/m."""
        return self._sum_of_curvatures / sin(self.pressure_angle)

    @property
    def pitch_line_speed(self) -> Any:
        """Pitch line speed V, m/s."""
        return self.pinion_speed * self.pinion_pitch_radius

    @property
    def sum_speed(self) -> Any:
        """Sum of the rolling speeds at the pitch point, V_ΣC = 2 V sin α, m/s."""
        return 2.0 * self.pitch_line_speed * sin(self.pressure_angle)

    @property
    def load_intensity(self) -> Any:
        """Load intensity K = F_t (u + 1)/(b d_1 u), Pa."""
        return self.tangential_load / self.face_width * self._sum_of_curvatures / 2.0

    @property
    def _sum_of_curvatures(self) -> Any:
        return 1.0 / self.pinion_pitch_radius + 1.0 / self.gear_pitch_radius


#: Loads over the whole torque on one pair that a duty spans.
DUTY_LOADS = (0.25, 1.5)


class DutyRange(NamedTuple):
    """Least and greatest of each, as `LocalContact` has them; SI."""

    line_load: tuple[float, float]  # N/m
    entrainment: tuple[float, float]  # m/s
    curvature: tuple[float, float]  # 1/m
    slide_to_roll: tuple[float, float]  # |v_s|/u
    #: entrainment at nominal speed, curvature and slide-to-roll ratio at places along the path of contact,
    #: where they belong together; none: they vary each for itself
    places: tuple[tuple[float, float, float], ...] = ()


def without_duty() -> DutyRange:
    """Stand for the duty where there is no mesh: raise InputError."""
    raise InputError(
        "film.law", '"solved"', "is tabulated over the duty of a mesh, and there is none", "use another law"
    )
