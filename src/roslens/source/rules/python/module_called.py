"""Rule ``python.module_called``: a module is taken for the function or class of its name, or the other way round."""

from __future__ import annotations

import importlib
import re
import sys
from collections.abc import Iterator
from functools import cache

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.views.python_names import python_names, text_of

_NAMESAKES = ("copy", "datetime", "glob", "pprint", "random", "time")
"""Modules of the standard library that hold a function or class of their own name."""

_CALLS = re.compile(rb"(?<![\w.])(\w+)\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield calls of what an import binds to a module, and attributes of a module's namesake that only it has."""
    for name, module, member, bound in _imported(node):
        if member:
            if member in _namesakes().get(module, ()):
                yield from _of_member(name, module, member, (bound, view))
            continue
        if name.encode() in view.names(_CALLS):
            yield from _called(name, module, (bound, view))
        if module in _namesakes():
            yield from _of_module(name, module, (bound, view))


def _imported(node: Node) -> Iterator[tuple[str, str, str, Node]]:
    """Yield for each name of an import statement: the name, the module, the member if it is one, what binds it."""
    module = node.child_by_field_name("module_name")
    for one in node.children_by_field_name("name"):
        written = one.child_by_field_name("name") if one.type == "aliased_import" else one
        alias = text_of(one.child_by_field_name("alias")) if one.type == "aliased_import" else ""
        whole = text_of(written)
        if module is None:
            # `import a.b` binds `a`, a package, which is no function either.
            yield alias or whole.partition(".")[0], whole if alias else whole.partition(".")[0], "", one
        elif module.type != "relative_import":
            yield alias or whole, text_of(module), whole, one


def _reads(name: str, bound: Node, view: FileView) -> Iterator[Node]:
    """Yield where a name is read that nothing but one import binds, in its scope."""
    names = python_names(view)
    for node, scope in names.reads_of(name) if not names.is_open else ():
        owner = scope.finds(name)
        binding = owner.bound[name] if owner is not None else ()
        if len(binding) == 1 and binding[0].start_byte == bound.start_byte:
            yield node


def _called(name: str, module: str, where: tuple[Node, FileView]) -> Iterator[Hit]:
    bound, view = where
    for node in _reads(name, bound, view):
        call = node.parent
        if call is None or call.type != "call" or call.child_by_field_name("function") != node:
            continue
        last = module.rpartition(".")[2]
        advice = f"; expected {name}.{last}()" if module in _namesakes() else ""
        message = f"{name!r} is the module {module}, and a module cannot be called: a TypeError{advice}"
        # Few modules put something else into their place.
        standard = module.partition(".")[0] in sys.stdlib_module_names
        yield view.hit("python.module_called", call, message, certainty=None if standard else Certainty.LIKELY)


def _of_member(name: str, module: str, member: str, where: tuple[Node, FileView]) -> Iterator[Hit]:
    bound, view = where
    kind, own, others = _namesakes()[module][member]
    for node, attribute in _attributes(name, bound, view, others - own):
        message = f"{name!r} is the {kind} {module}.{member}, which has no {attribute!r}: an AttributeError"
        advice = f"; expected `import {module}`"
        yield view.hit("python.module_called", node, message + advice)


def _of_module(name: str, module: str, where: tuple[Node, FileView]) -> Iterator[Hit]:
    bound, view = where
    for member, (kind, own, others) in _namesakes()[module].items():
        for node, attribute in _attributes(name, bound, view, own - others):
            message = f"{name!r} is the module {module}, which has no {attribute!r}: an AttributeError"
            yield view.hit("python.module_called", node, f"{message}; the {kind} {module}.{member} has it")


def _attributes(name: str, bound: Node, view: FileView, wrong: frozenset[str]) -> Iterator[tuple[Node, str]]:
    """Yield where one of the wrong attributes is looked for below a name."""
    if all(one.encode() not in view.words for one in wrong):
        return
    for node in _reads(name, bound, view):
        parent = node.parent
        if parent is not None and parent.type == "attribute":
            attribute = text_of(parent.child_by_field_name("attribute"))
            if attribute in wrong:
                yield parent, attribute


@cache
def _namesakes() -> dict[str, dict[str, tuple[str, frozenset[str], frozenset[str]]]]:
    """Return, by module and member of its name, what sort it is, what names it has, and what the module has."""
    found: dict[str, dict[str, tuple[str, frozenset[str], frozenset[str]]]] = {}
    for name in _NAMESAKES:
        module = importlib.import_module(name)
        member = getattr(module, name)
        kind = "class" if isinstance(member, type) else "function"
        own = frozenset(one for one in dir(member) if not one.startswith("_"))
        others = frozenset(one for one in dir(module) if not one.startswith("_"))
        found[name] = {name: (kind, own, others)}
    return found


RULE = FileRule(
    id="python.module_called",
    title="Module taken for the function of its name",
    finds="A call of a name that an import binds to a module (`import glob` and `glob(…)`), the other way round "
    "(`from glob import glob` and `glob.glob(…)`), and a name of `datetime.datetime` that is looked for in the module. "
    "Only names that one import binds, and nothing else.",
    why="Python ends there with a TypeError or an AttributeError: in setup.py the build, in a launch file the start, "
    "in a node whatever it was doing.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    kinds=("import_statement", "import_from_statement"),
    bad="import glob\n\nfiles = glob('launch/*')\n",
    good="from glob import glob\n\nfiles = glob('launch/*')\n",
    found=found,
)
