from __future__ import annotations

from msgspec.structs import replace

from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.object_oriented import mac
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import ClassFacts, MethodFacts

FACTS = ClassFacts("Arm", "arm::Arm", "class", 1, 1, 9)


def test_what_is_not_private_is_available():
    declared = tuple(MethodFacts("move", "()", access) for access in ("public", "protected", "private", "public"))
    assert mac.of_class(ClassInPackage(replace(FACTS, methods=declared)), CountingSettings()) == 3
