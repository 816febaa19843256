"""What the solved contact says of a law: where it is right, or how far it is off."""

from typing import NamedTuple


class JudgedRange(NamedTuple):
    """What the solved contact says of a law, over oils, surfaces and duties of gears (docs/ehl.md, Ranges).

    Attributes
    ----------
    right : lowest and highest ratio of the law's value to the solved one at which it is called right
    ratio : that ratio at 5, 50 and 95 % of the sampled contacts inside the judged limits; where there are
        none, inside the range of the law's authors
    limits : how many of the law's limits follow from the comparison, the last ones: where these hold, nine of
        ten contacts are right; 0: no such limits were found
    """

    right: tuple[float, float]
    ratio: tuple[float, float, float]
    limits: int = 0

    def said(self, limits: tuple[str, ...]) -> str:
        """Say it of a law with these limits."""
        if self.limits:
            low, high = self.right
            where = ", ".join(limits[-self.limits :])
            return f"by the solved contact: {where} ({low:g} to {high:g} times it)"
        low, _, high = self.ratio
        return f"no range by the solved contact: {low:.2g} to {high:.2g} times it"

    def named(self, limits: tuple[str, ...]) -> tuple[str, ...]:
        """Return the limits of a law; those that follow from the comparison end with "(judged)"."""
        own = len(limits) - self.limits
        return (*limits[:own], *(f"{limit} (judged)" for limit in limits[own:]))
