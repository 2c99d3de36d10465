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
from roslens.source.extract.domain.call_stack import CallStack
from roslens.source.extract.domain.changed_in_ways import Changes
from roslens.source.extract.domain.evaluation_frame import Frame, join
from roslens.source.extract.domain.kinds import all_of_kind
from roslens.source.extract.domain.word_list import Words
from roslens.source.extract.facts.chosen import Chosen
from roslens.source.extract.facts.node_facts import Evidence, led_to
from roslens.source.extract.interpreter.bound_parameters import bind
from roslens.source.extract.interpreter.evaluated_again import HEAVY, Again, Done
from roslens.source.extract.interpreter.evaluated_objects import Objects
from roslens.source.extract.interpreter.evaluated_statements import assign, block, initialise
from roslens.source.extract.ir.dialect import Dialect
from roslens.source.extract.ir.makes_endpoints import MAKE
from roslens.source.extract.ir.program import Call, Expression, Function, Parameter, Statement
from roslens.source.extract.symbolic.text import Condition, Text, said, unknown
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.symbols.workspace_index import Index
from roslens.source.extract.transfer.budget import Budget, SpentError
from roslens.source.extract.transfer.captured import Around, names_now, set_around
from roslens.source.extract.transfer.decorated import decorated
from roslens.source.extract.transfer.named_functions import NamedFunctions
from roslens.source.extract.transfer.refined_values import lose, lose_unseen
from roslens.source.extract.transfer.shared_values import changed_by_call, newest

_STOPPED = object()
_NONE = Text()
_SHARING = ("&", "*")


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
        stack: of calls.
        named: functions of the workspace by name.
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
        self.stack = CallStack()
        self.named = NamedFunctions(self)
        self.constants: dict[tuple[str, str], Value] = {}
        self.site = Evidence(node.path, node.line)
        self.written: tuple[Expression, ...] = ()

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

    def frame_of(self, path: str, scope: str, thing: Value = None, names: Names | None = None) -> Frame:
        """Return the frame of a call that begins."""
        return Frame(path, scope, thing, names)

    def as_returned(self, value: Value) -> Value:
        """Return a value as it is where a function returns it."""
        return value

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
        stack = self.stack.keys
        if key in stack or len(stack) >= self.budget.depth:
            if key in stack:
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
        done = self._again.known(key, function.self, (arguments, templates), stack) if plain else None
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
        frame = self.frame_of(function.path, what.qualified_name, thing, names)
        if isinstance(thing, Obj):
            frame.templates.update(thing.templates_of(what.class_name))
        if templates and what.templates:
            frame.templates.update(zip(what.templates[self._of_class_templates(function) :], templates, strict=False))
        frame.depth = len(self.conditions)
        site = self.site
        bind(self, what, arguments, keywords, frame)
        around, again.cuts = again.cuts, set()
        steps, touched = self.budget.steps, again.touched
        before = dict(thing.fields) if isinstance(thing, Obj) else {}
        self.stack.enter(key, site, what, written)
        self.frame = frame
        try:
            for statement in what.initialisers:
                initialise(self, statement)
            if what.sets:
                lose(thing, what, frame.names)
            block(self, what.body)
        finally:
            self.frame = outer
            self.stack.leave()
        if what.name == "lambda":
            set_around(self, function, frame)
        if frame.left and isinstance(thing, Obj):
            for fields, condition in frame.left:
                join(thing.fields, fields, condition)
        again.cuts.discard(key)
        if self.budget.steps - steps > HEAVY and again.touched == touched and not keywords and not function.names:
            given = (arguments, templates)
            again.keep(key, Done(what, thing, given, len(self.stack.keys), frame, before, again.cuts, self.site))
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

    def written_at(self, line: int) -> None:
        """Note the line at which something is made next that no call makes."""
        if line:
            self.site = Evidence(self.frame.path, line)

    def callable_type(self, function: Callable, place: int) -> str:
        """Return the declared type of a parameter of a callback; empty where it has none."""
        index = place + len([one for one in function.arguments if not isinstance(one, Unknown)])
        parameters = function.function.parameters
        return parameters[index].type if index < len(parameters) else ""

    def called_outer(self, callback: Value, note: Condition | None = None) -> str:
        """Remember that a callback was given away; return its name."""
        if isinstance(callback, Callable):
            # What was followed already is not followed later.
            if (callback.path, callback.function.line) not in self.reached:
                self.touched()
                self.later.append((callback, note))
            return callback.function.qualified_name
        return str(callback) if isinstance(callback, Text) else ""


__all__ = ["Class", "Evaluation", "Handle", "Named", "QosValue", "SpentError", "unknown"]
