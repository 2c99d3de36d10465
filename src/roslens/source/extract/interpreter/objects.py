"""Objects and values by their type: how classes are constructed, and what declarations make."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import (
    Callable,
    Invocation,
    Named,
    Names,
    Obj,
    QosValue,
    Unknown,
    Value,
)
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.domain.kinds import text_of
from roslens.source.extract.domain.made_texts import text_made
from roslens.source.extract.domain.quality import QUALITY_TYPES
from roslens.source.extract.domain.typed_list import TypedList
from roslens.source.extract.domain.word_list import Words
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.vocabulary import CallSite, find_class, find_outer
from roslens.source.extract.ir.program import Assign, Field, Function, Member
from roslens.source.extract.symbolic.reason import NotSet
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.symbols.symbol_table import Defined, type_arguments, type_name
from roslens.source.extract.transfer.base_templates import bind_bases
from roslens.source.extract.transfer.class_attributes import of_object
from roslens.source.extract.transfer.default_bases import bases_by_default
from roslens.source.extract.transfer.given_fields import set_fields
from roslens.source.extract.transfer.overload_choice import overload

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


class Objects:
    """Makes objects and values of a type."""

    __slots__ = ("ctx",)

    def __init__(self, ctx: Context) -> None:
        """Make them in an evaluation."""
        self.ctx = ctx

    def constructed(self, declared: str, value: Value) -> Value:
        """Return a member that is initialised with one value: an object of its class made of it, or the value."""
        ctx = self.ctx
        name, inside = type_name(declared)
        if "*" in declared or "&" in declared or "ptr" in declared.lower() or name in _PLAIN:
            return self.converted(declared, value)
        match value:
            case Text() if is_list(declared):
                # ``names_{"a"}`` is a list of one; what is not known may be a list itself.
                return [value] if value.known is not None else value
        defined = ctx.index.class_of(name, ctx.state.frame.path, ctx.state.frame.scope)
        outer = find_outer(ctx, ctx.index.meaning(name, ctx.state.frame.path, ctx.state.frame.scope))
        match value:
            case Obj() if value.defined is not None and value.defined == defined:
                return self.converted(declared, value)
            case Unknown() if outer is None:
                return self.converted(declared, value)
            case _ if defined is None and outer is None:
                return self.converted(declared, value)
        return self.of_type(name, [value], {}, tuple(type_arguments(inside)))

    def construct(
        self, defined: Defined, arguments: list[Value], keywords: Names, templates: tuple[str, ...] = ()
    ) -> Value:
        """Make an object of a class of the workspace, its constructor evaluated."""
        ctx = self.ctx
        known = find_class(ctx, defined.what.qualified_name, defined.path)
        if known is not None:
            name, word = known
            return word(ctx, None, CallSite(name, arguments, keywords, templates, (), ctx.state.site))
        thing = Obj(defined.what.qualified_name, defined, {})
        names = defined.what.templates
        thing.templates.update(zip(names, templates, strict=False))
        site, written, since = ctx.state.site, ctx.state.written, ctx.state.store.count
        self.prepare(thing)
        ctx.state.site, ctx.state.written = site, written
        self.construct_as(thing, defined, arguments, keywords)
        if ctx.state.store.count > since:
            ctx.state.store.made(thing.fields, since)
        if thing.node is not None:
            ctx.emitter.made.append(thing)
        return thing

    def prepare(self, thing: Obj) -> None:
        """Give an object the members that its classes declare."""
        ctx = self.ctx
        bind_bases(ctx, thing)
        if thing.type in ctx.state.preparing:
            # By value no class holds itself: what is taken for it here is a pointer, or something else of its name.
            return
        ctx.state.preparing.append(thing.type)
        for one in reversed(ctx.index.chain(thing.defined)) if thing.defined is not None else ():
            for field, always in self._members(one):
                if always is not _OF_TYPE:
                    thing.fields[field.name] = always
                else:
                    self._make(thing, one, field)
        ctx.state.preparing.pop()

    def _make(self, thing: Obj, of: Defined, field: Field) -> None:
        """Make a member of an object where its class declares it."""
        ctx = self.ctx
        outer, ctx.state.frame = ctx.state.frame, Frame(of.path, of.what.qualified_name, thing)
        ctx.state.frame.templates.update(thing.templates_of(of.what.qualified_name))
        ctx.state.site = Evidence(of.path, field.line)
        try:
            if field.value is not None:
                value = self.typed(field.type, ctx.value(field.value))
                thing.fields[field.name] = of_object(ctx, of, field.name, value) if of.path[-3:] == ".py" else value
            elif field.type and "*" not in field.type:
                value = self.declared(field.type)
                # Who sets it may not be followed: it is not sure to be empty.
                not_set = unknown(NotSet(field.name))
                thing.fields[field.name] = value if text_of(value) is None else not_set
        finally:
            ctx.state.frame = outer

    def _members(self, defined: Defined) -> tuple[tuple[Field, Value], ...]:
        """Return the members of a class that an object has, and what they are at first if that is always the same."""
        ctx = self.ctx
        known = ctx.index.memo.members
        found = known.get(id(defined.what))
        if found is None:
            initialised = {
                # Constructors of C++ initialise them: they are not made twice.
                name
                for method in ctx.index.methods(defined, defined.what.name)
                for name in _initialised(method.what)
            }
            given = [
                field
                for field in defined.what.fields
                if field.name in initialised
                or field.value is not None
                # A static member has its value where it is defined, outside of the class.
                or (field.type and "*" not in field.type and ctx.index.member(defined, field.name) is None)
            ]
            found = known[id(defined.what)] = tuple(
                (field, Unknown(field.name) if field.name in initialised else _at_first(field)) for field in given
            )
        return found

    def construct_as(self, thing: Obj, defined: Defined, arguments: list[Value], keywords: Names) -> None:
        """Evaluate the constructor of one class of an object."""
        ctx = self.ctx
        dialect = ctx.index.programs[defined.path].dialect
        name = dialect.constructor or defined.what.name
        found = ctx.index.methods(defined, name)
        chosen = overload(ctx.index, found, len(arguments) + len(keywords), arguments)
        if chosen is not None:
            whole = thing.defined
            if dialect.bases_are_constructed:
                for base in bases_by_default(ctx.index, defined, chosen.what):
                    self.construct_as(thing, base, [], {})
                # While a base is constructed, its own virtual methods are called.
                thing.defined = defined
            ctx.call(Invocation(Callable(chosen.what, chosen.path, thing), arguments, keywords, ctx.state.written))
            thing.defined = whole
            return
        if (
            dialect.fields_are_arguments
            and (arguments or keywords)
            and set_fields(ctx, thing, defined, arguments, keywords)
        ):
            return
        for base in ctx.index.chain(defined)[1:2]:
            self.construct_as(thing, base, arguments, keywords)
        if not ctx.index.chain(defined)[1:]:
            self.base_constructed(thing, defined, arguments, keywords)

    def base_constructed(self, thing: Obj, defined: Defined, arguments: list[Value], keywords: Names) -> None:
        """Construct the bases that are not in the workspace."""
        ctx = self.ctx
        for base in ctx.index.outer_bases(defined):
            ctx.calls.construct_outer(thing, base, arguments, keywords)

    def declared(self, declared: str) -> Value:
        """Return the value of a declaration without one: an object of a class by value, else what is unknown."""
        name, inside = type_name(declared)
        if ("*" in declared or "ptr" in declared.lower()) and name != "std.vector":
            return None
        return self.of_type(name, [], {}, tuple(type_arguments(inside)))

    def typed(self, declared: str, value: Value) -> Value:
        """Return a value as its declared type makes it: braces construct, numbers become texts of strings."""
        ctx = self.ctx
        match value:
            case list() | int():
                if not ctx.dialect.types_convert:
                    # Annotations make nothing.
                    return value
            case Unknown(reason=why) if ctx.dialect.types_convert and type_name(declared)[0] in QUALITY_TYPES:
                return QosValue(unknown=str(why))
            case _:
                return value
        match value:
            case Words() | TypedList():
                return value
            case list():
                if not is_list(declared) and not declared.startswith("std::map"):
                    name, inside = type_name(declared)
                    return self.of_type(name, value, {}, tuple(type_arguments(inside)))
            case int():
                name = type_name(declared)[0]
                if name == "double" or name == "float":
                    return float(value)
                if name in QUALITY_TYPES:
                    return self.of_type(name, [value], {})
        return value

    def converted(self, declared: str, value: Value) -> Value:
        """Return a value as a declaration makes it."""
        match value:
            case int() | float() if type_name(declared)[0] in ("std.string", "string"):
                return value
        return self.typed(declared, value)

    def of_type(self, name: str, arguments: list[Value], keywords: Names, templates: tuple[str, ...] = ()) -> Value:
        """Return an object of a class by its name as written."""
        ctx = self.ctx
        if not name or name in _PLAIN:
            return plain(name, arguments)
        name = ctx.state.frame.templates.get(name, name)
        alias = "" if templates else ctx.index.alias(name, ctx.state.frame.path, ctx.state.frame.scope)
        if alias.endswith("*"):
            return arguments[0] if arguments else None
        if "<" in alias:
            name, inside = type_name(alias)
            templates = tuple(ctx.calls.template(one) for one in type_arguments(inside))
        defined = ctx.index.class_of(name, ctx.state.frame.path, ctx.state.frame.scope)
        if defined is not None:
            return self.construct(defined, arguments, keywords, templates)
        return ctx.calls.made_outer(
            ctx.index.meaning(name, ctx.state.frame.path, ctx.state.frame.scope),
            arguments,
            keywords,
            templates,
        )


def plain(name: str, arguments: list[Value]) -> Value:
    """Return a value of a fundamental type."""
    if name in _TEXTS:
        return text_made(name, arguments) if arguments else Text()
    if not arguments:
        return Unknown("a value that is not set")
    return arguments[0]


def _initialised(constructor: Function) -> Iterator[str]:
    for statement in constructor.initialisers:
        match statement:
            case Assign(target=Member(name=name)):
                yield name


def _at_first(field: Field) -> Value:
    """Return what a member without a value is, if its type alone says it."""
    name = type_name(field.type)[0]
    if field.value is not None or (name and name not in _PLAIN and "ptr" not in field.type.lower()):
        return _OF_TYPE
    if "ptr" in field.type.lower() and name != "std.vector":
        return None
    if name in _TEXTS:
        return unknown(NotSet(field.name))
    return Unknown("a value that is not set") if not name or name in _PLAIN else _OF_TYPE


_OF_TYPE = Named("a value of its type")
"""What a member is whose value has to be made for each object."""
_TEXTS = ("std.string", "string", "QString", "std.string_view")
_LISTS = ("std::vector", "std::array", "std::set", "std::list", "std::deque", "std::unordered_set")


def is_pointer(declared: str) -> bool:
    """Whether a type as written is a pointer: one that is made of nothing points to nothing."""
    head, bracket, rest = declared.partition("<")
    outer = head + rest.rpartition(">")[2] if bracket else declared
    return "*" in outer or outer.rstrip(" &").lower().endswith("ptr")


def is_list(declared: str) -> bool:
    """Whether a type as written is a list of items."""
    return declared.removeprefix("const ").startswith(_LISTS)


_PLAIN = frozenset(
    {"std.string", "string", "QString", "std.string_view", "int", "double", "float", "bool", "size_t", "uint8_t",
     "uint16_t", "uint32_t", "uint64_t", "int8_t", "int16_t", "int32_t", "int64_t", "unsigned int", "unsigned", "long",
     "char", "auto", "void", "unsigned long", "std.size_t"}
)  # fmt: skip
