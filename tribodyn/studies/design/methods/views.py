"""A search with one objective as numbers that minimisers take."""

import math
from collections.abc import Sequence

import numpy as np

from tribodyn.studies.design.candidates.archive import Archive
from tribodyn.studies.design.candidates.scoring import NO_FIGURES, SLACK, Score

#: Stands for the objective of a candidate without figures, over that of the start.
POOR = 1.5


class Scalar:
    """One objective, relative to the start, and margins that must not be negative.

    Parameters
    ----------
    bound : upper bound of the other objective
    """

    def __init__(self, archive: Archive, objective: int = 0, bound: float | None = None) -> None:
        self.archive = archive
        self.objective = objective
        self.bound = bound
        self.scales = [self._scale(place) for place in range(len(archive.case.objectives))]

    def _scale(self, place: int) -> float:
        values = [candidate.score.objectives[place] for candidate in self.archive.evaluations]
        known = [abs(value) for value in values if math.isfinite(value) and value]
        return known[0] if known else 1.0

    def value(self, score: Score) -> float:
        """The objective over its scale; a poor one where there is none."""
        value = score.objectives[self.objective] / self.scales[self.objective]
        return value if math.isfinite(value) else POOR

    def margins(self, score: Score) -> list[float]:
        """Margins of the constraints, that of the bound last."""
        margins = [self._unknown(score) if score.message else margin for margin in score.margins]
        if score.shape is not None:
            margins.append(score.shape)
        if self.bound is None:
            return margins
        other = score.objectives[1 - self.objective]
        room = (self.bound - other) / self.scales[1 - self.objective]
        return [*margins, room if math.isfinite(room) else self._unknown(score)]

    @staticmethod
    def _unknown(score: Score) -> float:
        """Stands for a margin of a candidate without figures: the distance of its shape, if known."""
        return -NO_FIGURES if score.shape is None else min(score.shape, 0.0)

    def merit(self, score: Score) -> float:
        """Objective of a feasible candidate; of others above all those, growing with what they miss."""
        missed = -sum(min(0.0, margin) for margin in self.margins(score))
        if score.message:
            return 1e6 + score.violation
        return 1e6 + missed if missed > SLACK else self.value(score)

    def merits(self, several: Sequence[np.ndarray]) -> np.ndarray:
        """Merits of candidates that are evaluated side by side."""
        return np.array([self.merit(score) for score in self.archive.score_all(several)])
