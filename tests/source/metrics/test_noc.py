from __future__ import annotations

from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.object_oriented import noc
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import ClassFacts

FACTS = ClassFacts("Arm", "arm::Arm", "class", 1, 1, 9)


def test_it_is_the_number_of_children():
    assert noc.of_class(ClassInPackage(FACTS, children=frozenset({"a", "b"})), CountingSettings()) == 2
