"""What every assessment is asked beyond the duty."""

from typing import Literal

from tribodyn.gears.rating.settings import RatingTable


class AssessedTable(RatingTable):
    """What is asked beyond the duty, and what the standards need to know."""

    ring_root: Literal["as-cut", "formula"] = "as-cut"

    @property
    def root_by_formula(self) -> bool:
        """Whether roots of internal gears are those of the standard's formula."""
        return self.ring_root == "formula"
