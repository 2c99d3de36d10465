from __future__ import annotations

from time import process_time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.metrics.size.duplicated_lines import of_files


def test_no_lines_are_no_duplicates():
    assert of_files([], 10) == []
    assert of_files([(), (1, 2)], 2) == [0, 0]


def test_a_copy_in_another_file_makes_both_duplicates():
    assert of_files([(1, 2, 3, 4), (9, 1, 2, 3, 8), (7, 2, 3)], 3) == [3, 3, 0]


def test_blocks_that_overlap_each_other_are_counted_once():
    assert of_files([(1, 2, 3, 4), (1, 2, 3, 4)], 2) == [4, 4]


def test_a_block_is_no_copy_of_itself_one_line_on():
    assert of_files([(5,) * 5], 3) == [0]
    assert of_files([(5,) * 6], 3) == [6]


def test_any_window_below_one_is_one():
    assert of_files([(1, 1, 2)], 0) == of_files([(1, 1, 2)], 1) == [2]


lines = st.lists(st.integers(0, 3), max_size=12).map(tuple)


def naive(files: list[tuple[int, ...]], window: int) -> list[int]:
    blocks = [
        (file, start, hashes[start : start + window])
        for file, hashes in enumerate(files)
        for start in range(len(hashes) - window + 1)
    ]
    marked: list[set[int]] = [set() for _ in files]
    for file, start, block in blocks:
        for other, place, copy in blocks:
            if block == copy and (file != other or abs(start - place) >= window):
                marked[file].update(range(start, start + window))
    return [len(one) for one in marked]


@given(st.lists(lines, max_size=4), st.integers(1, 4))
def test_it_finds_what_comparing_all_with_all_finds(files, window):
    assert of_files(files, window) == naive(files, window)


@given(st.lists(lines, max_size=4), st.integers(1, 4), st.randoms())
def test_the_order_of_files_does_not_matter(files, window, random):
    order = list(range(len(files)))
    random.shuffle(order)
    straight = of_files(files, window)
    assert of_files([files[place] for place in order], window) == [straight[place] for place in order]


@given(lines.filter(bool))
def test_a_file_and_its_copy_are_duplicates_throughout(hashes):
    assert of_files([hashes, hashes], len(hashes)) == [len(hashes)] * 2


@pytest.mark.heavy
@pytest.mark.timed
def test_the_cost_is_linear():
    def cost(number: int) -> float:
        files = [tuple(range(number)), tuple(range(number)), (7,) * number]
        start = process_time()
        of_files(files, 10)
        return process_time() - start

    cost(1000)
    assert cost(80_000) < 20 * max(cost(20_000), 0.005)
