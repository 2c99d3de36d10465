import pytest

from roslens.source.extract.ir.program_text import program_text
from roslens.source.extract.lowering.python.python_program import program_of_python


def lowered(*cases):
    text = "match kind:\n" + "".join(f"    case {one}:\n        f({number})\n" for number, one in enumerate(cases))
    return program_text(program_of_python(text.encode())).splitlines()[1:]


def test_what_a_case_names_is_compared():
    assert lowered("'a'", "Kind.B") == [
        '  if (kind == "a"):',
        "    f(0)",
        "  else:",
        "    if (kind == Kind->B):",
        "      f(1)",
    ]


def test_several_patterns_a_guard_and_any():
    assert lowered("'a' | 'b'", "'c' if more", "_") == [
        '  if ((kind == "a") or (kind == "b")):',
        "    f(0)",
        "  else:",
        '    if ((kind == "c") and more):',
        "      f(1)",
        "    else:",
        "      f(2)",
    ]


def test_a_name_takes_what_is_looked_at():
    assert lowered("other") == ["  other = kind", "  f(0)"]


def lowered_of(subjects, *cases):
    text = f"match {subjects}:\n" + "".join(f"    case {one}:\n        pass\n" for one in cases)
    text = text.replace("pass", "g()")
    return program_text(program_of_python(text.encode())).splitlines()[1:]


@pytest.mark.parametrize("case", ["'x', 1", "('x', 1)", "['x', 1]"])
def test_several_subjects_are_compared_each_with_its_own_pattern(case):
    assert lowered_of("f(), b", case) == ["  #1 = f()", '  if ((#1 == "x") and (b == 1)):', "    g()"]


def test_of_several_subjects_some_may_be_anything_or_get_a_name():
    assert lowered_of("a, b", "'x', _") == ['  if (a == "x"):', "    g()"]
    assert lowered_of("a, b", "_, name") == ["  name = b", "  g()"]
    assert lowered_of("a, b", "both") == ["  both = [a, b]", "  g()"]
    assert lowered_of("a, b", "_") == ["  g()"]


def test_what_takes_the_rest_or_another_number_is_not_known():
    assert lowered_of("a, b", "'x', *_") == ["  if `'x', *_`:", "    g()"]
    assert lowered_of("a", "'x', 'y'") == ["  if `'x', 'y'`:", "    g()"]
