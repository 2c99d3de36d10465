from __future__ import annotations

from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.object_oriented import dit
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import ClassFacts

FACTS = ClassFacts("Arm", "arm::Arm", "class", 1, 1, 9)


def test_it_is_the_depth():
    assert dit.of_class(ClassInPackage(FACTS, depth=3), CountingSettings()) == 3
