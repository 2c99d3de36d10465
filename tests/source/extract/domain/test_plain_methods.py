import pytest

from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.domain.plain_methods import formatted, plain_method
from roslens.source.extract.domain.table_key import hashable
from roslens.source.extract.symbolic.reason import NamePart, OfNode, OfParameter
from roslens.source.extract.symbolic.text import Hole, Text


@pytest.mark.parametrize(
    ("of", "name", "arguments", "result"),
    [
        (Text.of("a"), "c_str", [], Text.of("a")),
        (Text.of("a"), "append", [Text.of("b")], Text.of("ab")),
        (Text.of(""), "empty", [], True),
        (Text.of("abc"), "size", [], 3),
        (Text.of("{}-{}"), "format", [Text.of("a"), 2], Text.of("a-2")),
        (Text.of("/"), "join", [[Text.of("a"), Text.of("b")]], Text.of("a/b")),
        ([1, 2], "front", [], 1),
        ([1, 2], "back", [], 2),
        ([], "empty", [], True),
        ({Text.of("k"): 1}, "get", [Text.of("k")], 1),
        ({Text.of("k"): 1}, "at", [Text.of("k")], 1),
        ({"k": 1}, "items", [], [["k", 1]]),
        ({"k": 1}, "keys", [], ["k"]),
        ({"k": 1}, "values", [], [1]),
    ],
)
def test_what_they_give(of, name, arguments, result):
    assert plain_method(of, name, arguments) == result


def test_what_is_not_known_says_so():
    assert plain_method(Text.of("a"), "swap", [0]) == Unknown("swap of a string")
    assert plain_method([], "find", []) == Unknown("find of a list")
    assert plain_method({}, "merge", []) == Unknown("merge()")
    assert plain_method(Unknown("why"), "anything", []) == Unknown("why")
    assert plain_method(3, "anything", []) == Unknown("result of anything()")


def test_lists_grow():
    values = [1]
    assert plain_method(values, "push_back", [2]) is None
    assert values == [1, 2]


def test_values_that_are_missing_are_holes():
    assert str(formatted(Text.of("%s/%s"), [Text.of("a")])) == "a/{a value that is missing}"


def test_what_cannot_be_a_key_is_its_text():
    assert hashable([1]) == "[1]"
    assert hashable(Text.of("a")) == Text.of("a")


SPACE = Hole(OfNode(NamePart.NAMESPACE), default="")
TOPIC = Hole(OfParameter("topic"), "topic")


def said(*parts):
    return lambda name, *arguments: plain_method(
        Text.of(*parts), name, [Text.of(one) if isinstance(one, str) else one for one in arguments]
    )


def test_parts_of_texts():
    of = said("/robot/scan")
    assert (of("find", "scan"), of("rfind", "/"), of("find", "x")) == (7, 6, -1)
    assert (of("substr", 7), of("substr", 0, 6), of("front")) == (Text.of("scan"), Text.of("/robot"), Text.of("/"))
    assert (of("empty"), said("")("empty"), of("back")) == (False, True, Text.of("n"))
    assert (of("starts_with", "/"), of("endswith", "scan"), of("compare", "/robot/scan")) == (True, True, 0)
    assert said("/a", TOPIC)("substr", 1) == Text.of("a", TOPIC)
    assert said("/a", TOPIC)("starts_with", "/") is True
    assert said(TOPIC)("substr", 1).holes[0].parameter == "topic"
    assert isinstance(said(TOPIC)("find", "/"), Unknown)
    assert isinstance(said(TOPIC)("back"), Unknown)
    assert isinstance(said(TOPIC)("empty"), Unknown)


def test_a_namespace_is_never_empty_and_begins_with_a_separator():
    of = said(SPACE)
    assert (of("empty"), of("front")) == (False, Text.of("/"))
    place = of("rfind", "/")
    assert of("substr", 0, place) == Text((Hole(OfNode(NamePart.ABOVE), default=""),))


@pytest.mark.parametrize(
    ("name", "arguments", "result"),
    [
        ("lower", [], Text.of("a/b")),
        ("strip", [Text.of("A")], Text.of("/B")),
        ("replace", [Text.of("/"), Text.of("_")], Text.of("A_B")),
        ("split", [Text.of("/")], [Text.of("A"), Text.of("B")]),
        ("partition", [Text.of("/")], [Text.of("A"), Text.of("/"), Text.of("B")]),
    ],
)
def test_methods_of_python_are_applied(name, arguments, result):
    assert plain_method(Text.of("A/B"), name, arguments) == result


def test_what_is_unknown_is_not_stripped_of_signs():
    namespace = Text((Hole(OfParameter("ns"), "ns"),))
    assert plain_method(namespace, "strip", []) == namespace
    (hole,) = plain_method(namespace, "strip", [Text.of("/")]).holes
    assert (hole.reason, hole.parameter) == ("strip of {parameter ns}", "ns")
    assert plain_method(Text.of("a" * 9_000), "replace", [Text.of("a"), Text.of("b" * 9_000)]).holes
