"""`law = "auto"`: the film and the friction law that are nearest to the contact as it is solved at a duty.

The film is also chosen where a scenario names a friction law that reads none, and no film law.

The contact of a pair is solved, mixed and with heat, at `SOLVED` places of its way through the mesh at the
nominal duty; every law that was compared with solved contacts of gears (`JudgedRange`) is evaluated there.
Of the film the law is taken whose values are nearest on the mean, of friction the one whose loss is; of those
that are next to nearest by `ALIKE` one whose whole range holds on `HOLDS` of the way is preferred. Where no
contact can be solved, the ratios of `JudgedRange` stand in. Laws that are tabulated, need values or are
readings of another law (`other-…`) are no candidates.
"""

import hashlib
import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple, TypeVar

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import curvature_share, pitch_slope, speed_share
from tribodyn.geometry.path import kinematics
from tribodyn.numerics.files.cache import arrays_kept_or_made
from tribodyn.numerics.files.sources import digest_of
from tribodyn.numerics.registry import Registry
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.closure import LEAST_SLIDING, Lubricated, closure, is_open, law_input
from tribodyn.tribology.contact import LocalContact, local_contact
from tribodyn.tribology.ehl.of_case import Contact, contact_of
from tribodyn.tribology.ehl.table import CACHE, solve_one
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import AUTO, Closure, FilmData, FilmLaw, FrictionLaw, LawInput
from tribodyn.tribology.surface_state import limits_last, surface_and_limits

#: Share of the way of a pair on which the limits of a law must hold.
HOLDS = 0.9
#: Places on the way at which limits are evaluated, and which of them are solved.
PLACES = 40
SOLVED = slice(2, PLACES, 9)
#: Grid's step of those contacts: the film within 2 %, friction within 3 %, in 0.05 s of a core each.
STEP = 0.25
#: Factor on the nearest law's departure up to which a law that is inside its range is preferred.
ALIKE = 1.1

CaseType = TypeVar("CaseType", bound=Lubricated)


class LawAtDuty(NamedTuple):
    """A law at a duty."""

    law: Any
    inside: float  # share of the way, of friction of its loss, inside the law's range; NaN: none stated
    #: law over solved contact at the places: least, on the mean (of friction over the loss), greatest; where
    #: none was solved, in nine of ten contacts of gears
    ratio: tuple[float, float, float]
    solved: bool

    @property
    def distance(self) -> float:
        """By which the law is off, as the logarithm of a factor; infinite where it gives nothing."""
        low, middle, high = (math.log(each) if each > 0.0 else -math.inf for each in self.ratio)
        return abs(middle) if self.solved else max(high, -low)

    @property
    def reason(self) -> str:
        """Why it was taken, for people."""
        what, (low, middle, high) = self.law.table, self.ratio
        contact = "the contact solved at this duty" if self.solved else "solved contacts of gears"
        of = "loss" if what == "friction" else "film"
        times = f"{middle:.2g} times its {of} ({low:.2g} to {high:.2g} along the way)"
        return f"nearest to {contact}: {times}; {self.range}"

    @property
    def range(self) -> str:
        """Whether its range holds, in words."""
        if math.isnan(self.inside):
            return "it states no range"
        of = "loss" if self.law.table == "friction" else "way"
        beyond = f"{100 * (1.0 - self.inside):.0f} % of the {of}"
        if self.inside >= HOLDS:
            return "its range holds" if self.inside == 1.0 else f"its range holds but for {beyond}"
        return f"outside its range in {beyond}"


def settled(case: CaseType) -> CaseType:
    """Return the case with a law in the place of each "auto"; the same case where it has none.

    A friction law that reads the film goes with its own film law where the scenario names none; with any
    other the nearest film law is taken, where the duty has a torque and a speed. Raises InputError where it
    has not and "auto" is asked for.
    """
    friction, film = case.friction.law, case.film.law
    if AUTO not in (friction, film):
        if not is_open(case) or 0.0 in _duty(case):
            return case
        film = AUTO
    contact, inputs, changed = _along(case), law_input(case), {}
    if friction == AUTO:
        nearest_law = nearest(FRICTION_LAWS, inputs, contact)
        changed["friction"] = replace(case.friction, law=nearest_law.law.name, **_why(nearest_law))
        if film is None and not nearest_law.law.reads_film:
            film = AUTO
    if film == AUTO:
        nearest_law = nearest(FILM_LAWS, inputs, contact)
        changed["film"] = FilmData(nearest_law.law.name, **_why(nearest_law))
    return replace(case, **changed)  # pyright: ignore[reportArgumentType]  (cases are dataclasses)


def _duty(case: Lubricated) -> tuple[float, float]:
    return abs(float(case.operating.gear_torque)), abs(float(case.operating.pinion_speed))


def _why(candidate: LawAtDuty) -> dict[str, Any]:
    return {"chosen": candidate.reason, "ratio": candidate.ratio if candidate.solved else None}


def _along(case: Lubricated) -> LocalContact:
    """Contacts of a pair on its way through the mesh; pairs in contact together carry equal loads."""
    torque, speed = _duty(case)
    if torque == 0.0 or speed == 0.0:
        rule = f'"{AUTO}" takes a law by the nominal duty, and this one has no torque or no speed'
        raise InputError(
            "friction.law" if case.friction.law == AUTO else "film.law",
            f'"{AUTO}"',
            rule,
            "name a law: tribodyn list laws",
        )
    assembly = assemble(family(case.family), case.drive)
    start, end = sorted(map(float, assembly.roll_limits))  # a ring that drives turns the other way
    roll = start + (np.arange(PLACES) + 0.5) / PLACES * (end - start)
    pitch, path, slope = float(assembly.pitch_angle), assembly.path, float(pitch_slope(assembly))
    many = int((end - start) / pitch) + 1
    pairs: Any = sum((roll + n * pitch >= start) & (roll + n * pitch <= end) for n in range(-many, many + 1))
    if slope:  # lines of contact of all pairs are about as long at every position
        pairs = (end - start) / pitch
    distance = path.signed_distance(roll)
    motion = kinematics(path, distance)
    load = torque / np.abs(motion.gear_normal_arm) / float(assembly.common_width) / pairs
    curvature = np.abs(motion.relative_curvature * curvature_share(slope, path, distance))
    speed = speed * np.asarray(speed_share(slope, path, distance))
    speeds = speed * motion.pinion_speed, speed * motion.gear_speed
    return local_contact(load, curvature, speed * motion.entrainment, speed * motion.sliding, *speeds)


def nearest(laws: Registry[Any], inputs: LawInput, contact: LocalContact) -> LawAtDuty:
    """The law nearest to the solved contact along a way of `PLACES` contacts, see the module."""
    films, coefficients = _solved(inputs, contact)
    right = films if laws is FILM_LAWS else coefficients
    ordered = sorted(_candidates(laws, inputs, contact, right), key=lambda candidate: candidate.distance)
    alike = [each for each in ordered if each.distance <= ordered[0].distance + math.log(ALIKE)]
    return next((each for each in alike if each.inside >= HOLDS), ordered[0])


def _solved(inputs: LawInput, contact: LocalContact) -> tuple[Float[Array, " place"], Float[Array, " place"]]:
    """Films (m) and friction coefficients of the contacts `SOLVED`; NaN where there is no solution."""
    ratio = np.maximum(np.abs(contact.sliding) / contact.entrainment, LEAST_SLIDING)
    columns = contact.line_load, contact.entrainment, contact.curvature, ratio
    rows = np.log(np.stack(np.broadcast_arrays(*columns), axis=1))[SOLVED]
    values = _solutions(contact_of(inputs), tuple(map(tuple, rows.tolist())))
    return np.exp(values[:, 0]), np.exp(values[:, 1])


@lru_cache(maxsize=64)
def _solutions(contact: Contact, duties: tuple[tuple[float, ...], ...]) -> Float[Array, "place 3"]:
    """`solve_one` of each duty, from this process, from the cache, or solved."""
    digest = hashlib.sha256(digest_of(solve_one.__module__) + repr((contact, duties)).encode()).hexdigest()
    solve = lambda: {"values": np.array([_one(contact, np.array(duty)) for duty in duties])}  # noqa: E731
    return arrays_kept_or_made(CACHE, digest, solve)["values"]


def _one(contact: Contact, duty: Float[Array, " number"]) -> Float[Array, " 3"]:
    try:
        return solve_one(contact, duty, STEP)
    except InputError:  # next to no load, or a film of another order than the contact
        return np.full(3, math.nan)


def _candidates(
    laws: Registry[Any], inputs: LawInput, contact: LocalContact, right: Float[Array, " place"]
) -> Iterator[LawAtDuty]:
    heat = contact.line_load * np.abs(contact.sliding)
    solved, names = np.isfinite(right), list[str]()
    for name, law in laws.items():
        if law.judged is None or law.table_error is not None:
            continue
        if any(name.startswith(f"{other}-") for other in names):  # a reading of that law
            continue
        names.append(name)
        try:
            state, limits = surface_and_limits(contact, _made(law, inputs))
        except InputError:  # a mean over the mesh without pressure angle at the pitch point
            continue
        film = law.table == "film"
        shares = limits_last(limits[0 if film else 1])
        least = np.min(np.broadcast_to(shares, (PLACES, shares.shape[-1])), axis=1)
        inside = math.nan
        if not np.all(np.isnan(least)):
            inside = float(np.average(least >= 1.0, weights=np.ones(PLACES) if film else heat))
        if not np.any(solved):
            judged = law.judged.ratio if inside >= HOLDS else law.judged.outside or law.judged.ratio
            yield LawAtDuty(law, inside, judged, solved=False)
            continue
        values = state.central_film_thickness if film else np.abs(state.friction_coefficient)
        ratio = np.broadcast_to(values, (PLACES,))[SOLVED][solved] / right[solved]
        if film:
            with np.errstate(divide="ignore"):  # a film of 0
                middle = float(np.exp(np.mean(np.log(ratio))))
        else:
            middle = float(np.average(ratio, weights=heat[SOLVED][solved] * right[solved]))
        yield LawAtDuty(law, inside, (float(np.min(ratio)), middle, float(np.max(ratio))), solved=True)


def _made(law: FilmLaw | FrictionLaw, inputs: LawInput) -> Closure:
    if isinstance(law, FilmLaw):
        return closure(inputs, law, FRICTION_LAWS["none"])
    return closure(inputs, FILM_LAWS[law.film], law)
