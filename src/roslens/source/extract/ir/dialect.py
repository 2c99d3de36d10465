"""What the two languages of programs do differently: the interpreter asks for it by name, never for a language."""

from __future__ import annotations

import msgspec


class Dialect(msgspec.Struct, frozen=True):
    """The rules of a language.

    Attributes:
        constructor: the name of constructors; empty where it is that of the class.
        names_share_objects: whether several names are of one object, so that who changes it does so for all of them.
        operands_are_results: whether ``and`` and ``or`` come to one of their operands, not to a truth value.
        members_without_object: whether a name alone may be that of a member.
        types_convert: whether what is declared of a variable makes something of its value.
        texts_change: whether methods change the text that they are called on.
        calls_set_arguments: whether a function may set the variables that it is given.
        bases_are_constructed: whether bases are constructed though no constructor says so.
        fields_are_arguments: whether a class without a constructor takes values of its members.
        declared_apart: whether a function may be declared in one file and have its body in another.
        overloads: whether functions of one name differ by what they take.
        linkage: whether which function a name means depends on what is linked.
        modules_run: whether statements outside of functions run, so that a variable of a module may change.
        classes_in_modules: whether a class is found as a member of a module.
        methods_take_objects: whether a method that the class is asked for gets the object as an argument.
        copies_are_captured: whether a function inside of another one may hold copies of its variables.
        sliced: whether programs lack functions that only compute, which may set any member.
    """

    constructor: str
    names_share_objects: bool
    operands_are_results: bool
    members_without_object: bool
    types_convert: bool
    texts_change: bool
    calls_set_arguments: bool
    bases_are_constructed: bool
    fields_are_arguments: bool
    declared_apart: bool
    overloads: bool
    linkage: bool
    modules_run: bool
    classes_in_modules: bool
    methods_take_objects: bool
    copies_are_captured: bool
    sliced: bool


CPP = Dialect(
    constructor="",
    names_share_objects=False,
    operands_are_results=False,
    members_without_object=True,
    types_convert=True,
    texts_change=True,
    calls_set_arguments=True,
    bases_are_constructed=True,
    fields_are_arguments=False,
    declared_apart=True,
    overloads=True,
    linkage=True,
    modules_run=False,
    classes_in_modules=False,
    methods_take_objects=False,
    copies_are_captured=True,
    sliced=True,
)
PYTHON = Dialect(
    constructor="__init__",
    names_share_objects=True,
    operands_are_results=True,
    members_without_object=False,
    types_convert=False,
    texts_change=False,
    calls_set_arguments=False,
    bases_are_constructed=False,
    fields_are_arguments=True,
    declared_apart=False,
    overloads=False,
    linkage=False,
    modules_run=True,
    classes_in_modules=True,
    methods_take_objects=True,
    copies_are_captured=False,
    sliced=False,
)
DIALECTS = {"cpp": CPP, "python": PYTHON}
"""The dialects by the language of a program."""
