"""Verbs of the command line that a study adds, with the Python functions of the same names.

A study's module `verbs` holds ``VERBS``, name -> `Verb`. It is imported for `tribodyn --help`, so it imports
nothing heavy at its top.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from tribodyn.cases.results import TextTable


class Option(NamedTuple):
    """How the command line reads a parameter of a verb: ``Annotated[int, Option("…", min=4)]``.

    Parameters
    ----------
    metavar : str, optional
    min, max : int, optional
        Limits of a number.
    type : type, optional
        What the command line gives, where Python may give more: ``list[str] | None``.
    """

    help: str
    metavar: str | None = None
    min: int | None = None
    max: int | None = None
    type: Any = None


class Finding(Protocol):
    """What a verb without a record finds, for the terminal, for JSON, as a picture, and for Python."""

    @property
    def remarks(self) -> Sequence[str]:
        """Sentences that stand below the tables."""
        ...

    def tables(self) -> Sequence["TextTable"]:
        """What the terminal shows."""
        ...

    def as_dict(self) -> dict[str, Any]:
        """What ``--json`` prints."""
        ...

    def plot(self) -> "Figure":
        """Draw it."""
        ...


class Verb(NamedTuple):
    """A verb of a study.

    Parameters
    ----------
    function : its docstring is the Python function's, and its first line the verb's help. Parameters whose
        annotation holds an `Option` are options of the verb. With `answers` it is ``function(case, *,
        progress, …) -> Finding``; otherwise ``function(source, …, *, overrides, …) -> Loaded``, the scenario
        to be run, with the options of `tribodyn run`. It takes the texts of the command line and Python's
        values alike.
    examples : what stands at the end of its help
    answers : whether it answers at once, without a record
    alias : another name, on the command line and in Python, that no list shows
    """

    function: Callable[..., Any]
    examples: str
    answers: bool = False
    alias: str = ""
