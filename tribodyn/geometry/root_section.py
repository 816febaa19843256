"""The critical section of a tooth root: where tangents at 30° (internal teeth: 60°) touch the fillet as cut.

ISO 6336-3 takes it from the virtual spur gear of a helical one: z_n = z/(cos² β_b cos β) teeth of the normal
module, cut by the same rack or by a pinion-type cutter with as many times its teeth.
"""

import math
from typing import NamedTuple

from scipy.optimize import brentq

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Side, body_of, reference_radius, tip_circle_radius
from tribodyn.geometry.helix import base_helix_angle
from tribodyn.geometry.rack_section import normal_section
from tribodyn.geometry.tooth import Tooth, cut_tooth, fillet_point, fillet_tangent, thickness_half_angle

#: Angle between the tangent and the tooth's axis: external, internal.
_EXTERNAL, _INTERNAL = math.radians(30.0), math.radians(60.0)


class CriticalSection(NamedTuple):
    """Section of the virtual spur tooth and how the load stands to it."""

    arm: float  # h_Fe: from the section to where the load crosses the tooth's axis, m
    thickness: float  # s_Fn, m
    notch_radius: float  # ρ_F of the fillet there, m
    load_angle: float  # α_Fen: between the load and the perpendicular of the tooth's axis, rad
    virtual_contact_ratio: float  # ε_αn


def critical_section(assembly: Assembly, side: Side) -> CriticalSection:
    """Section of an involute gear, loaded at the outer point of single pair contact of the virtual gear.

    That point is a base pitch times ε_αn − 1 from the tip; with ε_αn < 1 it is the tip. Where the fillet ends
    below the tangent's point, its end counts.
    """
    drive = assembly.drive
    normal, base = normal_section(drive), float(base_helix_angle(drive))
    more = 1.0 / (math.cos(base) ** 2 * math.cos(float(drive.helix_angle)))
    body = body_of(normal, side)
    teeth, module = float(body.teeth) * more, float(normal.module)
    tip = module * teeth / 2.0 + float(tip_circle_radius(drive, side) - reference_radius(drive, side))
    cutter = None if body.cutter_teeth is None else float(body.cutter_teeth) * more
    virtual = normal._replace(
        helix_angle=0.0,
        **{side: body._replace(teeth=teeth, tip_radius=tip, tip_break=0.0, cutter_teeth=cutter)},
    )
    tooth = cut_tooth(assembly.family, virtual, side)
    place, thickness, notch = _where_tangent(tooth, _EXTERNAL if teeth > 0.0 else _INTERNAL)
    ratio = float(assembly.contact_ratio) / math.cos(base) ** 2
    angle = float(normal.pressure_angle)
    base_radius, pitch = module * teeth / 2.0 * math.cos(angle), math.pi * module * math.cos(angle)
    along = math.sqrt(tip**2 - base_radius**2) - math.copysign(pitch, teeth) * max(ratio - 1.0, 0.0)
    loaded = math.copysign(math.hypot(along, base_radius), teeth)
    load_angle = math.acos(base_radius / loaded) - float(thickness_half_angle(tooth, loaded))
    arm = base_radius / math.cos(load_angle) - place
    return CriticalSection(arm, thickness, notch, load_angle, ratio)


def _where_tangent(tooth: Tooth, wanted: float) -> tuple[float, float, float]:
    """Where the tangent of the fillet has an angle: x, thickness 2 y there, radius of curvature, m."""

    def excess(normal: float) -> float:
        return float(fillet_tangent(tooth, normal).angle) - wanted

    first, last = float(tooth.form_angle), math.pi / 2.0
    normal = first if excess(first) >= 0.0 else brentq(excess, first, last, xtol=1e-14)
    x, y = fillet_point(tooth, normal)
    tangent = fillet_tangent(tooth, normal)
    return float(x), 2.0 * float(y), abs(float(tangent.rate / tangent.turning))
