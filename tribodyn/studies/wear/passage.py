"""Loads, films, friction and wear of the pairs of one hunting period, with flanks worn so far.

Pair n is tooth n of the pinion on tooth n of the gear, modulo their numbers, and enters with mesh cycle n.
It opens by what is worn off both. Loads, friction and film are solved together.
"""

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
from tribodyn.tribology.wear.depth import depth_per_passage
from tribodyn.tribology.wear.law import WearContact

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
    corners = np.sum(work * weight * ~places.on_path, axis=(1, 2, 3))
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
        float(np.sum(corners) / np.sum(through)),
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
