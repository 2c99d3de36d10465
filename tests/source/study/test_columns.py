"""Columns from quantities, and the bounds that are theirs."""

from roslens.judge.quality.quality_model import load_model
from roslens.source.metrics.table import QUANTITIES
from roslens.source.study.columns import column_of, size_among

ROS = load_model("ros", QUANTITIES)


def test_a_mean_has_the_bound_of_its_parts():
    column = column_of(QUANTITIES["cyclomatic_complexity"], [ROS])
    assert (column.maximum, column.threshold, column.size) == (15, "<= 15 (ros)", False)


def test_a_sum_has_not():
    column = column_of(QUANTITIES["eloc"], [ROS])
    assert (column.maximum, column.threshold, column.size) == (None, "", True)


def test_no_dimension_is_no_unit():
    assert column_of(QUANTITIES["cyclomatic_complexity"]).unit == ""
    assert column_of(QUANTITIES["loc"]).unit == "lines"


def test_what_grows_with_code():
    assert all(column_of(QUANTITIES[key]).size for key in ("loc", "rqv", "rcv", "comment_lines"))
    assert not any(column_of(QUANTITIES[key]).size for key in ("cbo", "comment_ratio", "dependents"))


def test_size():
    assert size_among(["x", "paper2016.loc"]) == "paper2016.loc"
    assert size_among(["loc", "paper2016.loc"]) == "loc"
    assert size_among(["x"]) == ""
