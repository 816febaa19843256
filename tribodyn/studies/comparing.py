"""Complete records of any study side by side."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies.pages import study_of_record
from tribodyn.studies.protocol.study import Study

if TYPE_CHECKING:
    from tribodyn.post.compare import Comparison
    from tribodyn.quantities.quantity import Quantity, Reported


def compare(records: Sequence[Record]) -> "Comparison":
    """Set complete records side by side; see `tribodyn.post.compare`. InputError where they cannot be."""
    from tribodyn.post import compare as comparing

    studies = [study_of_record(record) for record in records]
    for record, study in zip(records, studies, strict=True):
        if study.quantities != studies[0].quantities:
            rule = f'kind "{record.kind}" and kind "{records[0].kind}" share no quantities to compare'
            raise InputError("record", str(record.path), rule, "compare records of one kind")
        if not study.compared:
            rule = f"{study.about}: it has no means over a run to compare"
            raise InputError("record", str(record.path), rule, "draw them into one figure")
    return comparing.compare(records, _compared(studies))


def _compared(studies: Sequence[Study]) -> "Reported":
    """Heading -> quantities that any of the studies compares, in the order of the first that has them."""
    headings: dict[str, dict[str, Quantity]] = {}
    for study in studies:
        for heading in study.compared:
            some = headings.setdefault(heading, {})
            for quantity in study.reported().get(heading, ()):
                some.setdefault(quantity.name, quantity)
    return {heading: tuple(some.values()) for heading, some in headings.items()}
