"""Which bases a constructor of C++ constructs implicitly: by their default constructors."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.source.extract.ir.program import Call, Evaluate, Function, Name, Statement
from roslens.source.extract.symbols.symbol_table import Defined, SymbolTable
from roslens.source.extract.transfer.overload_choice import taking


def bases_by_default(index: SymbolTable, defined: Defined, constructor: Function) -> Iterator[Defined]:
    """Yield the bases of a class in the workspace that no initialiser of a constructor names, in order.

    None where it delegates to another constructor, or a base has none that takes no arguments: it is named otherwise.
    """
    if not defined.what.bases:
        return
    named = set(_named_bases(constructor.initialisers))
    if defined.what.name in named or len(named) >= len(defined.what.bases):
        return
    scope = defined.what.qualified_name.rpartition(".")[0]
    for written in defined.what.bases:
        base = index.class_of(written, defined.path, scope)
        if base is None or {written.rpartition(".")[2], base.what.name} & named:
            continue
        constructors = index.methods(base, base.what.name)
        if not constructors or taking(index, constructors, 0):
            yield base


def _named_bases(initialisers: tuple[Statement, ...]) -> Iterator[str]:
    for one in initialisers:
        match one:
            case Evaluate(expression=Call(function=Name(name=name))):
                yield name.rpartition(".")[2]
