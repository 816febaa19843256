"""One Python function, for arguments of certain types, to one C function."""

from types import FunctionType

from tribodyn.kernels.c.body.intrinsics import HELPER_NAMES
from tribodyn.kernels.c.body.loops import Loops
from tribodyn.kernels.c.body.statements import AgainError, OpenBlock
from tribodyn.kernels.c.lines import CLine, folded, names_in, without_unused
from tribodyn.kernels.c.sources import PythonSource, source_of
from tribodyn.kernels.c.types import (
    CArray,
    CKnown,
    CNumber,
    CPointer,
    CRecord,
    CTuple,
    CType,
    common,
    number_type,
    takes_place,
    tuple_name,
)
from tribodyn.kernels.c.unit import RESERVED, CFunction, Unit
from tribodyn.kernels.c.values import ATOM, Expression, Known, Several, Value, text_of

#: Names that no variable may have: C's own, and those of `HELPERS`.
_C_NAMES = RESERVED | HELPER_NAMES


class FunctionTranslator(Loops):
    """Translates one function."""

    def __init__(
        self,
        source: PythonSource,
        unit: Unit,
        kinds: tuple[CType, ...],
        general: dict[str, CType],
        renamed: set[str],
        exported: str,
    ):
        super().__init__(source, unit, general, renamed)
        self.kinds, self.exported = kinds, exported

    def translated(self) -> CFunction:
        """The C function."""
        parameters = self._parameters()
        self.blocks.append(
            OpenBlock({id(self.source.body)}, self.lines, 1, [], {name for _, name, _ in parameters})
        )
        ends = self.run(self.source.body)
        if not ends and any(not _is_none(value) for value in self.returned):
            raise self.source.error(self.source.node, "it does not return a value at its end")
        result = self._result()
        for line in self.lines:
            if line.text == "return":
                line.text = f"return{self._answer(line.returned, result)};"
        lines = without_unused(_without_last_return(self.lines))
        if clashes := self.called & self.taken:
            self.renamed |= {
                name.partition("@")[0] for name in self.scopes.names if self.named(name) in clashes
            }
            raise AgainError
        read = set().union(*(names_in(line.text) for line in lines)) if lines else set()
        text = [row for line in lines for row in folded(line.text, line.depth)]
        if self.exported:
            text = [f"    (void){name};" for _, name, _ in parameters if name not in read] + text
            used = parameters
        else:
            used = [one for one in parameters if one[1] in read]
        return CFunction(
            self.exported or self._c_name(),
            [(name, kind) for _, name, kind in used],
            [place for place, _, _ in used],
            result,
            self.writes,
            self.source.about,
            text,
            bool(self.exported),
        )

    def _c_name(self) -> str:
        name, function = self.source.name.strip("_"), self.source.function
        owner = self.unit.owners.setdefault(name, function)
        if owner is not function:
            return self.unit.unique(f"{self.source.module}_{name}")
        return self.unit.unique(name)

    def _parameters(self) -> list[tuple[int, str, CType]]:
        """Take over the arguments: place, name in C and type of those that are anything in C."""
        stored: list[tuple[int, str, CType]] = []
        given = self.source.parameters.parameters
        if any(one.kind in (one.VAR_POSITIONAL, one.VAR_KEYWORD) for one in given.values()):
            raise self.source.error(self.source.node, "it takes any number of arguments")
        if len(given) != len(self.kinds):
            raise self.source.error(
                self.source.node, f"it takes {len(given)} arguments, not {len(self.kinds)}"
            )
        for place, (name, kind) in enumerate(zip(given, self.kinds, strict=True)):
            if isinstance(kind, CKnown):
                self.values[name] = Known(kind.value)
                continue
            c_name = self.named(name)
            self.taken.add(c_name)
            if isinstance(kind, CPointer) and not takes_place(kind):
                self.values[name] = Expression("", kind.record, ATOM, "kept")
                continue
            if isinstance(kind, CTuple) and not takes_place(kind):
                self.values[name] = Several(tuple(Known(item.value) for item in kind.items))
                continue
            variable = Expression(c_name, kind, ATOM, "kept" if isinstance(kind, CPointer) else "local")
            self.values[name] = variable
            if self.scopes.assignments.get(name, 1) == 1:
                self.steady.add(c_name)
            else:
                self.variables[name] = variable
            stored.append((place, c_name, kind))
        return stored

    def _result(self) -> CType | None:
        """The type that takes all that the function returns."""
        values = [value for value in self.returned if not _is_none(value)]
        if not values:
            return None
        if len(values) < len(self.returned):
            raise self.source.error(self.source.node, "it returns a value at some places only")
        kinds = [self._kind(value) for value in values]
        kind = common(kinds)
        if kind is None:
            raise self.source.error(self.source.node, "it returns values of several types")
        if self.exported and not takes_place(kind):
            raise self.source.error(self.source.node, "it returns what is no number or tuple of numbers")
        if isinstance(kind, CTuple) and takes_place(kind):
            self.unit.tuples[tuple_name(kind)] = kind
        return kind

    def _kind(self, value: Value) -> CType:
        if isinstance(value, Several):
            return CTuple(tuple(self._kind(item) for item in value.items))
        if isinstance(value, Known):
            number = number_type(value.value) if self.exported else None
            return number or CKnown(value.value)
        if isinstance(value, Expression) and isinstance(value.type, CRecord) and value.place == "kept":
            return CPointer(value.type) if takes_place(value.type) else value.type
        return value.type

    def _answer(self, value: Value, kind: CType | None) -> str:
        if kind is None or not takes_place(kind):
            return ""
        return f" {self._text(value, kind)}"

    def _text(self, value: Value, kind: CType) -> str:
        """A value that is returned as one of a type."""
        if isinstance(kind, CTuple):
            if isinstance(value, Expression) and value.type == kind:
                return value.text
            items = self.items_of(value, self.source.node)
            pairs = zip(items, kind.items, strict=True)
            texts = [self._text(item, each) for item, each in pairs if takes_place(each)]
            return f"({tuple_name(kind)}){{{', '.join(texts)}}}"
        if isinstance(kind, CNumber):
            return text_of(value, wanted=kind)
        assert isinstance(value, Expression)
        if isinstance(kind, CPointer) and isinstance(value.type, CRecord):
            return f"&{value.text}"
        if isinstance(kind, CRecord) and isinstance(value.type, CPointer):
            return f"*{value.text}"
        assert isinstance(kind, (CRecord, CPointer, CArray))
        return value.text


def _is_none(value: Value) -> bool:
    return isinstance(value, Known) and value.value is None


def _without_last_return(lines: list[CLine]) -> list[CLine]:
    return lines[:-1] if lines and lines[-1].text == "return;" and lines[-1].depth == 1 else lines


def translate(unit: Unit, function: FunctionType, kinds: tuple[CType, ...], exported: str) -> CFunction:
    """The C function for arguments of such types; exported by a name, or for this file alone."""
    source = source_of(function)
    general: dict[str, CType] = {}
    renamed = {name for name in source.function.__code__.co_varnames if name in _C_NAMES}
    while True:
        try:
            return FunctionTranslator(source, unit, kinds, general, renamed, exported).translated()
        except AgainError:
            continue
