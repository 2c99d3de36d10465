"""What lowering a Python file knows while it reads."""

from roslens.source.extract.lowering.python.python_program_reading import DEEPEST, Reading
from roslens.source.syntax.python_tree import parse_tree


def test_places_and_texts():
    content = b"a\nb  .\\\n c # d\n"
    reading = Reading(content)
    first, second, comment = parse_tree(content).tree.root_node.children
    assert [reading.line(node) for node in (first, second, comment)] == [1, 2, 3]
    assert reading.text(first) == "a"
    assert reading.squeezed(second) == "b .\\ c"
    assert reading.squeezed(None) == ""
    assert comment.type == "comment"
    assert [reading.text(node) for node in reading.parts(second)] == ["b  .\\\n c"]


def test_notes_are_kept_once():
    content = b"a\n\nb\n"
    reading = Reading(content)
    node = parse_tree(content).tree.root_node.children[1]
    reading.note(node, "no")
    reading.note(node, "no")
    assert reading.incomplete == {(3, "no")}
    assert DEEPEST > 10
