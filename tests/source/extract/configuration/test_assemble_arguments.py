from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.configuration.assemble_arguments import command_line, split_once
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.text import Hole, Text

HERE = Evidence("a.launch", 1)


def line(text: str, generation: str = "ros2"):
    return command_line([Text.of(word) for word in text.split()], generation, HERE)


def test_words_of_ros2_hold_between_their_marks():
    found = line(
        "--x a --ros-args -r a:=b --remap n:c:=d -p rate:=5 -p other:q:=1 --params-file f.yaml --log-level debug -- y"
    )
    assert [(one.node, one.source.known, one.target.known) for one in found.rules] == [("", "a", "b"), ("n", "c", "d")]
    assert [(one.node, one.name.known, one.value.known, one.type) for one in found.settings] == [
        ("", "rate", "5", "int"),
        ("/**/other", "q", "1", "int"),
    ]
    assert [one.known for one in found.files] == ["f.yaml"]
    assert [one.known for one in found.rest] == ["--x", "a", "y"]


def test_words_of_ros1():
    found = line("in a:=b _rate:=5 __name:=n", "ros1")
    assert [(one.source.known, one.target.known) for one in found.rules] == [("a", "b"), ("__name", "n")]
    assert [(one.name.known, one.value.known) for one in found.settings] == [("~rate", "5")]
    assert [one.known for one in found.rest] == ["in"]


def test_holes_stay():
    hole = Hole("argument t")
    assert split_once(Text.of("a:=", hole), ":=") == (Text.of("a"), Text((hole,)))
    assert split_once(Text((hole,)), ":=") is None


@given(st.lists(st.sampled_from(["--ros-args", "-r", "-p", "--", "a:=b", "x", "--params-file", ":="]), max_size=8))
def test_any_words_can_be_read(words):
    for generation in ("ros1", "ros2"):
        command_line([Text.of(word) for word in words], generation, HERE)
