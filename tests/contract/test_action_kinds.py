"""Every kind of action is declared, can be carried out by whoever it names, has a page, and is tried by a test."""

import inspect
from importlib import import_module
from pathlib import Path

import pytest

from roslens.live.act import actions
from roslens.model.acting.action_kind import ACTION_KINDS, By

FOLDER = Path(actions.__file__).parent
TESTS = Path(__file__).parents[1]
PARAMETERS = {By.ROS: ["ros", "asked"], By.HOST: ["host", "request"]}
TRIED_IN = {
    By.ROS: "live/react/test_orders.py",
    By.HOST: "live/agent/test_host_hand.py",
}


@pytest.mark.parametrize("kind", ACTION_KINDS, ids=lambda one: one.key)
def test_a_kind_has_a_file_of_its_name_that_carries_it_out(kind):
    module = import_module(f"roslens.live.act.actions.{kind.key}")
    assert module.__doc__.startswith(f"``{kind.key}``: ")
    parameters = list(inspect.signature(module.act).parameters)
    assert parameters == PARAMETERS.get(kind.by, parameters)
    assert parameters[0] == "decision" or kind.by is not By.MONITOR
    assert hasattr(module, "prepare") is (kind.by is By.ROS)
    assert "Raises:" in module.act.__doc__


def test_there_is_no_file_that_is_no_kind():
    files = {one.stem for one in FOLDER.glob("*.py")} - {"__init__"}
    assert files == {one.key for one in ACTION_KINDS}


@pytest.mark.parametrize("kind", ACTION_KINDS, ids=lambda one: one.key)
def test_a_kind_is_tried_by_a_test(kind):
    place = TESTS / TRIED_IN.get(kind.by, f"live/react/actions/test_{kind.key}.py")
    assert kind.by is By.MONITOR or f'"{kind.key}"' in place.read_text(), place


@pytest.mark.parametrize("kind", ACTION_KINDS, ids=lambda one: one.key)
def test_a_kind_has_a_page(kind):
    page = TESTS.parent / "docs" / "reference" / "actions" / f"{kind.key}.md"
    assert kind.summary in page.read_text(), "make docs"
