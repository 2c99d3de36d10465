"""One parse answers for metrics and for the graph, with what two parses would say."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.source import Language
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.measure.analyse_file import analyse_file
from roslens.source.parsed_file import macro_preset, parse_file
from roslens.source.settings import MacroSettings

MACROS = MacroSettings(blank=("HOT",))

CPP = (
    b'#include "rclcpp/rclcpp.hpp"\nHOT int f() { return 1; }\n'
    b'int main() { auto p = node->create_publisher<std_msgs::msg::String>("chatter", 10); }\n'
    b"RCLCPP_COMPONENTS_REGISTER_NODE(a::B)\n"
)
PYTHON = b"import rospy\r\rdef f():\n    return rospy.Publisher('a' + 'b', String, queue_size=1)\n"


@given(st.one_of(st.just(CPP), st.text("{}()<>;ab\"'#\n \\", max_size=60).map(str.encode), st.binary(max_size=60)))
def test_of_cpp(content: bytes):
    parsed = parse_file(content, Language.CPP, MACROS)
    assert parsed.program() == program_of_cpp(content, macro_preset(MACROS))
    assert parsed.facts() == analyse_file(content, Language.CPP, MACROS).facts


@given(st.one_of(st.just(PYTHON), st.text("()[]:ab=\"'#\n \r", max_size=60).map(str.encode), st.binary(max_size=60)))
def test_of_python(content: bytes):
    parsed = parse_file(content, Language.LAUNCH_PYTHON, MACROS)
    assert parsed.program() == program_of_python(content)
    assert parsed.facts() == analyse_file(content, Language.PYTHON, MACROS).facts


@pytest.mark.parametrize("order", [("facts", "program"), ("program", "facts")])
def test_neither_answer_changes_the_other(order: tuple[str, str]):
    for content, language in ((CPP, Language.CPP), (PYTHON, Language.PYTHON)):
        parsed = parse_file(content, language, MACROS)
        answers = {name: getattr(parsed, name)() for name in order}
        assert answers["facts"] == parse_file(content, language, MACROS).facts()
        assert answers["program"] == parse_file(content, language, MACROS).program()
        assert answers["program"].functions


def test_what_has_no_syntax_is_refused():
    with pytest.raises(ValueError, match="'yaml' has no syntax"):
        parse_file(b"", Language.YAML, MACROS)
