"""Evaluates the programs of a workspace far enough to see which nodes, endpoints and parameters they make.

Statements are followed in order, calls into functions of the workspace with the values that are given, objects with
their members. What is not in the workspace is known by the vocabulary of ROS, or it is unknown. Both ways of an unknown
condition are followed; what is made there keeps it. Everything is bounded.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from roslens.source.extract.domain.abstract_value import (
    Building,
    Callable,
    Class,
    Handle,
    Named,
    Names,
    Obj,
    QosValue,
    Unknown,
    Value,
)
from roslens.source.extract.domain.changed_in_ways import Changes
from roslens.source.extract.domain.evaluation_frame import Frame, bind_rest, join
from roslens.source.extract.domain.kinds import all_of_kind
from roslens.source.extract.domain.outside_options import options_from_outside
from roslens.source.extract.domain.word_list import Words
from roslens.source.extract.facts.chosen import Chosen
from roslens.source.extract.facts.node_facts import Evidence, led_to
from roslens.source.extract.interpreter.evaluated_again import HEAVY, Again, Done
from roslens.source.extract.interpreter.evaluated_objects import Objects
from roslens.source.extract.interpreter.evaluated_statements import assign, block, initialise
from roslens.source.extract.ir.controller_handles import is_of_controller
from roslens.source.extract.ir.dialect import Dialect
from roslens.source.extract.ir.makes_endpoints import MAKE, makes_endpoints
from roslens.source.extract.ir.program import Call, Expression, Function, Parameter, Statement
from roslens.source.extract.symbolic.reason import OfController
from roslens.source.extract.symbolic.text import Condition, Text, said, unknown
from roslens.source.extract.symbols.lookups import Found
from roslens.source.extract.symbols.node_bases import NODE_BASES
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.symbols.workspace_index import Defined, Index, type_name
from roslens.source.extract.transfer.budget import MOST_DEPTH, Budget, SpentError
from roslens.source.extract.transfer.captured import Around, names_now, set_around
from roslens.source.extract.transfer.decorated import decorated
from roslens.source.extract.transfer.overload_choice import overload, taking
from roslens.source.extract.transfer.refined_values import lose, lose_unseen
from roslens.source.extract.transfer.shared_values import changed_by_call, newest

_STOPPED = object()
_NONE = Text()
_TYPED = (list, int)
_SHARING = ("&", "*")
_SHARED = (list, dict)
_FEW = 3

KNOWN_BETTER = frozenset({"declare_or_get_parameter"})
"""Methods of nodes whose meaning the vocabulary knows, wherever they are defined."""


class Evaluation(Objects):
    """One evaluation of a unit: a main function, a class that becomes a node, a module.

    Attributes:
        index: of the workspace.
        node: that is built.
        others: further nodes that were made on the way.
        made: objects of classes of the workspace that are nodes, in the order in which they were made.
        first: the node that is built first, whichever is evaluated.
        chosen: what is set that decides which plug-ins are loaded; None where that is not known yet.
        plugin_names: the class of each plug-in that has another name.
        plugged: objects of plug-ins and the nodes they are loaded into.
        preparing: classes whose objects are given their members, the outermost first.
        conditions: around what is evaluated, outermost first.
        changes: what is changed in objects while ways of open conditions are followed.
        asked: what decides conditions, by their place, with the condition that stood there.
        frame: of the function that is evaluated.
        once: values of variables that functions keep between calls, by their place.
        gave: where the value stands to which the last call returned a reference, in its frame.
        bare: functions without their decorators, by the identity of those with them, which they keep alive.
        words: of the command line, where they are known.
        budget: of steps.
        running: whether the node runs already: what is evaluated is called back, or comes when it has spun.
    """

    def __init__(
        self,
        index: Index,
        node: Building,
        chosen: Chosen | None = None,
        plugin_names: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        super().__init__()
        self.index = index
        self.node = self.first = node
        self.chosen = chosen
        self.plugin_names = plugin_names
        self.plugged: list[tuple[Obj, Building]] = []
        self.others: list[Building] = []
        self.conditions: list[Condition] = []
        self.changes = Changes()
        self.refined = self.changes.refined
        self.asked: dict[int, tuple[Condition, Condition | None]] = {}
        self.frame = Frame(node.path, "")
        self.words: Words | None = None
        self.running = False
        self.made: list[Obj] = []
        self.later: list[tuple[Callable, Condition | None]] = []
        self.reached = Reached()
        self.globals: Names = {}
        self.once: dict[tuple[object, ...], Value] = {}
        self.gave: tuple[Frame, Expression] | None = None
        self.bare: dict[int, tuple[Function, Function]] = {}
        self.budget = Budget()
        self._again = Again()
        self.preparing: list[str] = []
        self._stack: list[tuple[str, int]] = []
        self.constants: dict[tuple[str, str], Value] = {}
        self.site = Evidence(node.path, node.line)
        self.written: tuple[Expression, ...] = ()
        self.calls: list[tuple[Evidence, Function, tuple[Expression, ...]]] = []

    # What others ask of it

    @property
    def dialect(self) -> Dialect:
        """The rules of the language of the function that is evaluated."""
        return self.index.programs[self.frame.path].dialect

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

    def forget_calls(self) -> None:
        """Note that what all functions see is changed: none does again what it did."""
        self._again.touched += 1
        self._again.forget()

    @property
    def touches(self) -> int:
        """How often a word of the vocabulary was said, or a callback given away."""
        return self._again.touched

    def run_later(self) -> None:
        """Run the callbacks that were given away, once each, with arguments that are unknown."""
        while self.later:
            callback, note = self.later.pop(0)
            key = (callback.path, callback.function.line)
            if key not in self.reached:
                with_note = [] if note is None else [note]
                self.conditions += with_note
                before, self.running = self.running, True
                self.call(callback, [], {})
                self.running = before
                del self.conditions[len(self.conditions) - len(with_note) :]

    def assign(self, target: Expression, value: Value) -> None:
        """Put a value where an expression says."""
        assign(self, target, value)

    def under(self, condition: Condition, test: Condition | None = None) -> None:
        """Let a condition hold for what follows, until it is taken away again."""
        self.asked[len(self.conditions)] = (condition, test)
        self.conditions.append(condition)

    def asked_now(self) -> tuple[tuple[Condition, Condition], ...]:
        """Return those of the conditions that parameters decide."""
        found = (self.asked.get(place, (None, None)) for place in range(len(self.conditions)))
        pairs = zip(self.conditions, found, strict=True)
        return tuple(dict.fromkeys((one, test) for one, (known, test) in pairs if one == known and test is not None))

    def block(self, body: tuple[Statement, ...]) -> None:
        """Follow statements in order."""
        block(self, body)

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
        arguments: list[Value],
        keywords: Names,
        written: tuple[Expression, ...] = (),
        templates: tuple[str, ...] = (),
    ) -> Value:
        """Call a function of the workspace; ``written`` are the arguments as expressions, for references."""
        if function.function.name not in MAKE:
            return self._call(function, arguments, keywords, written, templates)
        site, before = self.site, {id(one): len(one.endpoints) for one in self._nodes()}
        result = self._call(function, arguments, keywords, written, templates)
        makes = False
        for one in self._nodes():
            for place in range(before.get(id(one), 0), len(one.endpoints)):
                one.endpoints[place] = led_to(one.endpoints[place], site)
                makes = True
        self.reached.pass_on((site.path, site.line), makes=makes)
        return result

    def _call(
        self,
        function: Callable,
        arguments: list[Value],
        keywords: Names,
        written: tuple[Expression, ...],
        templates: tuple[str, ...],
    ) -> Value:
        what = function.function
        key = (function.path, what.line)
        if key in self._stack or len(self._stack) >= MOST_DEPTH:
            if key in self._stack:
                self._again.cuts.add(key)
            return Unknown(f"result of {what.name}()")
        self.reached.add(key)
        if not what.body and not what.initialisers and self.index.programs[function.path].dialect.declared_apart:
            lose_unseen(self, function, written)
            return self._computed_by(what, [*function.arguments, *arguments])
        if what.decorators and (made := decorated(self, function)) is not function:
            return self.call(made, arguments, keywords, written) if isinstance(made, Callable) else made
        arguments = [*function.arguments, *arguments]
        plain = not keywords and not function.names
        done = self._again.known(key, function.self, (arguments, templates), self._stack) if plain else None
        if done is None:
            frame = self._followed(function, arguments, keywords, written, templates)
            result, names = frame.outcome(), frame.names
        else:
            result, names, self.site, self.gave = done.result, done.names, done.site, None
            if isinstance(function.self, Obj):
                if self.changes.open:
                    for name, value in done.fields.items():
                        self.changes.put(function.self.fields, name, value)
                function.self.fields.update(done.fields)
        for parameter, expression in zip(what.parameters, written, strict=False):
            if parameter.type.endswith(_SHARING) and "const" not in parameter.type.split() and parameter.name:
                self._given_back(parameter, expression, newest(self, names.get(parameter.name)))
        if self.refined:
            changed_by_call(self)
        return result

    def _nodes(self) -> tuple[Building, ...]:
        return (self.first, *self.others)

    def _given_back(self, parameter: Parameter, written: Expression, value: Value) -> None:
        # A pointer to anything else is the same object, or may point elsewhere by now.
        if parameter.type[-1] == "&" or isinstance(value, QosValue):
            self.assign(written, value)

    def _followed(
        self,
        function: Callable,
        arguments: list[Value],
        keywords: Names,
        written: tuple[Expression, ...],
        templates: tuple[str, ...],
    ) -> Frame:
        """Evaluate the body of a function; return its names and what it returned."""
        what, again, thing, outer = function.function, self._again, function.self, self.frame
        key = (function.path, what.line)
        names = function.names
        names = names_now(self, names) if type(names) is Around else dict(names or {})
        frame = Frame(function.path, what.qualified_name, thing, names)
        if isinstance(thing, Obj):
            frame.templates.update(thing.templates_of(what.class_name))
        if templates and what.templates:
            frame.templates.update(zip(what.templates[self._of_class_templates(function) :], templates, strict=False))
        frame.depth = len(self.conditions)
        site = self.site
        self._bind(what, arguments, keywords, frame)
        around, again.cuts = again.cuts, set()
        steps, touched = self.budget.steps, again.touched
        before = dict(thing.fields) if isinstance(thing, Obj) else {}
        self._stack.append(key)
        self.calls.append((site, what, written))
        self.frame = frame
        try:
            for statement in what.initialisers:
                initialise(self, statement)
            if what.sets:
                lose(thing, what, frame.names)
            block(self, what.body)
        finally:
            self.frame = outer
            self._stack.pop()
            self.calls.pop()
        if what.name == "lambda":
            set_around(self, function, frame)
        if frame.left and isinstance(thing, Obj):
            for fields, condition in frame.left:
                join(thing.fields, fields, condition)
        again.cuts.discard(key)
        if self.budget.steps - steps > HEAVY and again.touched == touched and not keywords and not function.names:
            given = (arguments, templates)
            again.keep(key, Done(what, thing, given, len(self._stack), frame, before, again.cuts, self.site))
        around |= again.cuts
        again.cuts = around
        return frame

    def _computed_by(self, what: Function, arguments: list[Value]) -> Value:
        """Return the result of a function that only computes; what decides its arguments decides it."""
        texts = all_of_kind(arguments, Text)
        if not texts:
            return Unknown(f"result of {what.name}()")
        parameter = next((hole.parameter for one in texts for hole in one.holes if hole.parameter), "")
        joined = [piece for one in texts for piece in (", ", one)]
        return unknown(said(f"result of {what.name}() of ", *joined[1:]), parameter=parameter)

    def _of_class_templates(self, function: Callable) -> int:
        """Return how many of a function's template parameters are those of its class."""
        if not function.function.class_name:
            return 0
        found = self.index.class_of(function.function.class_name, function.path, "")
        return len(getattr(found.what, "templates", ())) if found is not None else 0

    def method(self, thing: Obj, name: str) -> Callable | None:
        """Return a method of an object by name, of its class or the nearest base that has it."""
        defined = thing.defined
        if defined is None:
            return None
        known, key = self.index.lookups.method, (id(defined.what), name)
        found = known[key] if key in known else known.setdefault(key, self.method_of(defined, name))
        return None if found is None else Callable(found[0], found[1], thing)

    def method_of(self, defined: Defined, name: str) -> Found:
        """Return the method that a class or its nearest base has by a name, one with a body where there is any."""
        for one in self.index.chain(defined):
            found = self.index.methods(one, name)
            if found and isinstance(found[0].what, Function):
                functions = [(f.what, f.path) for f in found if isinstance(f.what, Function)]
                return next((one for one in functions if one[0].body), functions[0])
        return None

    def methods(self, thing: Obj, name: str, count: int, arguments: Sequence[Value] = ()) -> Callable | None:
        """Return the method of an object that takes so many arguments; of several the one that fits what is known."""
        defined = thing.defined
        if defined is None or (thing.node is not None and name in KNOWN_BETTER):
            return None
        known, key = self.index.lookups.overloads, (id(defined.what), name, count)
        found = known[key] if key in known else known.setdefault(key, self._overload_of(defined, name, count))
        if arguments and found is not None and key not in self.index.lookups.alone:
            found = self._overload_of(defined, name, count, arguments)
        return None if found is None else Callable(found[0], found[1], thing)

    def _overload_of(self, defined: Defined, name: str, count: int, arguments: Sequence[Value] = ()) -> Found:
        """Return the method of the first class of a chain that has one of a name; of C++ one that takes so many."""
        hidden: Found = None
        for one in self.index.chain(defined):
            found = self.index.methods(one, name)
            chosen = overload(self.index, found, count, arguments, self._stack[-1] if self._stack else ("", 0))
            if chosen is None or not isinstance(chosen.what, Function):
                continue
            if taking(self.index, [chosen], count) or not self.index.programs[chosen.path].dialect.overloads:
                if len(found) < 2:
                    self.index.lookups.alone.add((id(defined.what), name, count))
                return chosen.what, chosen.path
            # A class that has ``using Base::name`` has those of its base too.
            hidden = hidden or (chosen.what, chosen.path)
        return hidden

    def function(self, name: str, count: int, arguments: Sequence[Value] = ()) -> Callable | None:
        """Return the function outside of classes that a name means and that takes so many arguments."""
        frame, known = self.frame, self.index.lookups.functions
        key = (name, frame.path, frame.scope, count)
        if key in known:
            found = known[key]
        else:
            several = self.index.functions_of(name, frame.path, frame.scope)
            found = self._function(several, name, count, arguments)
            if len(several) < 2:
                known[key] = found
        return None if found is None else Callable(found[0], found[1])

    def _function(self, several: list[Defined], name: str, count: int, arguments: Sequence[Value]) -> Found:
        running = self._stack[-1] if self._stack else ("", 0)
        chosen = overload(self.index, several, count, arguments, running, (self.frame.path, self.first.path))
        if chosen is None:
            self._unknown_which(name, several)
        if chosen is None or not isinstance(chosen.what, Function) or chosen.what.class_name:
            return None
        return chosen.what, chosen.path

    def _unknown_which(self, name: str, several: list[Defined]) -> None:
        """Note a call of a function that makes endpoints, where the program of none of that name is this one."""
        makes = [one for one in several if isinstance(one.what, Function) and makes_endpoints(one.what)]
        if not makes:
            return
        places = ", ".join(f"{one.path}:{one.what.line}" for one in makes[:_FEW]) + (" …" if len(makes) > _FEW else "")
        reason = f"{name}() is called, but none that is known to be linked here: there is {places}"
        if (self.site, reason) not in self.node.unresolved:
            self.node.unresolved.append((self.site, reason))

    def written_at(self, line: int) -> None:
        """Note the line at which something is made next that no call makes."""
        if line:
            self.site = Evidence(self.frame.path, line)

    def callable_type(self, function: Callable, place: int) -> str:
        """Return the declared type of a parameter of a callback; empty where it has none."""
        index = place + len([one for one in function.arguments if not isinstance(one, Unknown)])
        parameters = function.function.parameters
        return parameters[index].type if index < len(parameters) else ""

    # Statements

    def _bind(self, what: Function, arguments: list[Value], keywords: Names, frame: Frame) -> None:
        declared, given, names = None, len(arguments), frame.names
        if given < len(what.parameters):
            declared = self.index.declaration(what, frame.path)
        for place, parameter in enumerate(what.parameters):
            if parameter.name[:1] == "*":
                given = min(given, place)
                bind_rest(what, place, arguments, keywords, frame)
            elif place < given:
                value = arguments[place]
                names[parameter.name] = self.typed(parameter.type, value) if isinstance(value, _TYPED) else value
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
                known = None if "**" in keywords else default
                value = self.not_given(what, parameter) if known is None else self.value(known)
                self.frame = outer
                if isinstance(value, _SHARED):
                    # A default of Python is one object: what a call puts into it the next one finds there.
                    value = self.once.setdefault((frame.path, what.line, place, id(what)), value)
                frame.names[parameter.name] = value

    def not_given(self, what: Function, parameter: Parameter) -> Value:
        """Return what stands for an argument that nobody gives; what must be a node is the one that is built."""
        reason = f"parameter {parameter.name} of {what.name}()"
        name = type_name(parameter.type)[0]
        if name in _TEXTS:
            return unknown(reason)
        if name.endswith("NodeOptions"):
            return options_from_outside()
        if is_of_controller(what, parameter):
            return Handle(self.node, unknown(OfController()))
        return Handle(self.node) if name and self.is_node(name) else Unknown(reason)

    def is_node(self, name: str) -> bool:
        """Whether a class by its name as written is a node."""
        name = self.frame.templates.get(name, name)
        defined = self.index.class_of(name, self.frame.path, self.frame.scope)
        if defined is None:
            return self.index.meaning(name, self.frame.path, self.frame.scope) in NODE_BASES
        return any(base in NODE_BASES for base in self.index.outer_bases(defined))

    # Values by type

    def called_outer(self, callback: Value, note: Condition | None = None) -> str:
        """Remember that a callback was given away; return its name."""
        if isinstance(callback, Callable):
            # What was followed already is not followed later.
            if (callback.path, callback.function.line) not in self.reached:
                self.touched()
                self.later.append((callback, note))
            return callback.function.qualified_name
        return str(callback) if isinstance(callback, Text) else ""


_TEXTS = ("std.string", "string", "std.string_view", "char")


__all__ = ["Class", "Evaluation", "Handle", "Named", "QosValue", "SpentError", "unknown"]
