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
