"""Functions of the workspace while they are called: their arguments, their body, and what it leaves behind."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Callable, Names, Obj, QosValue, Unknown, Value
from roslens.source.extract.domain.frame import Frame, join
from roslens.source.extract.domain.kinds import all_of_kind
from roslens.source.extract.domain.summaries import HEAVY, Summary
from roslens.source.extract.facts.node_facts import led_to
from roslens.source.extract.interpreter.bound_parameters import bind
from roslens.source.extract.interpreter.statements import initialise
from roslens.source.extract.ir.makes_endpoints import MAKE
from roslens.source.extract.ir.program import Expression, Function, Parameter
from roslens.source.extract.symbolic.text import Text, said, unknown
from roslens.source.extract.transfer.closures import Around, names_now, set_around
from roslens.source.extract.transfer.decorated import decorated
from roslens.source.extract.transfer.refined_values import havoc, havoc_unseen
from roslens.source.extract.transfer.shared_values import changed_by_call, newest

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_SHARING = ("&", "*")


class Functions:
    """Results of functions of the workspace."""

    __slots__ = ("ctx",)

    def __init__(self, ctx: Context) -> None:
        """Call functions in an evaluation."""
        self.ctx = ctx

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
        ctx = self.ctx
        site, before = ctx.state.site, {id(one): len(one.endpoints) for one in ctx.emitter.nodes}
        result = self._call(function, arguments, keywords, written, templates)
        makes = False
        for one in ctx.emitter.nodes:
            for place in range(before.get(id(one), 0), len(one.endpoints)):
                one.endpoints[place] = led_to(one.endpoints[place], site)
                makes = True
        ctx.callbacks.reached.pass_on((site.path, site.line), makes=makes)
        return result

    def _call(
        self,
        function: Callable,
        arguments: list[Value],
        keywords: Names,
        written: tuple[Expression, ...],
        templates: tuple[str, ...],
    ) -> Value:
        ctx, what = self.ctx, function.function
        state, key = ctx.state, (function.path, what.line)
        stack = ctx.stack.keys
        if key in stack or len(stack) >= ctx.budget.depth:
            if key in stack:
                ctx.summaries.cuts.add(key)
            return Unknown(f"result of {what.name}()")
        ctx.callbacks.reached.add(key)
        if not what.body and not what.initialisers and ctx.index.programs[function.path].dialect.declared_apart:
            havoc_unseen(ctx, function, written)
            return self._computed_by(what, [*function.arguments, *arguments])
        if what.decorators and (made := decorated(ctx, function)) is not function:
            return self.call(made, arguments, keywords, written) if isinstance(made, Callable) else made
        arguments = [*function.arguments, *arguments]
        plain = not keywords and not function.names
        done = ctx.summaries.known(key, function.self, (arguments, templates), stack) if plain else None
        if done is None:
            frame = self._followed(function, arguments, keywords, written, templates)
            result, names = frame.outcome(), frame.names
        else:
            result, names, state.site, state.gave = done.result, done.names, done.site, None
            if isinstance(function.self, Obj):
                if state.store.open:
                    for name, value in done.fields.items():
                        state.store.put(function.self.fields, name, value)
                function.self.fields.update(done.fields)
        for parameter, expression in zip(what.parameters, written, strict=False):
            if parameter.type.endswith(_SHARING) and "const" not in parameter.type.split() and parameter.name:
                self._given_back(parameter, expression, newest(ctx, names.get(parameter.name)))
        if state.store.refined:
            changed_by_call(ctx)
        return result

    def _given_back(self, parameter: Parameter, written: Expression, value: Value) -> None:
        # A pointer to anything else is the same object, or may point elsewhere by now.
        if parameter.type[-1] == "&" or isinstance(value, QosValue):
            self.ctx.assign(written, value)

    def _followed(
        self,
        function: Callable,
        arguments: list[Value],
        keywords: Names,
        written: tuple[Expression, ...],
        templates: tuple[str, ...],
    ) -> Frame:
        """Evaluate the body of a function; return its names and what it returned."""
        ctx, what, thing = self.ctx, function.function, function.self
        state, summaries = ctx.state, ctx.summaries
        outer = state.frame
        key = (function.path, what.line)
        names = function.names
        names = names_now(ctx, names) if type(names) is Around else dict(names or {})
        frame = state.frame_of(function.path, what.qualified_name, thing, names)
        if isinstance(thing, Obj):
            frame.templates.update(thing.templates_of(what.class_name))
        if templates and what.templates:
            frame.templates.update(zip(what.templates[self._of_class_templates(function) :], templates, strict=False))
        frame.depth = len(state.conditions)
        site = state.site
        bind(ctx, what, arguments, keywords, frame)
        around, summaries.cuts = summaries.cuts, set()
        steps, touched = ctx.budget.steps, summaries.touched
        before = dict(thing.fields) if isinstance(thing, Obj) else {}
        ctx.stack.enter(key, site, what, written)
        state.frame = frame
        try:
            for statement in what.initialisers:
                initialise(ctx, statement)
            if what.sets:
                havoc(thing, what, frame.names)
            ctx.block(what.body)
        finally:
            state.frame = outer
            ctx.stack.leave()
        if what.name == "lambda":
            set_around(ctx, function, frame)
        if frame.left and isinstance(thing, Obj):
            for fields, condition in frame.left:
                join(thing.fields, fields, condition)
        summaries.cuts.discard(key)
        if ctx.budget.steps - steps > HEAVY and summaries.touched == touched and not keywords and not function.names:
            given = (arguments, templates)
            summaries.keep(
                key, Summary(what, thing, given, len(ctx.stack.keys), frame, before, summaries.cuts, state.site)
            )
        around |= summaries.cuts
        summaries.cuts = around
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
        found = self.ctx.index.class_of(function.function.class_name, function.path, "")
        return len(found.what.templates) if found is not None else 0
