"""Carriers that give: super-elements between the hub, which is the carrier's body, and the pins of planets.

Coordinates of no body are what the pins move by against the rigid carrier, in its frame: across the axis, and
where the set moves in space along it and in tilts; behind them come modes with fixed seats. All else of the
structure follows statically. A planet's bearing is strained by how far the planet is from its pin,

    V = ½ k (d − S e)²,   d = q_planet − q_pin of the rigid carrier − offset,

of which the link has k d²/2. The mass of the rigid carrier is its body's; what couples it with e is of the
structure. Left out: Coriolis and centrifugal forces on e, of the order of (Ω over its lowest frequency)².
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tribodyn.errors import InputError, broken_list, quoted
from tribodyn.input.tables.housing_matrices import whole_of
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.assembly import BodyInertia, in_space_of
from tribodyn.studies.motion.case import Gearbox, LinkData, SetData
from tribodyn.train.coupling import CoupledMatrices
from tribodyn.train.elastic.beam_matrices import SIX
from tribodyn.train.elastic.superelement import SuperElement, modal_damping, rigid_motions
from tribodyn.train.layout import TrainLayout
from tribodyn.train.planetary import CARRIER
from tribodyn.train.structure import AXIAL, IN_SPACE, TURN, place_in_space, shift_of, turn_of

#: Difference of a pin's place from its planet's axis, over the radius; of a body's mass from its structure's.
MISPLACED, LIGHTER = 0.01, 0.01


@dataclass(frozen=True)
class CarrierData:
    """The structure of a carrier, compared by its bytes."""

    element: SuperElement = field(compare=False)
    hub: str
    pins: tuple[str, ...]  # seats, in the order of the planets
    damping_ratio: float
    digest: bytes


def carrier_of(key: str, table: Any, planets: int) -> CarrierData:
    """The structure that the table ``flexible_carrier`` at a key names, for so many planets; InputError."""
    try:
        element, found = whole_of(table)
    except InputError as error:
        error.key = key + error.key.removeprefix("housing")
        raise
    if not found.free:
        rule = "is held, and a carrier turns: its hub is held by the bearings of its body"
        raise InputError(f"{key}.matrices", None, rule, "reduce it free, with a seat where its hub is")
    seats = [table.hub, *table.pins]
    for name, listed in (("hub", [table.hub]), ("pins", list(table.pins))):
        for error in broken_list(f"{key}.{name}", listed, element.seats, "seat"):
            raise error
    if len(set(seats)) < len(seats) or len(table.pins) != planets:
        rule = f"must name a seat of its own for each of the {planets} planets, and none the hub's"
        raise InputError(f"{key}.pins", quoted(list(table.pins)), rule, 'pins = ["P1", "P2", "P3"]')
    return CarrierData(element, table.hub, tuple(table.pins), table.damping_ratio, element.digest)


def carrier_coordinates(gearset: SetData) -> int:
    """Coordinates of no body that the carrier of a set has."""
    if gearset.carrier is None:
        return 0
    return _directions(gearset) * len(gearset.planets) + gearset.carrier.element.modes


def carriers_of(
    case: Gearbox,
    layout: TrainLayout,
    new: dict[int, int],
    damping: Sequence[tuple[float, float, float]],
    inertias: Sequence[BodyInertia],
    first: int,
) -> Iterator[CoupledMatrices]:
    """Matrices of all carriers that give; their coordinates begin at the `first` of no body.

    Arguments as of `in_space.pins_in_space`. Raises InputError where pins are not where planets are, or the
    body of a carrier is lighter than its structure.
    """
    first += layout.half - layout.modes
    for gearset in case.sets:
        if gearset.carrier is None:
            continue
        own = first + np.arange(carrier_coordinates(gearset))
        yield _structure(case, gearset, layout, new, inertias, own)
        each = _directions(gearset)
        for number, planet in enumerate(gearset.planets):
            seat = own[each * number : each * (number + 1)]
            place, link = next(
                (k, one) for k, one in enumerate(case.links) if one.lever and one.ends[0] == planet
            )
            yield _in_plane(link, damping[place], layout, new, seat[:TURN])
            if each > TURN:
                width = max(case.gears[gear].face_width for gear in case.bodies[planet].gears)
                matrices = in_space_of(link, damping[place], inertias, width)
                yield _out_of_plane(case, link, matrices, layout, new, seat[TURN:])
        first += len(own)


def _directions(gearset: SetData) -> int:
    """Directions of a pin that load it."""
    return IN_SPACE if gearset.in_space else TURN


def _structure(
    case: Gearbox,
    gearset: SetData,
    layout: TrainLayout,
    new: dict[int, int],
    inertias: Sequence[BodyInertia],
    own: Any,
) -> CoupledMatrices:
    """What the carrier's own stiffness, damping and inertia do."""
    assert gearset.carrier is not None
    data, body = gearset.carrier, gearset.members[CARRIER]
    element, centre = data.element, _centre(case, gearset)
    every = np.arange(element.coordinates)
    pins = [element.seat(pin) + direction for pin in data.pins for direction in range(_directions(gearset))]
    kept = np.concatenate([pins, every[SIX * len(element.seats) :]]).astype(int)
    hub = element.seat(data.hub) + np.arange(SIX)
    rest = np.setdiff1d(every, np.concatenate([kept, hub]))
    follows = np.zeros((len(every), len(kept)))
    follows[kept, np.arange(len(kept))] = 1.0
    inner = element.stiffness[np.ix_(rest, rest)]
    follows[rest] = -np.linalg.solve(inner, element.stiffness[np.ix_(rest, kept)])
    moved = rigid_motions(element.places, element.modes, about=centre)
    moved[:, SIX - 1] *= case.bodies[body].sense
    number = new[body]
    if number < layout.spatial:
        at = [place_in_space(number, direction, layout) for direction in range(IN_SPACE)]
        moved = moved[:, [*range(IN_SPACE), SIX - 1]]
        weights = [inertias[body].mass] * 3 + [inertias[body].tilting] * 2
    else:
        at = [shift_of(number) + direction for direction in range(TURN)]
        moved = moved[:, [0, 1, SIX - 1]]
        weights = [inertias[body].mass] * 2
    at.append(turn_of(number, layout))
    weights.append(inertias[body].inertia)
    whole = np.hstack([moved, follows])
    mass = whole.T @ element.mass @ whole
    rigid = len(at)
    for place, name in ((0, "mass"), (rigid - 1, "inertia")):
        if weights[place] < (1.0 - LIGHTER) * mass[place, place]:
            unit = "kg" if name == "mass" else "kg m²"
            found, given = (f"{value:.4g} {unit}" for value in (mass[place, place], weights[place]))
            rule = f"has {found}, and the body that it is has {given}"
            remedy = f"give [[body]] {case.bodies[body].name} at least that {name}"
            raise InputError(f"{gearset.key}.flexible_carrier.matrices", None, rule, remedy)
    stiffness = np.zeros_like(mass)
    losses = np.zeros_like(mass)
    elastic = slice(rigid, None)
    stiffness[elastic, elastic] = follows.T @ element.stiffness @ follows
    losses[elastic, elastic] = modal_damping(
        mass[elastic, elastic], stiffness[elastic, elastic], data.damping_ratio
    )
    mass[:rigid, :rigid] = 0.0  # the body's
    return CoupledMatrices(np.concatenate([at, own]), stiffness, losses, mass, np.zeros(len(mass)))


def _centre(case: Gearbox, gearset: SetData) -> Float[Array, " 3"]:
    """The carrier's axis at the pins, in the axes of the structure."""
    assert gearset.carrier is not None
    data, carrier = gearset.carrier, case.bodies[gearset.members[CARRIER]]
    places = dict(zip(data.element.seats, data.element.places, strict=True))
    axis = places[data.hub]
    for pin, planet in zip(data.pins, gearset.planets, strict=True):
        due = np.subtract(case.bodies[planet].centre, carrier.centre)
        found = (places[pin] - axis)[:2]
        if np.linalg.norm(found - due) > MISPLACED * np.linalg.norm(due):
            shown, wanted = (f"x {1e3 * x:.5g} mm, y {1e3 * y:.5g} mm" for x, y in (found, due))
            rule = f"the pin {pin} stands at {shown} from the hub, and its planet at {wanted}"
            remedy = "check the order of the pins, the axes of the structure, and its unit of length"
            raise InputError(f"{gearset.key}.flexible_carrier.pins", None, rule, remedy)
    heights = [places[pin][2] for pin in data.pins]
    return np.array([axis[0], axis[1], np.mean(heights)])


def _in_plane(
    link: LinkData, damping: Sequence[float], layout: TrainLayout, new: dict[int, int], seat: Any
) -> CoupledMatrices:
    """What the pin's own motion in x and y adds to its planet's link."""
    assert link.lever is not None
    planet, carrier = (new[body] for body in link.ends)
    ends = [shift_of(body) + direction for body in (planet, carrier) for direction in range(TURN)]
    apart = np.hstack([np.eye(2), -np.eye(2), -np.array(link.lever)[:, None]])
    both = np.diag(link.stiffness[:2]), np.diag(damping[:2])
    places = np.array([*ends, turn_of(carrier, layout), *seat])
    part = _joined(apart, *both, places)
    part.force[-2:] = -both[0] @ np.array(link.offset)
    if carrier == 0:  # the reference has no micro-rotation, and yet is turned
        part.stiffness[:, 4] = part.damping[:, 4] = 0.0
    return part


def _out_of_plane(
    case: Gearbox,
    link: LinkData,
    matrices: tuple[Array, Array],
    layout: TrainLayout,
    new: dict[int, int],
    seat: Any,
) -> CoupledMatrices:
    """What the pin's own motion along z and its tilts add to `in_space.pins_in_space`."""
    right, up = np.subtract(case.bodies[link.ends[0]].centre, case.bodies[link.ends[1]].centre)
    pin = np.array([[1.0, up, -right], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    outer = slice(AXIAL, IN_SPACE)
    places = [
        place_in_space(new[body], direction, layout)
        for body in link.ends
        for direction in range(AXIAL, IN_SPACE)
    ]
    stiffness, losses = (each[outer, outer] for each in matrices)
    return _joined(np.hstack([np.eye(3), -pin]), stiffness, losses, np.array([*places, *seat]))


def _joined(apart: Array, stiffness: Array, damping: Array, places: Any) -> CoupledMatrices:
    """½ k (d − e)² less ½ k d², d = `apart` q; `places` of q and of e."""
    ends, count = apart.shape[1], len(places)
    found = np.zeros((3, count, count))  # the last: no mass
    for whole, each in zip(found, (stiffness, damping), strict=False):
        whole[:ends, ends:] = -apart.T @ each
        whole[ends:, :ends] = whole[:ends, ends:].T
        whole[ends:, ends:] = each
    return CoupledMatrices(places, found[0], found[1], found[2], np.zeros(count))
