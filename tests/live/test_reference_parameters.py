from contextlib import suppress

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.reading.read_reference import load_reference
from roslens.live.observe.reference_parameters import parameter_documents
from roslens.live.window.signals import BY_KEY
from roslens.model.errors import DocumentError

WHERE = "the parameter server at http://robot:11311"
SCAN = {"topic": "/scan", "rate": "25..35 Hz"}
ODOM = {"topic": "/odom", "rate": ">= 10 Hz", "severity": "error"}
TEXT = "kind: reference\nname: {}\nconstraints:\n  - topic: /{}\n    rate: 5..15 Hz\n"


def subjects(value, name="/roslens/reference"):
    reference = load_reference(parameter_documents(name, value, WHERE), BY_KEY)
    return sorted(one.details.id for one in reference.expectations)


@pytest.mark.parametrize(
    ("value", "ids"),
    [
        (TEXT.format("rover", "scan"), ["rover.topic.scan.rate"]),
        ([TEXT.format("a", "scan"), TEXT.format("b", "odom")], ["a.topic.scan.rate", "b.topic.odom.rate"]),
        ({"name": "rover", "constraints": [SCAN]}, ["rover.topic.scan.rate"]),
        ({"constraints": [SCAN, ODOM]}, ["reference.topic.odom.rate", "reference.topic.scan.rate"]),
        ([SCAN, ODOM], ["reference.topic.odom.rate", "reference.topic.scan.rate"]),
        ({"eyes": [SCAN], "Wheels 2": {"constraints": [ODOM]}}, ["eyes.topic.scan.rate", "wheels-2.topic.odom.rate"]),
        (
            [{"constraints": [SCAN]}, {"constraints": [ODOM]}],
            ["reference-0.topic.scan.rate", "reference-1.topic.odom.rate"],
        ),
    ],
)
def test_every_form_in_which_a_launch_file_puts_it(value, ids):
    assert subjects(value) == ids


def test_what_is_wrong_is_told_with_parameter_and_line():
    documents = parameter_documents("/ref", TEXT.format("a", "scan").replace("rate", "rat"), WHERE)
    with pytest.raises(
        DocumentError, match=r"parameter /ref of the parameter server at http://robot:11311:5:"
    ) as caught:
        load_reference(documents, BY_KEY)
    assert "'rate'" in str(caught.value)


@pytest.mark.parametrize("value", ["", " ", None, 7, True, [], {}, [7], [[]], {"a": 1}, [SCAN, 7], ["a: 1", 7]])
def test_what_is_no_document_is_refused(value):
    with pytest.raises(DocumentError, match="expected a reference in YAML"):
        parameter_documents("/ref", value, WHERE)


def test_endless_nesting_is_refused():
    value = []
    value.append(value)
    with pytest.raises(DocumentError):
        parameter_documents("/ref", value, WHERE)


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-9, 9) | st.floats(allow_nan=False) | st.text("ab: \n", max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(["constraints", "a", "kind"]), inner),
    max_leaves=6,
)


@given(VALUES)
def test_any_value_is_documents_or_refused(value):
    documents = None
    with suppress(DocumentError):
        documents = parameter_documents("/a/ref", value, WHERE)
    assert documents is None or all(document.content and "/a/ref" in document.shown for document in documents)
    assert documents != ()


def test_a_table_reads_back_as_it_was():
    (document,) = parameter_documents("/ref", {"constraints": [ODOM]}, WHERE)
    assert yaml.safe_load(document.content)["constraints"] == [ODOM]
