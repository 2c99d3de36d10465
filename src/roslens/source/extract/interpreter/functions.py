"""Functions of the workspace while they are called: their arguments, their body, and what it leaves behind."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Callable, Invocation, Names, QosValue, Unknown, Value
from roslens.source.extract.domain.frame import Frame, join
from roslens.source.extract.domain.kinds import all_of_kind, fields_of
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

    def call(self, call: Invocation) -> Value:
        """Return what a call of a function of the workspace returns."""
        if call.function.function.name not in MAKE:
            return self._call(call)
        ctx = self.ctx
        site, before = ctx.state.site, {id(one): len(one.endpoints) for one in ctx.emitter.nodes}
        result = self._call(call)
        makes = False
        for one in ctx.emitter.nodes:
            for place in range(before.get(id(one), 0), len(one.endpoints)):
                one.endpoints[place] = led_to(one.endpoints[place], site)
                makes = True
        ctx.callbacks.reached.pass_on((site.path, site.line), makes=makes)
        return result

    def _call(self, call: Invocation) -> Value:
        ctx, function = self.ctx, call.function
        what = function.function
        state, key = ctx.state, (function.path, what.line)
        stack = ctx.stack.keys
        if key in stack or len(stack) >= ctx.budget.depth:
            return self._cut(what, key)
        ctx.callbacks.reached.add(key)
        if not what.body and not what.initialisers and ctx.index.programs[function.path].dialect.declared_apart:
            havoc_unseen(ctx, function, call.written)
            return self._computed_by(what, [*function.arguments, *call.arguments])
        made = decorated(ctx, function) if what.decorators else function
        match made:
            case Unknown():
                return made
            case Callable() if made is not function:
                return self.call(Invocation(made, call.arguments, call.keywords, call.written))
        arguments = [*function.arguments, *call.arguments]
        plain = not call.keywords and not function.names
        done = ctx.summaries.known(key, function.self, (arguments, call.templates), stack) if plain else None
        if done is None:
            frame = self._followed(call, arguments)
            result, names = frame.outcome(), frame.names
        else:
            result, names, state.site, state.gave = done.result, done.names, done.site, None
            self._done_again(fields_of(function.self), done.fields)
        for parameter, expression in zip(what.parameters, call.written, strict=False):
            if parameter.type.endswith(_SHARING):
                self._given_back(parameter, expression, names)
        if state.store.refined:
            changed_by_call(ctx)
        return result

    def _cut(self, what: Function, key: tuple[str, int]) -> Value:
        """Return what stands for a call that is not followed: it is inside of itself, or too deep."""
        if key in self.ctx.stack.keys:
            self.ctx.summaries.cuts.add(key)
        return Unknown(f"result of {what.name}()")

    def _done_again(self, members: Names, after: Names) -> None:
        """Let members of an object be what a call made them before, which would do the same again."""
        store = self.ctx.state.store
        for name, value in after.items() if store.open else ():
            store.put(members, name, value)
        members.update(after)

    def _given_back(self, parameter: Parameter, written: Expression, names: Names) -> None:
        if "const" in parameter.type.split() or not parameter.name:
            return
        value = newest(self.ctx, names.get(parameter.name))
        # A pointer to anything else is the same object, or may point elsewhere by now.
        match value:
            case QosValue():
                self.ctx.assign(written, value)
            case _ if parameter.type[-1] == "&":
                self.ctx.assign(written, value)

    def _followed(self, call: Invocation, arguments: list[Value]) -> Frame:
        """Evaluate the body of a function with all its arguments; return its names and what it returned."""
        ctx, function, keywords = self.ctx, call.function, call.keywords
        what, thing, templates = function.function, function.self, call.templates
        state, summaries = ctx.state, ctx.summaries
        outer = state.frame
        key = (function.path, what.line)
        names = function.names
        names = names_now(ctx, names) if type(names) is Around else dict(names or {})
        frame = state.frame_of(function.path, what.qualified_name, thing, names)
        if frame.object is not None:
            frame.templates.update(frame.object.templates_of(what.class_name))
        if templates and what.templates:
            frame.templates.update(zip(what.templates[self._of_class_templates(function) :], templates, strict=False))
        frame.depth = len(state.conditions)
        site = state.site
        bind(ctx, what, arguments, keywords, frame)
        around, summaries.cuts = summaries.cuts, set()
        steps, touched = ctx.budget.steps, summaries.touched
        before = dict(frame.members or {})
        ctx.stack.enter(key, site, what, call.written)
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
        for fields, condition in frame.left if frame.members is not None else ():
            join(frame.members or {}, fields, condition)
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
