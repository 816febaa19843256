"""Loads, films, friction and wear of the pairs of one hunting period, and steps over the revolutions.

Pair n is tooth n of the pinion on tooth n of the gear, modulo their numbers, and enters with mesh cycle n.
It opens by what is worn off both. Loads, friction and film are solved together.

Steps are Heun's. None moves the load of any place, from its beginning to its predictor or to its end, by more
than a share of the largest load: one that does is halved and taken again. The volume that load, sliding and
coefficient wear off is integrated with the same weights as the depths.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.sharing.flank_gap import pitch_gap
from tribodyn.compliance.sharing.load_sharing import SharedLoad, half_width
from tribodyn.errors import SimulationError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.wear.case import WearCase
from tribodyn.studies.wear.pressed_positions import WearPlaces
from tribodyn.tribology.closure import closure_of
from tribodyn.tribology.law import Closure
from tribodyn.tribology.surface_state import ContactFriction, contact_friction
from tribodyn.tribology.wear.law import WearContact, depth_per_passage

# Friction moves loads through its arm alone: each round shrinks the error tenfold or more.
_ROUNDS, _TOLERANCE = 60, 1e-10

#: Depths (tooth, node, slice) of pinion and gear, m; one tooth where all are alike.
Depths = tuple[Float[Array, "tooth node slice"], Float[Array, "tooth node slice"]]


class Wearing(NamedTuple):
    """What a study needs to know beside the depths."""

    case: WearCase
    places: WearPlaces
    law: Any  # `tribology.wear.law.WearLaw`
    parameters: Any  # of the law
    #: what teeth lack from the beginning, each by itself; None: they are alike, but for their pitch errors
    own: Depths | None = None

    def closure_at(self, revolutions: float) -> Closure | None:
        """Laws of film and friction on flanks that have run so far; None: without a lubricant."""
        oiled, running_in = self.case.lubricated, self.case.running_in
        if oiled is None:
            return None
        share = 1.0 if running_in is None else running_in.share_at(revolutions)
        if share == 1.0:
            return closure_of(oiled)
        roughness = share * oiled.roughness, share * oiled.mean_roughness
        return closure_of(replace(oiled, roughness=roughness[0], mean_roughness=roughness[1]))


class ContactLaws(NamedTuple):
    """The laws at all positions (cycle, position, pair, slice); without a load they mean nothing."""

    friction_coefficient: Float[Array, "cycle position pair slice"]
    film: Float[Array, "cycle position pair slice"]  # m; 0 without a lubricant
    asperity_load_ratio: Float[Array, "cycle position pair slice"]
    seen: ContactFriction | None  # of the loaded ones (contact,)


class WearPassage(NamedTuple):
    """Loads of a hunting period, and what they wear."""

    depths: Depths
    closure: Closure | None  # None: without a lubricant
    load: Float[Array, "cycle position pair slice"]  # N
    deflection: Float[Array, "cycle position"]  # r_p θ_p − r_g θ_g, m
    approach: float  # the largest of what a slice's own load takes up, m
    line_load: Float[Array, "cycle position pair slice"]  # N/m
    pressure: Float[Array, "cycle position pair slice"]  # maximum Hertz pressure, Pa
    contacts: ContactLaws
    friction: Float[Array, "cycle position pair"]  # of the pairs
    coefficient: Float[Array, "cycle position pair slice"]  # K of the wear law, m²/N
    rates: Depths  # per revolution of the pinion, m
    volume_rate: float  # ∫ K F |v_s| dt on the path of contact in a revolution of the pinion, m³
    power_friction: float  # mean, W
    corner_share: float  # of ∫ F |v_s| dt that is off the path of contact

    @property
    def largest(self) -> float:
        """Largest line load, N/m."""
        return float(np.max(self.line_load))

    def moved_from(self, other: "WearPassage") -> float:
        """Largest change of the load of a place over the largest load of the other."""
        return float(np.max(np.abs(self.line_load - other.line_load))) / other.largest


def passage(
    study: Wearing,
    depths: Depths,
    revolutions: float,
    friction: Float[Array, "cycle position pair"] | None = None,
) -> WearPassage:
    """Find loads and rates after so many revolutions; `friction` begins the search for that of the pairs.

    Raises SimulationError if no state of contact is found, or load and friction do not settle.
    """
    case, places, closure = study.case, study.places, study.closure_at(revolutions)
    gap = _gap(study, depths)
    mu = np.full(gap.shape[:3], case.friction_coefficient) if friction is None else friction
    for _ in range(_ROUNDS):
        shared = places.held.share(case.operating.gear_torque, gap, mu)
        load = shared.slice_load
        contacts = _contacts(study, closure, load)
        before, mu = mu, _of_pairs(load, contacts.friction_coefficient, mu)
        if np.max(np.abs(mu - before)) < _TOLERANCE:
            break
    else:
        raise SimulationError("load and friction coefficient do not settle")
    return _worn(study, closure, depths, shared, contacts, mu)


def _gap(study: Wearing, depths: Depths) -> Float[Array, "cycle position pair slice"]:
    """What both flanks lack at all positions, worn off and from the beginning, m."""
    case, places = study.case, study.places
    shape = places.held.shape
    number = np.arange(case.cycles)[:, None] - places.ages  # of the pair, (cycle, pair)
    total = np.zeros((case.cycles, *shape))
    position, pair = np.arange(shape[0])[:, None], np.arange(shape[1])
    missing = depths if study.own is None else [a + b for a, b in zip(depths, study.own, strict=True)]
    for matrix, depth in zip(places.to_position, missing, strict=True):
        at = np.matmul(matrix, np.moveaxis(depth, -1, 1)[..., None])[..., 0]  # (tooth, slice, sample)
        by_tooth = np.moveaxis(at, 1, -1).reshape(len(depth), *shape)
        total += by_tooth[(number % len(depth))[:, None, :], position, pair]
    return total + pitch_gap(case.mesh.modifications, number)[:, None, :, None]


def _contacts(
    study: Wearing, closure: Closure | None, load: Float[Array, "cycle position pair slice"]
) -> ContactLaws:
    """Evaluate the laws where anything is carried."""
    places, case = study.places, study.case
    friction = np.full(load.shape, case.friction_coefficient)
    film, share = np.zeros(load.shape), np.ones(load.shape)
    if closure is None:
        return ContactLaws(friction, film, share, None)
    carries, speed = load > 0.0, case.operating.pinion_speed
    line_load = load / places.held.length
    whole = np.ones(load.shape)
    length, rate = places.vanishing
    seen = contact_friction(
        closure,
        line_load[carries],
        1.0 / (places.held.faces.curvature * whole)[carries],
        speed * (places.sliding.pinion_speed * whole)[carries],
        speed * (places.sliding.gear_speed * whole)[carries],
        length,
        speed * rate,
    )
    friction[carries] = seen.surface.friction_coefficient
    film[carries] = seen.surface.central_film_thickness
    share[carries] = seen.surface.asperity_load_ratio
    return ContactLaws(friction, film, share, seen)


def _of_pairs(
    load: Float[Array, "cycle position pair slice"], friction: Any, unloaded: Any
) -> Float[Array, "cycle position pair"]:
    """Mean over the face by the load; of a pair that carries nothing as it was."""
    total = np.sum(load, axis=-1)
    carried = np.where(total > 0.0, total, 1.0)
    return np.where(total > 0.0, np.sum(load * friction, axis=-1) / carried, unloaded)


def _worn(
    study: Wearing,
    closure: Closure | None,
    depths: Depths,
    shared: SharedLoad,
    contacts: ContactLaws,
    friction: Float[Array, "cycle position pair"],
) -> WearPassage:
    """Rates and powers of loads that have settled."""
    load = shared.slice_load
    case, places = study.case, study.places
    held, sliding = places.held, places.sliding
    line_load = load / held.length
    half = half_width(held.flanks.flexible, held.faces.curvature, line_load)
    pressure = np.where(load > 0.0, 2.0 * line_load / (np.pi * np.where(load > 0.0, half, 1.0)), 0.0)
    ratio = 0.0 if closure is None else contacts.film / closure.surfaces.roughness
    seen = WearContact(pressure, contacts.friction_coefficient, ratio, contacts.asperity_load_ratio)
    coefficient = study.law.functions.coefficient(seen, study.parameters) * np.ones(load.shape)
    on_path = places.on_path * coefficient
    pinion, gear = case.counts
    # a tooth of the gear passes z_1/z_2 times in a revolution of the pinion
    rates = (
        by_teeth(places, depth_per_passage(on_path, line_load, sliding.pinion_slip), len(depths[0])),
        by_teeth(places, depth_per_passage(on_path, line_load, sliding.gear_slip), len(depths[1]))
        * (pinion / gear),
    )
    work = load * sliding.sliding  # N m/rad
    speed, weight = case.operating.pinion_speed, places.weight[:, None, None]
    through = np.sum(work * weight, axis=(1, 2, 3))
    # in a revolution: positions are too few to tell by theirs where the path of contact ends
    on_path_work = pinion * float(np.mean(np.sum(work * places.along, axis=(1, 2, 3))))
    corners = np.any((work > 0.0) & ~places.on_path)
    lost = np.sum(contacts.friction_coefficient * work * weight, axis=(1, 2, 3))
    return WearPassage(
        depths,
        closure,
        load,
        shared.deflection,
        float(np.max(shared.overlap)),
        line_load,
        pressure,
        contacts,
        friction,
        coefficient,
        rates,
        pinion * float(np.mean(np.sum(coefficient * work * places.along, axis=(1, 2, 3)))),
        speed * float(np.mean(lost)),
        max(1.0 - on_path_work / (2.0 * math.pi * float(np.mean(through))), 0.0) if corners else 0.0,
    )


def by_teeth(
    places: WearPlaces, values: Float[Array, "cycle position pair slice"], teeth: int = 1
) -> Float[Array, "tooth node slice"]:
    """Values at the nodes of each of so many teeth, the mean over the mates that a tooth meets."""
    cycles, slices = values.shape[0], values.shape[-1]
    # pair n in the place of age a is there in cycle n + a
    cycle = (np.arange(cycles)[:, None] + places.ages) % cycles
    pair = np.arange(len(places.ages))
    history = values[cycle[:, None, :], np.arange(values.shape[1])[:, None], pair]
    samples = np.moveaxis(history.reshape(cycles, -1, slices), -1, 1)
    at_nodes = np.matmul(places.to_node, samples[..., None])[..., 0]  # (pair number, slice, node)
    of_teeth = at_nodes.reshape(-1, teeth, *at_nodes.shape[1:]).mean(axis=0)
    return np.maximum(np.moveaxis(of_teeth, 1, -1), 0.0)


#: Depth over the module at which a flank is no flank any more, as of modifications.
DEEPEST = 0.1
# Growth of a step at most, and the share of what the load change allows that the next one aims at.
_GROWTH, _AIM = 2.0, 0.8
# A step below this share of the revolutions to come leads nowhere; where nothing wears any step will do.
_SHORTEST, _ANY = 1e-9, 1e30


class Worn(NamedTuple):
    """State after some revolutions; all of it is needed to go on."""

    revolutions: float
    depths: Depths
    next_step: float  # revolutions
    volume: float  # ∫ K F |v_s| dt so far, m³
    steps: int
    rejected: int


def unworn(study: Wearing) -> Worn:
    """New flanks."""
    nodes, slices = len(study.places.node), study.places.held.shape[-1]
    counts = study.case.counts if study.case.each_tooth else (1, 1)
    pinion, gear = (np.zeros((count, nodes, slices)) for count in counts)
    return Worn(0.0, (pinion, gear), 0.0, 0.0, 0, 0)


def march(study: Wearing, start: Worn, rows: np.ndarray) -> Iterator[tuple[Worn, WearPassage]]:
    """Go on from a state; yield the state and its loads at every row, in revolutions, increasing.

    The loads at a row do not depend on the way there: who goes on from it takes the same steps. Raises
    SimulationError as `passage`, where a flank is worn away, or where no step is short enough.
    """
    state, at = start, None
    for row in rows:
        at = at or passage(study, state.depths, state.revolutions)
        while state.revolutions < row:
            state, at = _step(study, state, at, float(row))
        at = passage(study, state.depths, state.revolutions)
        yield state, at


def _step(study: Wearing, state: Worn, at: WearPassage, row: float) -> tuple[Worn, WearPassage]:
    """Take one step, to a row at most."""
    limit, remaining = study.case.load_change, row - state.revolutions
    wished = state.next_step or _first(study, at)
    rejected, running_in = state.rejected, study.case.running_in
    longest = np.inf if running_in is None else running_in.step_at(state.revolutions)
    while True:
        step = min(wished, remaining, longest)
        there = _ahead(state.depths, at.rates, step)
        ahead = row if step == remaining else state.revolutions + step
        trial = passage(study, there, ahead, at.friction)
        moved, passed = trial.moved_from(at), None
        if moved <= limit:
            rates = tuple((a + b) / 2.0 for a, b in zip(at.rates, trial.rates, strict=True))
            depths = _ahead(state.depths, (rates[0], rates[1]), step)
            passed = passage(study, depths, ahead, trial.friction)
            moved = max(moved, passed.moved_from(at))
        if passed is not None and moved <= limit:
            break
        wished, rejected = step / 2.0, rejected + 1
        if step < _SHORTEST * remaining:
            raise SimulationError(
                f"after {state.revolutions:.6g} revolutions no step is short enough: loads still move by "
                f"{100.0 * moved:.2g} %"
            )
    deepest = float(max(np.max(depth) for depth in passed.depths)) / study.case.drive.module
    if deepest > DEEPEST:
        raise SimulationError(
            f"after {state.revolutions + step:.6g} revolutions flanks are worn by more than a tenth of the "
            "module"
        )
    growth = min(_GROWTH, _AIM * limit / max(moved, 1e-12))
    # a step that was cut short at a row says little of the next one
    next_step = min(step * growth if step == wished else max(wished, step * growth), _ANY)
    volume = state.volume + step * (at.volume_rate + trial.volume_rate) / 2.0
    return Worn(ahead, passed.depths, next_step, volume, state.steps + 1, rejected), passed


def _first(study: Wearing, at: WearPassage) -> float:
    """A step that moves the flanks by a share of how far the load brings them together."""
    rate = float(np.max(at.rates[0])) + float(np.max(at.rates[1]))
    return study.case.load_change * at.approach / rate if rate > 0.0 else _ANY


def _ahead(depths: Depths, rates: Depths, step: float) -> Depths:
    pinion, gear = (depth + step * rate for depth, rate in zip(depths, rates, strict=True))
    return pinion, gear
