"""What in a workspace becomes a node when it is started, and what it makes then."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from roslens.source.extract.domain.abstract_value import Callable, Invocation, Named, Obj, Unknown, Value
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.domain.word_list import words_given
from roslens.source.extract.facts.chosen import Chosen
from roslens.source.extract.facts.node_facts import Evidence, NodeFacts
from roslens.source.extract.interpreter.interpreter import Interpreter
from roslens.source.extract.ir.program import (
    Assign,
    Branch,
    Call,
    Evaluate,
    Function,
    Literal,
    Loop,
    Name,
    Operation,
)
from roslens.source.extract.ir.program import Mapping as Table
from roslens.source.extract.ir.program import Sequence as Listed
from roslens.source.extract.symbolic.text import Text, Written
from roslens.source.extract.symbols.node_bases import NODE_BASES, generation_of
from roslens.source.extract.symbols.noted_table import NotedTable
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.symbols.symbol_table import Defined, SymbolTable
from roslens.source.extract.transfer.context import Given
from roslens.source.extract.transfer.module_values import changes_of
from roslens.source.extract.units.finished_unit import (
    building_of,
    class_name,
    finished,
    function_place,
    given_names,
    given_words,
)

NO_NAMES: Mapping[str, str] = MappingProxyType({})
_FIRST = (
    "on_init",
    "on_configure",
    "on_activate",
    "onInit",
    "configure",
    "initialize",
    "onInitialize",
    "init",
    "activate",
)
TREE_REGISTRATIONS = frozenset({"registerNodeType", "registerBuilder"})
"""Functions that register a class as a node of behaviour trees."""
_REGISTRATIONS = {
    "RCLCPP_COMPONENTS_REGISTER_NODE": 0,
    "PLUGINLIB_EXPORT_CLASS": 0,
    "CLASS_LOADER_REGISTER_CLASS": 0,
    "PLUGINLIB_DECLARE_CLASS": 2,
}


def node_classes(index: SymbolTable) -> Iterator[tuple[Defined, str, str]]:
    """Yield the classes that are nodes, with generation and kind: those that a node is a base of."""
    for path in sorted(index.programs):
        for one in index.programs[path].classes:
            found = Defined(path, one)
            for base in index.outer_bases(found):
                if base in NODE_BASES and index.version in ("", NODE_BASES[base][0]):
                    yield (found, *NODE_BASES[base])
                    break


def registered(index: SymbolTable) -> dict[str, Evidence]:
    """Return the classes that are registered as components, nodelets or plug-ins, and where."""
    found: dict[str, Evidence] = {}
    for path, program in index.programs.items():
        for statement in program.body:
            match statement:
                case Evaluate(expression=Call(function=Name(name=name)) as call) if name in _REGISTRATIONS:
                    place = _REGISTRATIONS[name]
                    match call.arguments[place : place + 1]:
                        case (Name(name=registered_name),):
                            found.setdefault(registered_name, Evidence(path, call.line, call.column))
    return found


def facts_of_class(
    index: SymbolTable, defined: Defined, generation: str, kind: str, reached: Reached | None = None, *,
    chosen: Chosen | None = None, plugin_names: Mapping[str, str] = NO_NAMES,
) -> list[NodeFacts]:  # fmt: skip
    """Return the facts of a class that is a node, and of further nodes that it makes.

    ``chosen`` and ``plugin_names`` tell which plug-ins are loaded, see :class:`Given`.
    """
    building = building_of(defined.what.qualified_name, defined.path, defined.what.line, generation, kind)
    ctx = Interpreter(NotedTable(index, defined.path), building, Given(chosen, plugin_names))

    def run() -> None:
        ctx.state.frame = Frame(defined.path, defined.what.qualified_name)
        thing = Obj(defined.what.qualified_name, defined, {}, building if generation == "ros1" else None)
        ctx.objects.prepare(thing)
        thing.node = thing.node or building
        building.named = False
        ctx.objects.construct_as(thing, defined, [], {})
        run_methods(ctx, thing)
        _run_made(ctx, thing)
        _run_plugged(ctx)

    given = given_names(chosen, plugin_names)
    return finished(ctx, run, reached, (*class_name("class", index, defined), generation, kind, *given))


def facts_of_plugin(
    index: SymbolTable, defined: Defined, generation: str, reached: Reached | None = None
) -> list[NodeFacts]:
    """Return the facts of a class that is loaded into a node as a plug-in: what it adds to whatever node that is."""
    building = building_of(defined.what.qualified_name, defined.path, defined.what.line, generation, "plugin")
    building.named = True
    ctx = Interpreter(NotedTable(index, defined.path), building)

    def run() -> None:
        ctx.state.frame = Frame(defined.path, defined.what.qualified_name)
        thing = Obj(defined.what.qualified_name, defined, {})
        ctx.objects.prepare(thing)
        ctx.objects.construct_as(thing, defined, [], {})
        run_methods(ctx, thing)
        for found in ctx.index.methods(defined, defined.what.name):
            # Constructors that are never called are an offer too.
            if (found.path, found.what.line) not in ctx.callbacks.reached:
                other = Obj(defined.what.qualified_name, defined, {})
                ctx.objects.prepare(other)
                ctx.call(Invocation(Callable(found.what, found.path, other)))
        ctx.run_later()

    return finished(ctx, run, reached, (*class_name("plugin", index, defined), generation))


def facts_of_function(
    index: SymbolTable, path: str, function: Function, reached: Reached | None = None, *, prepared: bool = True
) -> list[NodeFacts]:
    """Return the facts of a function that nothing is known to call, with arguments and object that are unknown.

    Of the members of its object the types are known, and their values at first, unless it is not ``prepared``.
    """
    generation = generation_of(index, path)
    building = building_of(function.qualified_name, path, function.line, generation, "function")
    building.named = True
    ctx = Interpreter(NotedTable(index, path), building)

    def run() -> None:
        defined = ctx.index.class_of(function.class_name, path, "") if function.class_name else None
        thing = None if defined is None else Obj(defined.what.qualified_name, defined, {})
        ctx.state.frame = Frame(path, "")
        if thing is not None and prepared:
            ctx.objects.prepare(thing)
        ctx.call(Invocation(Callable(function, path, thing)))
        ctx.run_later()

    place = function_place(index, path, function)
    return finished(ctx, run, reached, ("function", path, function.qualified_name, place, generation, str(prepared)))


def facts_of_main(
    index: SymbolTable, path: str, reached: Reached | None = None, words: Sequence[Text] | None = None, *,
    chosen: Chosen | None = None, plugin_names: Mapping[str, str] = NO_NAMES,
) -> list[NodeFacts]:  # fmt: skip
    """Return the facts of a C++ program by its main function: one node of ROS 1, or each node of ROS 2 it makes.

    ``words`` are those of its command line, where they are known; ``chosen`` and ``plugin_names`` tell which plug-ins
    are loaded, see :class:`Given`.
    """
    program = index.programs[path]
    main = next((one for one in program.functions if one.qualified_name == "main"), None)
    if main is None:
        return []
    generation = generation_of(index, path)
    building = building_of("main", path, main.line, generation, "node")
    ctx = Interpreter(NotedTable(index, path), building, Given(chosen, plugin_names))

    def run() -> None:
        ctx.state.frame = Frame(path, "")
        held = None if words is None else words_given(words)
        given: list[Value] = [Unknown("argc"), Unknown("argv")]
        if held is not None:
            given = [held.length, held]
        ctx.call(Invocation(Callable(main, path), given))
        _run_callbacks(ctx)
        if len(ctx.emitter.made) > 1:
            # Which node of several is which only this evaluation knows.
            _run_made(ctx)
        _run_plugged(ctx)

    known_of = (*given_names(chosen, plugin_names), *given_words(words))
    found = finished(ctx, run, reached, ("main", path, generation, *known_of))
    return [one for one in found if one.endpoints or one.parameters or one.name.parts]


def facts_of_module(
    index: SymbolTable,
    path: str,
    function: str = "",
    reached: Reached | None = None,
    words: Sequence[Text] | None = None,
) -> list[NodeFacts]:
    """Return the facts of a Python module: of a function of it, else of what it does when it is started.

    ``words`` are those of its command line, where they are known.
    """
    program = index.programs[path]
    generation = generation_of(index, path)
    building = building_of(function or "<module>", path, 1, generation, "node")
    ctx = Interpreter(NotedTable(index, path), building, Given(words=None if words is None else words_given(words)))

    def run() -> None:
        ctx.state.frame = Frame(path, "")
        ctx.state.frame.names["__name__"] = Text.of("__main__")
        chosen: list[Function] = [one for one in program.functions if one.qualified_name == function]
        if function and chosen:
            ctx.call(Invocation(Callable(chosen[0], path)))
        elif not function:
            changing = {name for name in changes_of(program) if not name.startswith("#")}
            for statement in program.body:
                match statement:
                    case Assign(Name(name=name), Listed() | Table() as first, operator="=") if name in changing:
                        # Statements that follow change it: it begins as it is at first, for functions too.
                        ctx.state.constants[path, name] = ctx.value(first)
                    case Branch() if _is_main(statement):
                        ctx.block(statement.then)
                    case Evaluate():
                        ctx.value(statement.expression)
                    case Branch() | Loop() | Assign(value=Call()):
                        ctx.block((statement,))
        _run_lifecycle(ctx)
        _run_callbacks(ctx)

    found = finished(ctx, run, reached, ("module", path, function, generation, *given_words(words)))
    return [one for one in found if one.endpoints or one.parameters or one.name.parts]


def _run_lifecycle(ctx: Interpreter) -> None:
    """Run the transitions of managed nodes until they are active, which their own program does not request."""
    for one in [made for made in ctx.emitter.made if made.node is not None and made.node.kind == "lifecycle"]:
        outer, ctx.emitter.node = ctx.emitter.node, one.node or ctx.emitter.node
        try:
            for name in _FIRST[:3]:
                method = ctx.named.method(one, name)
                if method is not None:
                    ctx.call(Invocation(method))
        finally:
            ctx.emitter.node = outer


def _is_main(branch: Branch) -> bool:
    match branch.condition:
        case Operation(operands=operands):
            return Literal("__main__") in operands
    return False


def run_methods(ctx: Interpreter, thing: Obj, *, again: bool = False) -> None:
    """Run what a node does after it is made: its life cycle first, then what was never called.

    What another object of its class did is done ``again``.
    """
    for name in _FIRST:
        method = ctx.named.method(thing, name)
        if method is not None and (again or (method.path, method.function.line) not in ctx.callbacks.reached):
            ctx.call(Invocation(method))
    _forget(ctx, thing)
    ctx.run_later()
    if thing.defined is None:
        return
    home = ctx.index.package(thing.defined.path)
    # What a base in another package could do is not what this node does.
    for one in [one for one in ctx.index.chain(thing.defined) if ctx.index.package(one.path) == home]:
        for found in ctx.index.methods_of(one):
            if not _made_by(found.what, one):
                called = Written(f"{found.what.name}() is called")
                ctx.callbacks.waiting.append((Callable(found.what, found.path, thing), called))
    ctx.run_later()


def _run_made(ctx: Interpreter, first: Obj | None = None) -> None:
    """Run what further nodes do that were made on the way: each class of them once."""
    seen: set[int] = {id(first)}
    while fresh := [one for one in ctx.emitter.made if id(one) not in seen and one.node is not None]:
        for one in fresh:
            seen.add(id(one))
            outer, ctx.emitter.node = ctx.emitter.node, one.node or ctx.emitter.node
            try:
                run_methods(ctx, one, again=True)
            finally:
                ctx.emitter.node = outer


def _run_plugged(ctx: Interpreter) -> None:
    """Run plug-ins that no evaluated code called; they may load others."""
    done = 0
    while done < len(ctx.emitter.plugged):
        thing, node = ctx.emitter.plugged[done]
        outer, ctx.emitter.node = ctx.emitter.node, node
        try:
            run_methods(ctx, thing)
        finally:
            ctx.emitter.node = outer
        done += 1


def _run_callbacks(ctx: Interpreter) -> None:
    """Run the callbacks of a program: by then, members of their objects may have changed."""
    for callback, _ in ctx.callbacks.waiting:
        match callback.self:
            case Obj() as thing:
                _forget(ctx, thing)
    ctx.run_later()


def _forget(ctx: Interpreter, thing: Obj) -> None:
    """Forget truth values that may have changed when a callback runs: those of members that methods set."""
    waiting, seen = [thing], set[int]()
    while waiting and len(seen) < 200:
        one = waiting.pop()
        if id(one) in seen or one.defined is None:
            continue
        seen.add(id(one))
        # Small programs of C++ leave out functions that only compute: they may set any member.
        any_member = ctx.index.programs[one.defined.path].dialect.sliced
        changed = ctx.index.changed(one.defined)
        for name, value in one.fields.items():
            match value:
                case bool() if any_member or name in changed:
                    one.fields[name] = Unknown(name)
                case Obj():
                    waiting.append(value)


def _made_by(function: Function, defined: Defined) -> bool:
    """Whether a function is a constructor or destructor, or makes no sense without its template arguments."""
    name, of_class = defined.what.name, len(defined.what.templates)
    return function.name in (name, f"~{name}", "__init__", "lambda") or len(function.templates) > of_class


__all__ = [
    "Named",
    "Reached",
    "facts_of_class",
    "facts_of_function",
    "facts_of_main",
    "facts_of_module",
    "facts_of_plugin",
    "node_classes",
    "registered",
]
