"""An index of programs that knows which names the vocabulary gives a meaning."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from roslens.source.extract.interpreter.vocabulary import known_names
from roslens.source.extract.ir.program import Program
from roslens.source.extract.symbols.included_files import Needs, Packages
from roslens.source.extract.symbols.symbol_table import SymbolTable

if TYPE_CHECKING:
    from roslens.source.extract.facts.node_facts import Target


def indexed(
    programs: Mapping[str, Program],
    packages: Packages | None = None,
    needs: Needs | None = None,
    targets: Iterable[Target] = (),
) -> SymbolTable:
    """Return an index of the programs of a workspace.

    See :class:`~roslens.source.extract.symbols.symbol_table.Index`.
    """
    return SymbolTable(programs, packages, needs, targets, known=known_names())
