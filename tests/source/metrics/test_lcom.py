from __future__ import annotations

import pytest
from msgspec.structs import replace

from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.object_oriented import lcom
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import ClassFacts, FieldFacts

FACTS = ClassFacts("Arm", "arm::Arm", "class", 1, 1, 9)


FIELDS = replace(FACTS, fields=(FieldFacts("x"), FieldFacts("y"), FieldFacts("z")))


@pytest.fixture
def parts(function_of):
    def count(**uses: str) -> float | None:
        bodies = tuple(function_of(name=name, identifiers=tuple(used.split())) for name, used in uses.items())
        return lcom.of_class(ClassInPackage(FIELDS, bodies=bodies), CountingSettings())

    return count


def test_a_shared_field_joins(parts):
    assert parts(a="x", b="x y", c="y") == 1
    assert parts(a="x", b="y", c="z") == 3


def test_a_call_joins(parts):
    assert parts(a="x b", b="y", c="z") == 2
    assert parts(a="", b="a", c="b") == 1


def test_other_names_join_nothing(parts):
    assert parts(a="i", b="i") == 2


def test_makers_and_destroyers_join_nothing(function_of):
    names = ("Arm", "~Arm", "__init__", "a", "b")
    bodies = [function_of(name=name, identifiers=("x", "y") if name[0] not in "ab" else (name,)) for name in names]
    assert lcom.of_class(ClassInPackage(FIELDS, bodies=tuple(bodies)), CountingSettings()) == 2


def test_overloads_are_one_part(function_of):
    bodies = (function_of(name="a", identifiers=("x",)), function_of(name="a", identifiers=("y",)))
    assert lcom.of_class(ClassInPackage(FIELDS, bodies=bodies), CountingSettings()) == 1


def test_without_bodies_there_is_none(function_of):
    assert lcom.of_class(ClassInPackage(FIELDS), CountingSettings()) is None
    assert lcom.of_class(ClassInPackage(FIELDS, bodies=(function_of(name="Arm"),)), CountingSettings()) is None
