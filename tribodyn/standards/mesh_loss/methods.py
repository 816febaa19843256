"""Loss of a mesh under load by the standards: P_VZP = P μ_m H_v, a method for each pair of both formulas.

The pitch line speed that enters a coefficient stays within the range of its tests, so that the loss at rest
is a finite torque; what lies outside is said by `MeshLossMethod.exceeded`.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from tribodyn.standards.contact_path import ContactPath, equivalent_radius, loss_factor
from tribodyn.standards.loss_factors import least_line_length, of_even_lines, of_rigid_lines
from tribodyn.standards.mesh_loss import friction
from tribodyn.standards.micropitting import mean_friction, roughness_factor


class LoadedMesh(NamedTuple):
    """What the methods take: a pair of involutes and its duty, whose fields may be arrays that broadcast."""

    path: ContactPath
    face_width: float  # common, m
    base_force: Any  # F_bt in the transverse plane of action, N, ≥ 0
    pitch_speed: Any  # v_t at the working pitch circles, in planetary sets against the carrier, m/s, ≥ 0
    viscosity: Any  # dynamic η of the oil at its own temperature, Pa s
    density: Any  # kg/m³
    pressure_viscosity: Any  # α, 1/Pa
    mean_roughness: float  # Ra = (Ra_1 + Ra_2)/2, m
    lubricant_factor: float = 1.0  # X_L by ISO/TR 15144-1: 1 of mineral oil, 0.8 of PAO
    schlenk_factor: float = 0.846  # X_L of the open program: 0.846 of mineral oil, 0.65 of PAO

    @property
    def base_helix_cosine(self) -> float:
        """Cosine of β_b."""
        return math.cos(self.path.base_helix_angle)

    @property
    def line_load(self) -> Any:
        """F_bt/b, N/m."""
        return np.asarray(self.base_force, dtype=float) / self.face_width

    @property
    def pitch_radius(self) -> float:
        """Normal radius of relative curvature ρ_C at the pitch point, m."""
        path = self.path
        point = path.length - path.tip_contact_ratios[0] * path.base_pitch
        return abs(float(equivalent_radius(path, point)))

    def speed_sum(self, low: float, high: float) -> Any:
        """v_ΣC = 2 v_t sin α_wt of a pitch line speed held within `low` and `high`, m/s."""
        return 2.0 * np.clip(self.pitch_speed, low, high) * math.sin(self.path.pressure_angle)


class MeshLossMethod(NamedTuple):
    """A coefficient of friction with its loss factor."""

    about: str
    source: str
    coefficient: Callable[[LoadedMesh], Any]  # μ_m
    factor: Callable[[ContactPath], float]  # H_v
    limits: tuple[str, ...]  # of the tests behind it
    shares: Callable[[LoadedMesh], tuple[Any, ...]]  # of the limits: below 1 where one is exceeded

    def power(self, mesh: LoadedMesh) -> Any:
        """P_VZP = F_bt v_t cos α_wt μ_m H_v, W."""
        speed = np.asarray(mesh.pitch_speed, dtype=float) * math.cos(mesh.path.pressure_angle)
        return np.asarray(mesh.base_force, dtype=float) * speed * self.loss_per_power(mesh)

    def loss_per_power(self, mesh: LoadedMesh) -> Any:
        """μ_m H_v, the loss over the power that the mesh passes: finite at rest; 0 without load."""
        loaded = np.asarray(mesh.base_force, dtype=float) > 0.0
        some = mesh._replace(base_force=np.where(loaded, mesh.base_force, 1.0))
        return np.where(loaded, self.coefficient(some) * self.factor(mesh.path), 0.0)

    def exceeded(self, mesh: LoadedMesh) -> tuple[str, ...]:
        """Limits that some point of the duty exceeds."""
        pairs = zip(self.limits, self.shares(mesh), strict=True)
        return tuple(limit for limit, share in pairs if bool(np.any(np.asarray(share) < 1.0)))


#: Pitch line speeds of the FZG tests, m/s, and their least load per width, N/m.
_SLOW, _FAST, _LIGHT = 1.0, 50.0, 150e3
_FZG_LIMITS = ("pitch line speed 1 to 50 m/s", "load per width at the base circle ≥ 150 N/mm")
#: Pitch line speeds, m/s, and load intensities, Pa, of ISO/TR 14179-1.
_AGMA_SPEED, _AGMA_LOAD = (2.0, 25.0), (1.4e6, 14e6)


def _fzg_shares(mesh: LoadedMesh) -> tuple[Any, ...]:
    return _within(mesh.pitch_speed, _SLOW, _FAST), mesh.line_load / _LIGHT


def _within(value: Any, low: float, high: float) -> Any:
    value = np.asarray(value, dtype=float)
    with np.errstate(divide="ignore"):
        return np.minimum(value / low, high / np.abs(value))


def _schlenk(mesh: LoadedMesh, lubricant: Any) -> Any:
    return friction.schlenk(
        mesh.line_load,
        mesh.speed_sum(_SLOW, _FAST),
        mesh.pitch_radius,
        mesh.viscosity,
        mesh.mean_roughness,
        lubricant,
    )


def _michaelis(mesh: LoadedMesh) -> Any:
    radius = mesh.pitch_radius
    rough = roughness_factor(mesh.mean_roughness, radius)
    return mean_friction(
        mesh.line_load,
        mesh.speed_sum(_SLOW, _FAST),
        radius,
        mesh.viscosity,
        rough,
        mesh.lubricant_factor,
    )


def _intensity(mesh: LoadedMesh) -> Any:
    path = mesh.path
    torque = np.asarray(mesh.base_force) * path.base_radius[0]
    return abs(friction.load_intensity(torque, mesh.face_width, path.pitch_radius[0], path.ratio))


def _agma(mesh: LoadedMesh) -> Any:
    kinematic = mesh.viscosity / np.asarray(mesh.density)
    return friction.iso_14179_1(kinematic, _intensity(mesh), np.clip(mesh.pitch_speed, *_AGMA_SPEED))


def _agma_shares(mesh: LoadedMesh) -> tuple[Any, ...]:
    return _within(mesh.pitch_speed, *_AGMA_SPEED), _within(_intensity(mesh), *_AGMA_LOAD)


def mechanical_advantage(path: ContactPath) -> float:
    """Mesh mechanical advantage M of ISO/TR 14179-1: 1/M is the loss factor of an even load on all lines.

    M = 2 cos α_w (H_s + H_t)/(H_s² + H_t²) of the sliding ratios H_s, H_t at the ends of contact, which are
    2π cos α_w (u + 1)/(z_1 u) times the tip contact ratios.
    """
    return 1.0 / of_even_lines(*path.tip_contact_ratios, path.teeth[0], path.ratio, 0.0)


def _agma_factor(path: ContactPath) -> float:
    working = math.atan(math.tan(path.base_helix_angle) / math.cos(path.pressure_angle))
    return math.cos(working) ** 2 / mechanical_advantage(path)


def _fernandes(mesh: LoadedMesh) -> Any:
    path = mesh.path
    length = least_line_length(path.contact_ratio, path.overlap_ratio, path.base_helix_angle)
    return friction.fernandes(
        np.asarray(mesh.base_force) / mesh.base_helix_cosine,
        length * mesh.face_width,
        mesh.speed_sum(_SLOW, _FAST),
        mesh.pitch_radius,
        mesh.viscosity,
        mesh.pressure_viscosity,
        mesh.mean_roughness,
        mesh.schlenk_factor,
    )


def _rigid_factor(path: ContactPath) -> float:
    return of_rigid_lines(
        *path.tip_contact_ratios, path.overlap_ratio, path.teeth[0], path.ratio, path.base_helix_angle
    )


#: P_VZP by name.
MESH_LOSS_METHODS = {
    "iso-14179-2": MeshLossMethod(
        "Schlenk's coefficient with X_L by the type of the oil, H_v of Ohlendorf and Niemann",
        "ISO/TR 14179-2:2001 (Niemann/Winter, Höhn)",
        lambda mesh: _schlenk(mesh, mesh.lubricant_factor),
        loss_factor,
        _FZG_LIMITS,
        _fzg_shares,
    ),
    "iso-14179-1": MeshLossMethod(
        "AGMA's coefficient, which falls with load and speed, and the mesh mechanical advantage",
        "ISO/TR 14179-1:2001",
        _agma,
        _agma_factor,
        ("pitch line speed 2 to 25 m/s", "load intensity K 1.4 to 14 N/mm²"),
        _agma_shares,
    ),
    "iso-15144": MeshLossMethod(
        "coefficient of Michaelis with the roughness over the radius of curvature, H_v as above",
        "ISO/TR 15144-1:2014, ISO/TS 6336-21:2017",
        _michaelis,
        loss_factor,
        _FZG_LIMITS,
        _fzg_shares,
    ),
    "schlenk": MeshLossMethod(
        "Schlenk's coefficient with his own X_L, loss factor of the lines of contact of rigid teeth",
        "Schlenk (TU München 1995); Wimmer (TU München 2006)",
        lambda mesh: _schlenk(mesh, mesh.schlenk_factor),
        _rigid_factor,
        _FZG_LIMITS,
        _fzg_shares,
    ),
    "fernandes": MeshLossMethod(
        "Fernandes' coefficient of a film number and a roughness number, loss factor as before",
        "Fernandes, Martins & Seabra, Tribol. Int. 70 (2014) 83; Wimmer (TU München 2006)",
        _fernandes,
        _rigid_factor,
        _FZG_LIMITS,
        _fzg_shares,
    ),
}
