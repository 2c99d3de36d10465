"""What Python does not compile is reported, and nothing that it compiles."""

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.match_file import match_file
from roslens.source.settings import MacroSettings


def reported(text):
    view = parse_file(text.encode(), Language.PYTHON, MacroSettings()).view()
    return [(hit.line, hit.message) for hit in match_file(view).hits if hit.rule == "python.syntax"]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("x = (1,\ny = 2\n", 1),
        ("x = [1 2]\n", 1),
        ("def f()\n    pass\n", 1),
        ("def f():\nx = 1\n", 2),
        ("def f(a, a):\n    pass\n", 1),
        ("x = 1\nreturn x\n", 2),
        ("if x:\n    y = 1\n  z = 2\n", 3),
        ("x = 'abc\ny = 2\n", 1),
        ("f(a=1, 2)\n", 1),
        ("rate = 010\n", 1),
        ("f() = 1\n", 1),
        ("for a in b:\n    pass\ncontinue\n", 3),
    ],
)
def test_the_line_at_which_the_compiler_stops(text, line):
    assert [found for found, _ in reported(text)] == [line]


@pytest.mark.parametrize(
    "text",
    [
        "x = (1,\n     2)\n",
        "match x:\n    case 1:\n        pass\n",
        "f'{a[\"x\"]}'\n",
        "print 'x'\ny = (1\n",
        "x = '\\d'\n",
        "a is 1\n",
        "\0x = 1\n",
        "(" * 3000,
        "",
        "{% for x in y %}\ny = {{ x }}\n{% endfor %}\n",
        "class @(name):\n    pass\n",
    ],
)
def test_what_another_rule_tells_or_a_template_writes_is_not_reported(text):
    assert reported(text) == []


def test_a_merge_conflict_is_named():
    ((line, message),) = reported("a = 1\n<<<<<<< HEAD\nb = 1\n=======\nb = 2\n>>>>>>> other\n")
    assert line == 2
    assert "a merge conflict that is not resolved" in message
