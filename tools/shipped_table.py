"""What is shipped, by number and name, into the README and the page Start here.

python -m tools.shipped_table                # prints it
python -m tools.shipped_table --write        # and puts it into both pages
"""

import sys
from collections.abc import Iterable

from tools.marked_block import DOCS, ROOT, put, table
from tribodyn.geometry.families import FAMILIES
from tribodyn.input.sources import names, shipped
from tribodyn.studies import STUDIES
from tribodyn.train.links import LINK_LAWS
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.wear import WEAR_LAWS
from tribodyn.validation import PAPERS

PAGES = (ROOT / "README.md", DOCS / "start.md")


def counts() -> str:
    """One row per sort: how many there are, the names in scenarios, and the verb that lists them."""
    papers = [paper.about.partition(",")[0].partition(":")[0] for paper in PAPERS.values()]
    rows = [
        ("kinds of study", *_named(STUDIES), "`tribodyn list kinds`"),
        ("tooth families", *_named(FAMILIES), "`tribodyn list families`"),
        ("film laws", *_named(FILM_LAWS), "`tribodyn list film-laws`"),
        ("friction laws", *_named(FRICTION_LAWS), "`tribodyn list laws`"),
        ("laws of links", *_named(LINK_LAWS), "`tribodyn list link-laws`"),
        ("wear laws", *_named(WEAR_LAWS), "`tribodyn list wear-laws`"),
        ("scenarios", len(names(shipped("scenarios"))), "by what they show", "`tribodyn list scenarios`"),
        ("papers", len(papers), ", ".join(papers), "`tribodyn list papers`"),
    ]
    return table(["shipped", "", "", "all, with a line each"], rows, "lr")


def _named(registered: Iterable[str]) -> tuple[int, str]:
    """Number and names; variants of a law, whose names begin with the law's, are counted and not named."""
    every = list(registered)
    heads = [name for name in every if not any(name.startswith(f"{other}-") for other in every)]
    variants = len(every) - len(heads)
    text = ", ".join(f"`{name}`" for name in heads)
    plural = "s" * (variants > 1)
    return len(every), f"{text}, and {variants} variant{plural}" if variants else text


if __name__ == "__main__":
    for page in PAGES if "--write" in sys.argv else ():
        put(page, "shipped", counts())
    print(counts())
