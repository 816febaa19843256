"""Names that a scenario chooses among: what this package offers, and what installed packages add to it."""

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from importlib import import_module
from typing import Any, Generic, TypeVar, cast

from tribodyn.errors import InputError, quoted, unknown_name

T = TypeVar("T")
U = TypeVar("U")

#: Begins the name of what was handed over from Python: no scenario can give it again.
FROM_PYTHON = "python:"


class Registry(Generic[T]):
    """Things by name, each imported when it is first used.

    Parameters
    ----------
    key : the scenario's key that takes these names: "friction.law"
    what : what they are, for messages: "friction law"
    places : name -> ``module:attribute``, of this package
    group : entry points of this group add names; a name of this package cannot be taken by one of them
    of : what all of them are instances of. It says its own name as `name`, or as `kind`.
    """

    def __init__(self, key: str, what: str, places: Mapping[str, str], group: str, of: type[T]) -> None:
        self.key = key
        self.what = what
        self.group = group
        self._places = dict(places)
        self._of = of
        self._loaded: dict[str, T] = {}
        self._warned: set[str] = set()

    @cached_property
    def _outside(self) -> dict[str, list[Any]]:
        """Entry points by name; looked for only where a name is not ours, because that reads the disk."""
        from importlib.metadata import entry_points

        offered: dict[str, list[Any]] = {}
        for entry in entry_points(group=self.group):
            if entry.name not in self._places:
                offered.setdefault(entry.name, []).append(entry)
        return offered

    def __contains__(self, name: object) -> bool:
        return name in self._places or name in self._outside

    def __iter__(self) -> Iterator[str]:
        """Go through all names, this package's first."""
        yield from self._places
        yield from sorted(self._outside)

    def items(self) -> Iterator[tuple[str, T]]:
        """Go through all names that can be loaded, and what they stand for; see `each`."""
        return self.each(lambda thing: thing)

    def each(self, part: Callable[[T], U]) -> Iterator[tuple[str, U]]:
        """Go through all names and a part of what they stand for.

        What an installed package offers and cannot be loaded is left out, so that one broken package does
        not take the rest down; a line of the log, which Python writes to stderr, names it once.
        """
        for name in self:
            try:
                result = part(self[name])
            except InputError as error:
                if name in self._places:
                    raise
                if name not in self._warned:
                    import logging

                    self._warned.add(name)
                    logging.getLogger(__name__).warning("left out: %s", error)
            else:
                yield name, result

    def __getitem__(self, name: str) -> T:
        """Return what a name stands for.

        Raises InputError if there is nothing of that name, or the package that offers it cannot be loaded.
        """
        if name not in self._loaded:
            self._loaded[name] = self._load(name)
        return self._loaded[name]

    def _load(self, name: str) -> T:
        if name in self._places:
            module, _, attribute = self._places[name].partition(":")
            return cast(T, getattr(import_module(module), attribute))
        if name.startswith(FROM_PYTHON):
            rule = f"this {self.what} was handed over from Python; a scenario cannot name it"
            remedy = "run it from Python again, or offer it in a package"
            raise InputError(self.key, quoted(name), rule, remedy)
        if name not in self._outside:
            raise unknown_name(self.key, name, self, self.what)
        entries = self._outside[name]
        packages = [entry.dist.name if entry.dist else entry.value for entry in entries]
        if len(entries) > 1:
            rule = f"offered more than once, by {' and '.join(sorted(set(packages)))}"
            raise InputError(self.key, quoted(name), rule, "uninstall one")
        try:
            thing = entries[0].load()
        except Exception as error:
            raise cannot_be_loaded(self.key, name, packages[0], error) from error
        actual = getattr(thing, "name", None) or getattr(thing, "kind", None)
        if not isinstance(thing, self._of):
            rule = f"{packages[0]} offers a {type(thing).__name__}, expected a {self._of.__name__}"
        elif actual != name:
            rule = f"{packages[0]} offers it by this name, but it calls itself {quoted(actual)}"
        else:
            return thing
        raise InputError(self.key, quoted(name), rule, f"mend or uninstall {packages[0]}")


def cannot_be_loaded(key: str, name: str, package: str, error: Exception) -> InputError:
    """Return what to say of a name whose package fails when it is imported."""
    why = " ".join(f"{type(error).__name__}: {error}".split())
    rule = f"the package {package} that offers it cannot be loaded: {why}"
    return InputError(key, quoted(name), rule, f"mend or uninstall {package}")
