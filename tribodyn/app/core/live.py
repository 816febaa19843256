"""What is computed while a scenario is edited: geometry at once, slow rotation, the check, the motion.

A stage takes what those before it have prepared; tables of the mesh, laws and kernels are kept between edits
that do not change them. What is wrong with a scenario is part of the result, as the command line says it.
"""

import math
import os
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Any

from tribodyn.app.core.geometry import mesh_geometry, train_geometry
from tribodyn.app.core.messages import Message, data_of, findings
from tribodyn.app.core.motion import motion_of
from tribodyn.app.core.shown import tables_of
from tribodyn.app.core.slow_rotation import at_torques, slow_rotation
from tribodyn.app.core.strength import strength_of
from tribodyn.cases.assessment_part import Meshing
from tribodyn.cases.results import Progress
from tribodyn.errors import InputError, OutputError, SimulationError
from tribodyn.gears.prepare import assembled
from tribodyn.input.tables.duty import in_force
from tribodyn.studies.motion import PAIR, TRAIN
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.prepare import tabulated
from tribodyn.studies.protocol.load import Loaded, SoundScenario
from tribodyn.tribology.friction import FRICTION_LAWS

#: In the order in which they are computed.
STAGES = ("geometry", "static", "motion", "torques", "strength", "check")
#: Scenarios whose cases are kept, as one is edited and compared with others.
KEPT = 8
#: A law that brings the film with it that it reads.
_NO_CHOICE = next(name for name, law in FRICTION_LAWS.items() if law.reads_film and not law.keys)
#: Shares of the nominal torque at which the transmission error is shown.
SHARES = (0.5, 1.0, 1.5)
_UNLOADED = "The duty has no torque: nothing is loaded."
_ELSEWHERE = "A study of kind %s is checked while it is edited, not computed: start it by Run …"


@dataclass(frozen=True)
class LiveRequest:
    """A scenario to be computed."""

    text: str
    path: str  # of its file, from which others are named
    mesh: str = ""  # of a train, the mesh that is looked at; "": the first
    torques: tuple[float, ...] = SHARES  # of the nominal, for the quasi-static transmission error


class Live:
    """Computes stages of scenarios, one after the other, in one process; runs are recorded in a folder."""

    def __init__(self, scratch: Path) -> None:
        self._scratch = scratch
        self._progress: Progress | None = None
        self._sound: dict[tuple[str, str], SoundScenario] = {}
        self._stamps: dict[tuple[str, str], dict[str, int]] = {}
        self._plain: dict[tuple[str, str], Gearbox] = {}
        self._loaded: dict[tuple[str, str], Loaded] = {}

    def compute(self, stage: str, request: LiveRequest, progress: Progress | None = None) -> dict[str, Any]:
        """The result of a stage; that of a scenario that is wrong says what is.

        `progress` is told the share done of a motion.

        Every result has `stage`, `ok`, `errors` (of each the fields of `Message`, and `short`), `warnings`
        and `seconds`; what a stage has besides is said of its function. Of a study that is no gearbox in
        motion there is the check alone.
        """
        begun = perf_counter()
        head: dict[str, Any] = {"stage": stage, "warnings": [], "errors": []}
        try:
            self._progress = progress
            study = self._of_text(request).study
            is_live = study in (PAIR, TRAIN) or stage == "check"
            result = _STAGES[stage](self, request) if is_live else {"remarks": [_ELSEWHERE % study.kind]}
            return head | {"ok": True, "seconds": perf_counter() - begun} | result
        except (InputError, SimulationError, OutputError) as error:
            errors = Message.each(error)
        except (ArithmeticError, ValueError, IndexError, KeyError, TypeError, AssertionError) as error:
            what = " ".join(f"{type(error).__name__}: {error}".split())
            errors = Message.each(SimulationError(f"a bug in tribodyn: {what}; report it"))
        return head | {
            "ok": False,
            "errors": [message._asdict() | {"short": message.short} for message in errors],
            "seconds": perf_counter() - begun,
        }

    def _geometry(self, request: LiveRequest) -> dict[str, Any]:
        """`meshes` and the `mesh`, what `mesh_geometry` has, and of a train `train`, as `train_geometry`."""
        sound, case, number = self._unchosen(request)
        with sound.origins.naming():
            mesh = case.meshes[number]
            shown = mesh_geometry(case, mesh, assembled(mesh.pair))
            shown["train"] = train_geometry(case) if case.named else None
        return _names(case, number) | shown

    def _static(self, request: LiveRequest) -> dict[str, Any]:
        """What `slow_rotation` has of the mesh; nothing of a duty without torque."""
        sound, case, number = self._unchosen(request)
        with sound.origins.naming():
            pair = case.meshes[number].pair
            found = slow_rotation(pair, assembled(pair))
        return _names(case, number) | (found or {"warnings": [_UNLOADED]})

    def _torques(self, request: LiveRequest) -> dict[str, Any]:
        """What `at_torques` has of the mesh; nothing of a duty without torque."""
        sound, case, number = self._unchosen(request)
        shares = [share for share in request.torques if math.isfinite(share) and share > 0.0]
        with sound.origins.naming():
            pair = case.meshes[number].pair
            found = at_torques(pair, assembled(pair), shares)
        return _names(case, number) | (found or {"warnings": [_UNLOADED]})

    def _strength(self, request: LiveRequest) -> dict[str, Any]:
        """What `strength_of` has of the mesh."""
        sound, case, number = self._unchosen(request)
        whole = sound.study.whole()
        with sound.origins.naming():
            pair = case.meshes[number].pair
            turns = whole.meshes(case)[number].meshing if whole is not None else (Meshing(), Meshing())
            return _names(case, number) | strength_of(pair, assembled(pair), turns)

    def _check(self, request: LiveRequest) -> dict[str, Any]:
        """`tables`, `details` and `remarks` as ``tribodyn check`` prints them, and its `data`, SI."""
        loaded = self._case(request)
        with loaded.naming():
            checked = loaded.study.check(loaded.case)
        return {
            "tables": tables_of(checked.tables),
            "details": tables_of(checked.details),
            "remarks": list(checked.remarks),
            "warnings": list(checked.warnings),
            "data": checked.data,
        }

    def _motion(self, request: LiveRequest) -> dict[str, Any]:
        """What `motion_of` has: the run that ``tribodyn run`` makes, its last cycles and its summary."""
        *_, case, number = self._unchosen(request)
        beside = threading.Thread(target=_tabulate, args=(case,), daemon=True)
        if (request.text, request.path) not in self._loaded:
            beside.start()  # tables need no laws, whose choice takes as long
        loaded = self._case(request)
        while beside.is_alive():  # in short waits, so that a newer request is heard
            beside.join(0.02)
        with loaded.naming():
            record = self._scratch / "motion.h5"
            return _names(loaded.case, number) | motion_of(loaded, record, number, self._progress)

    def _unchosen(self, request: LiveRequest) -> tuple[SoundScenario, Gearbox, int]:
        """The scenario of a text, its gearbox before laws are chosen, and the number of the mesh."""
        sound = self._of_text(request)
        key = request.text, request.path
        if key not in self._plain:
            _keep(self._plain, key, _without_choice(sound))
        case = self._plain[key]
        return sound, case, _mesh_of(case, request)

    def _of_text(self, request: LiveRequest) -> SoundScenario:
        """The scenario of a text that has passed schema and rules; raises all that it has not."""
        key = request.text, request.path
        if key in self._sound and _stamps(self._sound[key]) != self._stamps[key]:
            for kept in (self._sound, self._plain, self._loaded):
                kept.pop(key, None)
        if key not in self._sound:
            path = Path(request.path)
            data, broken = data_of(request.text, path)
            if broken is not None:
                raise broken
            found = findings(data, path)
            if found.sound is None:
                assert found.error is not None, "either of both"
                raise found.error
            _keep(self._sound, key, found.sound)
            _keep(self._stamps, key, _stamps(found.sound))
        return self._sound[key]

    def _case(self, request: LiveRequest) -> Loaded:
        """The case of a text, its laws chosen."""
        key = request.text, request.path
        sound = self._of_text(request)
        if key not in self._loaded:
            _keep(self._loaded, key, sound.loaded())
        return self._loaded[key]


_STAGES: dict[str, Callable[[Live, LiveRequest], dict[str, Any]]] = {
    "geometry": Live._geometry,
    "static": Live._static,
    "torques": Live._torques,
    "check": Live._check,
    "motion": Live._motion,
    "strength": Live._strength,
}


def _keep(kept: dict[tuple[str, str], Any], key: tuple[str, str], value: Any) -> None:
    kept[key] = value
    while len(kept) > KEPT:
        del kept[next(iter(kept))]


def _stamps(sound: SoundScenario) -> dict[str, int]:
    """When the files that a scenario names were changed, ns."""
    found = {}
    for file in sound.origins.files - {str(sound.path)}:
        with suppress(OSError):
            found[file] = os.stat(file).st_mtime_ns
    return found


def _without_choice(sound: SoundScenario) -> Gearbox:
    """The gearbox of a scenario under a law of friction that need not be chosen: for geometry and loads."""
    scenario = in_force(sound.scenario)
    values = {name: getattr(scenario.friction, name) for name in type(scenario.friction).model_fields}
    friction = type(scenario.friction).model_construct(**values | {"law": _NO_CHOICE})
    plain = scenario.model_copy(update={"friction": friction, "film": None})
    with sound.origins.naming():
        return sound.study.case(plain, "", "")


def _tabulate(case: Gearbox) -> None:
    """Make the tables of a case, which are kept; what is wrong with them is said by who needs them."""
    with suppress(InputError, SimulationError):
        tabulated(case)


def _mesh_of(case: Gearbox, request: LiveRequest) -> int:
    """The number of the mesh that is looked at; a name that is gone is the first one."""
    names = [mesh.name for mesh in case.meshes]
    return names.index(request.mesh) if request.mesh in names else 0


def _names(case: Gearbox, number: int) -> dict[str, Any]:
    names = [mesh.name if case.named else "" for mesh in case.meshes]
    return {"meshes": names, "mesh": names[number]}
