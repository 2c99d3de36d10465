from roslens.source.extract.domain.abstract_value import Named, NodeBuilder, Obj, Unknown, as_text
from roslens.source.extract.symbolic.text import Text


def test_values_as_text():
    assert [as_text(one).known for one in (Text.of("a"), True, False, 3, 1.5)] == ["a", "true", "false", "3", "1.5"]
    assert [as_text(one).holes[0].reason for one in (Unknown("why"), Named("x.y"), Obj("T"), None)] == [
        "why",
        "the value of x.y",
        "a T",
        "a value that is not a string",
    ]


def test_facts_of_what_is_built():
    building = NodeBuilder("A", "a.cpp", 3, "ros2")
    building.uses += ["B", "B"]
    facts = building.facts()
    assert (facts.unit, facts.path, facts.line, facts.generation, facts.uses) == ("A", "a.cpp", 3, "ros2", ("B",))


def test_lists_of_one_are_not_those_of_another():
    one, other = NodeBuilder("A", "a", 1, "ros2"), NodeBuilder("B", "b", 1, "ros2")
    one.uses.append("x")
    assert other.uses == []
