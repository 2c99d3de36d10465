"""What is on by default is true, or was mended since it was not."""

import msgspec
import pytest
import yaml

from graph_findings.judgements import NATIVE_TABLES, Judgement, Sample, samples
from graph_findings.mendings import Mending, read_mendings, since
from graph_findings.page import totals
from graph_findings.standing import BOUND
from roslens.model.finding import Severity
from roslens.source.rules.table import native_rules

TABLES = samples(NATIVE_TABLES)
TOTALS = totals(TABLES)
ON = [one.id for one in native_rules().values() if one.profiles and one.severity is not Severity.NOTE]
BELOW = [one for one in ON if TOTALS.get(one, (0, 0))[0] < BOUND * TOTALS.get(one, (0, 0))[1]]


@pytest.mark.parametrize("rule", BELOW)
def test_a_rule_that_was_too_often_not_true_was_mended_and_is_true_since(rule):
    mendings = read_mendings()
    assert rule in mendings, f"{rule} is {TOTALS[rule]}: mend it and say the cause, or make it a note"
    true, read = since(rule, mendings[rule], TABLES)
    assert true >= BOUND * read, f"{rule} is {true} of {read} since it was mended: mend it again, or make it a note"


def test_only_rules_that_are_below_the_bound_are_said_to_be_mended():
    assert sorted(read_mendings()) == sorted(BELOW)


def test_what_is_read_since_is_of_tables_that_were_drawn_later():
    def table(seed, verdict):
        row = Judgement("a/b", "cpp.a", "warning", "a.cpp", 1, "", "m", verdict, "")
        return Sample(False, seed, 5, "warning", {"a/b": "c"}, {}, {"cpp.a": 1}, {}, [row])

    found = {"one": table(1, False), "two": table(2, True), "three": table(3, True)}
    assert since("cpp.a", Mending("one", "why"), found) == (2, 2)
    assert since("cpp.a", Mending("three", "why"), found) == (0, 0)
    assert since("cpp.b", Mending("one", "why"), found) == (0, 0)
    with pytest.raises(KeyError):
        since("cpp.a", Mending("four", "why"), found)


def test_a_table_of_mendings_with_other_keys_is_refused(tmp_path):
    (tmp_path / "m.yaml").write_text(yaml.safe_dump({"cpp.a": {"after": "one", "why": "x"}}))
    with pytest.raises(msgspec.ValidationError):
        read_mendings(tmp_path / "m.yaml")
