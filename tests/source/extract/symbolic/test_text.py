from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.symbolic.reason import NamePart, OfNode, OfParameter
from roslens.source.extract.symbolic.text import Choice, Hole, IsTrue, Not, Text, Written, unknown

HOLES = st.builds(Hole, st.sampled_from(["argument", "parameter"]), default=st.none() | st.text(max_size=3))
PARTS = st.lists(st.text(max_size=3) | HOLES, max_size=6)


def test_known_pieces_are_joined_and_holes_kept():
    text = Text.of("/", "robot", Hole('argument "n"'), "", "/sc", Text.of("an"))
    assert text.parts == ("/robot", Hole('argument "n"'), "/scan")
    assert text.pattern == "/robot*/scan"
    assert str(text) == '/robot{argument "n"}/scan'
    assert text.known is None
    assert text.usual is None


def test_defaults_of_holes_make_the_usual_text():
    text = Text.of("/", unknown('parameter "topic"', parameter="topic", default="scan"))
    assert text.usual == "/scan"
    assert text.holes[0].parameter == "topic"


@given(PARTS)
def test_joining_keeps_order_and_is_stable(parts):
    text = Text.of(*parts)
    assert Text.of(text) == text
    assert text.pattern == "".join(part if isinstance(part, str) else "*" for part in parts)
    assert (text.known is None) == bool(text.holes)
    assert not any(isinstance(a, str) and isinstance(b, str) for a, b in zip(text.parts, text.parts[1:], strict=False))


def test_the_name_of_a_node_counts_with_what_is_below_it_only():
    whole = Hole(OfNode(NamePart.FULL_NAME), default="~")
    assert Text.of(whole, "/x").usual == "~/x"
    assert Text.of(whole).usual == "~"
    assert Text.of(whole, "x").usual is None
    assert Text.of("x", whole).usual is None
    assert Text.of("~", Hole(OfParameter("a"), "a", "b")).usual == "~b"


def test_holes_are_changed_in_choices_too():
    hole = Hole("a")
    test = Not(IsTrue(Text((hole,))))
    text = Text((Hole("one or the other", choice=(Choice(Written("c"), Text((hole,)), Text.of("b"), (test,)),)),))
    changed = text.mapped(lambda one: Text.of("known") if one == hole else one)
    (choice,) = changed.holes[0].choice
    assert (str(choice.then), str(choice.otherwise)) == ("known", "b")
    assert choice.test[0] == Not(IsTrue(Text.of("known")))
    assert Text.of("a").mapped(lambda one: one) == Text.of("a")


def test_what_doubles_again_and_again_ends():
    text, open_ = Text.of("x"), Text.of("x", Hole("y"))
    for _ in range(100):
        text, open_ = Text.of(text, text), Text.of(open_, open_)
    assert [str(one)[:30] for one in (text, open_)] == ["{a string that is too long to "] * 2


def test_what_a_text_begins_and_ends_with():
    hole = Hole("a")
    text = Text.of("/x/", hole, "/y")
    assert (text.head, text.tail, text.is_global, text.only) == ("/x/", "/y", True, None)
    assert (Text((hole,)).head, Text((hole,)).tail, Text((hole,)).only) == ("", "", hole)
    assert (Text().head, Text().tail, Text().is_global, Text().only) == ("", "", False, None)
