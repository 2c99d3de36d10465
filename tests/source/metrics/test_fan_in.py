from __future__ import annotations

from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.object_oriented import fan_in
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import ClassFacts

FACTS = ClassFacts("Arm", "arm::Arm", "class", 1, 1, 9)


def test_only_clients_count():
    subject = ClassInPackage(FACTS, suppliers=frozenset({"a"}), clients=frozenset({"b", "c"}))
    assert fan_in.of_class(subject, CountingSettings()) == 2
