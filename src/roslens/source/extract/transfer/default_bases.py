"""Which bases a constructor of C++ constructs without saying so: by their constructors that take no arguments."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.source.extract.ir.program import Call, Class, Evaluate, Function, Name
from roslens.source.extract.symbols.symbol_table import Defined, SymbolTable
from roslens.source.extract.transfer.overload_choice import taking


def bases_by_default(index: SymbolTable, defined: Defined, constructor: Function) -> Iterator[Defined]:
    """Yield the bases of a class in the workspace that no initialiser of a constructor names, in order.

    None where it delegates to another constructor, or a base has none that takes no arguments: it is named otherwise.
    """
    if not isinstance(defined.what, Class) or not defined.what.bases:
        return
    named = {
        one.expression.function.name.rpartition(".")[2]
        for one in constructor.initialisers
        if isinstance(one, Evaluate) and isinstance(one.expression, Call) and isinstance(one.expression.function, Name)
    }
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
