"""Names that a scenario chooses among: what this package offers, and what installed packages add to it."""

from collections.abc import Iterator, Mapping
from functools import cached_property
from importlib import import_module
from typing import Any, Generic, TypeVar, cast

from tribodyn.errors import InputError, quoted, unknown_name

T = TypeVar("T")


class Registry(Generic[T]):
    """Things by name, each imported when it is first asked for.

    Parameters
    ----------
    key : str
        The scenario's key that takes these names: "friction.law".
    what : str
        What they are, for messages: "friction law".
    places : mapping
        Name -> ``module:attribute``, of this package.
    group : str
        Entry points of this group add names; a name of this package cannot be taken by one of them.
    """

    def __init__(self, key: str, what: str, places: Mapping[str, str], group: str) -> None:
        self.key = key
        self.what = what
        self.group = group
        self._places = dict(places)
        self._loaded: dict[str, T] = {}

    @cached_property
    def _outside(self) -> dict[str, Any]:
        """Entry points by name; looked for only where a name is not ours, because that reads the disk."""
        from importlib.metadata import entry_points

        return {one.name: one for one in entry_points(group=self.group) if one.name not in self._places}

    def __contains__(self, name: object) -> bool:
        return name in self._places or name in self._outside

    def __iter__(self) -> Iterator[str]:
        """Go through all names, this package's first."""
        yield from self._places
        yield from sorted(self._outside)

    def items(self) -> Iterator[tuple[str, T]]:
        """Go through all names and what they stand for."""
        for name in self:
            yield name, self[name]

    def __getitem__(self, name: str) -> T:
        """Return what a name stands for.

        Raises
        ------
        InputError
            If there is nothing of that name, or the package that offers it cannot be loaded.
        """
        if name not in self._loaded:
            self._loaded[name] = self._found(name)
        return self._loaded[name]

    def _found(self, name: str) -> T:
        if name in self._places:
            module, _, attribute = self._places[name].partition(":")
            return cast(T, getattr(import_module(module), attribute))
        if name not in self._outside:
            raise unknown_name(self.key, name, self, self.what)
        entry = self._outside[name]
        try:
            return cast(T, entry.load())
        except Exception as error:
            package = entry.dist.name if entry.dist else entry.value
            rule = f"the package {package} that offers it cannot be loaded: {type(error).__name__}: {error}"
            raise InputError(self.key, quoted(name), rule, f"mend or uninstall {package}") from error
