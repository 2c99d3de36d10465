"""What the preprocessor leaves out, whatever is defined."""

import pytest

from roslens.source.rules.switched_off import switched_off


def lines(text):
    return sorted({line for one in switched_off(text.encode()) for line in one})


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a\n#if 0\nb\n#endif\nc\n", [2, 3, 4]),
        ("#if 0\na\n#else\nb\n#endif\n", [1, 2, 3]),
        ("#if 0\na\n#elif X\nb\n#endif\n", [1, 2, 3]),
        ("# if  false // not yet\na\n# endif\n", [1, 2, 3]),
        ("#if 0\n#if X\na\n#else\nb\n#endif\nc\n#endif\nd\n", [1, 2, 3, 4, 5, 6, 7, 8]),
        ("#if 0x1\na\n#endif\n", []),
        ("#if 0 || defined(X)\na\n#endif\n", []),
        ("#if 01\na\n#endif\n", []),
        ("#if 1\na\n#endif\n", []),
        ("#if 0\na\n", []),
        ("#endif\n#if 0\na\n#endif\n", [2, 3, 4]),
        ("#undef X\n#ifdef X\na\n#endif\nb\n", [2, 3, 4]),
        ("#undef X\n\n# ifdef X\na\n#else\nb\n#endif\n", [3, 4, 5]),
        ("#undef X\n#ifdef X_2\na\n#endif\n", []),
        ("#undef X\n#ifndef X\na\n#endif\n", []),
        ("#undef X\n#define X\n#ifdef X\na\n#endif\n", []),
        ('#undef X\n#include "x.h"\n#ifdef X\na\n#endif\n', []),
        ("#ifdef A\n#undef X\n#endif\n#ifdef X\na\n#endif\n", []),
        ("", []),
    ],
)
def test_lines_between_if_0_and_the_end_of_that_arm(text, expected):
    assert lines(text) == expected
