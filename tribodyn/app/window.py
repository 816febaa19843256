"""One open window: its document, its computations, and what is pinned beside it.

Windows share nothing but the folder: each has a worker process, a history and variants of its own.
"""

import asyncio
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import Any

from tribodyn.app.core.document import Document
from tribodyn.app.core.live import STAGES, LiveRequest
from tribodyn.app.core.worker import Worker
from tribodyn.app.folder import WorkFolder
from tribodyn.app.picture import Result
from tribodyn.errors import InputError

#: A value that is dragged is computed at most this often, s: geometry follows within 100 ms.
_BETWEEN = 0.04
#: Seconds after which it is said what is computed.
_SOON = 2.0
Results = dict[str, Result]


class DesignWindow:
    """What a browser window works on.

    Parameters
    ----------
    folder
        Where files are opened and saved.
    document
        What is open.
    worker
        Computes for this window alone.
    show
        Called with the names of what has changed: "form", "title", "pinned", "late", or stages.

    Attributes
    ----------
    results : the last result of each stage
    late : stages whose result is of an older value
    pinned_name : name of the variant that is compared with; "": none
    """

    def __init__(
        self,
        folder: WorkFolder,
        document: Document,
        worker: Worker,
        show: Callable[[Sequence[str]], None],
    ) -> None:
        self.folder, self.document, self.show = folder, document, show
        self.mesh = ""
        self.results: Results = {}
        self.late: tuple[str, ...] = STAGES
        self.of_variants: dict[tuple[str, str], Results] = {}
        self.pinned_name = document.variants[-1].name if document.variants else ""
        self._worker, self._second = worker, None
        self._task: asyncio.Task[None] | None = None
        self._others: asyncio.Task[None] | None = None
        self._stale = False
        self.bug: BaseException | None = None
        self.closed = False

    def close(self) -> None:
        """End the processes of this window."""
        self.closed = True
        for task in (self._task, self._others):
            if task is not None:
                task.cancel()
        self._worker.close()
        if self._second is not None:
            self._second.close()

    @property
    def pinned(self) -> Results:
        """Results of the variant that is compared with, as far as there are any."""
        variant = next((one for one in self.document.variants if one.name == self.pinned_name), None)
        return self.of_variants.get((variant.text, self.mesh), {}) if variant else {}

    def open(self, document: Document) -> None:
        """Work on another document."""
        self.document, self.mesh, self.results = document, "", {}
        self.pinned_name = document.variants[-1].name if document.variants else ""
        self.changed(["form", "pinned", "title", *STAGES])
        self.compare()

    def change(self, key: str, value: Any, *, drag: bool = False) -> InputError | None:
        """Give a key a value; what is wrong where the key leads to no table."""
        try:
            self.document.set(key, value, drag=drag)
        except InputError as error:
            return error
        self.changed(["form", "title"])
        return None

    def changed(self, parts: Sequence[str]) -> None:
        """Show parts, and compute what follows from the document."""
        self.late = STAGES
        self._stale = True
        self.show([*parts, "late"])
        if self._task is None or self._task.done():
            self._task = asyncio.create_task(self._follow())

    def choose(self, mesh: str) -> None:
        """Show another mesh of a train."""
        if mesh != self.mesh:
            self.mesh = mesh
            self.changed([])
            self.compare()

    def pin(self, name: str = "") -> None:
        """Keep the present state to compare with; its results are kept where they are there."""
        variant = self.document.pin(name)
        if not self.late:
            self.of_variants[variant.text, self.mesh] = dict(self.results)
        self.pinned_name = variant.name
        self.show(["pinned", "title"])
        self.compare()

    def unpin(self, name: str) -> None:
        """Forget a variant."""
        self.document.unpin(name)
        if self.pinned_name == name:
            self.pinned_name = self.document.variants[-1].name if self.document.variants else ""
        self.show(["pinned", "title"])

    def compare(self, name: str | None = None) -> None:
        """Compare with a variant; compute those of which there are no results yet, one after the other."""
        if name is not None:
            self.pinned_name = name
            self.show(["pinned"])
        if self.document.variants and (self._others is None or self._others.done()):
            self._others = asyncio.create_task(self._compute_variants())

    async def _compute_variants(self) -> None:
        while not self.closed:
            missing = [
                one
                for one in self.document.variants
                if set(self.of_variants.get((one.text, self.mesh), {})) < set(STAGES)
            ]
            if not missing:
                return
            missing.sort(key=lambda one: one.name != self.pinned_name)
            self._second = self._second or Worker()
            key = (missing[0].text, self.mesh)
            done: Results = {}
            async for result in self._second.results(self._request(*key)):
                done[result["stage"]] = result
                self.of_variants[key] = dict(done)
                self.show(["pinned"])
            # a stage that did not come is not asked for again
            self.of_variants[key] = {stage: {"ok": False} for stage in STAGES} | done

    def _request(self, text: str, mesh: str) -> LiveRequest:
        return LiveRequest(text, str(self.document.path), mesh)

    async def _follow(self) -> None:
        """Compute the newest state; a newer one ends the computation of an older one."""
        while self._stale and not self.closed:
            self._stale, self.late = False, STAGES
            request = self._request(self.document.text, self.mesh)
            computing = asyncio.create_task(self._compute(request))
            with suppress(asyncio.CancelledError):
                while not computing.done():
                    await asyncio.wait([computing], timeout=_BETWEEN)
                    # the first picture of each value is seen, also while it is dragged
                    if self._stale and ("geometry" not in self.late or computing.done()):
                        computing.cancel()
                        break
            if computing.done() and not computing.cancelled():
                self.bug = computing.exception()
                if self.bug is not None:
                    self.late = ()
                    self.show(["late"])

    async def _compute(self, request: LiveRequest) -> None:
        self.results.pop("", None)
        async for result in self._worker.results(request):
            stage = result["stage"]
            self.late = tuple(one for one in self.late if one != stage)
            if result.get("ok") or stage not in self.results:
                self.results[stage] = result
            else:  # the last picture stays, and what is wrong is said
                self.results[stage] = {**self.results[stage], **_complaint(result)}
            self.show([stage, "late"])
        if not self._stale:
            self.late = ()
            self.show(["late"])

    def columns(self) -> list[tuple[str, Results]]:
        """The present state and every variant with their results."""
        variants = self.document.variants
        others = [(one.name, self.of_variants.get((one.text, self.mesh), {})) for one in variants]
        return [("", self.results), *others]

    def at_work(self) -> str:
        """What has been computed for a while; nothing of what takes no time."""
        stage, seconds, share = self._worker.at_work
        if not self.late or not stage or seconds < _SOON:
            return ""
        part = "" if share is None else f", {100.0 * share:.0f} %"
        return f"{stage}: {seconds:.0f} s{part}"

    def sentences(self, name: str) -> list[str]:
        """What the computations say under a name, "warnings" or "remarks", each once."""
        said = [line for result in self.results.values() for line in result.get(name, ())]
        return list(dict.fromkeys(map(str, said)))

    def errors(self) -> list[tuple[str, str, str]]:
        """Key, text and short text of messages of the document, and of computations that failed."""
        found = {one.text: (one.key, one.text, one.short) for one in self.document.messages()}
        if self.bug is not None:
            text = f"a bug in tribodyn: {type(self.bug).__name__}: {self.bug}; report it"
            found[text] = "", text, text
        for result in self.results.values():
            for one in result.get("errors", ()):
                found.setdefault(one["text"], (one["key"], one["text"], one["short"]))
        return list(found.values())


def _complaint(result: Mapping[str, Any]) -> dict[str, Any]:
    return {"errors": result.get("errors", []), "warnings": result.get("warnings", [])}
