"""Files of Python that no Python can read."""

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.match_file import match_file
from roslens.source.settings import MacroSettings

FAULT = "import rclpy\nnode.create_publisher(State, 'arm-state', 10)\n"


def rules_in(text):
    view = parse_file(text.encode(), Language.PYTHON, MacroSettings()).view()
    return {hit.rule for hit in match_file(view).hits}


@pytest.mark.parametrize(
    "end",
    [
        "def later():\n    # comes\n",
        "class Later:\n\nx = 1\n",
        "if x:\n    # comes\nelse:\n    y()\n",
        "try:\n    x()\nexcept E:\n\n",
        "for x in y:",
        "open(('a')\n",
    ],
)
def test_what_it_would_do_is_not_said_of_a_file_that_cannot_be_read(end):
    assert "node.topic_name_python" not in rules_in(FAULT + end)


@pytest.mark.parametrize(
    "end",
    [
        'def later():\n    """Comes."""\n',
        "def later():\n    # comes\n    ...\n",
        "def later(): pass\n",
        "x = {\n    1:\n    2}\n",
        'x = """if x:\n"""\n',
        "match x:\n    case 1:\n        pass\n",
        "print 'x'\ndef later():\n    # comes\n",
    ],
)
def test_it_is_said_of_files_that_python_3_or_2_reads(end):
    assert "node.topic_name_python" in rules_in(FAULT + end)


def test_what_is_secret_is_said_of_a_file_that_cannot_be_read():
    text = "import rclpy\npassword = 'hV7kq2LmX9'\nlogin('ada', password='hV7kq2LmX9')\n"
    known = {rule for rule in rules_in(text) if rule.startswith("node.credential")}
    assert known
    assert known <= rules_in(text + "def later():\n")
