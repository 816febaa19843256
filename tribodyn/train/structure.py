"""What the dynamics are about: bodies, links and meshes, and where the state keeps their motion.

Body 0 is the reference: the independent variable is its actual rotation, in cycles of mesh 0, which it
drives, so that engagement in mesh 0 falls on exactly known values whatever the speed does. The state holds
coordinates that stay small. Every body turns positively in its own nominal sense; its micro-rotation is its
rotation less what the reference's actual rotation makes of it by the train's ratios, ϑ_b = θ_b − i_b θ_0.
That of the reference is nothing, and in its place stands the time lag, time less nominal time at this phase.

States in order: of every body that moves in the plane x and y (m) and ϑ (rad), of the others ϑ alone; of
every body that moves in space z (m) and its tilts about x and y (rad), without the gyroscopic effect; their
rates in the same order, in place of the lag's the reference's slip, its speed less the nominal one (rad/s);
works since the start (J): by the drive, on the loads, lost to damping, done by the change of stiffness and
geometry with phase, and for every mesh what is lost to tooth friction and what friction would take of bodies
that only rotate.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.elementary import law
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.links.chain import NO_PLAY
from tribodyn.tribology.contact import Surfaces

#: Works, counted from the first: those of the whole train, and from `OF_MESHES` on two of every mesh.
IN, OUT, DAMPING, PARAMETRIC, OF_MESHES = range(5)
FRICTION, SLIDING, WORKS_OF_MESH = 0, 1, 2
#: A link's second end that stands still.
GROUND = -1
#: What `TrainLayout.holds` says of a link that holds a body at its nominal speed, 0 or of its own: whether
#: its power counts as put in, or, where it brakes, as taken out.
DRIVES, BRAKES = 1, 2
#: Directions of a link; and those of one between bodies that move in space, x and y first.
X, Y, TURN = range(3)
AXIAL, TILT_X, TILT_Y, IN_SPACE = range(2, 6)
#: Numbers that a mesh's bodies move by against each other: along the pitch tangent, across, along z; and
#: tilts that move the +z side along the tangent, and across. Forces and moments on the driver go with them.
TOWARDS, ACROSS, ALONG_Z, LEAN_ALONG, LEAN_ACROSS, MOVES = range(6)


class Bodies(NamedTuple):
    """Numbers of the bodies; first those that move in space, then in the plane; before all the reference."""

    mass: Float[Array, " planar"]  # kg; of those that move in the plane
    inertia: Float[Array, " body"]  # kg m², about the axis of rotation
    ratio: Float[Array, " body"]  # nominal speed over the reference's, 0 where it is held
    load: Float[Array, " body"]  # constant torque against the motion, N m
    load_damping: Float[Array, " body"]  # rise of it per speed above nominal, N m s/rad
    tilting: Float[Array, " spatial"] = np.zeros(0)  # inertia about x and y, kg m²
    #: of bodies in a carrier's frame, see `dynamics.loads`: its speed over the reference's, counter-clockwise
    #: positive; that of its Coriolis and centrifugal forces, rad/s, 0: without; places from its axis, m
    carried: Float[Array, " planar"] = np.zeros(0)
    frame_speed: Float[Array, " planar"] = np.zeros(0)
    place: Float[Array, "planar 2"] = np.zeros((0, 2))
    #: Σ m r² Ω² of what a carrier carries, N m/rad: where it is turned, centrifugal forces turn with it
    hoop: Float[Array, " planar"] = np.zeros(0)


class Couplings(NamedTuple):
    """What couples any coordinates linearly, by entries at the layout's places; see `train.coupling`."""

    stiffness: Float[Array, " entry"] = np.zeros(0)
    damping: Float[Array, " entry"] = np.zeros(0)  # with what is gyroscopic
    force: Float[Array, " forced"] = np.zeros(0)  # constant forces
    spread: Float[Array, " inertial"] = np.zeros(0)  # of diag(m) M⁻¹
    mass: Float[Array, " inertial"] = np.zeros(0)  # of M less the bodies' own
    #: this and the next: elastic forces on bearings that are in the entries, along x, y, z, by coordinates
    reaction: Float[Array, "bearing 3 coordinate"] = np.zeros((0, 3, 0))
    reaction_at_rest: Float[Array, "bearing 3"] = np.zeros((0, 3))
    #: stiffness that passes: periods per reference cycle, amplitudes of cosine and sine by entry
    passing_rate: Float[Array, " tone"] = np.zeros(0)
    passing_cosine: Float[Array, " passing"] = np.zeros(0)
    passing_sine: Float[Array, " passing"] = np.zeros(0)


class BearingNumbers(NamedTuple):
    """Numbers of the bearings whose forces are evaluated in time."""

    #: what coordinates at the places of `bearing_forces` move the rings against each other by: x, y, z, tilts
    moves: Float[Array, "bearing 10"] = np.zeros((0, 2 * IN_SPACE))
    cage: Float[Array, " bearing"] = np.zeros(0)  # rotation of the cage about +z over that of the body
    constant: Float[Array, " bearing"] = np.zeros(0)  # load over compression to its power, of a point
    apart: Float[Array, " bearing"] = np.zeros(0)  # of groove centres at rest; of rollers unused, m
    normal: Float[Array, "bearing 2"] = np.zeros(
        (0, 2)
    )  # of rollers: of the outer raceway, radial and along z
    around: Float[Array, " element"] = np.zeros(0)  # angles of all elements in their cages, rad
    #: places on elements where they are pressed, and how far (rollers: in the first) they are at rest, m
    point: Float[Array, "point 4"] = np.zeros((0, 4))
    #: this and the next: at the mean loads: stiffness, displacement of all coordinates; no force reads them
    tangent: Float[Array, "bearing 5 5"] = np.zeros((0, IN_SPACE, IN_SPACE))
    settled: Float[Array, " coordinate"] = np.zeros(0)


class Links(NamedTuple):
    """Springs and dampers between two bodies, or a body and the ground: bearings, shafts, couplings.

    They act on the difference of the ends' coordinates, in x and y where both ends move in the plane, and on
    that of their rotations where both are bodies, which have one nominal speed then: in x and y linearly, in
    rotation by the laws that are switched, see `train.links`. Where both ends move in space, matrices over x,
    y, z and the tilts stand in place of the stiffness and damping in x and y.

    The rotation of its body moves an end off the axis, such as a planet's pin on the carrier, by a lever.
    """

    stiffness: Float[Array, "link direction"]  # N/m, N/m, N m/rad
    damping: Float[Array, "link direction"]  # N s/m, N s/m, N m s/rad
    own: Any = NO_PLAY  # parameters of the laws
    #: this and the next: symmetric, over x, y, z, tilts about x and y; N/m, N, N m; empty if nothing tilts
    stiffness_in_space: Float[Array, "link 5 5"] = np.zeros((0, IN_SPACE, IN_SPACE))
    damping_in_space: Float[Array, "link 5 5"] = np.zeros((0, IN_SPACE, IN_SPACE))
    #: this and the next: of the layout's `pins`, empty if there are none; what a rotation of an end's body
    #: moves that end by in x and y, m/rad
    lever: Float[Array, "link end 2"] = np.zeros((0, 2, 2))
    offset: Float[Array, "link 2"] = np.zeros((0, 2))  # how far apart in x and y the unloaded ends are, m
    coupled: Couplings = Couplings()
    bearings: BearingNumbers = BearingNumbers()


class GearMesh(NamedTuple):
    """Two gears in mesh: their table, their bodies' places, and the surfaces and laws of their contacts.

    In the frame of the mesh `along` is the direction in which both flanks move at the pitch point, `across`
    that from the driver's centre to the driven one's. Where the driver turns clockwise it is right-handed.
    """

    table: Any  # mesh.cycle.Polynomials
    driver_radius: Any  # this and the next: of the pitch circles, m
    driven_radius: Any
    along_x: Any
    along_y: Any
    across_x: Any
    across_y: Any
    damping: Any  # 2 ζ √J_e', so that c_i = damping √k_i; over √K of so many slices a pair; √kg
    surfaces: Surfaces
    film: Any  # this and the next: parameters of the laws in use
    friction: Any
    teeth: Any  # mesh.teeth.lookup.Teeth, what single teeth have of their own
    hand: Any = 1.0  # −1 where the +z side is early: left-hand driver that turns clockwise, or the reverse
    #: what x, y, z and the tilts of the driver and of the driven body move it by, see `positions.moves_of`
    moves: Float[Array, "end move direction"] = np.zeros((2, MOVES, IN_SPACE))
    #: speed of a frame that turns with a carrier, over the reference's, positive as the driver turns; the
    #: next as the driven body does
    driver_carried: Any = 0.0
    driven_carried: Any = 0.0
    #: −1 where the body's own sense of rotation is not that of its signed radius, as of an internal gear; the
    #: next likewise
    driver_sense: Any = 1.0
    driven_sense: Any = 1.0
    #: what the rotation of its carrier moves the pitch point by along the tangent, m/rad
    carrier_arm: Any = 0.0
    #: what the layout's rim coordinates of the mesh move it by, along and across; as long in all meshes
    rim: Float[Array, "2 coordinate"] = np.zeros((2, 0))


@law
def shift_of(body):
    """Place of the x of a body that moves in the plane; its y is the next."""
    return 3 * body


@law
def turn_of(body, layout):
    """Place of a body's micro-rotation."""
    return body + 2 * min(body + 1, layout.planar)


@law
def shifted(body, direction, y, layout):
    """Displacement of a body in x (0) or y (1), m."""
    return y[shift_of(body) + direction] if body < layout.planar else 0.0 * y[0]


@law
def shifting(body, direction, y, layout):
    """Rate of the displacement of a body in x (0) or y (1), m/s."""
    return y[layout.half + shift_of(body) + direction] if body < layout.planar else 0.0 * y[0]


@law
def place_in_space(body, direction, layout):
    """Place of x, y, z, tilt about x or y (0 … 4) of a body that moves in space."""
    return shift_of(body) + direction if direction < AXIAL else layout.tilts + 3 * body + direction - AXIAL


@law
def turned(body, y, layout):
    """Micro-rotation of a body, rad."""
    return y[turn_of(body, layout)] if body > 0 else 0.0 * y[0]


@law
def turning(body, y, layout):
    """Rate of the micro-rotation of a body, rad/s."""
    return y[layout.half + turn_of(body, layout)] if body > 0 else 0.0 * y[0]


@law
def slip_of(y, layout):
    """Speed of the reference less nominal, rad/s."""
    return y[layout.half + layout.lag]


@law
def speed_of(body, y, model):
    """Speed of a body, rad/s, positive in its nominal sense."""
    layout = model.options.layout
    reference = model.operation.nominal_speed + slip_of(y, layout)
    return model.bodies.ratio[body] * reference + turning(body, y, layout)


@law
def rolling_ratio(m, model):
    """Nominal speed of a mesh's driver against the frame of the mesh, over the reference's.

    Of the sign of its radius: with that of an internal gear it is negative.
    """
    mesh = model.meshes[m]
    return mesh.driver_sense * (model.bodies.ratio[model.options.layout.driver[m]] - mesh.driver_carried)


@law
def driver_arm(mesh):
    """What the driver's rotation in its own sense moves its pitch point by along the tangent, m/rad."""
    return mesh.driver_sense * mesh.driver_radius


@law
def driven_arm(mesh):
    """The same of the driven body."""
    return mesh.driven_sense * mesh.driven_radius


@law
def slip_of_body(body, y, model):
    """Speed of a body less nominal, rad/s."""
    layout = model.options.layout
    return model.bodies.ratio[body] * slip_of(y, layout) + turning(body, y, layout)


@law
def rotational_error_of(m, y, model):
    """Rotational transmission error r_1 θ_1 − r_2 θ_2 of a mesh, of rotations against its carrier, m."""
    layout, part = model.options.layout, model.meshes[m]
    error = driver_arm(part) * turned(layout.driver[m], y, layout)
    error = error - driven_arm(part) * turned(layout.driven[m], y, layout)
    if layout.carrier[m] >= 0:
        error = error - part.carrier_arm * turned(layout.carrier[m], y, layout)
    return error


def rotational_error(states: Any, mesh: int, model: Any) -> Any:
    """`rotational_error_of` with the states along the last axis."""
    return rotational_error_of(mesh, np.moveaxis(np.asarray(states), -1, 0), model)


def rotational_error_rate(states: Any, mesh: int, model: Any) -> Any:
    """Its rate, m/s."""
    half = model.options.layout.half
    return rotational_error_of(mesh, np.moveaxis(np.asarray(states), -1, 0)[half:], model)
