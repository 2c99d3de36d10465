from __future__ import annotations

from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.object_oriented import cbo
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import ClassFacts

FACTS = ClassFacts("Arm", "arm::Arm", "class", 1, 1, 9)


def test_a_class_that_is_used_and_uses_counts_once():
    subject = ClassInPackage(FACTS, suppliers=frozenset({"a", "b"}), clients=frozenset({"b", "c"}))
    assert cbo.of_class(subject, CountingSettings()) == 3


def test_alone_is_zero():
    assert cbo.of_class(ClassInPackage(FACTS), CountingSettings()) == 0
