import msgspec
from hypothesis import given
from hypothesis import strategies as st

from roslens.compare.finding_difference import about, finding_difference
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, Proof
from roslens.model.finding import Finding, Severity
from roslens.model.graph import Endpoint, Role


def finding(print_: str, line: int = 1, entity: str = "topic:/a") -> Finding:
    return Finding("qos", Severity.ERROR, "does not fit", "a.py", line, entity=entity, fingerprint=print_)


def test_what_only_one_side_has_is_new_or_gone():
    found = finding_difference([finding("a"), finding("b")], [finding("c"), finding("b", line=9)])
    assert [one.fingerprint for one in found.new] == ["c"]
    assert [one.fingerprint for one in found.gone] == ["a"]
    assert found


def test_lines_and_words_are_no_difference():
    other = msgspec.structs.replace(finding("a", line=7), message="still does not fit")
    assert not finding_difference([finding("a")], [other])


def test_several_of_one_fingerprint_are_told_once():
    assert finding_difference([], [finding("a", 1), finding("a", 2)]).new == (finding("a", 1),)


prints = st.lists(st.sampled_from("abcdef").map(finding))


@given(prints, prints)
def test_the_other_way_round_new_is_gone(before, after):
    there, back = finding_difference(before, after), finding_difference(after, before)
    assert (there.new, there.gone) == (back.gone, back.new)
    assert not finding_difference(before, before)


def test_findings_about_nodes():
    end = ConfiguredEndpoint(Endpoint("/n", Role.SERVICE_CLIENT, "/set"), Proof())
    shown = Configuration("c", "ros2", nodes=(ConfiguredNode("/n", Proof(), endpoints=(end,)),))
    entities = [
        "node:/n",
        "node:/m",
        "parameter:/n:rate",
        "parameter:/m:rate",
        "service:/set",
        "topic:/set",
        "package:p",
    ]
    kept = about([finding(one, entity=one) for one in entities], shown)
    assert [one.entity for one in kept] == ["node:/n", "parameter:/n:rate", "service:/set"]


def moved_finding(path: str, line: int, more: str = "") -> Finding:
    message = f"/n ({path}:{line}) publishes /a, but {path.split('/')[0]}/package.xml does not say so{more}"
    return Finding("dep", Severity.NOTE, message, path, line, entity="topic:/a", fingerprint=f"{path}{more}")


def test_what_is_said_in_another_file_has_moved():
    before, after = moved_finding("p/old.py", 3), moved_finding("p/new.py", 9)
    found = finding_difference([before], [after])
    assert [(one.before, one.after) for one in found.moved] == [(before, after)]
    assert not found
    assert (found.new, found.gone) == ((), ())


def test_files_that_are_named_in_words_are_those_of_the_later_side():
    before, after = moved_finding("p/old.py", 3), moved_finding("q/old.py", 3)
    assert len(finding_difference([before], [after]).new) == 1
    assert len(finding_difference([before], [after], {"p/package.xml": "q/package.xml"}).moved) == 1


def test_each_moves_once():
    before = [moved_finding("p/old.py", 3)]
    after = [moved_finding("p/new.py", 3), moved_finding("p/other.py", 3), moved_finding("p/third.py", 3, " at all")]
    found = finding_difference(before, after)
    assert [one.after.path for one in found.moved] == ["p/new.py"]
    assert [one.path for one in found.new] == ["p/other.py", "p/third.py"]


def test_what_is_measured_of_a_renamed_file_has_moved():
    def long_function(path):
        place = msgspec.structs.replace(moved_finding(path, 3), fingerprint=path, message="f is long")
        return msgspec.structs.replace(place, entity=f"function:{path}#f(int)")

    before, after = long_function("p/old.cpp"), long_function("p/new.cpp")
    assert finding_difference([before], [after]).new == (after,)
    found = finding_difference([before], [after], {"p/old.cpp": "p/new.cpp"})
    assert (found.new, found.gone) == ((), ())
    assert [(one.before, one.after) for one in found.moved] == [(before, after)]
