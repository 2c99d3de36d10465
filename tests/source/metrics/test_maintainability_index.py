from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from roslens.source.metrics.halstead.maintainability_index import of_values


def values(volume: float = 1.0, complexity: float = 0.0, loc: float = 1.0, **more: float) -> dict[str, float]:
    return {"halstead_volume": volume, "cyclomatic_complexity": complexity, "loc": loc, **more}


def test_the_least_code_has_the_full_mark():
    assert of_values(values()) == 100


def test_it_does_not_fall_below_nothing():
    assert of_values(values(1e9, 500.0, 1e6)) == 0


def test_without_code_there_is_none():
    assert of_values({}) is None
    assert of_values(values(loc=0.0)) is None


def test_a_file_without_functions_has_no_complexity():
    without = values(500.0, loc=20.0)
    del without["cyclomatic_complexity"]
    assert of_values(without) == of_values(values(500.0, 0.0, 20.0))


def test_a_package_of_equal_files_has_the_index_of_each():
    assert of_values(values(500.0, 3.0, 5 * 40.0, files=5.0)) == of_values(values(500.0, 3.0, 40.0))


@given(st.floats(1, 1e5), st.floats(1, 50), st.integers(1, 2000))
def test_more_of_anything_is_never_better(volume, complexity, loc):
    index = of_values(values(volume, complexity, float(loc)))
    assert 0 <= index <= 100
    assert of_values(values(volume * 2, complexity, float(loc))) <= index
    assert of_values(values(volume, complexity + 1, float(loc))) <= index
    assert of_values(values(volume, complexity, float(loc + 1))) <= index
