"""The usual ranges of a case's numbers, as a table for docs/scenario.md.

python -m tools.usual_ranges --into docs/scenario.md
"""

from argparse import Namespace

from tools.marked_block import generate, table
from tribodyn.gears.plausibility import USUAL


def usual_ranges(_given: Namespace | None = None) -> str:
    """Table of all ranges, in the order in which they are looked at."""
    rows = [(usual.what, usual.ends, usual.source) for usual in USUAL.values()]
    return table(("number", "usual", "from"), rows)


if __name__ == "__main__":
    generate(__doc__, usual_ranges=usual_ranges)
