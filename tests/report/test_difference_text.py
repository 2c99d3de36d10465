import msgspec

from roslens.compare.finding_difference import FindingDifference, MovedFinding
from roslens.compare.graph_difference import Difference
from roslens.model.finding import Finding, Severity
from roslens.report.graph.difference_text import FOLDED_FROM, MOST_ROWS, to_markdown, to_text


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


def finding(message: str, rule: str = "graph.qos") -> Finding:
    return Finding(rule, Severity.ERROR, message, "a/b.cpp", 7, fingerprint=message)


def test_findings_are_told_with_their_places():
    found = FindingDifference(new=(finding("lost"),), gone=(finding("found"),))
    assert to_text([], "A", "B", found).splitlines()[2:] == [
        "no difference in the graph",
        "findings: 1 new, 1 gone",
        "+ a/b.cpp:7: error: lost [graph.qos]",
        "- a/b.cpp:7: error: found [graph.qos]",
    ]
    assert to_text([], "A", "B", FindingDifference()).splitlines()[2:] == ["no difference"]


def test_findings_come_first_in_a_table():
    found = FindingDifference(new=(finding("/a_b offers `x|y`, _not_ [this](that) <b>"),))
    table = to_markdown([Difference("/a", "node", "", "added", "", "a/b")], "A", "B", found).splitlines()
    assert table[0].endswith("1 added; findings: 1 new")
    row = r"| new | error | `graph.qos` | `a/b.cpp:7` | /a_b offers `x\|y`, \_not\_ \[this\](that) \<b> |"
    assert table[4] == row
    assert table[8].startswith("| added | `/a`")


def test_a_back_tick_alone_opens_no_code():
    table = to_markdown([], "A", "B", FindingDifference(gone=(finding("a ` b *c*"),)))
    assert r"| a ' b \*c\* |" in table
    assert "no difference; findings: 1 gone" in table


def test_findings_that_moved_are_told_but_make_no_difference():
    before, after = finding("lost"), msgspec.structs.replace(finding("lost"), path="a/c.cpp", line=9)
    found = FindingDifference(moved=(MovedFinding(before, after),))
    assert to_text([], "A", "B", found).splitlines()[2:] == [
        "no difference",
        "findings: 1 moved",
        "= a/b.cpp:7 is now a/c.cpp:9: error: lost [graph.qos]",
    ]
    assert to_markdown([], "A", "B", found) == "**Computation graph**: `A` to `B`: no difference; findings: 1 moved\n"
    both = FindingDifference(new=(finding("found"),), moved=found.moved)
    table = to_markdown([], "A", "B", both).splitlines()
    assert table[-1] == "| moved | error | `graph.qos` | `a/c.cpp:9` | was at `a/b.cpp:7`: lost |"
