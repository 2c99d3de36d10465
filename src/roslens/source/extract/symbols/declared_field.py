"""How a member of a class is declared."""

from __future__ import annotations

from roslens.source.extract.symbols.workspace_index import Defined, Index


def declared_field(index: Index, defined: Defined | None, name: str) -> str:
    """Return the declared type of a member of a class; empty where neither it nor a base declares it."""
    for one in index.chain(defined) if defined else ():
        for field in getattr(one.what, "fields", ()):
            if field.name == name:
                return str(field.type)
    return ""
