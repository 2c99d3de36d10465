"""Which function a name means where it is called: of the methods of an object, and of functions outside of classes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from roslens.source.extract.domain.abstract_value import Callable, Obj, Value
from roslens.source.extract.domain.call_stack import CallStack
from roslens.source.extract.domain.emitter import Emitter
from roslens.source.extract.domain.state import State
from roslens.source.extract.ir.makes_endpoints import makes_endpoints
from roslens.source.extract.ir.program import Function
from roslens.source.extract.symbols.memo import Found
from roslens.source.extract.symbols.symbol_table import Defined, DefinedFunction, SymbolTable
from roslens.source.extract.transfer.overload_choice import overload, specialised, taking

_FEW = 3
KNOWN_BETTER = frozenset({"declare_or_get_parameter"})
"""Methods of nodes whose meaning the vocabulary knows, wherever they are defined."""


class Caller(Protocol):
    """What evaluates, as far as it decides what a name means; see :class:`Context` for its attributes."""

    index: SymbolTable
    emitter: Emitter
    state: State
    stack: CallStack


class NamedFunctions:
    """The functions of the workspace by name, as one evaluation calls them.

    Attributes:
        bare: functions without their decorators, by the identity of those with them, which they keep alive.
    """

    def __init__(self, ctx: Caller) -> None:
        """Look for them where ``ctx`` is."""
        self._ctx = ctx
        self.bare: dict[int, tuple[Function, Function]] = {}

    def method(self, thing: Obj, name: str) -> Callable | None:
        """Return a method of an object by name, of its class or the nearest base that has it."""
        defined = thing.defined
        if defined is None:
            return None
        known, key = self._ctx.index.memo.method, (id(defined.what), name)
        found = known[key] if key in known else known.setdefault(key, self.method_of(defined, name))
        return None if found is None else Callable(found[0], found[1], thing)

    def method_of(self, defined: Defined, name: str) -> Found:
        """Return the method that a class or its nearest base has by a name, one with a body where there is any."""
        for one in self._ctx.index.chain(defined):
            found = self._ctx.index.methods(one, name)
            if found:
                chosen = next((one for one in found if one.what.body), found[0])
                return chosen.what, chosen.path
        return None

    def methods(
        self, thing: Obj, name: str, count: int, arguments: Sequence[Value] = (), templates: Sequence[str] = ()
    ) -> Callable | None:
        """Return the method of an object that takes so many arguments; of several the one that fits what is known."""
        defined = thing.defined
        if defined is None or (thing.node is not None and name in KNOWN_BETTER):
            return None
        known, key = self._ctx.index.memo.overloads, (id(defined.what), name, count)
        found = known[key] if key in known else known.setdefault(key, self._overload_of(defined, name, count))
        if (arguments or templates) and found is not None and key not in self._ctx.index.memo.alone:
            found = self._overload_of(defined, name, count, arguments, templates)
        return None if found is None else Callable(found[0], found[1], thing)

    def _overload_of(
        self, defined: Defined, name: str, count: int, arguments: Sequence[Value] = (), templates: Sequence[str] = ()
    ) -> Found:
        """Return the method of the first class of a chain that has one of a name; of C++ one that takes so many."""
        hidden: Found = None
        for one in self._ctx.index.chain(defined):
            found = self._ctx.index.methods(one, name)
            meant = specialised(found, templates)
            chosen = overload(self._ctx.index, meant, count, arguments, self._ctx.stack.running)
            if chosen is None:
                continue
            if taking(self._ctx.index, [chosen], count) or not self._ctx.index.programs[chosen.path].dialect.overloads:
                if len(found) < 2:
                    self._ctx.index.memo.alone.add((id(defined.what), name, count))
                return chosen.what, chosen.path
            # A class that has ``using Base::name`` has those of its base too.
            hidden = hidden or (chosen.what, chosen.path)
        return hidden

    def function(
        self, name: str, count: int, arguments: Sequence[Value] = (), templates: Sequence[str] = ()
    ) -> Callable | None:
        """Return the function outside of classes that a name means and that takes so many arguments."""
        frame, known = self._ctx.state.frame, self._ctx.index.memo.functions
        key = (name, frame.path, frame.scope, count)
        if key in known:
            found = known[key]
        else:
            several = self._ctx.index.functions_of(name, frame.path, frame.scope)
            found = self._function(specialised(several, templates), name, count, arguments)
            if len(several) < 2 and not any(one.what.specialised for one in several):
                known[key] = found
        return None if found is None else Callable(found[0], found[1])

    def _function(self, several: list[DefinedFunction], name: str, count: int, arguments: Sequence[Value]) -> Found:
        running = self._ctx.stack.running
        chosen = overload(
            self._ctx.index,
            several,
            count,
            arguments,
            running,
            (self._ctx.state.frame.path, self._ctx.emitter.first.path),
        )
        if chosen is None:
            self._unknown_which(name, several)
        if chosen is None or chosen.what.class_name:
            return None
        return chosen.what, chosen.path

    def _unknown_which(self, name: str, several: list[DefinedFunction]) -> None:
        """Note a call of a function that makes endpoints, where the program of none of that name is this one."""
        makes = [one for one in several if makes_endpoints(one.what)]
        if not makes:
            return
        places = ", ".join(f"{one.path}:{one.what.line}" for one in makes[:_FEW]) + (" …" if len(makes) > _FEW else "")
        reason = f"{name}() is called, but none of its definitions is known to be linked here: {places}"
        if (self._ctx.state.site, reason) not in self._ctx.emitter.node.unresolved:
            self._ctx.emitter.node.unresolved.append((self._ctx.state.site, reason))
