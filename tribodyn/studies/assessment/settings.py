"""What every assessment is asked beyond the duty."""

from typing import Literal

from pydantic import Field

from tribodyn.gears.rating.settings import RatingTable


class AssessedTable(RatingTable):
    """What is asked beyond the duty, and what the standards need to know."""

    ring_root: Literal["as-cut", "formula"] = Field(
        "as-cut", description="root of internal gears: the fillet as cut, or by the formula of ISO 6336-3"
    )

    @property
    def root_by_formula(self) -> bool:
        """Whether roots of internal gears are those of the standard's formula."""
        return self.ring_root == "formula"
