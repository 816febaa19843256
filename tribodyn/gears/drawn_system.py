"""Shafts as drawn in a gearbox: where they stand, under which loads, and what they are to the bodies.

Every body that a drawn shaft carries moves by itself; shafts, bearings and housing couple them, about the
operating point under the mean loads of the meshes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from tribodyn.dynamics.data import BearingData
from tribodyn.errors import InputError
from tribodyn.gears.supports import BearingUnderLoad, GearSupport, element_loads, placed_shaft, refusing
from tribodyn.input.tables.drawn_shafts import DrawnShaft
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.coupling import CoupledMatrices, coupled, own_mass
from tribodyn.train.elastic.beam_matrices import SIX
from tribodyn.train.elastic.in_time import tangent_of
from tribodyn.train.elastic.superelement import SuperElement, modal_damping
from tribodyn.train.elastic.system import (
    Reduced,
    Settled,
    ShaftSystem,
    reduced,
    settled,
    structure_of,
)
from tribodyn.train.layout import TrainLayout
from tribodyn.train.structure import (
    IN_SPACE,
    TILT_X,
    TILT_Y,
    Bodies,
    Couplings,
    place_in_space,
    turn_of,
)

#: Elements of a shaft at least where its own modes are looked for.
ELEMENTS = 24


@dataclass(frozen=True)
class ShaftData:
    """A drawn shaft in its place."""

    name: str
    key: str  # of the drawing in the scenario, dotted
    drawing: DrawnShaft
    points: tuple[tuple[int, float], ...]  # bodies that it carries, and where along it, m
    centre: tuple[float, float]  # of its axis, m
    start: float  # z of its start, m
    sense: int  # of rotation, +1: counter-clockwise seen from +z
    speed: float  # rad/s


@dataclass(frozen=True)
class DrawnSystem:
    """All drawn shafts of a gearbox, and the mean loads of the meshes on what they carry."""

    shafts: tuple[ShaftData, ...]
    #: of every point, shaft by shaft: forces along x, y, z (N), moments about x and y (N m)
    loads: tuple[tuple[float, ...], ...]
    #: None: a stiff one; compared by its bytes, `digest`
    housing: SuperElement | None = field(default=None, compare=False)
    digest: bytes = b""
    housing_modes_up_to: float = 0.0  # rad/s
    radiation_efficiency: float = 1.0  # of the estimate by area and velocity

    @property
    def bodies(self) -> tuple[int, ...]:
        """The bodies at the points."""
        return tuple(body for shaft in self.shafts for body, _ in shaft.points)

    @property
    def bearing_names(self) -> list[str]:
        """Names of all bearings: middle-1 is the first one of the shaft middle."""
        return [
            f"{shaft.name}-{number}"
            for shaft in self.shafts
            for number in range(1, len(shaft.drawing.bearing) + 1)
        ]

    @property
    def linear(self) -> bool:
        """Whether no bearing is stiffer under another load."""
        drawn = (bearing for shaft in self.shafts for bearing in shaft.drawing.bearing)
        return all(bearing.matrix is not None or bearing.type is None for bearing in drawn)

    @cached_property
    def settled(self) -> Settled:
        """Where the mean loads bring it; InputError where they are not held."""
        structure = structure_of(self._physical, ELEMENTS if self._modes_up_to else 1)
        with refusing([shaft.key for shaft in self.shafts for _ in shaft.points]):
            return settled(structure, self.loads)

    @cached_property
    def reduced(self) -> Reduced:
        """What is left of it to the bodies, about that."""
        return reduced(self.settled, self._modes_up_to / (2.0 * np.pi))

    @property
    def _modes_up_to(self) -> float:
        of_shafts = [shaft.drawing.modes_up_to or 0.0 for shaft in self.shafts]
        return max(*of_shafts, self.housing_modes_up_to)

    def _shares_of_shafts(self) -> Float[Array, " mode"]:
        """Kinetic energy of the shafts in the modes that are kept, over that of all: the rest is damped."""
        structure, left = self.settled.structure, self.reduced
        shapes = left.recovery[:, SIX * len(self.bodies) :]
        momentum = structure.mass @ shapes
        shafts = SIX * len(structure.turns)
        own = np.einsum("im,im->m", shapes[:shafts], momentum[:shafts])
        return own / np.einsum("im,im->m", shapes, momentum)

    def motion_of_housing(
        self, layout: TrainLayout, new: Mapping[int, int]
    ) -> Float[Array, "own coordinate"]:
        """Coordinates of the housing by those of a model."""
        assert self.housing is not None
        rows = np.zeros((self.housing.coordinates, layout.half))
        whole = self.reduced.recovery[-self.housing.coordinates :]
        numbers = [new[body] for body in self.bodies]
        places = np.array(places_of(numbers, layout, self.reduced.modes))
        rows[:, places] = whole
        rows[:, places[SIX - 1 : SIX * len(numbers) : SIX]] = 0.0  # bearings let shafts turn
        return rows

    @property
    def _physical(self) -> ShaftSystem:
        shafts = (
            placed_shaft(
                shaft.drawing,
                (place for _, place in shaft.points),
                shaft.sense * shaft.speed,
                moving=True,
            )
            for shaft in self.shafts
        )
        return ShaftSystem(tuple(shafts), self.housing)

    def supports(self) -> dict[int, GearSupport]:
        """Every body's displacement and stiffness; with the first of a shaft the loads of its bearings."""
        state, left = self.settled, self.reduced
        five = [SIX * n + i for n in range(len(self.bodies)) for i in range(IN_SPACE)]
        of_bearings = range(SIX * len(self.bodies), len(left.stiffness) - len(left.frequencies))
        held = np.ix_([*five, *of_bearings], [*five, *of_bearings])
        yielding = np.linalg.inv((left.stiffness + tangent_of(left.in_time))[held])
        found, number, bearing = {}, 0, 0
        for shaft in self.shafts:
            drawn = shaft.drawing.bearing
            under_load = state.bearings[bearing : bearing + len(drawn)]
            on_bearings = tuple(
                BearingUnderLoad(table.position, table, tuple(one.force.tolist()), element_loads(one))
                for table, one in zip(drawn, under_load, strict=True)
            )
            for first, (body, _) in enumerate(shaft.points):
                at = slice(IN_SPACE * number, IN_SPACE * (number + 1))
                own = np.linalg.inv(yielding[at, at])
                data = BearingData.of_matrix(
                    tuple(map(tuple, ((own + own.T) / 2.0).tolist())), shaft.drawing.damping_ratio
                )
                moved = tuple(state.points[number][:IN_SPACE].tolist())
                found[body] = GearSupport(data, moved, () if first else on_bearings)
                number += 1
            bearing += len(drawn)
        return found

    def inertia_of(self, body: int) -> float:
        """Polar inertia of a shaft that turns with a body, kg m²; 0 where it keeps its own modes."""
        if self.reduced.frequencies or body not in self.bodies:
            return 0.0
        turns = range(SIX - 1, SIX * len(self.bodies), SIX)
        return float(np.sum(self.reduced.mass[turns[self.bodies.index(body)], turns]))

    def couplings(
        self, layout: TrainLayout, bodies: Bodies, new: Mapping[int, int]
    ) -> tuple[CoupledMatrices, Float[Array, "bearing 3 coordinate"], Float[Array, "bearing 3"]]:
        """What couples the bodies of a model; forces on the bearings by the coordinates, and at rest.

        `new` are the numbers of the case's bodies in the model. Rotations about z are strained by links.
        """
        left, numbers = self.reduced, [new[body] for body in self.bodies]
        senses = [shaft.sense for shaft in self.shafts for _ in shaft.points]
        places = np.array(places_of(numbers, layout, left.modes))
        signs = np.ones(len(places))
        turns = np.arange(SIX - 1, SIX * len(numbers), SIX)
        signs[turns] = senses
        both = np.outer(signs, signs)
        stiffness = left.stiffness * both
        stiffness[turns], stiffness[:, turns] = 0.0, 0.0
        damping = left.damping * both
        damping[turns], damping[:, turns] = 0.0, 0.0
        spins = [shaft.sense * shaft.speed for shaft in self.shafts for _ in shaft.points]
        for first, body, spin in zip(range(0, SIX * len(numbers), SIX), numbers, spins, strict=True):
            momentum = float(bodies.inertia[body]) * spin
            damping[first + TILT_X, first + TILT_Y] += momentum
            damping[first + TILT_Y, first + TILT_X] -= momentum
        own = own_mass(layout, bodies)[places]
        own[SIX * len(numbers) :] = 0.0
        ratios = np.repeat([shaft.drawing.damping_ratio for shaft in self.shafts for _ in shaft.points], SIX)
        ratios = np.append(ratios, np.mean(ratios) * self._shares_of_shafts())
        free = np.setdiff1d(np.arange(len(places)), turns)
        damping[np.ix_(free, free)] += modal_damping(
            (left.mass + np.diag(own))[np.ix_(free, free)],
            (stiffness + tangent_of(left.in_time))[np.ix_(free, free)],
            ratios[free],
            rounding=0.0,
        )
        force = left.force * signs
        force[turns] = 0.0
        reaction = np.zeros((len(left.reaction), 3, layout.half))
        reaction[:, :, places] = left.reaction[:, :3] * signs
        reaction[:, :, places[turns]] = 0.0
        mass = left.mass * both
        if not left.frequencies:  # see `inertia_of`
            mass[turns], mass[:, turns] = 0.0, 0.0
        parts = CoupledMatrices(places, stiffness, damping, mass, force)
        # contiguous, as where nothing is drawn: machine code depends on it
        return parts, reaction, left.reaction_at_rest[:, :3].copy()


def coupled_by(
    system: DrawnSystem | None,
    further: Sequence[CoupledMatrices],
    layout: TrainLayout,
    bodies: Bodies,
    new: Mapping[int, int],
    prescribed: bool,
) -> tuple[TrainLayout, Couplings]:
    """The layout and numbers of what couples the bodies of a model; arguments as of `coupling.coupled`."""
    if system is None:
        return coupled(layout, further, bodies, prescribed) if further else (layout, Couplings())
    parts, reaction, at_rest = system.couplings(layout, bodies, new)
    layout, numbers = coupled(layout, [parts, *further], bodies, prescribed)
    return layout, numbers._replace(reaction=reaction, reaction_at_rest=at_rest)


def starts(shafts: Sequence[Mapping[int, float]], meshing: Sequence[tuple[int, int]]) -> list[float]:
    """Z of the starts of shafts: faces that mesh stand opposite each other, that of the first at z = 0.

    Of every shaft the places of its bodies; `meshing` are bodies that mesh.
    """
    place_of = {body: (n, place) for n, bodies in enumerate(shafts) for body, place in bodies.items()}
    found: dict[int, float] = {}
    for first in range(len(shafts)):
        if first in found:
            continue
        found[first] = -min(shafts[first].values())
        waiting = [first]
        while waiting:
            here = waiting.pop()
            for pair in meshing:
                for one, other in (pair, pair[::-1]):
                    if one in place_of and other in place_of and place_of[one][0] == here:
                        there, place = place_of[other]
                        if there not in found:
                            found[there] = found[here] + place_of[one][1] - place
                            waiting.append(there)
    return [found[n] for n in range(len(shafts))]


def _clear(shaft: ShaftData, begin: float, end: float) -> float:
    """Radius that a hollow shaft leaves free over a stretch of the axis, m; 0 where it is solid."""
    free, start = np.inf, shaft.start
    for section in shaft.drawing.section:
        if start < end and start + section.length > begin:
            free = min(free, section.bore / 2.0)
        start += section.length
    return float(free) if shaft.start <= begin and start >= end else 0.0


def check_room_of_shafts(
    shafts: Sequence[ShaftData],
    gears: Sequence[tuple[str, int, float, float]],
    centres: Sequence[Sequence[float]],
) -> None:
    """Raise InputError where a shaft penetrates a gear of another, if not in its shaft's bore.

    `gears` are names, bodies, tip radii and face widths; `centres` of the bodies, m.
    """
    shaft_of = {body: (shaft, place) for shaft in shafts for body, place in shaft.points}
    for shaft in shafts:
        for name, body, tip, width in gears:
            if body not in shaft_of or shaft_of[body][0] is shaft:
                continue
            carrier, place = shaft_of[body]
            middle = carrier.start + place
            apart = float(np.hypot(*(np.subtract(centres[body], shaft.centre))))
            start = shaft.start
            for number, section in enumerate(shaft.drawing.section):
                end = start + section.length
                inside = start < middle + width / 2.0 and end > middle - width / 2.0
                overlap = section.diameter / 2.0 + tip - apart
                shared = max(start, middle - width / 2.0), min(end, middle + width / 2.0)
                if inside and overlap > 0.0 and apart + section.diameter / 2.0 > _clear(carrier, *shared):
                    rule = (
                        f"penetrates {name} on the shaft {carrier.name} by {1e3 * overlap:.3g} mm: "
                        f"the axes are {1e3 * apart:.6g} mm apart, its tips at a radius of {1e3 * tip:.6g} mm"
                    )
                    remedy = "end the shaft before, make it thinner there, or change an azimuth or a position"
                    raise InputError(f"{shaft.key}.section.{number}.diameter", None, rule, remedy)
                start = end


def places_of(bodies: Sequence[int], layout: TrainLayout, modes: int) -> list[int]:
    """Places in the state of six directions of bodies of the model, and of all coordinates of no body."""
    places = []
    for body in bodies:
        places += [place_in_space(body, direction, layout) for direction in range(IN_SPACE)]
        places.append(turn_of(body, layout))
    return places + list(range(layout.half - modes, layout.half))
