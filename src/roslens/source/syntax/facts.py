"""What one parse of a file yields, for every metric and rule that reads it.

A syntax (:mod:`roslens.source.syntax.cpp`, :mod:`roslens.source.syntax.python`) parses the file once and
returns :class:`FileFacts`. Metrics are pure functions of these facts: they never see a tree. Facts are
cached by content hash, so they hold nothing that depends on other files.

Roles name what a piece of syntax does, in one vocabulary for all languages:

==================  ==================================================================================
``if`` ``elif``     a condition; an ``else if`` / ``elif`` is ``elif``, never ``else`` + ``if``
``else``            an ``else`` arm (also of loops in Python: ``loop_else``; of try: ``try_else``)
``for`` ``while``   loops (range loops and ``async for`` are ``for``), ``do`` for do-while
``switch``          ``switch`` and Python's ``match``
``case``            a label of a switch or a case of a match that is not the catch-all
``default``         ``default:`` and ``case _:`` (or ``case name:``) without a guard
``try`` ``catch``   ``catch`` is also Python's ``except``; ``finally``; ``catch_group``: ``except*`` (and ``catch``)
``ternary``         ``a ? b : c`` and ``b if a else c``
``and`` ``or``      one event per binary operator (``a && b && c`` has two); ``and``/``or`` spellings too
``lambda``          a lambda expression; what is inside it is counted in ``lambda_counts``
``function``        a function defined inside this one (Python); its inside is *not* part of this one
``comprehension``   one ``for`` of a comprehension; ``comprehension_if`` for its ``if``
``with`` ``assert`` Python statements
``guard``           the ``if`` of a Python match case
``return`` ``throw`` ``break`` ``continue`` ``goto`` ``label`` ``yield`` ``await``
``call``            a call as written (a macro used like a function included)
``recursion``       a call of the function's own unqualified name (counted besides ``call``)
``preproc_if``      ``#if`` / ``#ifdef`` / ``#ifndef`` inside a function; ``preproc_else`` for ``#else`` / ``#elif``
``preproc_ifndef``  ``#ifndef`` (counted besides ``preproc_if``); ``preproc_elif``: ``#elif`` (and ``preproc_else``)
``statement``       a simple statement (expression statement, jump, declaration with initialiser)
==================  ==================================================================================
"""

from __future__ import annotations

import msgspec


class Control(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """One event of the control structure of a function, in source order.

    ``role`` is one of the roles above that are not counted besides another, nor ``call`` or ``statement``. ``depth``
    counts the control events around it: its parent is the nearest event before it with
    ``depth - 1``. ``part`` says where in its parent it stands: ``condition`` or ``body``. An
    ``elif`` and an ``else`` have the depth of the ``if`` they belong to; ``catch``, ``finally`` and
    ``try_else`` that of their ``try``; a ``case`` is a child of its ``switch`` and the statements
    behind a label are children of the ``case``. An ``and``/``or`` that is an operand of another
    one is its child only when nothing but parentheses stands between them.
    ``alternative`` marks what stands in a second or later arm of an ``#if``.
    """

    role: str
    depth: int
    part: str = "body"
    alternative: bool = False


class Halstead(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """Halstead's four counts of a token stream (Halstead 1977)."""

    distinct_operators: int = 0
    distinct_operands: int = 0
    operators: int = 0
    operands: int = 0


class Lines(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """Lines of a file, as cloc classifies them: ``physical = code + comment + blank``.

    A line with code and a comment is code.
    """

    physical: int = 0
    code: int = 0
    comment: int = 0
    blank: int = 0


class SyntaxFault(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """A place that could not be parsed; the rest of the file still was."""

    line: int
    column: int
    end_line: int
    text: str


class FunctionFacts(msgspec.Struct, frozen=True, gc=False, omit_defaults=True):
    """A function with a body, as written.

    ``name`` is what stands before the parameters without scope (``Foo``, ``~Foo``,
    ``operator==``, ``operator bool``); ``qualified_name`` has all enclosing namespaces, classes and
    (Python) functions and the written scope, joined with ``::`` in C++ and ``.`` in Python;
    ``class_name`` is the qualified name of the class it is a member of, as far as the file tells.
    ``signature`` is the parameter types between parentheses, white space squeezed, names and
    defaults left out where the language has types (Python: the parameter names).

    ``counts`` has one entry per role that occurs, for the function as written with lambdas and all
    arms of ``#if``; ``lambda_counts`` and ``alternative_counts`` say how much of it is inside
    lambdas and in second or later ``#if`` arms, so that a metric can leave them out.
    ``parameter_types`` and ``types`` are the class-like names used in the signature and in the
    whole function; ``calls`` the names of what it calls, as written without template arguments
    and receiver (``foo``, ``ns::foo``), sorted, distinct. ``identifiers`` are the distinct
    identifiers in the body of a *member* function (empty for others). ``eloc`` is the number of
    lines of the body that hold an executable token (rules in docs/reference/metrics).
    ``approximate`` is true when a part of it could not be parsed.

    Python only: ``aside_counts`` says how much of ``counts`` is inside ``assert`` statements, local classes and the
    decorators, defaults and annotations of nested functions, where some tools do not look; ``header_counts``
    what stands in the defaults and annotations of the function itself, which are evaluated where it is defined
    and therefore are part of the ``counts`` of what encloses it. Its ``identifiers`` are the names that it
    reaches through its first parameter or the name of its class.
    """

    name: str
    qualified_name: str
    signature: str
    line: int
    column: int
    end_line: int
    class_name: str = ""
    access: str = ""
    static: bool = False
    virtual: bool = False
    decorators: tuple[str, ...] = ()
    parameters: int = 0
    nested_in: str = ""
    counts: dict[str, int] = {}
    lambda_counts: dict[str, int] = {}
    alternative_counts: dict[str, int] = {}
    control: tuple[Control, ...] = ()
    lines: Lines = Lines()
    eloc: int = 0
    halstead: Halstead = Halstead()
    parameter_types: tuple[str, ...] = ()
    types: tuple[str, ...] = ()
    calls: tuple[str, ...] = ()
    identifiers: tuple[str, ...] = ()
    approximate: bool = False
    aside_counts: dict[str, int] = {}
    header_counts: dict[str, int] = {}


class FieldFacts(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """A data member: its name, the class-like names in its type, its access."""

    name: str
    types: tuple[str, ...] = ()
    access: str = "private"
    static: bool = False


class MethodFacts(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """A member function as its class declares (or defines) it."""

    name: str
    signature: str
    access: str = "private"
    line: int = 0
    static: bool = False
    virtual: bool = False
    types: tuple[str, ...] = ()
    defined_here: bool = False


class ClassFacts(msgspec.Struct, frozen=True, gc=False, omit_defaults=True):
    """A class, struct or union with a body.

    ``bases`` are names as written without template arguments; ``methods`` holds declared and
    inline-defined member functions (constructors and destructors included); ``types`` every
    class-like name that stands in the class body outside function bodies.
    """

    name: str
    qualified_name: str
    kind: str
    line: int
    column: int
    end_line: int
    bases: tuple[str, ...] = ()
    fields: tuple[FieldFacts, ...] = ()
    methods: tuple[MethodFacts, ...] = ()
    types: tuple[str, ...] = ()
    friends: tuple[str, ...] = ()
    approximate: bool = False


class FileFacts(msgspec.Struct, frozen=True, gc=False, omit_defaults=True):
    """Everything one parse of a file yields.

    ``syntax`` is ``cpp`` or ``python``. ``top_level`` has the counts outside functions (role to
    number), ``includes`` the included headers or imported modules as written with their line.
    ``line_hashes`` holds one 32-bit hash per code line with its comments and white space removed,
    in order, and ``line_numbers`` the lines they stand on: duplication is found on these.
    """

    syntax: str
    lines: Lines
    halstead: Halstead = Halstead()
    functions: tuple[FunctionFacts, ...] = ()
    classes: tuple[ClassFacts, ...] = ()
    top_level: dict[str, int] = {}
    includes: tuple[tuple[str, int], ...] = ()
    line_hashes: tuple[int, ...] = ()
    line_numbers: tuple[int, ...] = ()
    faults: tuple[SyntaxFault, ...] = ()
