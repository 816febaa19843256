"""The gears that a scenario of any kind holds: of its own, or of the scenario within it."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, NamedTuple

from tribodyn.errors import InputError
from tribodyn.gears.case import GearCase, OiledCase
from tribodyn.gears.rating.settings import RatingTable
from tribodyn.gears.scenario import GearScenario, gear_fields
from tribodyn.geometry.drive import SIDES
from tribodyn.input.messages import Origins
from tribodyn.input.quantity import Table
from tribodyn.input.tables.duty import in_force
from tribodyn.input.tables.lubricant import lubricant_of
from tribodyn.input.tables.temperature import oil_temperature_of
from tribodyn.studies import study_of
from tribodyn.studies.motion import PAIR, TRAIN
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.protocol.load import SoundScenario
from tribodyn.tribology.friction import FRICTION_LAWS

#: Kinds whose gears move.
MOVING = (PAIR, TRAIN)
#: A law that brings the film with it that it reads.
_NO_CHOICE = next(name for name, law in FRICTION_LAWS.items() if law.reads_film and not law.keys)
#: Of helical teeth by finite elements.
_BY_ENERGY = (
    "Loads and transmission error are shown by the energy method: finite elements of helical teeth, which a "
    "run takes, need minutes."
)


class HeldMesh(NamedTuple):
    """A mesh: its name, "" of a pair by itself, the names of its gears, and the pair at its duty."""

    name: str
    gears: tuple[str, str]
    pair: GearCase


class HeldGears(NamedTuple):
    """The gears of a scenario."""

    meshes: tuple[HeldMesh, ...]
    gearbox: Gearbox | None = None  # of a pair of a kind without motion there is none
    whole: Any = None  # what the study of a train says of its meshes
    place: str = ""  # before their keys, where they are those of a scenario within this one
    remarks: tuple[str, ...] = ()  # which state of them this is
    rated: bool = False  # whether the kind rates them itself

    def chosen(self, name: str) -> HeldMesh:
        """The mesh of a name; the first where there is none."""
        return next((mesh for mesh in self.meshes if mesh.name == name), self.meshes[0])

    @property
    def train(self) -> Gearbox | None:
        """The gearbox of a train, whose gears stand in places of their own."""
        return self.gearbox if self.gearbox is not None and self.gearbox.named else None


def held_by(sound: SoundScenario, place: str = "") -> HeldGears | None:
    """The gears of a scenario, no law of friction or film chosen; None: it holds none.

    Raises as its kind does where they cannot be put together; keys begin with the `place` of the scenario.
    """
    with keys_within(sound.origins, place):
        if sound.study in MOVING:
            return _of_gearbox(sound)._replace(place=place)
        if isinstance(sound.scenario, GearScenario):
            pair, said = _at_hand(_pair(in_force(sound.scenario)))
            return HeldGears((HeldMesh("", SIDES, pair),), place=place, remarks=said, rated=_rates(sound))
    if not isinstance(getattr(sound.scenario, "scenario", None), Table):
        return None
    with keys_within(sound.origins, f"{place}scenario."):
        within, said = _within(sound)
    found = held_by(within._replace(origins=sound.origins), f"{place}scenario.")
    said = (*filter(None, [said]), *found.remarks) if found else ()
    return found and found._replace(remarks=said, rated=found.rated or _rates(sound))


def _rates(sound: SoundScenario) -> bool:
    """Whether a scenario has settings of a rating."""
    return any(isinstance(value, RatingTable) for _, value in sound.scenario)


def is_searched(sound: SoundScenario) -> bool:
    """Whether the gears are those that a run begins with and changes."""
    return hasattr(type(sound.scenario), "begun")


@contextmanager
def keys_within(origins: Origins, place: str) -> Iterator[None]:
    """Name keys and files of errors inside the block, which are of a scenario at a place of the whole one."""
    with origins.naming():
        try:
            yield
        except InputError as error:
            if not place:
                raise
            raise InputError(f"{place}{error.key}", error.value, error.rule, error.remedy) from None


def _within(sound: SoundScenario) -> tuple[SoundScenario, str]:
    """The scenario within one as a run begins with it, and what is to be said of it."""
    if is_searched(sound):
        return type(sound.scenario).begun(sound)
    data = sound.data["scenario"]
    return sound._replace(data=data, study=study_of(data), scenario=sound.scenario.scenario), ""


def _of_gearbox(sound: SoundScenario) -> HeldGears:
    """A gearbox under a law of friction that need not be chosen: for geometry and loads."""
    scenario = in_force(sound.scenario)
    values = {name: getattr(scenario.friction, name) for name in type(scenario.friction).model_fields}
    friction = type(scenario.friction).model_construct(**values | {"law": _NO_CHOICE})
    case: Gearbox = sound.study.case(scenario.model_copy(update={"friction": friction, "film": None}), "", "")
    if not case.named:
        return HeldGears((HeldMesh("", SIDES, case.pair),), case)
    meshes = [
        HeldMesh(mesh.name, (case.gears[mesh.gears[0]].name, case.gears[mesh.gears[1]].name), mesh.pair)
        for mesh in case.meshes
    ]
    return HeldGears(tuple(meshes), case, sound.study.whole())


def _pair(scenario: Any) -> GearCase:
    """A pair with its oil, if there is any."""
    fields = gear_fields(scenario, "", "")
    if scenario.lubricant is None:
        return GearCase(**fields)
    return OiledCase(**fields, lubricant=lubricant_of(scenario.lubricant, oil_temperature_of(scenario)))


def _at_hand(pair: GearCase) -> tuple[GearCase, tuple[str, ...]]:
    """A pair whose table does not take minutes: of helical teeth by the energy method, and that it is."""
    if not (pair.mesh.at_load and pair.drive.helix_angle):
        return pair, ()
    return replace(pair, mesh=replace(pair.mesh, compliance="energy")), (_BY_ENERGY,)
