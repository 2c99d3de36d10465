"""Evaluates the programs of a workspace far enough to see which nodes, endpoints and parameters they make.

Statements are followed in order, calls into functions of the workspace with the values that are given, objects with
their members. What is not in the workspace is known by the vocabulary of ROS, or it is unknown. Both ways of an unknown
condition are followed; what is made there keeps it. Everything is bounded.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from roslens.source.extract.abstract_value import (
    Building,
    Callable,
    Class,
    Handle,
    Named,
    Obj,
    QosValue,
    Unknown,
    as_text,
)
from roslens.source.extract.base_templates import bind_bases
from roslens.source.extract.command_words import Words
from roslens.source.extract.evaluated_again import HEAVY, Again, Done
from roslens.source.extract.evaluated_calls import Calls
from roslens.source.extract.evaluated_statements import assign, block, initialise
from roslens.source.extract.evaluation_frame import Frame
from roslens.source.extract.node_bases import NODE_BASES
from roslens.source.extract.node_facts import Evidence
from roslens.source.extract.program import Assign, Call, Expression, Function, Member, Parameter
from roslens.source.extract.text import Text, unknown
from roslens.source.extract.vocabulary import find_outer
from roslens.source.extract.vocabulary_options import options_from_outside
from roslens.source.extract.workspace_index import Defined, Index, type_arguments, type_name

MOST_STEPS = 60_000
MOST_DEPTH = 14
MOST_TURNS = 64
_STOPPED = object()
_NONE = Text()

KNOWN_BETTER = frozenset({"declare_or_get_parameter"})
"""Methods of nodes whose meaning the vocabulary knows, wherever they are defined."""


class SpentError(Exception):
    """The bounds of evaluation are spent."""


class Evaluation(Calls):
    """One evaluation of a unit: a main function, a class that becomes a node, a module.

    Attributes:
        index: of the workspace.
        node: that is built.
        others: further nodes that were made on the way.
        made: objects of classes of the workspace that are nodes, in the order in which they were made.
        conditions: around what is evaluated, outermost first.
        frame: of the function that is evaluated.
        words: of the command line, where they are known.
    """

    def __init__(self, index: Index, node: Building) -> None:
        super().__init__()
        self.index = index
        self.node = node
        self.others: list[Building] = []
        self.conditions: list[str] = []
        self.frame = Frame(node.path, "")
        self.words: Words | None = None
        self.made: list[Obj] = []
        self.later: list[tuple[Callable, str]] = []
        self.reached: set[tuple[str, int]] = set()
        self.globals: dict[str, Any] = {}
        self._steps = 0
        self._again = Again()
        self._stack: list[tuple[str, int]] = []
        self.constants: dict[tuple[str, str], Any] = {}
        self.site = Evidence(node.path, node.line)
        self.written: tuple[Expression, ...] = ()
        self.calls: list[tuple[Evidence, Function, tuple[Expression, ...]]] = []

    # What others ask of it

    def place(self, line: int, column: int = 0, how: str = "written") -> Evidence:
        """Return evidence of a place in the file that is evaluated."""
        return Evidence(self.frame.path, line, column, how)

    def at(self, call: Call) -> None:
        """Note which call is made next."""
        self.site = Evidence(self.frame.path, call.line, call.column)
        self.written = call.arguments

    def touched(self) -> None:
        """Note that a word of the vocabulary is said, or a callback given away."""
        self._again.touched += 1

    def step(self) -> None:
        """Count a step.

        Raises:
            SpentError: there were too many.
        """
        self._steps += 1
        if self._steps > MOST_STEPS:
            raise SpentError

    def run_later(self) -> None:
        """Run the callbacks that were given away, once each, with arguments that are unknown."""
        while self.later:
            callback, note = self.later.pop(0)
            key = (callback.path, callback.function.line)
            if key not in self.reached:
                with_note = [note] if note else []
                self.conditions += with_note
                self.call(callback, [], {})
                del self.conditions[len(self.conditions) - len(with_note) :]

    def constructed(self, declared: str, value: Any) -> Any:
        """Return a member that is initialised with one value: an object of its class made of it, or the value."""
        name, inside = type_name(declared)
        if "*" in declared or "&" in declared or "ptr" in declared.lower() or name in _PLAIN:
            return self.converted(declared, value)
        defined = self.index.class_of(name, self.frame.path, self.frame.scope)
        same = isinstance(value, Obj) and value.defined is not None and value.defined == defined
        outer = find_outer(self, self.index.meaning(name, self.frame.path, self.frame.scope))
        if same or (isinstance(value, Unknown) and outer is None) or (defined is None and outer is None):
            return self.converted(declared, value)
        return self.of_type(name, [value], {}, tuple(type_arguments(inside)))

    def assign(self, target: Expression, value: Any) -> None:
        """Put a value where an expression says."""
        assign(self, target, value)

    def further(self, evidence: Evidence, name: Text = _NONE, arguments: Sequence[Text] = ()) -> Building:
        """Return a further node of ROS 2 that is made."""
        node = Building(self.node.unit, evidence.path or self.node.path, evidence.line, "ros2", name=name)
        node.arguments, node.conditions = list(arguments), tuple(dict.fromkeys(self.conditions))
        self.others.append(node)
        node.number, node.named = len(self.others), True
        return node

    # Calls into the workspace

    def call(
        self,
        function: Callable,
        arguments: list[Any],
        keywords: dict[str, Any],
        written: tuple[Expression, ...] = (),
        templates: tuple[str, ...] = (),
    ) -> Any:
        """Call a function of the workspace; ``written`` are the arguments as expressions, for references."""
        what = function.function
        key = (function.path, what.line)
        if key in self._stack or len(self._stack) >= MOST_DEPTH:
            if key in self._stack:
                self._again.cuts.add(key)
            return Unknown(f"result of {what.name}()")
        self.reached.add(key)
        if not what.body and not what.initialisers and self.index.programs[function.path].language == "cpp":
            return self._computed_by(what, [*function.arguments, *arguments])
        arguments = [*function.arguments, *arguments]
        plain = not keywords and not function.names
        done = self._again.known(key, function.self, (arguments, templates), self._stack) if plain else None
        if done is None:
            frame = self._followed(function, arguments, keywords, written, templates)
            result, names = frame.result if frame.returned else None, frame.names
        else:
            result, names, self.site = done.result, done.names, done.site
            if isinstance(function.self, Obj):
                function.self.fields.update(done.fields)
        for parameter, expression in zip(what.parameters, written, strict=False):
            if parameter.type.endswith("&") and "const" not in parameter.type.split() and parameter.name:
                self.assign(expression, names.get(parameter.name))
        return result

    def _followed(
        self,
        function: Callable,
        arguments: list[Any],
        keywords: dict[str, Any],
        written: tuple[Expression, ...],
        templates: tuple[str, ...],
    ) -> Frame:
        """Evaluate the body of a function; return its names and what it returned."""
        what, again, thing, outer = function.function, self._again, function.self, self.frame
        key = (function.path, what.line)
        frame = Frame(function.path, what.qualified_name, thing, dict(function.names or {}))
        if isinstance(thing, Obj):
            frame.templates.update(thing.templates_of(what.class_name))
        frame.templates.update(zip(what.templates[self._of_class_templates(function) :], templates, strict=False))
        frame.depth = len(self.conditions)
        site = self.site
        self._bind(what, arguments, keywords, frame)
        around, again.cuts = again.cuts, set()
        steps, touched = self._steps, again.touched
        before = dict(thing.fields) if isinstance(thing, Obj) else {}
        self._stack.append(key)
        self.calls.append((site, what, written))
        self.frame = frame
        try:
            for statement in what.initialisers:
                initialise(self, statement)
            block(self, what.body)
        finally:
            self.frame = outer
            self._stack.pop()
            self.calls.pop()
        again.cuts.discard(key)
        if self._steps - steps > HEAVY and again.touched == touched and not keywords and not function.names:
            given = (arguments, templates)
            again.keep(key, Done(what, thing, given, len(self._stack), frame, before, again.cuts, self.site))
        around |= again.cuts
        again.cuts = around
        return frame

    def _computed_by(self, what: Function, arguments: list[Any]) -> Any:
        """Return the result of a function that only computes; what decides its arguments decides it."""
        texts = [one for one in arguments if isinstance(one, Text)]
        if not texts:
            return Unknown(f"result of {what.name}()")
        parameter = next((hole.parameter for one in texts for hole in one.holes if hole.parameter), "")
        return unknown(f"result of {what.name}() of {', '.join(map(str, texts))}", parameter=parameter)

    def _of_class_templates(self, function: Callable) -> int:
        """Return how many of a function's template parameters are those of its class."""
        if not function.function.class_name:
            return 0
        found = self.index.class_of(function.function.class_name, function.path, "")
        return len(getattr(found.what, "templates", ())) if found is not None else 0

    def construct(
        self, defined: Defined, arguments: list[Any], keywords: dict[str, Any], templates: tuple[str, ...] = ()
    ) -> Any:
        """Make an object of a class of the workspace, its constructor evaluated."""
        thing = Obj(defined.what.qualified_name, defined, {})
        names = getattr(defined.what, "templates", ())
        thing.templates.update(zip(names, templates, strict=False))
        site, written = self.site, self.written
        self.prepare(thing)
        self.site, self.written = site, written
        self.construct_as(thing, defined, arguments, keywords)
        if thing.node is not None:
            self.made.append(thing)
        return thing

    def prepare(self, thing: Obj) -> None:
        """Give an object the members that its classes declare."""
        bind_bases(self, thing)
        for one in reversed(self.index.chain(thing.defined)) if thing.defined is not None else ():
            initialised = self._initialised(one)
            for field in getattr(one.what, "fields", ()):
                if field.name in initialised:
                    thing.fields[field.name] = Unknown(field.name)
                    continue
                outer, self.frame = self.frame, Frame(one.path, one.what.qualified_name, thing)
                self.frame.templates.update(thing.templates_of(one.what.qualified_name))
                self.site = Evidence(one.path, field.line)
                try:
                    if field.value is not None:
                        thing.fields[field.name] = self.typed(field.type, self.value(field.value))
                    elif field.type and "*" not in field.type:
                        value = self.declared(field.type)
                        # Who sets it may not be followed: it is not sure to be empty.
                        not_set = unknown(f"{field.name}, which is not set")
                        thing.fields[field.name] = not_set if isinstance(value, Text) else value
                finally:
                    self.frame = outer

    def _initialised(self, defined: Defined) -> set[str]:
        """Return the members that constructors of a class of C++ initialise: they are not made twice."""
        return {
            statement.target.name
            for method in self.index.methods(defined, defined.what.name)
            for statement in getattr(method.what, "initialisers", ())
            if isinstance(statement, Assign) and isinstance(statement.target, Member)
        }

    def construct_as(self, thing: Obj, defined: Defined, arguments: list[Any], keywords: dict[str, Any]) -> None:
        """Evaluate the constructor of one class of an object."""
        python = self.index.programs[defined.path].language == "python"
        name = "__init__" if python else defined.what.name
        found = self.index.methods(defined, name)
        chosen = _overload(found, len(arguments) + len(keywords))
        if chosen is not None and isinstance(chosen.what, Function):
            self.call(Callable(chosen.what, chosen.path, thing), arguments, keywords, self.written)
            return
        for base in self.index.chain(defined)[1:2]:
            self.construct_as(thing, base, arguments, keywords)
        if not self.index.chain(defined)[1:]:
            self.base_constructed(thing, defined, arguments, keywords)

    def base_constructed(self, thing: Obj, defined: Defined, arguments: list[Any], keywords: dict[str, Any]) -> None:
        """Construct the bases that are not in the workspace."""
        for base in self.index.outer_bases(defined):
            self.construct_outer(thing, base, arguments, keywords)

    def method(self, thing: Obj, name: str) -> Callable | None:
        """Return a method of an object by name, of its class or the nearest base that has it."""
        if thing.defined is None:
            return None
        for one in self.index.chain(thing.defined):
            found = self.index.methods(one, name)
            if found and isinstance(found[0].what, Function):
                functions = [(f.what, f.path) for f in found if isinstance(f.what, Function)]
                what, path = next((one for one in functions if one[0].body), functions[0])
                return Callable(what, path, thing)
        return None

    def methods(self, thing: Obj, name: str, count: int) -> Callable | None:
        """Return the method of an object that takes so many arguments."""
        if thing.defined is None or (thing.node is not None and name in KNOWN_BETTER):
            return None
        for one in self.index.chain(thing.defined):
            found = self.index.methods(one, name)
            chosen = _overload(found, count)
            if chosen is not None and isinstance(chosen.what, Function):
                return Callable(chosen.what, chosen.path, thing)
        return None

    def function(self, name: str, count: int) -> Callable | None:
        """Return the function outside of classes that a name means and that takes so many arguments."""
        found = self.index.functions_of(name, self.frame.path, self.frame.scope)
        chosen = _overload(found, count)
        if chosen is None or not isinstance(chosen.what, Function) or chosen.what.class_name:
            return None
        return Callable(chosen.what, chosen.path)

    def written_at(self, line: int) -> None:
        """Note the line at which something is made next that no call makes."""
        if line:
            self.site = Evidence(self.frame.path, line)

    def declared(self, declared: str) -> Any:
        """Return the value of a declaration without one: an object of a class by value, else what is unknown."""
        name, inside = type_name(declared)
        if "*" in declared or "ptr" in declared.lower():
            return None
        return self.of_type(name, [], {}, tuple(type_arguments(inside)))

    def typed(self, declared: str, value: Any) -> Any:
        """Return a value as its declared type makes it: braces construct, numbers become texts of strings."""
        name, inside = type_name(declared)
        braced = isinstance(value, list) and not isinstance(value, Words)
        if braced and not declared.startswith(("std::vector", "std::array", "std::map", "std::set")):
            return self.of_type(name, value, {}, tuple(type_arguments(inside)))
        if name in ("rclcpp.QoS", "rmw_qos_profile_t") and isinstance(value, int):
            return self.of_type(name, [value], {})
        return value

    def callable_type(self, function: Callable, place: int) -> str:
        """Return the declared type of a parameter of a callback; empty where it has none."""
        index = place + len([one for one in function.arguments if not isinstance(one, Unknown)])
        parameters = function.function.parameters
        return parameters[index].type if index < len(parameters) else ""

    # Statements

    def _bind(self, what: Function, arguments: list[Any], keywords: dict[str, Any], frame: Frame) -> None:
        declared = self.index.declaration(what.qualified_name)
        for place, parameter in enumerate(what.parameters):
            if place < len(arguments):
                frame.names[parameter.name] = self.typed(parameter.type, arguments[place])
            elif parameter.name in keywords:
                frame.names[parameter.name] = keywords[parameter.name]
            else:
                default = parameter.default
                if not self._stack and parameter.type.rstrip("& ").endswith("NodeOptions"):
                    # Whoever loads a component gives it options, whatever holds where nobody does.
                    frame.names[parameter.name] = options_from_outside()
                    continue
                if default is None and declared is not None and place < len(declared.parameters):
                    default = declared.parameters[place].default
                outer, self.frame = self.frame, frame
                value = self.not_given(what, parameter) if default is None else self.value(default)
                self.frame = outer
                frame.names[parameter.name] = value

    def not_given(self, what: Function, parameter: Parameter) -> Any:
        """Return what stands for an argument that nobody gives; what must be a node is the one that is built."""
        reason = f"parameter {parameter.name} of {what.name}()"
        name = type_name(parameter.type)[0]
        if name in _TEXTS:
            return unknown(reason)
        if name.endswith("NodeOptions"):
            return options_from_outside()
        return Handle(self.node) if name and self.is_node(name) else Unknown(reason)

    def is_node(self, name: str) -> bool:
        """Whether a class by its name as written is a node."""
        name = self.frame.templates.get(name, name)
        defined = self.index.class_of(name, self.frame.path, self.frame.scope)
        if defined is None:
            return self.index.meaning(name, self.frame.path, self.frame.scope) in NODE_BASES
        return any(base in NODE_BASES for base in self.index.outer_bases(defined))

    def converted(self, declared: str, value: Any) -> Any:
        """Return a value as a declaration makes it."""
        name, _ = type_name(declared)
        if isinstance(value, int | float) and name in ("std.string", "string"):
            return value
        return self.typed(declared, value)

    # Values by type

    def of_type(
        self, name: str, arguments: list[Any], keywords: dict[str, Any], templates: tuple[str, ...] = ()
    ) -> Any:
        """Return an object of a class by its name as written."""
        if not name or name in _PLAIN:
            return self.plain(name, arguments)
        name = self.frame.templates.get(name, name)
        alias = "" if templates else self.index.alias(name, self.frame.path, self.frame.scope)
        if "<" in alias:
            name, inside = type_name(alias)
            templates = tuple(self.template(one) for one in type_arguments(inside))
        defined = self.index.class_of(name, self.frame.path, self.frame.scope)
        if defined is not None:
            return self.construct(defined, arguments, keywords, templates)
        return self.made_outer(
            self.index.meaning(name, self.frame.path, self.frame.scope), arguments, keywords, templates
        )

    def plain(self, name: str, arguments: list[Any]) -> Any:
        """Return a value of a fundamental type."""
        if name in ("std.string", "string", "QString", "std.string_view"):
            return as_text(arguments[0]) if arguments else Text()
        if not arguments:
            return Unknown("a value that is not set")
        return arguments[0]

    def called_outer(self, callback: Any, note: str = "") -> str:
        """Remember that a callback was given away; return its name."""
        if isinstance(callback, Callable):
            # What was followed already is not followed later.
            if (callback.path, callback.function.line) not in self.reached:
                self.touched()
                self.later.append((callback, note))
            return callback.function.qualified_name
        return str(callback) if isinstance(callback, Text) else ""


_TEXTS = ("std.string", "string", "std.string_view", "char")
_PLAIN = frozenset(
    {"std.string", "string", "QString", "std.string_view", "int", "double", "float", "bool", "size_t", "uint8_t",
     "uint16_t", "uint32_t", "uint64_t", "int8_t", "int16_t", "int32_t", "int64_t", "unsigned int", "unsigned", "long",
     "char", "auto", "void", "unsigned long", "std.size_t"}
)  # fmt: skip


def _overload(found: list[Defined], count: int) -> Defined | None:
    """Return the function that takes so many arguments, else the one with the most to say."""
    if len(found) < 2:
        return found[0] if found and isinstance(found[0].what, Function) else None
    functions = [one for one in found if isinstance(one.what, Function)]
    fit = [
        one
        for one in functions
        if isinstance(one.what, Function)
        and sum(parameter.default is None for parameter in one.what.parameters) <= count <= len(one.what.parameters)
    ]
    best = fit or functions
    return max(best, key=lambda one: len(one.what.body) if isinstance(one.what, Function) else 0, default=None)


__all__ = ["Class", "Evaluation", "Handle", "Named", "QosValue", "SpentError", "unknown"]
