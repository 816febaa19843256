"""Whatever is typed into whichever field: a message in the words of the command line, never a traceback."""

import random

import pytest

from tribodyn.app.core.document import Document
from tribodyn.app.core.form import form_of, written_as
from tribodyn.app.core.live import Live, LiveRequest
from tribodyn.errors import InputError

TYPED = (
    *("", "0", "-1", "nan", "inf", "1e400", "1e-400", "many", "true", "[]", "[1, 2]", "{a = 1}", '"', "'"),
    *("3 mm", "3 furlongs", "1e9 mm", "-5 deg", "0 N*m", "3,5 mm", "1/0", "∞", "a\u202eb", "\x00", "9" * 400),
    *("x" * 30_000, "../../etc/passwd", "[[", "2026-01-01", "__import__('os').system('true')"),
)


@pytest.mark.parametrize("name", ["spur-25-51", "helical-23-47", "two-stage-reducer", "planetary-24-84"])
def test_anything_may_be_typed(tmp_path, name):
    live, drawn = Live(tmp_path), random.Random(name)
    fields = [field for group in form_of(Document.open(name)) for field in group.fields]
    for _ in range(25):
        document = Document.open(name)
        field = drawn.choice(fields)
        text = drawn.choice((*TYPED, *field.choices))
        try:
            document.set(field.path, written_as(field, text, drawn.choice(("", *field.units))))
        except InputError:
            continue
        said = document.messages()
        assert document.of_link(document.link(), tmp_path).text == document.text
        assert form_of(document)
        shown = live.compute("geometry", LiveRequest(document.text, str(document.path)))
        assert not any("a bug" in error["text"] for error in shown["errors"]), (field.path, text)
        if said:
            assert [error["text"] for error in shown["errors"]] == [message.text for message in said]
        document.undo()
        assert document.messages() == ()
