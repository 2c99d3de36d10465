import pytest

from roslens.source.extract.facts.environment_defaults import supposed, supposed_place, supposed_rule, with_defaults
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.facts.resolve_name import Place, Rule
from roslens.source.extract.symbolic.reason import OfEnvironment, OfParameter
from roslens.source.extract.symbolic.text import Hole, Text


def variable(name, default=None):
    return Hole(OfEnvironment(name), default=default)


@pytest.mark.parametrize(
    ("text", "pattern", "words"),
    [
        (Text.of("/a"), "/a", ()),
        (Text.of("/", variable("R", "r1"), "/a"), "/r1/a", ("default of environment R",)),
        (Text.of(variable("R", "r"), variable("R", "r")), "rr", ("default of environment R",)),
        (Text.of(variable("R", "/r1"), "/a"), "/r1/a", ("default of environment R",)),
        (Text.of("/b/", variable("R", "/r1")), "/b/*", ()),
        (Text.of("/", variable("R")), "/*", ()),
        (Text.of(variable("R", "r"), "/", variable("S")), "r/*", ("default of environment R",)),
        (Text.of(Hole(OfParameter("a"), "a", "x")), "*", ()),
        (Text.of(Hole("result of f()", default="x")), "*", ()),
    ],
)
def test_only_defaults_of_the_environment_stand_in_place_of_holes(text, pattern, words):
    found, why = supposed(text)
    assert (found.pattern, why) == (pattern, words)


def test_a_place_is_below_the_default_of_its_namespace():
    space = Text.of("/", variable("R", "r1"))
    found = supposed_place(Place(space, Text.of(space, "/n"), "ros2"))
    assert (found.namespace.known, found.node.known) == ("/r1", "/r1/n")
    assert found.supposed == ("default of environment R",)


def test_a_namespace_may_be_empty_and_a_name_may_not():
    space = Text.of("/", variable("R", ""))
    found = supposed_place(Place(space, Text.of(space, "/n"), "ros1"))
    assert (found.namespace.known, found.node.known) == ("/", "/n")
    nameless = Place(Text.of("/"), space, "ros1")
    assert supposed_place(nameless) is nameless


def test_a_remapping_says_which_of_its_names_is_supposed():
    rule = Rule(Text.of("a"), Text.of(variable("T", "scan")), Evidence("a.launch", 1))
    found, of_source, of_target = supposed_rule(rule)
    assert found.target.known == "scan"
    assert (of_source, of_target) == ((), ("default of environment T",))


def test_a_default_in_words():
    text = Text.of("/", variable("R", "r1"), "/", variable("S"), "/", Hole(OfParameter("a"), "a", "x"))
    assert with_defaults(text) == "/{environment R, 'r1' where that is not set}/{environment S}/{parameter a}"
