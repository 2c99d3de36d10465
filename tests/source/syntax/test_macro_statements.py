"""Statements that only a macro can be."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.syntax.macro.macro_statements import blank_statements


@pytest.mark.parametrize(
    ("source", "blanked"),
    [
        ("a();\nCHECK_IT(x)  // it is (so\nb();\n", "a();\n\nb();\n"),
        ('{\n  DEBUG(\n    "(" << x)\n  return;\n}', "{\n\n\n  return;\n}"),
        ("#ifdef A\n// one\nDEFINE_LIMIT(A)\n#endif\n", "#ifdef A\n\n\n#endif\n"),
        ("public:\n  // (one\n  KARTO_Object(A)\n  // two\n\n  int a;", "public:\n\n\n\n\n  int a;"),
        ("struct A {\n  FIELDS(F)\n};", "struct A {\n\n};"),
        ("DEFINE_LIMIT(A)\nDEFINE_LIMIT(B)\n", "\n\n"),
        ("#include <a>\nDEFINE_LIMIT(A)\nint b;\n", "#include <a>\n\nint b;\n"),
    ],
)
def test_what_is_no_call(source, blanked):
    found = blank_statements(source.encode()).decode()
    assert [line.split("//")[0].rstrip() for line in found.splitlines()] == [
        line.rstrip() for line in blanked.splitlines()
    ]
    assert len(found) == len(source)


@pytest.mark.parametrize(
    "source",
    [
        "a();\nCHECK_IT(x);\nb();\n",
        "TEST_F(A, b)\n{\n}\n",
        "a = b +\n  SUM(c)\n  ;\n",
        "f(a,\n  SUM(c)\n  + d);\n",
        "x = y +\nSUM(c)\n* d;\n",
        "#define A \\\n  BODY(x)\nint b;\n",
        "a();\ncheck(x)\nb();\n",
        "CHECK_IT(x\nb();\n",
        "/* a\nCHECK_IT(x)\nb */\n",
    ],
)
def test_what_may_be_more_stays(source):
    assert blank_statements(source.encode()).decode() == source


PIECES = ["A_MACRO(", ")", "\n", "x", ";", '"', "//", "/*", "*/", "{", "}", "\\", " ", "#define "]


@given(st.lists(st.sampled_from(PIECES)).map("".join))
def test_places_hold(text):
    content = text.encode()
    found = blank_statements(content)
    assert len(found) == len(content)
    assert [at for at, byte in enumerate(found) if byte == 10] == [at for at, byte in enumerate(content) if byte == 10]
