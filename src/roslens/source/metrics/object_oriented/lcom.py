"""Lack of cohesion of methods (LCOM4)."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FunctionFacts

QUANTITY = Quantity(
    key="lcom",
    title="Lack of cohesion (LCOM4)",
    unit="parts",
    kinds=(EntityKind.CLASS,),
    text="Into how many unrelated parts a class falls; 1 is a cohesive class.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="number of connected components of the graph whose nodes are the methods with a body, without "
    "constructors and destructors, and whose edges join two methods that use the same field of the class or of which "
    "one calls the other",
    source="Hitz and Montazeri, Measuring Coupling and Cohesion in Object-Oriented Systems, 1995",
    limits="By name: a local variable named like a field joins methods. Inherited fields join none. Absent where no "
    "such method has a body.",
    minimum=1,
    decimals=1,
)

_MAKERS_OF_PYTHON = frozenset({"__init__", "__new__", "__del__"})


def of_class(subject: ClassInPackage, _counting: CountingSettings) -> float | None:
    """Return the number of parts of a class, None where no method has a body."""
    own_name = subject.facts.name
    bodies = [body for body in subject.bodies if not _makes_or_destroys(body, own_name)]
    if not bodies:
        return None
    shared = {field.name for field in subject.facts.fields} | {body.name for body in bodies}
    return _components([{body.name} | shared.intersection(body.identifiers) for body in bodies])


def _makes_or_destroys(body: FunctionFacts, class_name: str) -> bool:
    return body.name == class_name or body.name.startswith("~") or body.name in _MAKERS_OF_PYTHON


def _components(groups: Sequence[set[str]]) -> int:
    members: defaultdict[str, list[int]] = defaultdict(list)
    for number, group in enumerate(groups):
        for name in group:
            members[name].append(number)
    unseen = set(range(len(groups)))
    components = 0
    while unseen:
        components += 1
        reached = [unseen.pop()]
        while reached:
            for name in groups[reached.pop()]:
                near = unseen.intersection(members.pop(name, ()))
                unseen -= near
                reached.extend(near)
    return components
