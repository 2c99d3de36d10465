from __future__ import annotations

from msgspec.structs import replace

from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.object_oriented import methods
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import ClassFacts, MethodFacts

FACTS = ClassFacts("Arm", "arm::Arm", "class", 1, 1, 9)


def test_every_overload_counts():
    facts = replace(FACTS, methods=(MethodFacts("move", "(int)"), MethodFacts("move", "(double)")))
    assert methods.of_class(ClassInPackage(facts), CountingSettings()) == 2
