"""The page of reactions holds what the reader knows, and its example is one that reader and schema take."""

from roslens.judge.pages.reactions_page import EXAMPLE, reactions_page
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.reaction_keys import CONDITION_KEYS, REACTION_KEYS, STEP_KEYS
from roslens.judge.reference.template import FIELDS
from roslens.live.window.signals import BY_KEY

from .test_references_page import accepted


def test_the_page_names_every_key_and_field():
    page = reactions_page()
    selecting = {"host", "node", "process", "topic", "connection", "service", "parameter", "type", "publisher"}
    left = selecting | {"subscriber", "on", "without"}
    for key in {*CONDITION_KEYS, *REACTION_KEYS, *STEP_KEYS} - left:
        assert f"| `{key}` |" in page
    for field in FIELDS:
        assert f"`{{{field}}}`" in page


def test_its_example_is_read_and_taken_by_the_schema():
    reference = load_reference([GivenText("front.yaml", EXAMPLE.encode())], BY_KEY)
    assert [one.name for one in reference.reactions] == ["front.blind", "front.lidar"]
    assert accepted(EXAMPLE)


def test_the_schema_refuses_what_the_reader_refuses():
    assert not accepted(EXAMPLE.replace("restart:", "explode:"))
    assert not accepted(EXAMPLE.replace("is: [crashed, stopped]", "is: [crashed, stoped]"))
    assert not accepted(EXAMPLE.replace("is: [crashed, stopped], ", ""))
    assert not accepted(EXAMPLE.replace("type: std_msgs/msg/Bool", "typ: std_msgs/msg/Bool"))
