"""Where the parts of cases lie that leave no record: for cases that come again, what did not change stays.

A search or a sweep over assessments changes keys of which most parts hang on none. In a folder that is kept
from case to case they are taken up (see `tasks.results`), all others are computed again.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from tempfile import TemporaryDirectory

#: Cases side by side, such as duties, of which each has a folder that is kept: of more there is no room.
MOST = 8
_folder: ContextVar[Path | None] = ContextVar("folder", default=None)


@contextmanager
def kept_in(folder: Path | None) -> Iterator[None]:
    """Keep the parts of the cases inside the block in a folder; None: of none."""
    token = _folder.set(folder)
    try:
        yield
    finally:
        _folder.reset(token)


@contextmanager
def within(number: int) -> Iterator[None]:
    """Take the block for one of several cases, which come again in the same order."""
    folder = _folder.get()
    with kept_in(folder / str(number) if folder and number < MOST else None):
        yield


@contextmanager
def scratch() -> Iterator[Path]:
    """Give a folder for the parts of a case: the one that is kept, or a temporary one."""
    if folder := _folder.get():
        folder.mkdir(parents=True, exist_ok=True)
        yield folder
        return
    with TemporaryDirectory(prefix="tribodyn-") as temporary:
        yield Path(temporary)
