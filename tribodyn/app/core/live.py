"""What is computed while a scenario is edited: geometry at once, slow rotation, the check, the motion.

A stage takes what those before it have prepared; tables of the mesh, laws and kernels are kept between edits
that do not change them. What is wrong with a scenario is part of the result, as the command line says it.
"""

import math
import os
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Any

from tribodyn.app.core.geometry import mesh_geometry, train_geometry
from tribodyn.app.core.held import MOVING, HeldGears, HeldMesh, held_by, is_searched, keys_within
from tribodyn.app.core.messages import Message, data_of, findings
from tribodyn.app.core.motion import motion_of
from tribodyn.app.core.shown import tables_of
from tribodyn.app.core.slow_rotation import at_torques, slow_rotation
from tribodyn.app.core.strength import rated_by_check, strength_of
from tribodyn.cases.assessment_part import Meshing
from tribodyn.cases.results import Progress
from tribodyn.errors import InputError, OutputError, SimulationError
from tribodyn.gears.prepare import assembled
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.prepare import tabulated
from tribodyn.studies.protocol.load import Loaded, SoundScenario

#: In the order in which they are computed.
STAGES = ("geometry", "static", "motion", "torques", "strength", "check")
#: Scenarios whose cases are kept, as one is edited and compared with others.
KEPT = 8
_RATED = "S_H and S_F are those of the check, with the factors that the scenario gives."
#: Shares of the nominal torque at which the transmission error is shown.
SHARES = (0.5, 1.0, 1.5)
_UNLOADED = "The duty has no torque: nothing is loaded."
_ELSEWHERE = "A study of kind %s is checked while it is edited, not computed: start it by Run …"
_STILL = "Of a study of kind %s teeth and slow rotation are shown while it is edited: start it by Run …"


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
        self._plain: dict[tuple[str, str], HeldGears | None] = {}
        self._loaded: dict[tuple[str, str], Loaded] = {}

    def compute(self, stage: str, request: LiveRequest, progress: Progress | None = None) -> dict[str, Any]:
        """The result of a stage; that of a scenario that is wrong says what is.

        `progress` is told the share done of a motion.

        Every result has `stage`, `ok`, `errors` (of each the fields of `Message`, and `short`), `warnings`
        and `seconds`; what a stage has besides is said of its function. Gears that do not move have no
        motion, and of a study that holds no gears there is the check alone.
        """
        begun = perf_counter()
        head: dict[str, Any] = {"stage": stage, "warnings": [], "errors": []}
        try:
            self._progress = progress
            result = self._computed(stage, request)
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

    def _computed(self, stage: str, request: LiveRequest) -> dict[str, Any]:
        """What a stage has; why there is none where there is none. A start of a search may be impossible."""
        sound = self._of_text(request)
        try:
            missing = self._missing(stage, request)
            return {"remarks": [missing]} if missing else _STAGES[stage](self, request)
        except InputError as error:
            if stage == "check" or not is_searched(sound):
                raise
            return {"remarks": [f"The start of the search cannot be shown: {error}"]}

    def _missing(self, stage: str, request: LiveRequest) -> str:
        """Why there is no such stage of a scenario; "": there is."""
        sound = self._of_text(request)
        if stage == "check" or sound.study in MOVING:
            return ""
        if (held := self._held(request)) is None:
            return _ELSEWHERE % sound.study.kind
        if stage == "strength" and held.rated:
            return _RATED
        return _STILL % sound.study.kind if stage == "motion" else ""

    def _geometry(self, request: LiveRequest) -> dict[str, Any]:
        """`meshes` and the `mesh`, what `mesh_geometry` has, and of a train `train`, as `train_geometry`."""
        with self._mesh(request) as (held, mesh):
            bodies = held.gearbox is not None and held.train is None
            shown = mesh_geometry(mesh, assembled(mesh.pair), bodies=bodies)
            shown["train"] = train_geometry(held.train) if held.train is not None else None
            return _names(held, mesh) | shown | {"remarks": list(held.remarks)}

    def _static(self, request: LiveRequest) -> dict[str, Any]:
        """What `slow_rotation` has of the mesh; nothing of a duty without torque."""
        with self._mesh(request) as (held, mesh):
            found = slow_rotation(mesh.pair, assembled(mesh.pair))
            return _names(held, mesh) | (found or {"warnings": [_UNLOADED]})

    def _torques(self, request: LiveRequest) -> dict[str, Any]:
        """What `at_torques` has of the mesh; nothing of a duty without torque."""
        shares = [share for share in request.torques if math.isfinite(share) and share > 0.0]
        with self._mesh(request) as (held, mesh):
            found = at_torques(mesh.pair, assembled(mesh.pair), shares)
            return _names(held, mesh) | (found or {"warnings": [_UNLOADED]})

    def _strength(self, request: LiveRequest) -> dict[str, Any]:
        """What `strength_of` has of the mesh."""
        with self._mesh(request) as (held, mesh):
            turns = Meshing(), Meshing()
            if held.whole is not None:
                turns = held.whole.meshes(held.gearbox)[held.meshes.index(mesh)].meshing
            return _names(held, mesh) | strength_of(mesh.pair, assembled(mesh.pair), turns)

    def _check(self, request: LiveRequest) -> dict[str, Any]:
        """`tables`, `details` and `remarks` as ``tribodyn check`` prints them, and its `data`, SI.

        Of gears that it rates also `rows` and a table of the mesh, as `rated_by_check`.
        """
        loaded = self._case(request)
        held = None
        with suppress(InputError):  # what is wrong is said by the check
            held = self._held(request)
        mesh = held.chosen(request.mesh).name if held is not None else ""
        with loaded.naming():
            checked = loaded.study.check(loaded.case)
        rates = held is not None and held.rated
        rows, more = rated_by_check(checked.data, mesh) if rates else ([], [])
        return {
            "tables": tables_of([*checked.tables, *more]),
            "details": tables_of(checked.details),
            "remarks": list(checked.remarks),
            "warnings": list(checked.warnings),
            "data": checked.data,
            "rows": rows,
        }

    def _motion(self, request: LiveRequest) -> dict[str, Any]:
        """What `motion_of` has: the run that ``tribodyn run`` makes, its last cycles and its summary."""
        with self._mesh(request) as (held, mesh):
            beside = threading.Thread(target=_tabulate, args=(held.gearbox,), daemon=True)
            if (request.text, request.path) not in self._loaded:
                beside.start()  # tables need no laws, whose choice takes as long
            loaded = self._case(request)
            while beside.is_alive():  # in short waits, so that a newer request is heard
                beside.join(0.02)
            record, number = self._scratch / "motion.h5", held.meshes.index(mesh)
            return _names(held, mesh) | motion_of(loaded, record, number, self._progress)

    def _held(self, request: LiveRequest) -> HeldGears | None:
        """The gears of a text before laws are chosen; None: it holds none."""
        sound = self._of_text(request)
        key = request.text, request.path
        if key not in self._plain:
            _keep(self._plain, key, held_by(sound))
        return self._plain[key]

    @contextmanager
    def _mesh(self, request: LiveRequest) -> Iterator[tuple[HeldGears, HeldMesh]]:
        """The gears of a text that holds some, and the mesh that is looked at: by name, else the first.

        Errors inside the block are named by the text.
        """
        held = self._held(request)
        assert held is not None, "said to be missing"
        mesh = held.chosen(request.mesh)
        with keys_within(self._of_text(request).origins, held.place):
            yield held, mesh

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


def _tabulate(case: Gearbox) -> None:
    """Make the tables of a case, which are kept; what is wrong with them is said by who needs them."""
    with suppress(InputError, SimulationError):
        tabulated(case)


def _names(held: HeldGears, mesh: HeldMesh) -> dict[str, Any]:
    return {"meshes": [one.name for one in held.meshes], "mesh": mesh.name}
