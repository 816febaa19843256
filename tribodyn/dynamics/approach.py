"""Where the contacts of a mesh are and how fast their flanks approach, from its table and its motion.

Written for all compilers, see `contact_forces`, whose `work` it fills.
"""

from typing import Any, NamedTuple

from tribodyn.mesh.cycle import CHANNELS
from tribodyn.mesh.teeth.lookup import COMPLIANCE as COMPLIANCE_OF_TEETH
from tribodyn.mesh.teeth.lookup import FRICTION as FRICTION_OF_TEETH
from tribodyn.mesh.teeth.lookup import GAP as GAP_OF_TEETH
from tribodyn.mesh.teeth.lookup import deflect_apart, differ, own_and_slope, own_place
from tribodyn.numerics.elementary import last_axis_of_four, law, skippable, sqrt

# Quantities of one contact, rows of `work`.
DISTANCE = 0  # signed distance r from the pitch point, m
RADIUS = 1  # equivalent radius ρ; where it vanishes at P, averaged over the contact's width, m
DRIVER_SPEED = 2  # speed along the driver's flank, averaged with the radius, m/s
DRIVEN_SPEED = 3
COMPLIANCE = 4  # of the pair, without the load-dependent Hertz contact, m/N
APPROACH = 5  # δ, m
APPROACH_RATE = 6  # dδ/dt, m/s
APPROACH_SLOPE = 7  # ∂δ/∂φ at fixed coordinates, m/rad
COMPLIANCE_SLOPE = 8  # dC/dφ, m/(N rad)
EFFECTIVE_APPROACH = 9  # δ less what the loads on neighbouring pairs deflect, m
ELASTIC_LOAD = 10  # N
NORMAL_LOAD = 11  # elastic and damping, N
STIFFNESS = 12  # of one pair at its load, below the contact width at that of the width, N/m
SLIDING = 13  # nominal sliding velocity, driver less driven, along t, m/s
RELATIVE_VELOCITY = 14  # the same with the vibration, m/s
FRICTION_FORCE = 15  # on the driver along +t, N
FRICTION_COEFFICIENT = 16
COS = 17  # of the pressure angle
SIN = 18
TRANSMISSION_ERROR = 19  # along the pair's normal, gap not subtracted, m
TURNED = 20  # sliding velocity over that at which friction has reversed
TURNED_BEFORE = 21  # the same at the start of a step, see `march.step_control`
TURNING_RATE = 22  # its rate in the last step, per mesh cycle
PRESENT = 23  # part of the slot's width that is on the path of contact; 1 or 0 of a whole face
PRESENT_SLOPE = 24  # its derivative by the driver's rotation, 1/rad
WHOLE_LOAD = 25  # elastic load if the whole width touched, N
LINE_LOAD = 26  # normal load per width of the slot, N/m
LEAN_COS = 27  # of the angle of the normal to the transverse plane
LEAN_SIN = 28  # positive where the driver pushes the driven flank along +z
AXIAL_PLACE = 29  # z where the load of the slot acts, from the middle of the face, m
OWN_FRICTION = 30  # what single teeth add to 1 as a factor on the friction coefficient, where they differ
COUPLING = 31  # deflection per load on slot 0, and on from here per load on the other slots, m/N
QUANTITIES = 31  # and one more for every slot

# Channels of mesh.cycle.Polynomials.channel.
_COSINE, _SINE = CHANNELS.index("cosine"), CHANNELS.index("sine")
_DISTANCE, _RADIUS = CHANNELS.index("signed_distance"), CHANNELS.index("equivalent_radius")
_SPEED = CHANNELS.index("pinion_speed")
_COMPLIANCE, _GAP = CHANNELS.index("compliance"), CHANNELS.index("gap")
PEAK = CHANNELS.index("line_load_peak")
_SHARE, _PLACE = CHANNELS.index("share"), CHANNELS.index("face_place")


class MeshPlace(NamedTuple):
    """Where a mesh stands in its table."""

    segment: Any  # whole
    cell: Any  # whole
    u: Any  # position in the cell, 0 … 1
    cells_per_radian: Any  # cells per rotation of the driver
    phase: Any  # of the mesh, 0 … 1
    #: driver_tooth, driven_tooth: numbers of the teeth that entered last, where teeth differ
    driver_tooth: Any
    driven_tooth: Any


class Motion(NamedTuple):
    """How the two bodies of a mesh stand and move against each other, in its frame; driver less driven.

    What a point of the driver is ahead of the driven body's there is, at z from the middle of the face and p
    along and s across from the pitch point, `towards` + z `lean_along` along the pitch tangent, `across` + z
    `lean_across` across, and `axial` − p `lean_along` − s `lean_across` along z.
    """

    towards: Any  # along the pitch tangent, rotations included, m
    across: Any  # along the line of centres, m
    along_rate: Any  # rate of the translation along the pitch tangent, m/s
    turning_rate: Any  # rate of r_1 ϑ_1 − r_2 ϑ_2, m/s
    across_rate: Any  # m/s
    #: driver_speed, driven_speed: of the bodies against the frame of the mesh, rad/s, with their signed radii
    driver_speed: Any
    driven_speed: Any
    phase_rate: Any  # nominal such speed of the driver at the reference's actual speed, rad/s
    axial: Any  # along z at the pitch point, m
    lean_along: Any  # tilt that moves the +z side along the pitch tangent, rad
    lean_across: Any  # that moves it across, rad
    axial_rate: Any  # m/s
    lean_along_rate: Any  # this and the next: rad/s
    lean_across_rate: Any


@law
def out_of_reach(segment, i, mesh):
    """Whether a slot's pair is off the path of contact in this segment, and may be passed over."""
    return skippable(mesh.table.in_contact[segment, i] == 0.0)


@law
def absent(i, work):
    """Whether a slot is off the path of contact, after `approach`, and may be passed over."""
    return skippable(work[PRESENT, i] == 0.0)


@law
def sliced(mesh):
    """Whether the pairs of a mesh are cut into slices."""
    return mesh.table.face_position.shape[0] > 1


@law
def cubic(c, segment, cell, slot, channel, u):
    """Value at u ∈ [0, 1] of one channel's spline in a cell."""
    c0, c1, c2, c3 = last_axis_of_four(c, segment, cell, slot, channel)
    return c0 + u * (c1 + u * (c2 + u * c3))


@law
def cubic_slope(c, segment, cell, slot, channel, u):
    """Its derivative with respect to u."""
    _, c1, c2, c3 = last_axis_of_four(c, segment, cell, slot, channel)
    return c1 + u * (2.0 * c2 + 3.0 * u * c3)


@law
def cubic_and_slope(c, segment, cell, slot, channel, u):
    """Both at once."""
    c0, c1, c2, c3 = last_axis_of_four(c, segment, cell, slot, channel)
    return c0 + u * (c1 + u * (c2 + u * c3)), c1 + u * (2.0 * c2 + 3.0 * u * c3)


@law
def approach(place, motion, mesh, work):
    """Fill `work` with geometry, approach and its rates for every slot.

    δ = towards cos α + across sin α − gap of a spur gear; of slices along the true normal, which leans by
    tan β_w cos α out of the transverse plane. Back flanks live in the mirrored world, where the pitch tangent
    and rotations change sign.
    """
    table = mesh.table
    c = table.channel
    segment, cell, u, cells_per_radian, _, _, _ = place
    ratio = mesh.driver_radius / mesh.driven_radius
    speed = motion.driver_speed
    for i in range(table.side.shape[0]):
        if out_of_reach(segment, i, mesh):
            work[PRESENT, i] = 0.0
            continue
        work[PRESENT, i] = table.in_contact[segment, i]
        work[PRESENT_SLOPE, i] = 0.0
        if sliced(mesh):
            share, share_slope = cubic_and_slope(c, segment, cell, i, _SHARE, u)
            work[PRESENT, i] = table.in_contact[segment, i] * share
            work[PRESENT_SLOPE, i] = table.in_contact[segment, i] * share_slope * cells_per_radian
            if absent(i, work):
                continue
        side = table.side[i]
        cosine, cosine_slope = cubic_and_slope(c, segment, cell, i, _COSINE, u)
        sine, sine_slope = cubic_and_slope(c, segment, cell, i, _SINE, u)
        gap, gap_slope = cubic_and_slope(c, segment, cell, i, _GAP, u)
        compliance, compliance_slope = cubic_and_slope(c, segment, cell, i, _COMPLIANCE, u)
        distance, distance_slope = cubic_and_slope(c, segment, cell, i, _DISTANCE, u)
        z, z_slope = 0.0 * cosine, 0.0 * cosine
        if sliced(mesh):
            z, z_slope = cubic_and_slope(c, segment, cell, i, _PLACE, u)
            z, z_slope = mesh.hand * z, mesh.hand * z_slope
        along = side * (motion.towards + z * motion.lean_along)
        across = motion.across + z * motion.lean_across
        along_rate = side * (motion.along_rate + z * motion.lean_along_rate)
        across_rate = motion.across_rate + z * motion.lean_across_rate
        error = along * cosine + across * sine
        slope = along * cosine_slope + across * sine_slope
        if sliced(mesh):
            slope = slope + z_slope * (side * motion.lean_along * cosine + motion.lean_across * sine)
        rate = (along_rate + side * motion.turning_rate) * cosine + across_rate * sine
        lean_cos, lean_sin = 1.0 + z * 0.0, z * 0.0
        if sliced(mesh):
            # driver over driven along z where they touch
            on_along, on_across = side * motion.lean_along, motion.lean_across
            axial = motion.axial - distance * (cosine * on_along + sine * on_across)
            axial_rate = motion.axial_rate - distance * (
                cosine * side * motion.lean_along_rate + sine * motion.lean_across_rate
            )
            axial_slope = -distance_slope * (cosine * on_along + sine * on_across)
            axial_slope = axial_slope - distance * (cosine_slope * on_along + sine_slope * on_across)
            steep = side * mesh.hand * table.pitch_slope
            lean_cos = 1.0 / sqrt(1.0 + steep * cosine * steep * cosine)
            lean_sin = steep * cosine * lean_cos
            cube = lean_cos * lean_cos * lean_cos
            cos_slope = -steep * steep * cosine * cosine_slope * cube
            sin_slope = steep * cosine_slope * cube
            slope = lean_cos * slope + cos_slope * error + lean_sin * axial_slope + sin_slope * axial
            error = lean_cos * error + lean_sin * axial
            rate = lean_cos * rate + lean_sin * axial_rate
        slope = (slope - gap_slope) * cells_per_radian
        compliance_slope = compliance_slope * cells_per_radian
        if differ(mesh):
            tooth_place = own_place(i, place, mesh)
            missing, missing_slope = own_and_slope(tooth_place, GAP_OF_TEETH, mesh)
            gap = gap + missing
            slope = slope - missing_slope
            if deflect_apart(mesh):
                softer, softer_slope = own_and_slope(tooth_place, COMPLIANCE_OF_TEETH, mesh)
                compliance = compliance + softer
                compliance_slope = compliance_slope + softer_slope
                work[OWN_FRICTION, i], _ = own_and_slope(tooth_place, FRICTION_OF_TEETH, mesh)
        flank_speed = cubic(c, segment, cell, i, _SPEED, u)
        driver_lever = distance + mesh.driver_radius * sine
        driven_lever = mesh.driven_radius * sine - distance

        work[COS, i] = cosine
        work[SIN, i] = sine
        work[LEAN_COS, i] = lean_cos
        work[LEAN_SIN, i] = lean_sin
        work[AXIAL_PLACE, i] = z
        work[DISTANCE, i] = distance
        work[RADIUS, i] = cubic(c, segment, cell, i, _RADIUS, u)
        work[DRIVER_SPEED, i] = side * speed * flank_speed
        work[DRIVEN_SPEED, i] = side * speed * (flank_speed - (1.0 + ratio) * distance)
        work[COMPLIANCE, i] = compliance
        work[COMPLIANCE_SLOPE, i] = compliance_slope
        work[TRANSMISSION_ERROR, i] = error
        work[APPROACH, i] = error - gap
        work[APPROACH_SLOPE, i] = slope
        work[APPROACH_RATE, i] = rate + slope * motion.phase_rate
        work[SLIDING, i] = side * speed * (1.0 + ratio) * distance
        work[RELATIVE_VELOCITY, i] = (
            side * (speed * driver_lever - motion.driven_speed * driven_lever)
            + sine * along_rate
            - cosine * across_rate
        )
