"""The statements of an answer in a normal form.

The normal form does not depend on names, comments and spaces. It does not depend on the order of operands.

One symbol replaces all names that the program defines: variables, parameters, functions, and attributes.
Names that are defined elsewhere are not replaced, because they show what the code does. Docstrings,
annotations and the contents of strings are removed.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass, field

from course_pkg.grading.flags.syntax import Function, is_text

COMMUTATIVE = (ast.Add, ast.Mult, ast.BitAnd, ast.BitOr, ast.BitXor)
MIRRORED = {ast.Gt: ast.Lt, ast.GtE: ast.LtE}
BLOCKS = ("body", "orelse", "finalbody", "handlers", "cases")
# A `Name` contains a name, and the number of the scope that binds this name. The number 0 is the module, and
# -1 means attributes.
Name = tuple[int, str]


@dataclass
class Statement:
    """One statement, without the statements in its body."""

    form: str  # `form` is the normal form of the statement.
    line: int
    parent: int  # `parent` is the index of the enclosing statement, or -1 at the top level.
    # `binds` contains the names of the program to which the statement assigns values.
    binds: set[Name] = field(default_factory=set)
    uses: set[Name] = field(default_factory=set)  # The statement reads these names of the program.


def statements_of(module: ast.Module) -> list[Statement]:
    """Return the statements of a Python program; an inner statement comes after its enclosing statement."""
    return _Reader(module).read()


class _Reader:
    """Reads the statements of one program."""

    def __init__(self, module: ast.Module) -> None:
        self._module = module
        self._attributes = set(_own_attributes(module))
        self._scopes: list[set[str]] = []
        self._made: list[Statement] = []

    def read(self) -> list[Statement]:
        """Return all statements."""
        self._block(self._module.body, -1, (self._scope(self._module),))
        return self._made

    def _scope(self, node: ast.AST) -> int:
        self._scopes.append(_bound(node))
        return len(self._scopes) - 1

    def _block(self, body: list[ast.stmt], parent: int, scopes: tuple[int, ...]) -> None:
        for node in body:
            if is_text(node) or isinstance(node, ast.Pass | ast.Global | ast.Nonlocal):
                continue
            self._statement(node, parent, scopes)

    def _statement(self, node: ast.AST, parent: int, scopes: tuple[int, ...]) -> None:
        inner = (*scopes, self._scope(node)) if isinstance(node, Function) else scopes
        made = Statement("", getattr(node, "lineno", 0), parent)
        made.form = _Form(self, made, inner).of(node)
        place = len(self._made)
        self._made.append(made)
        for name in BLOCKS:
            for child in getattr(node, name, []):
                if isinstance(child, ast.ExceptHandler | ast.match_case):
                    self._statement(child, place, inner)
                else:
                    self._block([child], place, inner)

    def owner(self, name: str, scopes: tuple[int, ...]) -> Name | None:
        """Return the innermost scope in `scopes` that binds `name`, together with the name.

        Return None if the program does not define the name.
        """
        for scope in reversed(scopes):
            if name in self._scopes[scope]:
                return scope, name
        return None

    def is_own_attribute(self, name: str) -> bool:
        """Return whether the program sets an attribute, or defines a method, with this name."""
        return name in self._attributes


class _Form:
    """Creates the normal form of one statement, and stores the names that the statement sets and uses."""

    def __init__(self, reader: _Reader, statement: Statement, scopes: tuple[int, ...]) -> None:
        self._reader = reader
        self._statement = statement
        self._scopes = scopes

    def of(self, node: ast.AST) -> str:
        """Return the normal form of a node of the syntax tree."""
        if isinstance(node, ast.Name):
            return self._name(node.id, stored=not isinstance(node.ctx, ast.Load))
        if isinstance(node, ast.arg):
            return self._name(node.arg, stored=True)
        if isinstance(node, ast.Attribute):
            return f"{self.of(node.value)}.{self._attribute(node.attr, not isinstance(node.ctx, ast.Load))}"
        if isinstance(node, ast.Constant):
            return "S" if isinstance(node.value, str) else repr(node.value)
        if isinstance(node, ast.JoinedStr):
            parts = [self.of(each.value) for each in node.values if isinstance(each, ast.FormattedValue)]
            return f"S({','.join(parts)})"
        return self._compound(node)

    def _compound(self, node: ast.AST) -> str:
        if isinstance(node, ast.AugAssign):
            target = self.of(node.target)
            self._statement.uses |= self._statement.binds  # An augmented assignment also reads the old value.
            value = self._operands(node.op, [target, self.of(node.value)])
            return f"Assign({target},{value})"
        if isinstance(node, ast.AnnAssign):
            return f"Assign({self.of(node.target)},{self.of(node.value) if node.value else ''})"
        if isinstance(node, ast.BinOp):
            return self._operands(node.op, [self.of(node.left), self.of(node.right)])
        if isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in MIRRORED:
            right, left = self.of(node.comparators[0]), self.of(node.left)
            return f"Compare({right},{MIRRORED[type(node.ops[0])].__name__},{left})"
        if isinstance(node, ast.Call):
            named = self._is_own(node.func)
            words = sorted(f"{'V' if named else each.arg}={self.of(each.value)}" for each in node.keywords)
            return f"Call({','.join([self.of(node.func), *map(self.of, node.args), *words])})"
        if isinstance(node, Function | ast.ClassDef | ast.ExceptHandler) and node.name:
            name = self._name(node.name, stored=True, outside=isinstance(node, Function))
            return f"{type(node).__name__}({name},{','.join(self._fields(node))})"
        if isinstance(node, ast.alias):
            self._name(node.asname or node.name.partition(".")[0], stored=True)
            return node.name
        return f"{type(node).__name__}({','.join(self._fields(node))})"

    def _fields(self, node: ast.AST) -> Iterator[str]:
        """Yield the normal forms of a syntax node's fields; skip statements, annotations, names and `ctx`."""
        for name, value in ast.iter_fields(node):
            if name in (*BLOCKS, "returns", "annotation", "ctx", "type_comment", "name"):
                continue
            for each in value if isinstance(value, list) else [value]:
                if isinstance(each, ast.AST):
                    yield self.of(each)
                elif isinstance(each, str | int) and name in ("module", "level", "attr"):
                    yield str(each)

    @staticmethod
    def _operands(operator: ast.operator, forms: list[str]) -> str:
        ordered = sorted(forms) if isinstance(operator, COMMUTATIVE) else forms
        return f"{type(operator).__name__}({','.join(ordered)})"

    def _name(self, name: str, *, stored: bool, outside: bool = False) -> str:
        scopes = self._scopes[:-1] if outside else self._scopes
        own = self._reader.owner(name, scopes)
        if own is None and outside and self._reader.is_own_attribute(name):
            own = (-1, name)
        return self._own(own, stored) if own else name

    def _attribute(self, name: str, stored: bool) -> str:
        return self._own((-1, name), stored) if self._reader.is_own_attribute(name) else name

    def _is_own(self, function: ast.expr) -> bool:
        """Return whether the program itself defines the function that is called."""
        if isinstance(function, ast.Attribute):
            return self._reader.is_own_attribute(function.attr)
        return isinstance(function, ast.Name) and self._reader.owner(function.id, self._scopes) is not None

    def _own(self, own: Name, stored: bool) -> str:
        (self._statement.binds if stored else self._statement.uses).add(own)
        return "V"


def _own_attributes(module: ast.Module) -> Iterator[str]:
    for node in ast.walk(module):
        if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.attr
        elif isinstance(node, ast.ClassDef):
            yield from (each.name for each in node.body if isinstance(each, Function | ast.ClassDef))
            assigned = [each for each in node.body if isinstance(each, ast.Assign | ast.AnnAssign)]
            named = [name for each in assigned for name in ast.walk(each) if isinstance(name, ast.Name)]
            yield from (name.id for name in named if isinstance(name.ctx, ast.Store))


def _bound(node: ast.AST) -> set[str]:
    """Return the names that a function or module binds; names in inner functions are not included."""
    names: set[str] = set()
    if isinstance(node, Function):
        given = node.args
        listed = [*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg]
        names |= {each.arg for each in listed if each}
    todo: list[ast.AST] = list(getattr(node, "body", []))
    while todo:
        each = todo.pop()
        if isinstance(each, Function | ast.ClassDef):
            names.add(each.name)
            if isinstance(each, Function):
                continue
        if isinstance(each, ast.Name) and not isinstance(each.ctx, ast.Load):
            names.add(each.id)
        elif isinstance(each, ast.ExceptHandler) and each.name:
            names.add(each.name)
        elif isinstance(each, ast.arg):
            names.add(each.arg)  # Here, each argument is an argument of a lambda.
        todo += ast.iter_child_nodes(each)
    return names
