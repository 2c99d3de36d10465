import pytest

from roslens.source.rules.include_lines import include_lines, place_for_standard
from roslens.source.syntax.comments import blank_comments


def lines_of(text):
    content = text.encode()
    return include_lines(content, blank_comments(content, "cpp"))


def with_header(text, header, own=""):
    at, added = place_for_standard(text.encode(), lines_of(text), header, own=own)
    return text[:at] + added + text[at:]


def test_conditions_are_known_and_a_guard_is_none():
    text = '#ifndef A_H\n#define A_H\n#include <a>  // why\n#if X\n# include "b.h"\n#endif\n#define Y\n#endif\n'
    lines = lines_of(text)
    assert [(one.name, one.conditional) for one in lines.lines] == [("<a>", False), ('"b.h"', True)]
    assert [text[one.start : one.end] for one in lines.lines] == ["#include <a>  // why\n", '# include "b.h"\n']
    assert [text[at : at + 9] for at in lines.other] == ["#define Y"]
    assert lines.top == len("#ifndef A_H\n#define A_H\n")


@pytest.mark.parametrize(
    ("text", "own", "expected"),
    [
        ("#include <a>\n#include <z>\n", "", "#include <a>\n#include <m>\n#include <z>\n"),
        ("#include <a>\n\n#include <b>\n", "", "#include <a>\n#include <m>\n\n#include <b>\n"),
        ('#include "x/arm.hpp"\n#include "b.h"\n', "arm", '#include "x/arm.hpp"\n\n#include <m>\n\n#include "b.h"\n'),
        ('#include "x/arm.hpp"\n\n#include "b.h"\n', "arm", '#include "x/arm.hpp"\n\n#include <m>\n\n#include "b.h"\n'),
        ("#include <x/arm.h>\n", "arm", "#include <m>\n\n#include <x/arm.h>\n"),
        ('int a;\n\n// of b\n#include "b.h"\n', "", 'int a;\n\n#include <m>\n\n// of b\n#include "b.h"\n'),
        ('// of all\n#include "b.h"\n', "", '// of all\n#include <m>\n\n#include "b.h"\n'),
        ('*/\n// of b\n#include "b.h"\n', "", '*/\n// of b\n#include <m>\n\n#include "b.h"\n'),
        ('#include "b.h"\n', "arm", '#include <m>\n\n#include "b.h"\n'),
        ("#pragma once\nint a;\n", "", "#pragma once\n\n#include <m>\nint a;\n"),
        ("// of me\nint a;\n", "", "// of me\n\n#include <m>\nint a;\n"),
        ("#if X\n#include <a>\n#endif\n", "", "\n#include <m>\n#if X\n#include <a>\n#endif\n"),
    ],
)
def test_a_header_of_the_library_comes_among_its_like(text, own, expected):
    assert with_header(text, "m", own) == expected
