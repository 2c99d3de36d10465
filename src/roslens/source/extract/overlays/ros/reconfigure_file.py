"""What a ``.cfg`` file of dynamic_reconfigure declares: a script in Python, evaluated as a small program, never run.

It calls a generator: ``gen.add(name, type, level, description, default, min, max, edit_method)``, of groups too, and at
last ``gen.generate(package, node, name)``, which makes the class ``package::nameConfig`` (dynamic_reconfigure,
parameter_generator_catkin.py). Functions that it imports may call it as well.
"""

from __future__ import annotations

import math
from functools import partial
from weakref import WeakKeyDictionary

import msgspec

from roslens.source.extract.domain.abstract_value import (
    Foreign,
    Named,
    Names,
    NodeBuilder,
    Obj,
    Unknown,
    Value,
    as_text,
)
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.domain.kinds import all_of_kind, is_number, is_whole, items_of, known_text, name_of
from roslens.source.extract.domain.state import State
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.expressions import Expressions
from roslens.source.extract.interpreter.interpreter import Interpreter, Parts
from roslens.source.extract.interpreter.vocabulary import CallSite, method, outer
from roslens.source.extract.symbolic.text import Conditions, Text, unknown
from roslens.source.extract.symbols.symbol_table import SymbolTable
from roslens.source.extract.transfer.budget import BudgetExceededError
from roslens.source.extract.transfer.context import Context

_GENERATOR, _GROUP = "dynamic_reconfigure.ParameterGenerator", "dynamic_reconfigure.Group"
_MODULES = ("dynamic_reconfigure.parameter_generator_catkin", "dynamic_reconfigure.parameter_generator")
_TYPES = {"int": "int", "double": "double", "str": "string", "bool": "bool"}
_NOTHING: Names = {"int": 0, "double": 0.0, "string": Text(), "bool": False}
_ADDED = "-added"
_ODD = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, RecursionError)


class Declaration(Foreign, frozen=True):
    """A parameter that a ``.cfg`` file declares.

    Attributes:
        name: of it, below the namespace of the server.
        type: ``bool``, ``int``, ``double`` or ``string``; empty where unknown.
        default: as text; a hole where it is unknown.
        range: as ``least..greatest``; either end may be missing.
        description: for people.
        evidence: where it is declared.
        conditions: under which it is.
    """

    name: Text
    type: str
    default: Text
    range: str
    description: str
    evidence: Evidence
    conditions: Conditions = ()


class ReconfigureFile(msgspec.Struct, frozen=True):
    """What one call of ``generate`` makes.

    Attributes:
        package: namespace of the class in C++; empty where it is unknown.
        name: of the class without ``Config``; empty where it is unknown.
        path: of the ``.cfg`` file.
        declarations: its parameters, in their order.
        whole: whether all of the file was followed.
    """

    package: str
    name: str
    path: str
    declarations: tuple[Declaration, ...]
    whole: bool = True


class _Script(Expressions):
    """Expressions of a ``.cfg`` file, which keep what it generates."""

    def __init__(self, ctx: Context, generated: list[ReconfigureFile]) -> None:
        super().__init__(ctx)
        self.generated = generated

    def outside(self, name: str) -> Value:
        """Return what a name means that is not of the script."""
        return math.pi if name in ("math.pi", "pi") else super().outside(name)


_read: WeakKeyDictionary[SymbolTable, dict[str, tuple[ReconfigureFile, ...]]] = WeakKeyDictionary()


def reconfigure_files(index: SymbolTable, name: str) -> tuple[ReconfigureFile, ...]:
    """Return what the ``.cfg`` files of a workspace declare for classes ``nameConfig``, each named like its class.

    Args:
        index: of the workspace.
        name: without package and ``Config``.
    """
    known = _read.setdefault(index, {})
    if name not in known:
        ending = f"/{name}.cfg"
        paths = [path for path in index.programs if path.endswith(ending)]
        known[name] = tuple(one for path in sorted(paths) for one in read_reconfigure_file(index, path))
    return tuple(one for one in known[name] if one.name in (name, ""))


def read_reconfigure_file(index: SymbolTable, path: str) -> tuple[ReconfigureFile, ...]:
    """Return what a ``.cfg`` file declares, for each class that it generates."""
    program = index.programs[path]
    if program.language != "python":
        return ()
    generated: list[ReconfigureFile] = []
    reading = Interpreter(
        index,
        NodeBuilder("<module>", path, 1, "ros1", parameters=[], endpoints=[], unresolved=[]),
        parts=Parts(partial(_Script, generated=generated)),
        state=State(Frame(path, "", names={"__name__": Text.of("__main__")}), Evidence(path, 1)),
    )
    whole = not program.incomplete
    try:
        reading.block(program.body)
    except (BudgetExceededError, *_ODD):
        whole = False
    return tuple(msgspec.structs.replace(one, whole=whole) for one in generated)


@outer("ParameterGenerator", *(f"{module}.ParameterGenerator" for module in _MODULES))
def generator(_ctx: Context, _thing: Value, _called: CallSite) -> Value:
    """A generator is made."""
    return Obj(_GENERATOR, None, {_ADDED: []})


@method(_GENERATOR, "add_group")
@method(_GROUP, "add_group")
def group(_ctx: Context, thing: Obj, _called: CallSite) -> Value:
    """A group is made; it is for people who look at the parameters, their names stay without it."""
    return Obj(_GROUP, None, {_ADDED: thing.fields[_ADDED]})


@method(_GENERATOR, "const", "enum")
def constant(_ctx: Context, _thing: Obj, called: CallSite) -> Value:
    """A constant, or values that are chosen from: they limit nothing."""
    return Unknown(f"result of {called.name}()")


@method(_GENERATOR, "add")
@method(_GROUP, "add")
def add(ctx: Context, thing: Obj, called: CallSite) -> Value:
    """A parameter is declared."""
    kind = _type(called.argument(1, "paramtype"))
    ends = [_end(called.argument(place, name), kind) for place, name in ((5, "min"), (6, "max"))]
    description = as_text(called.argument(3, "description", default=Text()))
    items_of(thing.fields[_ADDED]).append(
        Declaration(
            as_text(called.argument(0, "name")),
            kind,
            _value(called.argument(4, "default"), kind),
            "..".join(ends) if any(ends) else "",
            description.known or "",
            called.evidence,
            tuple(dict.fromkeys(ctx.state.conditions)),
        )
    )
    return None


@method(_GENERATOR, "generate")
def generate(ctx: Context, thing: Obj, called: CallSite) -> Value:
    """A class is generated of what was declared until now."""
    match ctx.expressions:
        case _Script(generated=generated):
            texts = [as_text(called.argument(place, name)) for place, name in ((0, "pkgname"), (2, "name"))]
            package, name = (one.known or "" for one in texts)
            added = all_of_kind(items_of(thing.fields[_ADDED]), Declaration)
            generated.append(ReconfigureFile(package, name, ctx.state.frame.path, tuple(added)))
    return 0


def _type(value: Value) -> str:
    """Return the type that ``int_t`` names, or the text that it is in the generator's own source."""
    written = known_text(value) or name_of(value)
    return _TYPES.get(written.rpartition(".")[2].removesuffix("_t"), "")


def _value(value: Value, kind: str) -> Text:
    """Return a default as text: what fits its type; without one it is nothing of its type."""
    if value is None and kind:
        value = _NOTHING[kind]
    if kind == "double" and is_number(value):
        return Text.of(repr(float(value)))
    match kind, value:
        case ("bool", bool()) | ("string", Text()):
            return as_text(value)
        case "int", int() if is_whole(value):
            return as_text(value)
        case _, Unknown() | Named():
            return unknown(as_text(value).holes[0].reason)
    return unknown(f"no value of type {kind}")


def _end(value: Value, kind: str) -> str:
    if kind not in ("int", "double") or not is_number(value):
        return ""
    return repr(float(value)) if kind == "double" else str(int(value))
