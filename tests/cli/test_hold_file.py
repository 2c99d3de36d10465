import json
import time

import pytest

from roslens.cli.main import main
from roslens.cli.react.hold_file import Held, hold, hold_path, release


@pytest.fixture
def environment(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    return {"XDG_STATE_HOME": str(tmp_path)}


def test_a_hold_is_seen_at_once_and_so_is_its_release(environment):
    held = Held(environment)
    assert held() == ""
    hold(environment, "ann", "changing the gripper", None)
    assert held() == "by ann: changing the gripper"
    hold(environment, "bob", "", None)
    assert held() == "by bob"
    assert release(environment)
    assert held() == ""
    assert not release(environment)


def test_a_hold_ends_by_itself_where_it_was_said_so(environment):
    held = Held(environment)
    hold(environment, "ann", "", time.time() + 3600)
    assert held()
    hold(environment, "ann", "", time.time() - 1)
    assert held() == ""


@pytest.mark.parametrize(
    "content", ["", "{", "[]", json.dumps({"by": "ann"}), json.dumps({"by": 1, "why": "", "until": "x"})]
)
def test_a_hold_that_cannot_be_read_holds(environment, content):
    held = Held(environment)
    path = hold_path(environment)
    path.parent.mkdir(parents=True)
    path.write_text(content)
    assert "its author cannot be read" in held()
    path.unlink()
    path.mkdir()
    assert held()


def test_the_command_holds_and_releases(environment, capsys):
    assert main(["react", "--hold", "cleaning", "--for", "30min"]) == 0
    assert "everything is held until" in capsys.readouterr().out
    assert "cleaning" in Held(environment)()
    assert main(["react", "--release"]) == 0
    assert Held(environment)() == ""
    assert main(["react", "--release"]) == 0
    assert "nothing was held" in capsys.readouterr().out
