"""Each worst shape of each grammar is read within the budget of a file, or left out as such; it never crashes."""

import pytest
from pace import slowness

from roslens.intake.file_budget import MORE_S, memory_of_file
from roslens.intake.time_budget import SOURCE_FILE_S
from shapes.readers import LIMITS, READERS, measured, ready
from shapes.shapes import SHAPES, nested, numbered, repeated

SMALL = 4_000
MOST_S = 3 * (SOURCE_FILE_S + MORE_S + 1)
"""A launch file is evaluated up to three times, a message for both versions of ROS."""
BASE_MB = 150


def test_every_grammar_has_shapes_and_a_reader():
    assert SHAPES.keys() == READERS.keys() == LIMITS.keys()
    assert sum(map(len, SHAPES.values())) > 250


def test_shapes_have_about_the_size_that_is_asked_for():
    assert repeated("ab", "(", ")")(10) == b"(abababab)"
    assert nested("(", ")", "1")(7) == b"(((1)))"
    assert numbered("{},", "[", "]")(8) == b"[0,1,2,]"
    for shapes in SHAPES.values():
        for name, shape in shapes.items():
            assert 0 < len(shape(SMALL)) <= SMALL + 2_000, name


@pytest.mark.parametrize("grammar", READERS)
def test_small_shapes_are_read(grammar):
    ready(grammar)
    for name, shape in SHAPES[grammar].items():
        found = measured(grammar, shape(SMALL))
        assert not found.left_out, name
        assert found.seconds < 3 * slowness(), name
        assert found.grown < 2 * BASE_MB, name


@pytest.mark.nightly
@pytest.mark.heavy
@pytest.mark.timeout(4 * 3600)
@pytest.mark.parametrize("share", [0.01, 0.1, 1])
@pytest.mark.parametrize("grammar", READERS)
def test_shapes_of_all_sizes_stay_within_the_budget(grammar, share):
    ready(grammar)
    for name, shape in SHAPES[grammar].items():
        found = measured(grammar, shape(int(LIMITS[grammar] * share)))
        assert found.seconds < MOST_S, name
        assert found.grown < BASE_MB + memory_of_file() / 1e6, name
