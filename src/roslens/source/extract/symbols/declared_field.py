"""How a member of a class is declared."""

from __future__ import annotations

from roslens.source.extract.symbols.symbol_table import Defined, SymbolTable


def declared_field(index: SymbolTable, defined: Defined | None, name: str) -> str:
    """Return the declared type of a member of a class; empty where neither it nor a base declares it."""
    for one in index.chain(defined) if defined else ():
        for field in one.what.fields:
            if field.name == name:
                return str(field.type)
    return ""
