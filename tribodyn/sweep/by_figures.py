"""Cases of any kind, one after the other, each by the figures that its study works out without a record."""

from collections.abc import Hashable, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.record.sweep_schema import DONE, FAILED, SweepLayout
from tribodyn.record.trust import TRUST, number
from tribodyn.record.withheld import remarked, remarks, warned
from tribodyn.studies.gears.rounded import remarks_in_brief
from tribodyn.studies.protocol.estimate import Estimate, variable_bytes
from tribodyn.studies.protocol.evaluated import alone
from tribodyn.studies.protocol.study import Study
from tribodyn.studies.sweeping.batch import Chunk


class NoSettings(NamedTuple):
    """Nothing can be chosen."""


class ByFigures:
    """See `sweeping.batch.Batch`.

    Parameters
    ----------
    study : one with `swept` figures
    """

    states = 0

    def __init__(self, study: Study) -> None:
        if not study.swept():
            raise InputError(
                "kind", f'"{study.kind}"', "such a study cannot be swept", "run its cases one by one"
            )
        self.study = study

    def settings(self, cases: Sequence[Any], transient: int | None, engine: str) -> NoSettings:
        """Nothing to choose; marching and JAX belong to motions."""
        if transient is not None:
            rule = f"{self.study.about}: its cases have no mesh cycles to march"
            raise InputError("--transient", transient, rule, "omit it")
        if engine == "jax":
            raise InputError("--engine", "jax", f"{self.study.about}: JAX integrates motions only", "omit it")
        return NoSettings()

    def following(self, settings: NoSettings, unstable: bool) -> NoSettings:
        """The same: such cases do not go on from each other."""
        return settings

    def layout(self, settings: NoSettings) -> SweepLayout:
        """The quantities that the study names."""
        swept = self.study.swept()
        return SweepLayout({name: quantity.variable() for name, quantity in swept.items()})

    def size_of_chunk(self, settings: NoSettings, total: int, width: int) -> int:
        """One: each is recorded as soon as it is done."""
        return 1

    def estimate(self, case: Any, settings: NoSettings, total: int, width: int) -> Estimate:
        """What the study says of a run; the record holds its figures."""
        row = variable_bytes(self.layout(settings).variables.values(), {})
        return self.study.estimate(case)._replace(record=row)

    def sharing(self, case: Any) -> Hashable:
        """Nothing is known to be shared."""
        return None

    def check(self, case: Any, settings: NoSettings) -> None:
        """Check a case as `tribodyn check` does."""
        self.study.check(case)

    def evaluate(self, chunk: Chunk, settings: NoSettings, workers: int | None) -> dict[str, np.ndarray]:
        """Work out the figures of every case."""
        layout = self.layout(settings)
        rows = layout.empty_rows(len(chunk.cases))
        for i, case in enumerate(chunk.cases):
            figures = alone(self.study, case)
            if isinstance(figures, str):
                rows["message"][i], rows["status"][i] = figures, FAILED
                continue
            for name in layout.figures:
                if figures.get(name) is not None:
                    rows[name][i] = figures[name]
            rows["message"][i] = remarked(*map(warned, [*remarks(figures), *remarks_in_brief(case.toml)]))
            rows[TRUST][i] = number(figures)
            rows["status"][i] = DONE
        return rows
