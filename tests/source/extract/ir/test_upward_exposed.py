"""Whether a turn of a loop reads what an earlier one set."""

import pytest

from roslens.source.extract.ir.program import Name
from roslens.source.extract.ir.upward_exposed import is_read_first


@pytest.mark.parametrize(
    ("body", "reads"),
    [
        ("f(t); t = 1;", True),
        ("t = 1; f(t);", False),
        ("t = g(t);", True),
        ("if (a) { t = 1; } f(t);", True),
        ("if (a) { t = 1; }", False),
        ("if (t) { f(); }", True),
        ("if (a) { f(t); }", True),
        ("for (auto b : c) { t = 1; f(t); }", False),
        ("f(); t = 1;", False),
        ("t += 1;", True),
        ("u = t;", True),
    ],
)
def test_what_is_read_first(index_of, body, reads):
    program = index_of(a_cpp=f"void run() {{ {body} }}").programs["pkg/a.cpp"]
    assert is_read_first(program.functions[0].body, Name("t")) is reads
