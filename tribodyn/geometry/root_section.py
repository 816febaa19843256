"""The critical section of a tooth root: where tangents at 30° (internal teeth: 60°) touch the fillet as cut.

ISO 6336-3 takes it from the virtual spur gear of a helical one: z_n = z/(cos² β_b cos β) teeth of the normal
module, cut by the same rack or by a pinion-type cutter with as many times its teeth. Its formula for internal
teeth has a rack in place of that cutter, with an equivalent radius of the tip; for racks both are the same.
"""

import math
from typing import NamedTuple, cast

from scipy.optimize import brentq

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import GearBody, Side, body_of, reference_radius, tip_circle_radius
from tribodyn.geometry.helix import base_helix_angle, normal_section
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


def critical_section(assembly: Assembly, side: Side, by_formula: bool = False) -> CriticalSection:
    """Section of an involute gear, loaded at the outer point of single pair contact of the virtual gear.

    That point is a base pitch times ε_αn − 1 from the tip; with ε_αn < 1 it is the tip. Where the fillet ends
    below the tangent's point, its end counts. `by_formula` takes chord and radius of internal teeth from the
    standard's formula in place of the fillet as cut.
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
    tooth, angle = cut_tooth(assembly.family, virtual, side), float(normal.pressure_angle)
    if teeth < 0.0 and by_formula:
        place, thickness, notch = _ring_by_formula(body_of(drive, side), body, tooth, module, teeth, angle)
    else:
        place, thickness, notch = _where_tangent(tooth, _EXTERNAL if teeth > 0.0 else _INTERNAL)
    ratio = float(assembly.contact_ratio) / math.cos(base) ** 2
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


def _ring_by_formula(
    cutter: GearBody, body: GearBody, tooth: Tooth, module: float, teeth: float, angle: float
) -> tuple[float, float, float]:
    """The same of an internal gear by ISO 6336-3:2006, 6.2: a rack in place of the pinion-type cutter.

    Its tip is rounded by ρ_fPv = ρ_fP + m_n (x_0 + h_fP/m_n − ρ_fP/m_n)^1.95/(3.156 · 1.036^z_0). From
    memory; another program's reports of two rings confirm it.
    """
    shift = float(body.profile_shift) + float(body.thickness_allowance) / (2.0 * module * math.tan(angle))
    depth = abs(float(tooth.root_radius)) / module + teeth / 2.0 + shift
    rounding = float(body.fillet_radius)
    more = max(float(body.cutter_shift) + depth - rounding, 0.0) ** 1.95
    rounding += more / (3.156 * 1.036 ** float(cutter.cutter_teeth))
    over = math.pi / 4.0 - depth * math.tan(angle) - (1.0 - math.sin(angle)) * rounding / math.cos(angle)
    height = rounding - depth + shift  # G
    wide = 2.0 / teeth * (math.pi / 2.0 - over) - math.pi / 6.0  # H
    slope = 2.0 * height / teeth  # θ = slope tan θ − H, the smaller of two solutions; of a dozen teeth none
    last = math.acos(math.sqrt(min(max(slope, 1e-9), 1.0)))
    solved = slope * math.tan(last) - wide <= last
    theta = last
    if solved:
        theta = cast(float, brentq(lambda t: slope * math.tan(t) - wide - t, 0.0, last, xtol=1e-14))
    half_angle, tip = math.pi / 6.0 - theta, height / math.cos(theta) - rounding
    curved = math.cos(theta) * (abs(teeth) * math.cos(theta) ** 2 - 2.0 * height)
    return (
        module / 2.0 * (teeth * math.cos(half_angle) + math.sqrt(3.0) * tip),
        module * (teeth * math.sin(half_angle) + tip),
        module * (rounding + 2.0 * height**2 / curved),
    )
