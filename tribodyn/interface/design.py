"""Searches from Python: the values of a scenario's keys that minimise its figures."""

import shutil
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tribodyn.errors import InputError, quoted
from tribodyn.interface.run import Run
from tribodyn.interface.scenario import Source, in_toml
from tribodyn.interface.words import in_python
from tribodyn.studies.design.short_form import loaded_search
from tribodyn.studies.protocol.run import run
from tribodyn.studies.protocol.study import Progress

Bounds = Sequence[Any] | Mapping[str, Any] | str
"""(from, to), a list of choices, {"from": …, "to": …} or {"choices": […]}."""


class Design(Run):
    """A search that ran; `design` makes one. It is a `Run`, whose data are over the evaluations."""

    @property
    def objective_start(self) -> Any:
        """The objective at the start, SI: a number, or a list of two; None where the start has no figures."""
        return self.summary.get("objective_start")

    @property
    def objective(self) -> Any:
        """The objective at the best, SI: a number, or a list of two."""
        return self.summary.get("objective")

    @property
    def best(self) -> dict[str, Any]:
        """Best value by key, as a scenario has it: overrides of the scenario that was searched."""
        return dict(self.summary.get("best", {}))

    @property
    def evaluations(self) -> int:
        """Number of candidates that were evaluated."""
        return int(self.summary["evaluations"])


@in_python()
def design(
    source: Source,
    free: Mapping[str, Bounds] | Sequence[Mapping[str, Any]] | None = None,
    minimise: Any = None,
    subject_to: Sequence[str] = (),
    *,
    overrides: Mapping[str, Any] | None = None,
    output: str | Path | None = None,
    force: bool = False,
    resume: bool = False,
    progress: Progress | None = None,
    allow_large: bool = False,
    client: Any = None,
    **more: Any,
) -> Design:
    """Search for the values of a scenario's keys that minimise its figures.

    Parameters
    ----------
    source : str, Path, mapping or case
        The scenario to search through, or a search (kind "design"), whose keys these replace.
    free : mapping or list, optional
        Key to bounds, ``{"drive.pinion.profile_shift": (-0.2, 0.4)}``, or to a list of texts to choose among;
        or entries as the scenario has them.
    minimise : str or list, optional
        Name of a figure; two of them; or a list of ``{"figure": …, "weight": …}``.
    subject_to : sequence of str
        ``"contact_ratio >= 1.3"``.
    overrides : mapping, optional
        Dotted key to value, of the scenario to search through.
    output : path, optional
        Keep the record, and the best scenario beside it; default: in a temporary folder.
    force, resume : bool
        Replace a record of that name, or go on from what an unfinished search left.
    progress : callable, optional
        Called with the share done, 0 … 1.
    allow_large : bool
        Search what takes very much memory, disk or time, too.
    client : distributed.Client, optional
        Of Dask, whose workers evaluate the candidates; default: the cores of this machine.
    **more
        Further keys of ``[design]``: ``method``, ``evaluations``, ``maximise``, ``duty``, ``tolerance``, …

    Returns
    -------
    Design
        Its `status` is "failed", and `message` says why, where no candidate satisfies all constraints.

    Raises
    ------
    InputError
        Before anything is computed.
    """
    keys: dict[str, Any] = {name: in_toml(value) for name, value in more.items()}
    if free is not None:
        keys["free"] = _entries(free)
    if minimise is not None:
        keys["minimise"] = in_toml(minimise)
    if subject_to:
        keys["subject_to"] = list(subject_to)
    written = in_toml(source) if isinstance(source, Mapping) else source
    changes = {str(key): in_toml(value) for key, value in (overrides or {}).items()}
    case = loaded_search(written, keys, changes).case
    how: dict[str, Any] = {"progress": progress, "allow_large": allow_large, "client": client}
    if output is not None:
        return Design(run(case, output, force=force, resume=resume, **how).path)
    folder = tempfile.mkdtemp(prefix="tribodyn-")
    try:
        return Design(run(case, Path(folder) / f"{case.name}.h5", **how).path, folder)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise


def _entries(free: Any) -> list[dict[str, Any]]:
    if not isinstance(free, Mapping):
        return [in_toml(one) for one in free]
    return [{"key": str(key), **_bounds(str(key), bounds)} for key, bounds in free.items()]


def _bounds(key: str, bounds: Any) -> dict[str, Any]:
    if isinstance(bounds, Mapping):
        return in_toml(bounds)
    values = in_toml(bounds)
    if isinstance(values, list) and len(values) == 2 and not _are_words(values):
        return {"from": values[0], "to": values[1]}
    if isinstance(values, list):
        return {"choices": values}
    rule = "neither two bounds nor a list of choices"
    raise InputError(key, quoted(values), rule, 'give them like ("0 um", "40 um")')


def _are_words(values: list[Any]) -> bool:
    return all(isinstance(value, str) and value.strip()[:1] not in "+-.0123456789" for value in values)
