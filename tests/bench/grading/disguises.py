"""Changes programs as students do: rewrites an answer in another style, or disguises a copy.

A style changes the structure of a program. A disguise changes only names, comments, and the order of
functions and of independent statements.
"""

from __future__ import annotations

import ast
import random
from collections.abc import Callable, Sequence

RESULTS = ("response", "result", "answer", "reply", "res", "out", "resp", "returned")
WORDS = [
    "alpha",
    "beta",
    "gamma",
    "item",
    "box",
    "thing",
    "my_value",
    "foo",
    "data1",
    "tmp",
    "helper",
    "inner",
    "part",
    "piece",
    "unit",
    "entry",
]
REMARKS = (
    "TODO: clean up",
    "here the work is done",
    "see the slides",
    "works now",
    "the server answers here",
    "check the value first",
)
Rule = Callable[[ast.Module, random.Random], None]


def in_style(source: str, style: Sequence[Rule], draw: random.Random) -> str:
    """Rewrite a program by the rules of a style; the behaviour of the program does not change."""
    magic, module = _parsed(source)
    for rule in style:
        rule(module, draw)
    return magic + ast.unparse(ast.fix_missing_locations(module)) + "\n"


def a_style(draw: random.Random) -> list[Rule]:
    """Return a random selection of the style rules, in random order."""
    return draw.sample(RULES, draw.randint(4, 7))


def disguised(source: str, keep: set[str], draw: random.Random) -> str:
    """Return a copy of a program with other names, order and comments.

    The names in the argument `keep` stay the same.
    """
    magic, module = _parsed(source)
    _without_docstrings(module)
    _renamed(module, keep, draw)
    _reordered(module, draw)
    lines = ast.unparse(ast.fix_missing_locations(module)).splitlines()
    made = []
    for line in lines:
        indent = line[: len(line) - len(line.lstrip())]
        if draw.random() < 0.25 and line.strip() and not line.lstrip().startswith(("elif", "else", "except")):
            made.append(f"{indent}# {draw.choice(REMARKS)}")
        made.append(line)
    return magic + "\n".join(made) + "\n"


def _parsed(source: str) -> tuple[str, ast.Module]:
    magic, _, rest = source.partition("\n")
    if magic.startswith("%%"):
        return f"{magic}\n#!/usr/bin/env python3\n", ast.parse(rest)
    return "", ast.parse(source)


def _without_docstrings(module: ast.Module) -> None:
    for node in ast.walk(module):
        body = getattr(node, "body", None)
        text = isinstance(body, list) and len(body) > 1 and isinstance(body[0], ast.Expr)
        if text and isinstance(body[0].value, ast.Constant):
            del body[0]


def _renamed(module: ast.Module, keep: set[str], draw: random.Random) -> None:
    """Rename the functions, methods, parameters, variables and attributes of the program."""
    listed = [alias for node in ast.walk(module) for alias in getattr(node, "names", [])]
    imported = {alias.asname or alias.name for alias in listed if isinstance(alias, ast.alias)}
    fixed = {"success", "message", "area", "volume", "self", *keep, *imported}
    new = _new_names(sorted(_variables(module) - fixed), draw)
    members = _new_names(sorted(_members(module) - fixed), draw)
    inside = {id(each) for node in ast.walk(module) if isinstance(node, ast.ClassDef) for each in node.body}
    for node in ast.walk(module):
        if isinstance(node, ast.ClassDef):
            for target in (
                target for each in node.body if isinstance(each, ast.Assign) for target in each.targets
            ):
                for name in ast.walk(target):
                    if isinstance(name, ast.Name):
                        name.id = members.get(name.id, name.id)
        if id(node) in inside and isinstance(node, ast.FunctionDef):
            node.name = members.get(node.name, node.name)
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            node.name = new.get(node.name, node.name)
        elif isinstance(node, ast.arg):
            node.arg = new.get(node.arg, node.arg)
        elif isinstance(node, ast.Name):
            node.id = new.get(node.id, node.id)
        elif isinstance(node, ast.Attribute):
            node.attr = members.get(node.attr, node.attr)
        elif isinstance(node, ast.Global | ast.Nonlocal):
            node.names = [new.get(name, name) for name in node.names]


def _new_names(old: Sequence[str], draw: random.Random) -> dict[str, str]:
    kept = [name for name in old if not name.startswith("__")]
    return {name: f"{draw.choice(WORDS)}_{number}" for number, name in enumerate(kept)}


def _variables(module: ast.Module) -> set[str]:
    """Return the names of variables, parameters, functions and classes."""
    own: set[str] = set()
    inside = {id(each) for node in ast.walk(module) if isinstance(node, ast.ClassDef) for each in node.body}
    for node in ast.walk(module):
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and id(node) not in inside:
            own.add(node.name)
        elif isinstance(node, ast.arg):
            own.add(node.arg)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            own.add(node.id)
    return own - _members(module)


def _members(module: ast.Module) -> set[str]:
    """Return the names of attributes and methods."""
    own: set[str] = set()
    for node in ast.walk(module):
        if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            own.add(node.attr)
        elif isinstance(node, ast.ClassDef):
            for each in node.body:
                own |= {each.name} if isinstance(each, ast.FunctionDef) else _stored(each)
    return own


def _reordered(module: ast.Module, draw: random.Random) -> None:
    """Change the order of methods, adjacent functions and classes, and adjacent assignments."""
    for node in ast.walk(module):
        body = getattr(node, "body", None)
        if not isinstance(body, list):
            continue
        start = 0
        while start < len(body):
            end = start + 1
            while end < len(body) and _may_swap(body[start:end], body[end]):
                end += 1
            part = body[start:end]
            draw.shuffle(part)
            body[start:end] = part
            start = end
        for call in ast.walk(node):
            if isinstance(call, ast.Call):
                draw.shuffle(call.keywords)


def _may_swap(before: Sequence[ast.AST], node: ast.AST) -> bool:
    definitions = (ast.FunctionDef,)
    if isinstance(node, definitions) and not node.decorator_list:
        return all(isinstance(each, definitions) and not each.decorator_list for each in before)
    if not isinstance(node, ast.Assign | ast.Import | ast.ImportFrom):
        return False
    return all(
        isinstance(each, ast.Assign | ast.Import | ast.ImportFrom)
        and not (_stored(each) & _named(node) or _stored(node) & _named(each))
        for each in before
    )


def _named(node: ast.AST) -> set[str]:
    return {each.id if isinstance(each, ast.Name) else each.attr
            for each in ast.walk(node) if isinstance(each, ast.Name | ast.Attribute)}  # fmt: skip


def _stored(node: ast.AST) -> set[str]:
    if isinstance(node, ast.Import | ast.ImportFrom):
        return {alias.asname or alias.name for alias in node.names}
    found = set()
    for each in ast.walk(node):
        if isinstance(each, ast.Name | ast.Attribute) and isinstance(each.ctx, ast.Store):
            found.add(each.id if isinstance(each, ast.Name) else each.attr)
    return found


def _blocks(module: ast.Module) -> list[list[ast.stmt]]:
    found = []
    for node in ast.walk(module):
        for name in ("body", "orelse"):
            body = getattr(node, name, None)
            if isinstance(body, list):
                found.append(body)
    return found


def _functions(module: ast.Module) -> list[ast.FunctionDef]:
    return [
        node for node in ast.walk(module) if isinstance(node, ast.FunctionDef) and node.name != "__init__"
    ]


def _statement(text: str) -> ast.stmt:
    return ast.parse(text).body[0]


def name_results(module: ast.Module, draw: random.Random) -> None:
    """Assign each returned response, or each of its fields, to a variable."""
    name, one_by_one = draw.choice(RESULTS), draw.random() < 0.5
    for body in _blocks(module):
        for place in range(len(body) - 1, -1, -1):
            node = body[place]
            if not isinstance(node, ast.Return) or not isinstance(node.value, ast.Call):
                continue
            call = node.value
            made = [ast.Assign([ast.Name(name, ast.Store())], call, lineno=0)]
            if one_by_one and call.keywords and not call.args:
                made[0] = ast.Assign([ast.Name(name, ast.Store())], ast.Call(call.func, [], []), lineno=0)
                made += [
                    ast.Assign([ast.Attribute(ast.Name(name, ast.Load()), each.arg, ast.Store())], each.value,
                               lineno=0)
                    for each in call.keywords if each.arg
                ]  # fmt: skip
            body[place : place + 1] = [*made, ast.Return(ast.Name(name, ast.Load()))]


def log_calls(module: ast.Module, draw: random.Random) -> None:
    """Add a log message at the beginning of some functions."""
    level = draw.choice(["loginfo", "logdebug", "logwarn", "loginfo_once"])
    for function in _functions(module):
        if draw.random() < 0.7:
            first = function.args.args[-1].arg if function.args.args else "None"
            words = draw.choice(['"called"', f'"got %s", {first}', f'f"{function.name}: {{{first}}}"'])
            function.body.insert(0, _statement(f"rospy.{level}({words})"))


def print_results(module: ast.Module, draw: random.Random) -> None:
    """Add a print() before each return."""
    text = draw.choice(['print("done")', 'print("ok", flush=True)', "rospy.sleep(0)"])
    for body in _blocks(module):
        if body and isinstance(body[-1], ast.Return) and draw.random() < 0.6:
            body.insert(len(body) - 1, _statement(text))


def format_texts(module: ast.Module, draw: random.Random) -> None:
    """Rewrite f-strings and calls of str()."""
    style = draw.choice(["{}", "%"])

    class Change(ast.NodeTransformer):
        def visit_Call(self, node: ast.Call) -> ast.AST:
            self.generic_visit(node)
            if isinstance(node.func, ast.Name) and node.func.id == "str" and len(node.args) == 1:
                if style == "%":
                    return ast.BinOp(ast.Constant("%s"), ast.Mod(), node.args[0])
                return ast.Call(ast.Attribute(ast.Constant("{}"), "format", ast.Load()), node.args, [])
            return node

    Change().visit(module)


def turn_conditions(module: ast.Module, draw: random.Random) -> None:
    """Swap the branches of `if … else`."""
    for node in ast.walk(module):
        if isinstance(node, ast.If) and node.orelse and draw.random() < 0.7:
            node.test = ast.UnaryOp(ast.Not(), node.test)
            node.body, node.orelse = node.orelse, node.body


def leave_else_out(module: ast.Module, draw: random.Random) -> None:
    """If the body of an `if` ends with return or raise, move the following statements into an else branch."""
    for body in _blocks(module):
        for place, node in enumerate(body):
            ends = isinstance(node, ast.If) and isinstance(node.body[-1], ast.Return | ast.Raise)
            if ends and not node.orelse and body[place + 1 :]:
                node.orelse = body[place + 1 :]
                del body[place + 1 :]
                break


def spread_conditional_values(module: ast.Module, draw: random.Random) -> None:
    """Write `x = a if c else b` as an if statement."""
    for body in _blocks(module):
        for place in range(len(body) - 1, -1, -1):
            node = body[place]
            value = getattr(node, "value", None)
            if isinstance(node, ast.Assign) and isinstance(value, ast.IfExp):
                body[place] = ast.If(
                    value.test,
                    [ast.Assign(node.targets, value.body, lineno=0)],
                    [ast.Assign(node.targets, value.orelse, lineno=0)],
                )


def name_arguments(module: ast.Module, draw: random.Random) -> None:
    """Assign each calculated argument of a call to a variable before the call."""
    name = draw.choice(WORDS)
    for body in _blocks(module):
        for place in range(len(body) - 1, -1, -1):
            node = body[place]
            if not isinstance(node, ast.Return | ast.Assign | ast.Expr) or not isinstance(
                node.value, ast.Call
            ):
                continue
            made = []
            for each in node.value.keywords:
                if isinstance(each.value, ast.Call | ast.BinOp | ast.IfExp | ast.Compare):
                    label = f"{name}{len(made)}"
                    made.append(ast.Assign([ast.Name(label, ast.Store())], each.value, lineno=0))
                    each.value = ast.Name(label, ast.Load())
            body[place:place] = made


def compare_with_true(module: ast.Module, draw: random.Random) -> None:
    """Add `== True` to conditions."""
    operator = draw.choice([ast.Is, ast.Eq])
    for node in ast.walk(module):
        if isinstance(node, ast.If | ast.IfExp) and isinstance(node.test, ast.Attribute | ast.Name):
            node.test = ast.Compare(node.test, [operator()], [ast.Constant(True)])


def guard(module: ast.Module, draw: random.Random) -> None:
    """Add a check of the argument at the beginning of each handler."""
    test = draw.choice(["{} is None", "not hasattr({}, '__slots__')", "rospy.is_shutdown()"])
    for function in _functions(module):
        if function.args.args and draw.random() < 0.8:
            name = function.args.args[-1].arg
            function.body.insert(0, _statement(f"if {test.format(name)}:\n    return None"))


def protect(module: ast.Module, draw: random.Random) -> None:
    """Put the body of each handler into a try statement, or into a `with` statement with a lock."""
    error = draw.choice(["ValueError", "TypeError", "Exception"])
    if draw.random() < 0.5:
        for function in _functions(module):
            if len(function.body) > 1:
                tried = _statement(
                    f"try:\n    pass\nexcept {error} as problem:\n    rospy.logerr(problem)\n    raise"
                )
                assert isinstance(tried, ast.Try)
                tried.body, function.body = function.body, [tried]
        return
    module.body.insert(0, _statement("import threading"))
    module.body.insert(1, _statement("lock = threading.RLock()"))
    for function in _functions(module):
        locked = _statement("with lock:\n    pass")
        assert isinstance(locked, ast.With)
        locked.body, function.body = function.body, [locked]


def annotate_steps(module: ast.Module, draw: random.Random) -> None:
    """Assign the fields of the request to variables at the beginning of each handler."""
    for function in _functions(module):
        fields = sorted(
            {node.attr for node in ast.walk(function) if isinstance(node, ast.Attribute)
             and isinstance(node.value, ast.Name) and node.value.id in ("request", "req")}
        )  # fmt: skip
        if fields and function.args.args:
            name = function.args.args[-1].arg
            for node in ast.walk(function):
                for part, value in ast.iter_fields(node):
                    if isinstance(value, ast.Attribute) and value.attr in fields and _is(value.value, name):
                        setattr(node, part, ast.Name(f"the_{value.attr}", ast.Load()))
            function.body[:0] = [_statement(f"the_{field} = {name}.{field}") for field in fields]


def slip(module: ast.Module, draw: random.Random) -> None:
    """Add a mistake, such as a wrong number or comparison."""
    for node in ast.walk(module):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult) and draw.random() < 0.5:
            node.op = ast.Add()
        elif isinstance(node, ast.Compare) and isinstance(node.ops[0], ast.Lt) and draw.random() < 0.5:
            node.ops[0] = ast.LtE()
        elif isinstance(node, ast.Constant) and node.value == 0 and draw.random() < 0.5:
            node.value = 1


def serve_in_main(module: ast.Module, draw: random.Random) -> None:
    """Move the creation of the services into a function."""
    assigned = [node for node in module.body if isinstance(node, ast.Assign)]
    services = [node for node in assigned if ast.unparse(node.value).startswith("rospy.Service(")]
    if services:
        place = module.body.index(services[0])
        names = [ast.unparse(node.targets[0]) for node in services]
        function = _statement(f"def {draw.choice(['serve', 'start', 'setup', 'create'])}():\n    pass")
        assert isinstance(function, ast.FunctionDef)
        result = ast.parse(", ".join(names), mode="eval").body
        function.body = [*services, ast.Return(result)]
        module.body = [node for node in module.body if node not in services]
        module.body[place:place] = [function, _statement(f"{', '.join(names)} = {function.name}()")]


def _is(node: ast.AST, name: str) -> bool:
    return isinstance(node, ast.Name) and node.id == name


RULES: list[Rule] = [
    name_results, log_calls, print_results, format_texts, turn_conditions, leave_else_out,
    spread_conditional_values, name_arguments, compare_with_true, guard, protect, annotate_steps, slip,
    serve_in_main,
]  # fmt: skip
