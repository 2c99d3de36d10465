"""The study's arithmetic, with values worked out by hand."""

from __future__ import annotations

from math import log, sin, sqrt

import pytest

from roslens.source.tools.cccc_quantities import CCCC_QUANTITIES
from roslens.source.tools.cccc_report import CcccFile, CcccFunction, CcccModule
from roslens.source.tools.paper2016 import (
    StudiedFile,
    class_values,
    file_values,
    is_studied,
    maintainability_index,
    package_values,
)

BUSY = StudiedFile(
    "p/a.cpp",
    CcccFile(
        loc=100,
        comment_lines=19,
        modules=(
            CcccModule("A", 3, cbo=6, noc=11, wmc=101, dit=6, mac=21),
            CcccModule("B", 9, cbo=5, noc=10, wmc=100, dit=5, mac=20),
            CcccModule("std", 0, cbo=1, noc=0, wmc=0, dit=0, mac=0),
        ),
        functions=(CcccFunction("A", "f()", 4, 16), CcccFunction("A", "g()", 5, 15), CcccFunction("A", "h()", 6, 0)),
    ),
    1000.0,
)
CALM = StudiedFile("p/b.h", CcccFile(50, 60, functions=(CcccFunction("anonymous", "k()", 2, 2),)), 200.0)
COMMENTS_ALONE = StudiedFile("p/c.h", CcccFile(0, 40), 0.0)


def test_what_is_measured_of_a_file():
    assert file_values(BUSY) == {
        "paper2016.halstead_volume": 1000.0,
        "paper2016.rqv": 7.0,
        "paper2016.loc": 100.0,
        "paper2016.comment_lines": 19.0,
        "paper2016.comment_ratio": 19.0,
    }
    assert file_values(COMMENTS_ALONE) == {"paper2016.halstead_volume": 0.0, "paper2016.rqv": 0.0}


@pytest.mark.parametrize(("loc", "comments", "ratio", "violations"), [(30, 6, 20, 0), (31, 6, 19, 1), (3, 2, 66, 0)])
def test_the_ratio_of_a_file_is_rounded_down_before_it_is_judged(
    loc: int, comments: int, ratio: float, violations: int
):
    values = file_values(StudiedFile("a.c", CcccFile(loc, comments), 1.0))
    assert (values["paper2016.comment_ratio"], values["paper2016.rqv"]) == (ratio, violations)


def test_what_is_measured_of_a_class_leaves_zeros_out():
    assert class_values(CcccModule("C", 1, cbo=2, noc=0, wmc=3, dit=0, mac=0)) == {
        "paper2016.cbo": 2.0,
        "paper2016.wmc": 3.0,
    }


def test_what_is_measured_of_a_package():
    values = package_values([BUSY, CALM, COMMENTS_ALONE])
    assert set(values) == {quantity.key for quantity in CCCC_QUANTITIES}
    assert values["paper2016.loc"] == 150
    assert values["paper2016.comment_lines"] == 79
    assert values["paper2016.comment_ratio"] == pytest.approx(100 * 79 / 150)
    assert values["paper2016.cyclomatic_complexity"] == 11
    assert values["paper2016.cbo"] == 4
    assert values["paper2016.noc"] == 10.5
    assert values["paper2016.wmc"] == 100.5
    assert values["paper2016.dit"] == 5.5
    assert values["paper2016.mac"] == 20.5
    assert values["paper2016.halstead_volume"] == 400
    assert values["paper2016.rqv"] == 7
    expected = (171 - 5.2 * log(400) - 0.23 * 11 - 16.2 * log(75)) * 100 / 171 + 50 * sin(sqrt(2.4 * 79 / 150))
    assert values["paper2016.maintainability_index"] == pytest.approx(expected)


def test_a_package_without_code_has_no_values():
    assert package_values([]) == {}
    assert package_values([COMMENTS_ALONE]) == {}


def test_a_mean_of_nothing_is_zero():
    values = package_values([StudiedFile("a.h", CcccFile(10, 0), 30.0)])
    assert (values["paper2016.cyclomatic_complexity"], values["paper2016.mac"]) == (0, 0)


def test_the_index_is_never_negative_and_may_be_above_100():
    assert maintainability_index(1e9, 400, 1e6, 0) == 0
    assert maintainability_index(10, 1, 3, 1.0) > 100
    assert maintainability_index(0, 1, 10, 0.5) == 0


@pytest.mark.parametrize(
    ("path", "studied"),
    [
        ("src/a.cpp", True),
        ("a.cc", True),
        ("include/p/a.h", True),
        ("test/a.hpp", True),
        ("a.c", True),
        ("a.cxx", False),
        ("a.hxx", False),
        ("a.CPP", False),
        ("a.py", False),
        ("doc/a.cpp", False),
        ("src/cmake/a.cpp", False),
        ("bin/a.c", False),
        (".git/a.c", False),
        ("docs/a.cpp", True),
        ("src/doc.cpp", True),
    ],
)
def test_which_files_are_studied(path: str, studied: bool):
    assert is_studied(path) is studied
