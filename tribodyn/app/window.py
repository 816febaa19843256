"""One open window: its document, its computations, and what is pinned beside it.

Windows share nothing but the folder: each has a worker process, a history and variants of its own.
"""

import asyncio
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from typing import Any

from tribodyn.app.core.document import Document
from tribodyn.app.core.live import STAGES, LiveRequest
from tribodyn.app.core.worker import Worker
from tribodyn.app.folder import WorkFolder
from tribodyn.app.picture import Result
from tribodyn.errors import InputError

#: A newer value waits until the teeth of the one before it are shown, and so much more for its quasi-static
#: error, s; where none has come for a while, twice as long as that took last, unless it takes too long.
_PATIENCE, _LONG, _WHILE = 0.03, 0.5, 0.3
#: What it takes is taken to be so much less each time that it did not come: the first one prepares more.
_AGAIN = 0.8
#: What is not to keep teeth from the browser comes so much behind them; it waits for them at most so long, s.
_SHORTLY, _LATEST = 0.005, 0.25
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
        Called with the names of what has changed: "form", "title", "pinned", stages, "busy" (`late`), or
        "late" (that and what is wrong).

    Attributes
    ----------
    results : the last result of each stage
    late : stages whose result is of an older value
    as_text : whether the scenario is shown as text
    refused : whether a text was refused, which the browser still shows
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
        self.as_text = self.refused = False
        self.results: Results = {}
        self.late: tuple[str, ...] = STAGES
        self.of_variants: dict[tuple[str, str], Results] = {}
        self.pinned_name = document.variants[-1].name if document.variants else ""
        self._worker, self._second = worker, None
        self._task: asyncio.Task[None] | None = None
        self._others: asyncio.Task[None] | None = None
        self._stale = False
        self._coming: tuple[str, ...] = ()
        self._drawn_at = self._static_at = self._static_takes = 0.0
        self._behind: list[str] = []
        self.bug: Exception | None = None
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
        self.document, self.mesh, self.results, self._coming = document, "", {}, ()
        self.pinned_name = document.variants[-1].name if document.variants else ""
        self.changed(["form", "pinned", "title", *STAGES])
        self.compare()

    def change(self, key: str, value: Any, *, drag: bool = False) -> InputError | None:
        """Give a key a value; what is wrong where the key leads to no table."""
        try:
            self.document.set(key, value, drag=drag)
        except InputError as error:
            return error
        if drag:  # teeth come before the form
            self._behind = ["form", "title"]
            self._begin()
            self.show(["busy"])
            asyncio.get_running_loop().call_later(_LATEST, self._show_behind)
        else:
            self.changed(["form", "title"])
        return None

    def changed(self, parts: Sequence[str]) -> None:
        """Show parts, and compute what follows from the document."""
        self._begin()
        self.show([*parts, "late"])

    def _begin(self) -> None:
        self.late, self._stale, self.refused = STAGES, True, False
        self._go_on()  # the worker computes while the page is brought in step

    def _show_behind(self) -> None:
        """Show what waits until teeth are drawn."""
        if self._behind:
            parts, self._behind = self._behind, []
            self.show([*parts, "late"])

    def choose(self, mesh: str) -> None:
        """Show another mesh of a train."""
        if mesh != self.mesh:
            self.mesh, self._coming = mesh, ()
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

    def _go_on(self) -> None:
        """Compute the newest state once the older one has had its share; a computation of that ends."""
        if not self._stale or self.closed or "geometry" in self._coming:
            return
        if "static" in self._coming:
            loop = asyncio.get_running_loop()
            seldom = self._drawn_at - self._static_at > _WHILE and self._static_takes < _LONG / 2.0
            patience = max(_PATIENCE, 2.0 * self._static_takes) if seldom else _PATIENCE
            left = self._drawn_at + patience - loop.time()
            if left > 0.0:
                loop.call_later(left, self._go_on)
                return
            self._static_takes *= _AGAIN
        self._stale, self._coming = False, STAGES
        results = self._worker.results(self._request(self.document.text, self.mesh))
        self._task = asyncio.create_task(self._take(results))

    async def _take(self, results: AsyncIterator[Result]) -> None:
        """Show the results of a state as they come, until they end or a newer state is computed."""
        this = asyncio.current_task()
        self.bug = None
        self.results.pop("", None)
        try:
            async for result in results:
                if self._task is this:
                    self._take_one(result)
        except Exception as error:
            self.bug = error
        if self._task is not this:
            return
        self._coming = ()
        if not self._stale:
            self.late = ()
            self.show(["late"])
        self._go_on()

    def _take_one(self, result: Result) -> None:
        stage = result["stage"]
        self._coming = tuple(one for one in self._coming if one != stage)
        now = asyncio.get_running_loop().time()
        if stage == "geometry":
            self._drawn_at = now
        if stage == "static":
            self._static_at, self._static_takes = now, float(result["seconds"])
        self._go_on()
        if not self._stale:
            self.late = tuple(one for one in self.late if one != stage)
        if result.get("ok") or stage not in self.results:
            self.results[stage] = result
        else:  # the last picture stays, and what is wrong is said
            self.results[stage] = {**self.results[stage], **_complaint(result)}
        self.show([stage, "busy" if self._behind else "late"])
        if self._behind:
            wait = _PATIENCE if stage == "geometry" else _SHORTLY
            asyncio.get_running_loop().call_later(wait, self._show_behind)

    def columns(self) -> list[tuple[str, Results]]:
        """The present state and every variant with their results."""
        variants = self.document.variants
        others = [(one.name, self.of_variants.get((one.text, self.mesh), {})) for one in variants]
        return [("", self.results), *others]

    def at_work(self) -> str:
        """What has been computed for a while; nothing of what takes no time."""
        stage, seconds, share, doing = self._worker.at_work
        if not self.late or not stage or seconds < _SOON:
            return ""
        part = "" if share is None else f", {100.0 * share:.0f} %"
        return f"{stage}: {seconds:.0f} s{part}" + (f", {doing}" if doing else "")

    def sentences(self, name: str) -> dict[str, bool]:
        """What the computations say under a name, "warnings" or "remarks": whether it is of older values."""
        said: dict[str, bool] = {}
        for stage, result in self.results.items():
            for line in map(str, result.get(name, ())):
                said[line] = said.get(line, True) and stage in self.late
        return said

    @property
    def doubtful(self) -> bool:
        """Whether a computation failed with older values, and these have not been computed yet."""
        return any(self.results.get(stage, {}).get("errors") for stage in self.late)

    def errors(self) -> list[tuple[str, str, str]]:
        """Key, text and short text of messages of the document, and of computations that failed.

        A message of a computation with older values may name what is no longer there: it is left out.
        """
        found = {one.text: (one.key, one.text, one.short) for one in self.document.messages()}
        if self.bug is not None:
            text = f"a bug in tribodyn: {type(self.bug).__name__}: {self.bug}; report it"
            found[text] = "", text, text
        for stage, result in self.results.items():
            for one in result.get("errors", ()) if stage not in self.late else ():
                found.setdefault(one["text"], (one["key"], one["text"], one["short"]))
        return list(found.values())


def _complaint(result: Mapping[str, Any]) -> dict[str, Any]:
    return {"errors": result.get("errors", []), "warnings": result.get("warnings", [])}
