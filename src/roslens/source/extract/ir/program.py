"""A file as a small program: what tells of nodes, topics and parameters in it, in one form for C++ and Python.

A lowering (the room ``lowering``) takes it from the tree of the one parse. It is kept by content hash, so it holds
nothing that depends on other files: names stand as written, and who evaluates it finds what they mean in the
workspace.

Expressions and statements that say nothing about the graph are :class:`Opaque` or left out: a program holds calls,
assignments, returns, and the control structure around them, not arithmetic for its own sake.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.source.extract.ir.dialect import DIALECTS, Dialect


class Literal(msgspec.Struct, frozen=True, array_like=True, tag="lit", gc=False):
    """A text, number or truth value as written; None is ``None``, ``nullptr`` and ``NULL``."""

    value: str | int | float | bool | None


class Name(msgspec.Struct, frozen=True, array_like=True, tag="name", gc=False):
    """A name as written, its scope joined by ``.`` in both languages: ``rclcpp.QoS``, ``topic_name_``, ``self``.

    C++'s ``this`` is ``self``. A member reached through an object is :class:`Member`, not a name with a dot.
    """

    name: str


class Member(msgspec.Struct, frozen=True, array_like=True, tag="member"):
    """``of.name``, ``of->name``; of a name in Python too, where only evaluation can tell modules from objects."""

    of: Expression
    name: str


class Item(msgspec.Struct, frozen=True, array_like=True, tag="item"):
    """``of[key]``."""

    of: Expression
    key: Expression


class Call(msgspec.Struct, frozen=True, array_like=True, tag="call"):
    """A call, a construction, or a declaration with constructor arguments (its function is the type then).

    Attributes:
        function: what is called, without template arguments.
        arguments: by position; ``*args`` is :class:`Opaque`.
        keywords: Python's, by name; under ``*`` what is spread out for arguments by position, in their order, and under
            ``**`` for those by name.
        templates: template arguments as written, white space squeezed: ``std_msgs::msg::String``.
        line: where the call begins, from 1 on.
        column: likewise.
    """

    function: Expression
    arguments: tuple[Expression, ...] = ()
    keywords: tuple[tuple[str, Expression], ...] = ()
    templates: tuple[str, ...] = ()
    line: int = 0
    column: int = 0


class Operation(msgspec.Struct, frozen=True, array_like=True, tag="op"):
    """An operator with its operands.

    ``+`` ``-`` ``*`` ``/`` ``%`` ``<<`` ``==`` ``!=`` ``<`` ``>`` ``<=`` ``>=`` ``in`` ``and`` ``or`` ``not``, and
    ``?:`` (condition, then, else). ``+``, ``<<``, ``and`` and ``or`` in a row may be one with more than two operands.
    Of C++ also: other operators as written, ``=`` inside an expression, and ``,`` for what holds calls but says
    nothing else (the calls, then its text).
    """

    operator: str
    operands: tuple[Expression, ...]


class Sequence(msgspec.Struct, frozen=True, array_like=True, tag="seq"):
    """A list, tuple, set or initializer list; ``{…}`` of C++ is one."""

    items: tuple[Expression, ...]


class Mapping(msgspec.Struct, frozen=True, array_like=True, tag="map"):
    """A dictionary display."""

    items: tuple[tuple[Expression, Expression], ...]


class Format(msgspec.Struct, frozen=True, array_like=True, tag="format"):
    """Text put together: an f-string, ``'…'.format(…)`` and ``'…' % …`` as far as they are written in place."""

    parts: tuple[Expression, ...]


class Lambda(msgspec.Struct, frozen=True, array_like=True, tag="lambda"):
    """A function without a name.

    Attributes:
        function: index of its :class:`Function` in the program.
        holds: variables around of which it has copies (``[a, this]``); ``=`` is all but those that stand behind it.
    """

    function: int
    holds: tuple[str, ...] = ()


class Opaque(msgspec.Struct, frozen=True, array_like=True, tag="opaque", gc=False):
    """An expression of which nothing more is known than its text (at most 80 characters)."""

    text: str


Expression = Literal | Name | Member | Item | Call | Operation | Sequence | Mapping | Format | Lambda | Opaque

NO_EXCEPTION = Opaque("no exception")
"""The condition of ``try``: its block has run to its end."""
NO_BREAK = Opaque("no break")
"""The condition of what stands behind ``else`` of the loop before."""


class Assign(msgspec.Struct, frozen=True, array_like=True, tag="assign"):
    """``target = value``, a declaration with a value or constructor arguments included.

    ``declared`` is the type as written, white space squeezed (``auto`` and Python without annotation: empty);
    ``operator`` is ``=``, ``+=``, or of variables of functions of C++ ``static`` where it is initialised once, ``&``
    where it is another name of what stands there, and ``*`` where it points to that. Of another augmented assignment of
    Python it is that operator, and ``value`` what it comes to.
    A declaration without value has ``value`` None.
    """

    target: Expression
    value: Expression | None
    declared: str = ""
    operator: str = "="
    line: int = 0


class Evaluate(msgspec.Struct, frozen=True, array_like=True, tag="eval"):
    """An expression that stands alone, for what it calls; ``throw x`` of C++ is a call of ``throw``."""

    expression: Expression
    line: int = 0


class Return(msgspec.Struct, frozen=True, array_like=True, tag="return"):
    """``return value`` (also ``co_return``); ``yield`` is an :class:`Evaluate`."""

    value: Expression | None
    line: int = 0


class Branch(msgspec.Struct, frozen=True, array_like=True, tag="if"):
    """``if``, and what decides likewise.

    A ``switch`` is one branch a case with the condition ``subject == label``; of ``try`` the handlers are ``otherwise``
    and the condition is ``NO_EXCEPTION``; of ``#if`` inside functions it is ``Opaque`` with the directive.
    """

    condition: Expression
    then: tuple[Statement, ...]
    otherwise: tuple[Statement, ...] = ()
    line: int = 0

    @property
    def head(self) -> tuple[Expression | None, ...]:
        """What is evaluated before its parts."""
        return (self.condition,)

    @property
    def parts(self) -> tuple[tuple[Statement, ...], ...]:
        """The statements of each of its ways."""
        return self.then, self.otherwise


class Loop(msgspec.Struct, frozen=True, array_like=True, tag="loop"):
    """``for`` and ``while``; ``target`` and ``over`` are of a loop over a sequence, None and the condition else.

    ``update`` is done after each turn: ``++i``. Of ``do … while``, which has its first turn in any case, ``over`` is
    None and what the condition calls stands at the end of the body.
    """

    target: Expression | None
    over: Expression | None
    body: tuple[Statement, ...]
    line: int = 0
    update: tuple[Statement, ...] = ()

    @property
    def head(self) -> tuple[Expression | None, ...]:
        """What is evaluated before its parts."""
        return self.target, self.over

    @property
    def parts(self) -> tuple[tuple[Statement, ...], ...]:
        """The statements of a turn, which may be none."""
        return ((*self.body, *self.update),)


class Leave(msgspec.Struct, frozen=True, array_like=True, tag="leave", gc=False):
    """``break`` of a loop, or with ``again`` its ``continue``."""

    again: bool = False
    line: int = 0


Statement = Assign | Evaluate | Return | Branch | Loop | Leave


class Parameter(msgspec.Struct, frozen=True, array_like=True):
    """A parameter of a function: its declared type and default, empty and None where there is none."""

    name: str
    type: str = ""
    default: Expression | None = None


class Function(msgspec.Struct, frozen=True, omit_defaults=True):
    """A function with a body.

    Attributes:
        name: without scope; ``lambda`` of one without name.
        qualified_name: with namespaces and classes, joined by ``.`` in both languages.
        class_name: qualified name of the class it is a member of; empty of none.
        line: of its name.
        parameters: of a Python method without ``self``.
        initialisers: of members and bases by a constructor, as assignments to ``self.member`` or calls of the base. The
            value of a member with other than one argument is the sequence of them: what it constructs its class says.
        body: its statements; of a C++ function that only computes it is empty, also where it returns something.
        templates: names of its template parameters, those of its class first.
        specialised: the template arguments that an explicit specialisation of C++ is for: ``template <> int f<int>()``.
        decorators: Python's, as expressions.
        hands: whether it is of C++ and returns a reference or pointer to what may be changed.
        local: whether it is of C++ and known to its own file only: ``static``, or in a namespace without name.
        sets: names that statements of C++ set which were left out, those of members among them, and parameters that
            such statements may set for the caller.
    """

    name: str
    qualified_name: str
    line: int
    class_name: str = ""
    parameters: tuple[Parameter, ...] = ()
    initialisers: tuple[Statement, ...] = ()
    body: tuple[Statement, ...] = ()
    templates: tuple[str, ...] = ()
    decorators: tuple[Expression, ...] = ()
    sets: tuple[str, ...] = ()
    hands: bool = False
    local: bool = False
    specialised: tuple[str, ...] = ()


class Field(msgspec.Struct, frozen=True, array_like=True):
    """A data member with its declared type, and its value where the class gives one (Python: class attributes)."""

    name: str
    type: str = ""
    value: Expression | None = None
    line: int = 0


class Class(msgspec.Struct, frozen=True, omit_defaults=True):
    """A class: ``bases`` as written without template arguments of their own, scope joined by ``.``.

    ``base_templates`` are these arguments, for each base; empty where no base has any.
    """

    name: str
    qualified_name: str
    line: int
    bases: tuple[str, ...] = ()
    fields: tuple[Field, ...] = ()
    templates: tuple[str, ...] = ()
    base_templates: tuple[tuple[str, ...], ...] = ()


class Program(msgspec.Struct, frozen=True, omit_defaults=True):
    """A file.

    Attributes:
        language: ``cpp`` or ``python``.
        functions: every one with a body, lambdas included, in source order.
        classes: in source order.
        body: statements outside functions: globals and constants, and calls of registration macros; Python's module.
            In C++ the name of a global stands with its namespaces and class, joined by ``.``.
        macros: ``#define`` of a constant: name to value.
        imports: Python: local name to what it means (``rospy``, ``std_msgs.msg.String``); C++: alias of a namespace or
            type to what it means, and ``using`` of a name. What is known in a namespace, class or function of C++ only
            has its scope before it, joined by ``.``; meanings are as written, with ``::`` and template arguments.
        using: namespaces that are used whole (``using namespace std``; ``from x import *``).
        includes: headers as written, with their line; in Python the imported modules.
        incomplete: lines at which something could not be lowered, and why.
        declarations: C++: functions declared without a body whose parameters have defaults, which their definition
            elsewhere does not repeat.
        variants: of a file of C++ with conditions that ask for the version of ROS: what it is for ``ros1`` and
            ``ros2``; the rest of the program is of all arms. Variants have none themselves.
    """

    language: str
    functions: tuple[Function, ...] = ()
    classes: tuple[Class, ...] = ()
    body: tuple[Statement, ...] = ()
    macros: dict[str, Expression] = {}
    imports: dict[str, str] = {}
    using: tuple[str, ...] = ()
    includes: tuple[tuple[str, int], ...] = ()
    incomplete: tuple[tuple[int, str], ...] = ()
    declarations: tuple[Function, ...] = ()
    variants: dict[str, Program] = {}

    @property
    def dialect(self) -> Dialect:
        """The rules of its language."""
        return DIALECTS[self.language]

    def variables(self) -> Iterator[tuple[str, Expression | None]]:
        """Yield the variables that are declared or set outside of functions, each with its value as often as it is."""
        for statement in self.body:
            match statement:
                case Assign(target=Name(name=name)):
                    yield name, statement.value
