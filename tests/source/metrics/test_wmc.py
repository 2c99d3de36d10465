from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.object_oriented import wmc
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import ClassFacts, MethodFacts

FACTS = ClassFacts("Arm", "arm::Arm", "class", 1, 1, 9)


def declared(*names: str) -> ClassFacts:
    return replace(FACTS, methods=tuple(MethodFacts(name, "()") for name in names))


def test_methods_without_a_body_count_one(function_of):
    body = function_of("if\nfor", name="move")
    subject = ClassInPackage(declared("Arm", "move", "move", "stop"), bodies=(body,))
    assert wmc.of_class(subject, CountingSettings()) == 3 + 3


def test_a_body_that_the_class_does_not_declare_counts_all_the_same(function_of):
    assert wmc.of_class(ClassInPackage(FACTS, bodies=(function_of("if", name="move"),)), CountingSettings()) == 2


def test_options_reach_the_complexity(function_of):
    subject = ClassInPackage(FACTS, bodies=(function_of("lambda\n  if", name="move"),))
    assert wmc.of_class(subject, CountingSettings()) == 2
    assert wmc.of_class(subject, CountingSettings(lambdas=False)) == 1


@given(st.lists(st.sampled_from("abcd")), st.lists(st.sampled_from("abcd")))
def test_it_is_at_least_the_number_of_methods(function_of, names, with_body):
    subject = ClassInPackage(declared(*names), bodies=tuple(function_of("if", name=name) for name in with_body))
    assert wmc.of_class(subject, CountingSettings()) >= len(names)
