import pytest

from roslens.model.configuration import ConfiguredParameter, Origin, Proof
from roslens.source.extract.facts.node_facts import Evidence, ParameterFact, Sure
from roslens.source.extract.parameters.assemble_written import Write, after_writes, taken_by_server
from roslens.source.extract.symbolic.text import Text, Written, unknown

PLACE = Evidence("a.cpp", 3)
LAUNCH = Proof("a.launch", 1, origin=Origin.LAUNCH)
NOT_SET = ConfiguredParameter("/a/x", None)
SET = ConfiguredParameter("/a/x", "1", set_type="int", set_by=LAUNCH)


def write(value, sure=Sure.CERTAIN, conditions=(), kind="int", line=3):
    place = Evidence("a.cpp", line, sure=sure)
    fact = ParameterFact(Text.of("x"), place, "written", kind, value=value, writer=place, conditions=conditions)
    return Write(fact, value, sure)


def serve(default, kind="int", between="", path="a.cpp", conditions=()):
    place = Evidence(path, 5, sure=Sure.LIKELY)
    fact = ParameterFact(Text.of("x"), PLACE, "declared", kind, default, between, conditions, writer=place)
    return Write(fact, default, Sure.CERTAIN)


def result(parameter, *writes):
    found = after_writes(parameter, writes)
    proof = found.written_by
    return found.value, "" if proof is None else proof.sure, "" if proof is None else proof.how


@pytest.mark.parametrize("before", [NOT_SET, SET])
def test_a_write_that_is_sure_decides(before):
    assert result(before, write(Text.of("2"))) == ("2", "certain", "")


def test_the_last_one_counts():
    found = after_writes(NOT_SET, [write(Text.of("2"), line=3), write(Text.of("4"), line=4)])
    assert (found.value, found.written_by.line) == ("4", 4)


@pytest.mark.parametrize("doubt", [{"sure": Sure.LIKELY}, {"conditions": (Written("armed"),)}])
def test_one_that_is_not_sure_leaves_the_value_and_says_so(doubt):
    held = ", only if armed" if "conditions" in doubt else ""
    assert result(SET, write(Text.of("2"), **doubt)) == ("1", "likely", f"`2` may be written{held}")


def test_where_nothing_is_set_it_is_what_there_may_be():
    assert result(NOT_SET, write(Text.of("2"), conditions=(Written("armed"),))) == ("2", "likely", "only if armed")


def test_the_same_value_again_changes_nothing():
    assert result(SET, write(Text.of("1"), conditions=(Written("armed"),))) == ("1", "", "")


def test_an_unknown_value_makes_it_unknown():
    assert result(SET, write(unknown("pose"))) == (None, "possible", "{pose}")
    assert result(SET, write(unknown("pose"), conditions=(Written("armed"),))) == (
        "1", "likely", "`{pose}` may be written, only if armed",
    )  # fmt: skip


def test_what_only_reads_writes_nothing():
    fact = ParameterFact(Text.of("x"), PLACE, "read")
    assert after_writes(SET, [Write(fact, None, Sure.CERTAIN)]) == SET


def test_a_server_writes_its_default_where_nothing_is_set():
    assert result(NOT_SET, serve(Text.of("7"))) == ("7", "likely", "")


def test_a_server_holds_its_default_in_the_range_too():
    assert result(NOT_SET, serve(Text.of("7"), between="0..5"))[0] == "5"


def test_what_is_set_is_kept_beside_what_a_server_makes_of_it():
    found = after_writes(SET, [serve(Text.of("7"), between="3..9")])
    assert (found.value, found.set_value, found.written_by.how) == ("3", "1", "`1` is below the minimum")


def test_a_server_leaves_what_fits():
    assert after_writes(SET, [serve(Text.of("7"), between="0..9")]) == SET


def test_a_server_takes_what_was_written_before_it():
    assert result(NOT_SET, write(Text.of("12")), serve(Text.of("7"), between="0..9")) == (
        "9", "likely", "`12` is above the maximum",
    )  # fmt: skip


def test_a_server_that_there_may_be_changes_nothing_for_sure():
    assert after_writes(SET, [serve(Text.of("7"), between="3..9", conditions=(Written("armed"),))]) == SET


def test_a_default_that_is_unknown():
    assert result(NOT_SET, serve(unknown("os.getpid()")))[0] is None


@pytest.mark.parametrize(
    ("value", "kind", "wanted", "between", "expected"),
    [
        ("5", "int", "int", "0..9", "5"),
        ("12", "int", "int", "0..9", "9"),
        ("-1", "int", "int", "0..9", "0"),
        ("-1", "int", "int", "..9", "-1"),
        ("5", "int", "double", "0.0..9.0", "5.0"),
        ("12", "int", "double", "0.0..9.0", "9.0"),
        ("2.5", "double", "int", "", "3"),
        ("2.4", "double", "int", "", "2"),
        ("-2.4", "double", "int", "", "-3"),
        ("fast", "string", "double", "", "7"),
        ("true", "bool", "bool", "", "true"),
        ("1", "int", "bool", "", "7"),
        ("1", "int", "string", "", "7"),
        ("1", "", "string", "", "1"),
        ("1", "int", "", "", "1"),
    ],
)
def test_what_a_server_of_roscpp_makes_of_a_value(value, kind, wanted, between, expected):
    fact = ParameterFact(Text.of("x"), PLACE, "declared", wanted, range=between)
    assert taken_by_server(value, kind, fact, "7", python=False)[0] == expected


@pytest.mark.parametrize(
    ("value", "kind", "wanted", "between", "expected"),
    [
        ("5", "int", "double", "0.0..9.0", "5"),
        ("12", "int", "double", "0.0..9.0", "9.0"),
        ("fast", "string", "double", "", "fast"),
        ("2.5", "double", "int", "", "2.5"),
    ],
)
def test_rospy_converts_nothing(value, kind, wanted, between, expected):
    fact = ParameterFact(Text.of("x"), PLACE, "declared", wanted, range=between)
    assert taken_by_server(value, kind, fact, "7", python=True)[0] == expected
