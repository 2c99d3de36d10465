"""Executable lines."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FunctionFacts

QUANTITY = Quantity(
    key="eloc",
    title="Executable lines",
    unit="lines",
    kinds=(EntityKind.FUNCTION,),
    text="Lines of a function's body that contain executable code.",
    folds=(Fold.SUM, Fold.MAX),
    formula="number of lines of the body that contain a token of an executable construct: an expression, a condition, "
    "a jump, a declaration with an initialiser. Lines with nothing but brackets and punctuation, `else`, `try`, `do` "
    "or `finally`, labels, preprocessor directives, comments, docstrings and declarations without initialiser do not "
    "count",
    source="STXLN of the HIS and KTH models as QA-C measures it (number of executable lines)",
    limits="Arms of `#if` and lambdas always count for the enclosing function, regardless of the options. A "
    "declaration whose constructor runs code (`std::lock_guard lock(m);`) has arguments and counts; `Foo foo;` does "
    "not.",
)


def of_function(facts: FunctionFacts, _counting: CountingSettings) -> float:
    """Return the number of executable lines of a function."""
    return facts.eloc
