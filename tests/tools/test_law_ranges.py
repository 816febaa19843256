"""Ranges by the solved contact hold for contacts that they were not made from."""

import math

import pytest

from tools.law_ranges import OILS, PAGE, Ratios, ratios, right
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS

#: Not that of the tool.
SEED = 2026


def law_of(what: str, name: str):
    return FILM_LAWS[name] if what == "film" else FRICTION_LAWS[name]


def share_right(found: dict[tuple[str, str], Ratios], what: str) -> float:
    """Of contacts inside the judged limits of all laws that have some."""
    hits = [
        hit
        for (kind, name), ratio in found.items()
        if kind == what and law_of(kind, name).judged.limits
        for hit in right(law_of(kind, name), ratio.ratio[ratio.judged])
    ]
    assert len(hits) >= 10
    return sum(hits) / len(hits)


@pytest.mark.soak
def test_fresh_contacts_inside_the_ranges():
    found = ratios(SEED, len(OILS))
    for what in ("film", "friction"):
        assert share_right(found, what) >= 0.9


@pytest.mark.soak
def test_many_fresh_contacts_inside_the_ranges():
    count = 12 * len(OILS)
    found = ratios(SEED, count)
    # nine of ten, less two standard deviations of as many pairs
    least = 0.9 - 2.0 * math.sqrt(0.09 / count)
    for (what, name), ratio in found.items():
        law = law_of(what, name)
        inside = right(law, ratio.ratio[ratio.judged])
        if law.judged.limits:
            assert inside.mean() >= least, (what, name)
            # the limits say something: outside of them the law is right less often
            assert right(law, ratio.ratio[~ratio.judged]).mean() < inside.mean(), (what, name)
        else:
            assert inside.mean() < 0.9, (what, name)


def test_the_page_has_every_law_that_was_compared():
    page = PAGE.read_text("utf-8")
    for what, registry in (("film", FILM_LAWS), ("friction", FRICTION_LAWS)):
        for name in registry:
            law = registry[name]
            if law.judged is None:
                assert name in ("solved", "coulomb", "none")
                continue
            low, high = law.judged.right
            begins, criterion = f"| {what} `{name}` |", f"| {low:g} … {high:g} |"
            (line,) = (row for row in page.splitlines() if row.startswith(begins) and criterion in row)
            assert ", ".join(f"{value:.3g}" for value in law.judged.ratio) in line
            limits = law.limits[len(law.limits) - law.judged.limits :]
            assert (", ".join(limits) or "none found") in line
