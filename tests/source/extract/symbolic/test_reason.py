import msgspec
import pytest

from roslens.source.extract.symbolic.reason import (
    MAKER,
    EachOf,
    ItemOf,
    NamePart,
    NotSet,
    OfController,
    OfEnvironment,
    OfHandle,
    OfMany,
    OfNode,
    OfParameter,
    PartOf,
    RandomEnd,
    Reason,
    for_node,
    is_of_many,
    node_of_reason,
)
from roslens.source.extract.symbolic.text import Hole, Text, said

REASONS = [
    ("result of read()", "result of read()"),
    (OfNode(NamePart.NAME), "name of the node"),
    (OfNode(NamePart.FULL_NAME, 2), "full name of the node no. 2"),
    (OfNode(NamePart.NAMESPACE, MAKER), "namespace of the node that creates it"),
    (OfNode(NamePart.ABOVE), "namespace above the node"),
    (OfParameter("topic"), "parameter topic"),
    (OfParameter("topic", 2), "parameter topic of node no. 2"),
    (OfParameter("topic", MAKER), "parameter topic of the node that creates it"),
    (OfHandle(OfParameter("ns")), "namespace of the handle: parameter ns"),
    (OfController(), "namespace of the controller"),
    (EachOf(OfParameter("names")), "each of parameter names"),
    (ItemOf(-1, OfParameter("names")), "item -1 of parameter names"),
    (PartOf("type", EachOf(OfParameter("names"))), "type of each of parameter names"),
    (OfEnvironment("ROBOT"), "environment ROBOT"),
    (RandomEnd(), "random end"),
    (NotSet("topic_"), "topic_, which is not set"),
    (OfMany("one of many strings, by x"), "one of many strings, by x"),
]


@pytest.mark.parametrize(("reason", "text"), REASONS)
def test_a_reason_is_written_and_kept(reason, text):
    assert str(reason) == text
    assert msgspec.msgpack.decode(msgspec.msgpack.encode(reason), type=Reason) == reason


def test_reasons_have_an_order():
    in_order = sorted((reason for reason, _ in REASONS), key=str)
    assert sorted(reason for reason, _ in reversed(REASONS)) == in_order


def test_the_node_that_decides_is_found_in_what_is_made_of_its_parameter():
    whole = PartOf("type", EachOf(ItemOf(1, OfParameter("names", 2))))
    assert node_of_reason(whole) == 2
    assert for_node(whole, MAKER) == PartOf("type", EachOf(ItemOf(1, OfParameter("names", MAKER))))
    assert for_node(OfHandle(OfNode(NamePart.NAME)), 3) == OfHandle(OfNode(NamePart.NAME, 3))
    assert (node_of_reason("read()"), for_node("read()", 3)) == (0, "read()")


def test_what_is_made_of_one_of_many_texts_is_one():
    many = OfMany("one of many strings, by x")
    assert is_of_many(EachOf(many))
    assert not is_of_many(EachOf("x"))
    assert said("a part of ", Text((Hole(many),))) == OfMany("a part of {one of many strings, by x}")
    assert said("a part of ", Text((Hole("x"),)), most=8) == "a part o"
