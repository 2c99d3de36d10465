"""Which of several functions of one name is meant: by how many arguments there are, then by what they are."""

from __future__ import annotations

import re
from collections.abc import Sequence

from roslens.source.extract.domain.abstract_value import Callable, Handle, Obj, Value
from roslens.source.extract.ir.program import Function
from roslens.source.extract.ir.type_names import NUMBER_TYPES
from roslens.source.extract.symbolic.text import Text
from roslens.source.extract.symbols.linkage import Near
from roslens.source.extract.symbols.symbol_table import DefinedFunction, SymbolTable, type_name

_TEXTS = frozenset({"string", "char", "QString", "string_view"})
_TAGS = {"true_type": True, "false_type": False}
_STANDARD = re.compile(r"\b(?:::)?std::")
_SAME_TYPES = {"int32_t": "int", "signed": "int", "uint32_t": "unsigned", "unsignedint": "unsigned"}
_FITS, _UNFIT = 1, -4
_HANDLES = frozenset({"NodeHandle", "NodeHandlePtr"})
_PLAIN = _TEXTS | NUMBER_TYPES


def overload(
    index: SymbolTable, found: list[DefinedFunction], count: int, arguments: Sequence[Value] = (),
    running: tuple[str, int] = ("", 0), at: tuple[str, str] = ("", ""),
) -> DefinedFunction | None:  # fmt: skip
    """Return the function that takes so many arguments, else the one with the largest body.

    Of functions outside of classes that are those which the file that calls knows; of several files that are linked
    with it none.

    Args:
        index: that knows how functions are declared.
        found: functions of one name.
        count: how many arguments are given.
        arguments: those that are known, which decide where several functions take so many.
        running: path and line of the function that calls: it calls another one of its name, rather than itself.
        at: path of the file that calls and of the program that it is a part of, where linkage decides.
    """
    near = _near(index, found, at)
    functions = [one for one in found if (one.path, _line(one)) in near] if at[0] else found
    if len(functions) < 2:
        return functions[0] if functions else None
    best = taking(index, functions, count) or functions
    if len(best) > 1 and arguments:
        fits = [fit(one, arguments) for one in best]
        most = max(fits)
        best = [one for one, fitting in zip(best, fits, strict=True) if fitting == most]
        best = [one for one in best if (one.path, _line(one)) != running] or best
    if at[0]:
        nearest = min(near[one.path, _line(one)] for one in best)
        best = [one for one in best if near[one.path, _line(one)] is nearest]
        if nearest >= Near.LINKED and len({one.path for one in best}) > 1:
            return None
    return max(best, key=lambda one: len(one.what.body), default=None)


def specialised(found: list[DefinedFunction], templates: Sequence[str]) -> list[DefinedFunction]:
    """Return the functions that a call with such template arguments may mean.

    That is the specialisation for them, else those that are for no certain arguments. A call without any may mean each.
    """
    if not templates or not any(one.what.specialised for one in found):
        return found
    wanted = tuple(map(_plain_type, templates))
    same = [one for one in found if tuple(map(_plain_type, one.what.specialised)) == wanted]
    return same or [one for one in found if not one.what.specialised]


def _plain_type(written: str) -> str:
    """Return a type in one way of writing, as far as types are often written in two."""
    plain = _STANDARD.sub("", "".join(written.replace(".", "::").split()))
    return _SAME_TYPES.get(plain, plain)


def _line(one: DefinedFunction) -> int:
    return one.what.line


def _near(index: SymbolTable, found: list[DefinedFunction], at: tuple[str, str]) -> dict[tuple[str, int], Near]:
    """Return how the file that calls knows functions, those that it does not know left out."""
    path, unit = at
    program = index.programs.get(path)
    known = index.linkage.near if program is not None and program.dialect.linkage else None
    near: dict[tuple[str, int], Near] = {}
    for one in found:
        what = one.what
        if what.class_name or known is None:
            near[one.path, what.line] = Near.OWN
        elif (how := known(path, one.path, unit, local=what.local)) is not None:
            near[one.path, what.line] = how
    return near


def taking(index: SymbolTable, found: list[DefinedFunction], count: int) -> list[DefinedFunction]:
    """Return the functions that take so many arguments."""
    return [one for one in found if count <= len(one.what.parameters) and _least(index, one.what, one.path) <= count]


def known_function(index: SymbolTable, found: list[DefinedFunction], at: tuple[str, str]) -> DefinedFunction | None:
    """Return the function of a name that a file knows best, see :func:`overload`; None where several are as near."""
    near = _near(index, found, at)
    known = [one for one in found if (one.path, _line(one)) in near]
    if not known:
        return None
    nearest = min(near[one.path, _line(one)] for one in known)
    best = [one for one in known if near[one.path, _line(one)] is nearest]
    return best[0] if nearest < Near.LINKED or len({one.path for one in best}) == 1 else None


def taking_so_many(index: SymbolTable, callback: Callable, count: int) -> Callable:
    """Return a callback, or one of its name that takes so many arguments where it does not."""
    function = callback.function
    if len(function.parameters) == count or function.name == "lambda":
        return callback
    several = index.functions_of(function.qualified_name, callback.path, "")
    near = _near(index, several, (callback.path, "")) if len(several) > 1 else {}
    found = [one for one in taking(index, several, count) if (one.path, _line(one)) in near]
    if not found:
        return callback
    return Callable(found[0].what, found[0].path, callback.self, callback.names, callback.arguments)


def _least(index: SymbolTable, function: Function, path: str) -> int:
    """Return how many arguments a function needs, of which its declaration may have defaults."""
    declared = index.declaration(function, path) or function
    pairs = zip(function.parameters, declared.parameters, strict=True)
    return sum(own.default is None and other.default is None for own, other in pairs)


def fit(one: DefinedFunction, arguments: Sequence[Value]) -> int:
    """Return how well a function fits to arguments; what is unknown fits anywhere."""
    return sum(_fit(parameter.type, value) for parameter, value in zip(one.what.parameters, arguments, strict=False))


def _fit(declared: str, value: Value) -> int:
    name = type_name(declared)[0].rpartition(".")[2] if declared else ""
    if not name or name in ("auto", "T"):
        return 0
    match value:
        case Text():
            # A text with a hole may be any parameter.
            return _best(name, _TEXTS, unfit=frozenset() if value.holes else NUMBER_TYPES)
        case bool():
            return _fit_of_truth(name, value=value)
        case int() | float():
            return _best(name, NUMBER_TYPES, unfit=_TEXTS)
        case Handle():
            return _best(name, _HANDLES, unfit=_PLAIN)
        case Obj():
            return 2 * _FITS if name == value.type.rpartition(".")[2] else _best(name, unfit=_PLAIN | _HANDLES)
        case Callable():
            return _best(name, unfit=_PLAIN)
    return 0


def _best(name: str, fit: frozenset[str] = frozenset(), *, unfit: frozenset[str]) -> int:
    return _FITS if name in fit else _UNFIT if name in unfit else 0


def _fit_of_truth(name: str, *, value: bool) -> int:
    if name in _TAGS:
        return 2 * _FITS if _TAGS[name] is value else _UNFIT
    if name == "bool":
        return 2 * _FITS
    return _FITS if name in NUMBER_TYPES else _UNFIT
