"""What laws may read of a mesh: its pitch point, for mean coefficients; its range of duties, for tables."""

from typing import Any, NamedTuple

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import cos, sin


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
