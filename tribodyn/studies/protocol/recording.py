"""The record of a case, from its name to its writer."""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from tribodyn.record.schema import Layout
from tribodyn.record.writer import RecordWriter, check_target
from tribodyn.studies.protocol.study import CaseHead


def target(case: CaseHead, output: str | Path | None, force: bool) -> Path:
    """Where a case's record goes.

    Raises
    ------
    InputError
        If it cannot be written there, see `record.writer.check_target`; so it is checked before any work.
    """
    path = Path(output) if output is not None else Path(f"{case.name}.h5")
    check_target(path, force)
    return path


def writer(
    case: CaseHead,
    path: Path,
    layout: Layout,
    samples: int,
    *,
    groups: Mapping[str, Mapping[str, Any]] = MappingProxyType({}),
    scales: Mapping[str, Any] = MappingProxyType({}),
    force: bool = False,
    code: str = "",
) -> RecordWriter:
    """The writer of a case's record; arguments as those of `RecordWriter`."""
    return RecordWriter(
        path,
        layout=layout,
        kind=case.kind,
        scenario_toml=case.toml,
        sha256=case.sha256,
        samples=samples,
        groups=groups,
        scales=scales,
        force=force,
        code=code,
    )
