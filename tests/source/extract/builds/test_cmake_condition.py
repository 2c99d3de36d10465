"""Conditions of three values; what they are of known values is held against cmake in test_cmake_blocks."""

import pytest

from roslens.source.extract.builds.cmake_condition import Answer, Word, answer, opposite
from roslens.source.extract.builds.cmake_syntax import parse_cmake
from roslens.source.extract.builds.cmake_value import hole


class Around:
    """Variables: SET is known, USER may be set otherwise, HOLE is unknown."""

    def words(self, arguments):
        return [Word(hole("x") if one.written == "${HOLE}" else one.literal, one.kind == "quoted", one.kind == "paren")
                for one in arguments]  # fmt: skip

    def variable(self, name):
        known = {"SET": ("value", False), "USER": ("ON", True), "HOLE": (hole("HOLE"), False), "LIST": ("a;b", False)}
        return known.get(name, (None, name.isupper()))

    def exists(self, path, *, folder):
        return {"here": True, "gone": False}.get(path)

    def target(self, name):
        return True if name == "mine" else None

    def command(self, name):
        return True if name == "set" else None

    def matched(self, groups):
        self.groups = groups


def of(text):
    return answer(parse_cmake(f"if({text})\nendif()".encode()).body[0].branches[0][0].arguments, Around())


@pytest.mark.parametrize(
    ("text", "value", "usual"),
    [
        ("SET", True, None),
        ("unset", False, None),
        ("USER", None, True),
        ("NOT USER", None, False),
        ("OTHER", None, False),
        ("HOLE", None, None),
        ("NOT HOLE", None, None),
        ("SET AND HOLE", None, None),
        ("unset AND HOLE", False, None),
        ("SET OR HOLE", True, None),
        ("HOLE OR USER", None, True),
        ("HOLE AND OTHER", None, False),
        ("HOLE STREQUAL x", None, None),
        ("USER STREQUAL ON", None, True),
        ("${HOLE} MATCHES x", None, None),
        ("EXISTS here", True, None),
        ("EXISTS gone", False, None),
        ("EXISTS elsewhere", None, None),
        ("TARGET mine", True, None),
        ("TARGET theirs", None, None),
        ("COMMAND set", True, None),
        ("POLICY CMP0001", None, None),
        ("a IN_LIST LIST", True, None),
        ("DEFINED USER", None, True),
        ("a b c", None, None),
        ("", None, None),
        ('SET MATCHES "(a*)*b"', None, None),
    ],
)  # fmt: skip
def test_answers(text, value, usual):
    assert of(text) == Answer(value, usual)


def test_opposite():
    assert opposite(Answer(None, True)) == Answer(None, False)
    assert opposite(Answer(True)) == Answer(False)


def test_nesting_is_bounded():
    assert of("(" * 5000 + "SET" + ")" * 5000) == Answer(None)
    assert of("NOT " * 5000 + "SET") == Answer(True)


def test_what_versions_of_cmake_read_differently_is_unknown():
    # Of 3.16 and before, AND binds tighter; later it does not, or the last two of three are joined first.
    assert of("1 OR 1 AND 0") == Answer(None)
    assert of("0 AND 1 AND 0 OR NOT 0") == Answer(None)
    assert of("0 AND 1 OR 1") == Answer(True)
    assert of("1 AND 0 OR 0") == Answer(False)


def test_whether_what_may_not_be_set_is_defined_is_unknown():
    assert of("DEFINED HOLE") == Answer(None)
