"""`law = "auto"`: the film and the friction law that are nearest to the solved contact at a duty.

Every law that was compared with the solved contact (`JudgedRange`) is evaluated along the way of a pair at
the nominal duty. It holds where its limits do on `HOLDS` of the way: those by the solved contact, or its
authors' where there are none; a friction law's by the heat that is made there, as friction at the pitch point
costs nothing. Of those that hold the one is taken whose ratio to the solved contact is nearest to 1 at 5 and
95 % of the contacts of gears; where none holds, of all, outside their ranges. Laws that are tabulated, need
values or are readings of another law (`other-…`) are no candidates.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple, TypeVar

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.path import kinematics
from tribodyn.numerics.registry import Registry
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.closure import Lubricated, closure, law_input
from tribodyn.tribology.contact import LocalContact, local_contact
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import AUTO, Closure, FilmData, FilmLaw, FrictionLaw, LawInput
from tribodyn.tribology.surface_state import limits_last, surface_and_limits

#: Share of the way of a pair on which the limits of a law must hold.
HOLDS = 0.9
#: Places on the way at which laws are evaluated.
PLACES = 41

CaseType = TypeVar("CaseType", bound=Lubricated)


class LawAtDuty(NamedTuple):
    """A law at a duty."""

    law: Any
    holds: bool
    #: law over solved contact in nine of ten contacts, inside its range where it holds, outside elsewhere
    ratio: tuple[float, float]

    @property
    def factor(self) -> float:
        """By which the law is off at most."""
        low, high = self.ratio
        return max(high, 1.0 / low)

    @property
    def reason(self) -> str:
        """Why it was taken, for people."""
        what, (low, high) = self.law.table, self.ratio
        whose = "whose range holds at this duty" if self.holds else "at this duty, at which no range holds"
        times = f"{low:.2g} to {high:.2g} times it in nine of ten contacts"
        return f"nearest to the solved contact of the {what} laws {whose}: {times}"


def settled(case: CaseType) -> CaseType:
    """Return the case with a law in the place of each "auto"; the same case where it has none.

    A friction law that reads the film goes with its own film law where the scenario names none. Raises
    InputError where the duty has no torque or no speed.
    """
    friction, film = case.friction.law, case.film.law
    if AUTO not in (friction, film):
        return case
    contact, changed = _along(case), {}
    if friction == AUTO:
        heat = contact.line_load * np.abs(contact.sliding)
        found = _nearest(FRICTION_LAWS, law_input(case), contact, heat)
        changed["friction"] = replace(case.friction, law=found.law.name, chosen=found.reason)
        if film is None and not found.law.reads_film:
            film = AUTO
    if film == AUTO:
        found = _nearest(FILM_LAWS, law_input(case), contact, np.ones_like(contact.line_load))
        changed["film"] = FilmData(found.law.name, chosen=found.reason)
    return replace(case, **changed)  # pyright: ignore[reportArgumentType]  (cases are dataclasses)


def _along(case: Lubricated) -> LocalContact:
    """Contacts of a pair on its way through the mesh; pairs in contact together carry equal loads."""
    torque, speed = abs(float(case.operating.gear_torque)), abs(float(case.operating.pinion_speed))
    if torque == 0.0 or speed == 0.0:
        rule = f'"{AUTO}" takes a law by the nominal duty, and this one has no torque or no speed'
        raise InputError("friction.law", f'"{AUTO}"', rule, "name a law: tribodyn list laws")
    assembly = assemble(family(case.family), case.drive)
    start, end = map(float, assembly.roll_limits)
    roll = start + (np.arange(PLACES) + 0.5) / PLACES * (end - start)
    pitch = float(assembly.pitch_angle)
    many = int((end - start) / pitch) + 1
    pairs = sum((roll + n * pitch >= start) & (roll + n * pitch <= end) for n in range(-many, many + 1))
    motion = kinematics(assembly.path, assembly.path.signed_distance(roll))
    load = torque / np.abs(motion.gear_normal_arm) / float(assembly.common_width) / pairs
    speeds = speed * motion.pinion_speed, speed * motion.gear_speed
    return local_contact(
        load, np.abs(motion.relative_curvature), speed * motion.entrainment, speed * motion.sliding, *speeds
    )


def _nearest(
    laws: Registry[Any], given: LawInput, contact: LocalContact, weight: Float[Array, " place"]
) -> LawAtDuty:
    """The law of the smallest factor of those that hold, or of all where none does."""
    found = list(_candidates(laws, given, contact, weight))
    return min(found, key=lambda candidate: (not candidate.holds, candidate.factor))


def _candidates(
    laws: Registry[Any], given: LawInput, contact: LocalContact, weight: Float[Array, " place"]
) -> Iterator[LawAtDuty]:
    names: list[str] = []
    for name, law in laws.items():
        if law.judged is None or law.table_error is not None:
            continue
        if any(name.startswith(f"{other}-") for other in names):  # a reading of that law
            continue
        names.append(name)
        try:
            made = _made(law, given)
        except InputError:  # a mean over the mesh without pressure angle at the pitch point
            continue
        shares = limits_last(surface_and_limits(contact, made)[1][0 if law.table == "film" else 1])
        shares = np.broadcast_to(shares, (PLACES, shares.shape[-1]))[:, -law.judged.limits :]
        inside = float(np.average(np.all(shares >= 1.0, axis=1), weights=weight))
        ratio = law.judged.ratio
        if inside < HOLDS and law.judged.outside is not None:
            ratio = law.judged.outside
        yield LawAtDuty(law, inside >= HOLDS, (ratio[0], ratio[2]))


def _made(law: FilmLaw | FrictionLaw, given: LawInput) -> Closure:
    if isinstance(law, FilmLaw):
        return closure(given, law, FRICTION_LAWS["none"])
    return closure(given, FILM_LAWS[law.film], law)
