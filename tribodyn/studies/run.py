"""Runs a case of any kind."""

from pathlib import Path

from tribodyn.studies import STUDIES
from tribodyn.studies.study import CaseHead, Progress, RunResult


def run(
    case: CaseHead, output: str | Path | None = None, *, force: bool = False, progress: Progress | None = None
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`."""
    return STUDIES[case.kind].run(case, output, force=force, progress=progress)
