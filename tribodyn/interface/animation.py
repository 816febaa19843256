"""The teeth rolling through mesh, inline in a notebook: the report's page without its figures."""

from collections.abc import Sequence
from html import escape

from tribodyn.errors import InputError
from tribodyn.post.page.rolling_teeth import rolling_teeth
from tribodyn.record.reader import Record

#: Of the frame in a notebook, in pixels: room for the teeth, the readings beside them, and the controls.
HEIGHT = 520


class Animation:
    """The teeth in mesh as a page; `Run.animate` makes one.

    Attributes
    ----------
    html : str
        The page: one HTML document that needs no other, with the teeth, a slider and the quantities of the
        pairs at its position.
    """

    def __init__(self, html: str) -> None:
        self.html = html

    def _repr_html_(self) -> str:
        page = escape(self.html, quote=True)
        return (
            f'<iframe srcdoc="{page}" sandbox="allow-scripts" title="The teeth in mesh" '
            f'style="width: 100%; height: {HEIGHT}px; border: 0"></iframe>'
        )

    def __repr__(self) -> str:
        return "<tribodyn animation: shown in a notebook; `html` is its page>"


def check_teeth(records: Sequence[Record]) -> None:
    """Raise InputError for a record of which there are no teeth to roll."""
    for record in records:
        if rolling_teeth(record) is None:
            rule = "holds no gears that turn"
            raise InputError("record", str(record.path), rule, "draw it with plot instead")
