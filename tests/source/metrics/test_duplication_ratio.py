from __future__ import annotations

import pytest

from roslens.source.metrics.size.duplication_ratio import of_values


@pytest.mark.parametrize("values", [{"loc": 0.0, "duplicated_lines": 0.0}, {"loc": 5.0}, {}])
def test_without_code_or_before_the_package_is_known_there_is_none(values):
    assert of_values(values) is None


def test_it_is_in_per_cent():
    assert of_values({"loc": 8.0, "duplicated_lines": 2.0}) == 25
