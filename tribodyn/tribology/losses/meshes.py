"""Oil in a mesh without load: splash and squeezing of a whole stage, oil sprayed into the mesh.

Torques at the driver by its speed, rad/s, at least 0.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.loss import OilState, Sump, Torque, Wheel


class MeshInOil(NamedTuple):
    """A mesh: its gears with their depths in the oil, and the oil sprayed into it."""

    driver: Wheel
    driven: Wheel
    normal_module: float  # m
    flow: float = 0.0  # sprayed into the mesh, m³/s
    jet_speed: float = 0.0  # m/s
    into_mesh: bool = True  # sprayed where teeth come into mesh, else where they leave it


#: v_t0, m/s; h_e0 and b_0, m.
_SPEED, _DEPTH, _WIDTH = 10.0, 10e-3, 10e-3


_TESTED = "pitch line velocity 10 to 60 m/s (its tests)"


def _tested(velocity: Float[Array, "..."]) -> bool:
    return bool(np.all((velocity >= 10.0) & (velocity <= 60.0)))


def iso_14179_2(mesh: MeshInOil, speed: Float[Array, "..."], oil: OilState, sump: Sump) -> Torque:
    """Hydraulic losses of a stage in an oil bath, splash and squeezing together, by ISO/TR 14179-2:2001.

    T_H = C_Sp C_1 exp(C_2 v_t/10 m/s) N m with C_1 = 0.063 (h_e1 + h_e2)/10 mm + 0.0128 (b/10 mm)³,
    C_2 = (h_e1 + h_e2)/(80 · 10 mm) + 0.2 and C_Sp = [4 h_e,max/(3 h_C)]^1.5 2 h_C/l_h: h_e depth of the tip
    circle, h_C height of the pitch point above the lowest point of the gear that dips deepest (both axes are
    taken at one height: its tip radius), l_h hydraulic length of the housing.

    After R. Walter (1982) and W. Mauz (1987), Stuttgart; from memory, also that P_VZ0 = T_H π n/30 with the
    driver's speed. Their tests: spur gears at 10 to 60 m/s; the oil's viscosity is not in it.
    """
    wheels = mesh.driver, mesh.driven
    deepest = max(wheels, key=lambda wheel: wheel.immersion)
    velocity = np.asarray(speed, dtype=float) * mesh.driver.pitch_radius
    depths = sum(wheel.immersion for wheel in wheels) / _DEPTH
    width = min(wheel.face_width for wheel in wheels) / _WIDTH
    if depths <= 0.0:
        return Torque(0.0 * velocity)
    height = deepest.tip_radius
    splash = (4.0 * deepest.immersion / (3.0 * height)) ** 1.5 * 2.0 * height / sump.hydraulic_length
    constant = splash * (0.063 * depths + 0.0128 * width**3)
    exceeded = []
    if not _tested(velocity):
        exceeded.append(_TESTED)
    if deepest.immersion > height:
        exceeded.append("immersed at most to the axis")
    return Torque(constant * np.exp((depths / 80.0 + 0.2) * velocity / _SPEED), tuple(exceeded))


#: ν_0, mm²/s, and h_Z0 over the normal module.
_VISCOSITY, _TOOTH_HEIGHT = 40.0, 2.3


def mauz(mesh: MeshInOil, speed: Float[Array, "..."], oil: OilState, sump: Sump) -> Torque:
    """Squeezing of oil that is sprayed into the mesh, by Mauz, and its impulse, by Ariura.

    T = 4.12 ρ Q^0.75 r_w v_t^1.25 b^0.25 m_n^0.25 (ν/ν_0)^0.25 (h_Z/h_Z0)^0.5 of oil where teeth come into
    mesh, SI but ν, ν_0 = 40 mm²/s, h_Z the depth of the teeth and h_Z0 = 2.3 m_n; and ρ Q r_w (v_t ∓ v_s), −
    where they come into mesh, at least 0: the jet's speed v_s lies along the pitch line.

    W. Mauz, Hydraulische Verluste von Stirnradgetrieben, Stuttgart 1987; T. Ariura et al., Bull. JSME 16
    (1973); from memory. Spur gears at 10 to 60 m/s.
    """
    driver = mesh.driver
    radius, width = driver.pitch_radius, min(driver.face_width, mesh.driven.face_width)
    velocity = np.asarray(speed, dtype=float) * radius
    along = velocity - mesh.jet_speed if mesh.into_mesh else velocity + mesh.jet_speed
    torque = oil.density * mesh.flow * radius * np.maximum(along, 0.0)
    if mesh.into_mesh:
        depth = (driver.tip_radius - driver.root_radius) / (_TOOTH_HEIGHT * mesh.normal_module)
        size = radius * (width * mesh.normal_module) ** 0.25 * depth**0.5
        squeezed = 4.12 * oil.density * mesh.flow**0.75 * velocity**1.25 * size
        torque = torque + squeezed * (oil.kinematic / _VISCOSITY) ** 0.25
    return Torque(torque, () if _tested(velocity) else (_TESTED,))


#: Methods by the names that a scenario has.
MESHES: dict[str, Callable[[MeshInOil, Float[Array, "..."], OilState, Sump], Torque]] = {
    "iso-14179-2": iso_14179_2,
    "mauz": mauz,
}
