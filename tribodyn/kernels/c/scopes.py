"""Variables of a function: how often they are assigned, and in which block the C variable is declared.

A name that stands for one thing after the other is several variables, each of a block and of a type.
"""

import ast
from dataclasses import dataclass

Path = tuple[int, ...]


@dataclass(eq=False)
class Occurrence:
    """A variable that is read or assigned."""

    name: str
    assigned: bool
    path: Path  # blocks around it, outermost first, by their numbers
    node: ast.Name | None = None


@dataclass
class PythonBlock:
    """Statements that run one after the other."""

    path: Path
    is_loop: bool
    first: int  # number of the first occurrence
    end: int = 0


class Scopes:
    """The variables of a function, in the order in which it runs through them once."""

    def __init__(self, body: list[ast.stmt], parameters: list[str]):
        self._all = [Occurrence(name, True, (id(body),)) for name in parameters]
        self._blocks: dict[int, PythonBlock] = {}
        self._loops: list[tuple[ast.For, int, int, Path]] = []
        self._block(body, (), False)
        self.scoped: set[int] = set()
        self._find_scoped()
        self._split()
        left = [one for one in self._all if one.name]
        self.names = {one.name for one in left}
        self.assignments = {name: sum(o.name == name and o.assigned for o in left) for name in self.names}
        self.home = {name: self._home([o for o in left if o.name == name]) for name in self.names}

    def _block(self, body: list[ast.stmt], path: Path, is_loop: bool) -> None:
        path = (*path, id(body))
        # the variable of a loop is assigned in its body, before that
        known = self._blocks.setdefault(id(body), PythonBlock(path, is_loop, len(self._all)))
        for statement in body:
            self._statement(statement, path)
        known.end = len(self._all)

    def _statement(self, node: ast.stmt, path: Path) -> None:
        if isinstance(node, ast.For):
            self._expression(node.iter, path)
            first = len(self._all)
            inside = (*path, id(node.body))
            self._blocks[id(node.body)] = PythonBlock(inside, True, first)
            self._expression(node.target, inside)
            self._block(node.body, path, True)
            if isinstance(node.target, ast.Name):
                self._loops.append((node, first, len(self._all), path))
        elif isinstance(node, ast.While):
            self._expression(node.test, path)
            self._block(node.body, path, True)
            self._expression(node.test, path)
        elif isinstance(node, ast.If):
            self._expression(node.test, path)
            self._block(node.body, path, False)
            self._block(node.orelse, path, False)
        elif isinstance(node, ast.Assign):
            self._expression(node.value, path)
            for target in node.targets:
                self._expression(target, path)
        elif isinstance(node, ast.AnnAssign):
            self._expression(node.value or ast.Constant(None), path)
            self._expression(node.target, path)
        elif isinstance(node, ast.AugAssign):
            if isinstance(node.target, ast.Name):
                self._all.append(Occurrence(node.target.id, False, path, node.target))
            self._expression(node.value, path)
            self._expression(node.target, path)
        else:
            self._expression(node, path)

    def _expression(self, node: ast.AST, path: Path) -> None:
        for part in ast.walk(node):
            if isinstance(part, ast.Name):
                self._all.append(Occurrence(part.id, isinstance(part.ctx, ast.Store), path, part))

    def _find_scoped(self) -> None:
        """Loops whose number is a variable of the loop alone; takes their occurrences out."""
        for node, first, end, path in self._loops:
            assert isinstance(node.target, ast.Name)
            name = node.target.id
            inside = [one for one in self._all[first:end] if one.name == name]
            if any(one.assigned for one in inside[1:]) or not self._is_dead_after(name, first, end, path):
                continue
            self.scoped.add(id(node))
            for one in inside:
                one.name = ""

    def _split(self) -> None:
        """Make variables of their own of names that a block assigns first and nothing reads behind it."""
        for number, block in enumerate(sorted(self._blocks.values(), key=lambda one: -len(one.path))):
            if len(block.path) == 1:
                continue
            inside = self._all[block.first : block.end]
            for name in sorted({one.name for one in inside if one.name and "@" not in one.name}):
                own = [one for one in inside if one.name == name]
                if not (own[0].assigned and own[0].path == block.path):
                    continue
                if not self._is_dead_after(name, block.first, block.end, block.path[:-1]):
                    continue
                for one in own:
                    one.name = f"{name}@{number}"
                    if one.node is not None:
                        one.node.id = one.name

    def _is_dead_after(self, name: str, first: int, end: int, path: Path) -> bool:
        """Whether nothing reads a variable as a part of a block leaves it."""
        spans = [(end, len(self._all))]
        for number in reversed(path):  # what a loop around it reads when it comes round
            if self._blocks[number].is_loop:
                spans.append((self._blocks[number].first, first))
        return all(self._is_dead(name, span, path) for span in spans)

    def _is_dead(self, name: str, span: tuple[int, int], path: Path) -> bool:
        """Whether a variable is assigned before it is read in a part of the function."""
        covered: list[Path] = []
        for one in self._all[slice(*span)]:
            if one.name.partition("@")[0] != name or any(
                one.path[: len(block)] == block for block in covered
            ):
                continue
            if not one.assigned:
                return False
            if path[: len(one.path)] == one.path:
                return True
            covered.append(one.path)
        return True

    def _home(self, occurrences: list[Occurrence]) -> int:
        """The innermost block that has all occurrences, outside loops that hand the variable on."""
        path = occurrences[0].path
        for one in occurrences:
            same = [a == b for a, b in zip(path, one.path, strict=False)]
            path = path[: same.index(False) if False in same else len(same)]
        first = occurrences[0]
        while (
            len(path) > 1 and self._blocks[path[-1]].is_loop and not (first.assigned and first.path == path)
        ):
            path = path[:-1]
        return path[len(path) - 1]
