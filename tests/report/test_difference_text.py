from roslens.compare.graph_difference import Difference
from roslens.report.difference_text import FOLDED_FROM, MOST_ROWS, to_markdown, to_text


def test_several_of_one_kind_tell_what_is_new_and_what_is_gone():
    one = Difference("/a", "publisher", "/x", "changed", "", "std_msgs/msg/String, if b")
    assert "~   publisher /x: also std_msgs/msg/String, if b" in to_text([one], "A", "B")
    other = Difference("/a", "publisher", "/x", "changed", "std_msgs/msg/String", "")
    assert "~   publisher /x: no more std_msgs/msg/String" in to_text([other], "A", "B")


def test_nothing_that_a_terminal_or_a_table_would_obey_is_written():
    one = Difference("/a", "parameter", "x", "added", "", "\x1b[31m|\n`b`")
    assert "\x1b" not in to_text([one], "A", "B")
    row = to_markdown([one], "A", "B").splitlines()[-1]
    assert "\x1b" not in row
    assert row.endswith("\\| 'b'` |")


def test_a_long_table_is_folded_and_ends():
    found = [Difference(f"/n{number:04}", "node", "", "added", "", "a/b") for number in range(MOST_ROWS + 5)]
    assert "<details>" not in to_markdown(found[:FOLDED_FROM], "A", "B")
    table = to_markdown(found, "A", "B")
    assert f"<details><summary>{MOST_ROWS + 5} differences in {MOST_ROWS + 5} nodes</summary>" in table
    assert "5 more are not shown" in table
    assert table.count("\n| added") == MOST_ROWS
