"""The page of a map."""

from tribodyn.post.figures.panel import View
from tribodyn.post.page.page import PageContent
from tribodyn.post.page.page import page as page_of
from tribodyn.post.style import house_style
from tribodyn.record.reader import Record
from tribodyn.studies.map.figures import DRAWINGS
from tribodyn.studies.map.report import REPORTED, sentences, tables, verdict


def page(record: Record) -> str:
    """A page of its own: all pictures in place of curves along an axis."""
    pictures = []
    with house_style():
        for name, drawing in DRAWINGS.items():
            if drawing.fits(record):
                pictures.append((name, drawing.about, drawing.draw([record], View())))
    content = PageContent(
        REPORTED, sentences(record), verdict=verdict(record), pictures=pictures, parts=tables(record)
    )
    return page_of([record], [content])
