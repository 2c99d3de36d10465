import os
from pathlib import Path

import pytest

from roslens.judge.patterns.pattern import Pattern
from roslens.live.agent.allow_list import EXAMPLE, AllowedNodes, AllowList, read_allow_list
from roslens.model.acting.host_request import HostRequest
from roslens.model.errors import DocumentError


def request(kind, node="/camera/left", **arguments):
    return HostRequest("r/1.1", kind, node, 7, (), arguments)


@pytest.fixture
def written(tmp_path):
    def write(text, mode=0o600):
        path = tmp_path / "allow.yaml"
        path.write_text(text)
        path.chmod(mode)
        return path

    return write


def test_nothing_is_allowed_that_is_not_written():
    assert "not on the allow-list" in AllowList().refusal(request("restart"), "")
    assert "not on the allow-list" in AllowList().refusal(request("command", name="x"), "")


def test_the_example_means_what_it_says(written):
    allow = read_allow_list(written(EXAMPLE))
    command = "/opt/ros/lib/camera/camera_node --ros-args"
    for node, kind, line, allowed in (
        ("/camera_left", "restart", command, True),
        ("/camera_left", "kill", command, False),
        ("/camera_left", "restart", "/usr/bin/other", False),
        ("/arm", "restart", command, False),
    ):
        assert (allow.refusal(request(kind, node), line) == "") is allowed
    assert allow.refusal(request("command", "", name="power_cycle"), "") == ""
    assert allow.commands["power_cycle"].words == ("/usr/bin/uhubctl", "-a", "cycle")
    assert allow.commands["power_cycle"].timeout_s == 20.0


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("nodes:\n- name: /a\n  actions: [reboot]\n", "allow.yaml:3:12: the action 'reboot'"),
        ("nodes:\n- actions: [stop]\n", "without a name"),
        ("nodes:\n- name: /a\n", "no actions"),
        ("commands:\n- name: a\n  run: [reboot]\n", "begins with 'reboot'"),
        ("commands:\n- name: a\n  run: [/bin/x]\n  timeout: 20\n", "no unit"),
        ("commands:\n- name: a\n  run: [/bin/x]\n  timeout: 1 h\n", "3600 s"),
        ("commands:\n- {name: a, run: [/b]}\n- {name: a, run: [/b]}\n", "second time"),
        ("node: []\n", "unknown key 'node'"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(written, text, why):
    with pytest.raises(DocumentError) as caught:
        read_allow_list(written(text))
    assert why in str(caught.value)


def test_a_list_that_others_can_write_is_none(written, tmp_path):
    with pytest.raises(DocumentError, match="chmod go-w"):
        read_allow_list(written(EXAMPLE, 0o666))
    with pytest.raises(DocumentError, match="--enrol"):
        read_allow_list(tmp_path / "none")


def test_a_list_that_others_can_replace_is_none(written, tmp_path):
    folder = tmp_path / "open"
    folder.mkdir()
    place = written(EXAMPLE)
    moved = folder / "allow.yaml"
    place.rename(moved)
    assert read_allow_list(moved).commands
    folder.chmod(0o777)
    with pytest.raises(DocumentError, match="others can replace it: they can write the folder"):
        read_allow_list(moved)
    # A link from elsewhere leads through the same folder.
    link = tmp_path / "link.yaml"
    link.symlink_to(moved)
    with pytest.raises(DocumentError, match="others can replace it"):
        read_allow_list(link)
    folder.chmod(0o1777)  # as /tmp is: what is there belongs to its owner
    assert read_allow_list(link).commands


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a link to somebody else")
def test_a_list_behind_a_link_of_somebody_else_is_none(written, tmp_path):
    link = tmp_path / "link.yaml"
    link.symlink_to(written(EXAMPLE))
    os.lchown(link, 12345, -1)
    with pytest.raises(DocumentError, match="they can write the link"):
        read_allow_list(link)


def test_a_list_is_opened_once(written, monkeypatch):
    place = written(EXAMPLE)
    opened = []
    really = os.open
    monkeypatch.setattr(
        os, "open", lambda path, *more, **named: opened.append(str(path)) or really(path, *more, **named)
    )
    read_allow_list(place)
    assert opened.count(str(place)) == 1


def test_the_page_of_the_agent_has_its_form():
    page = Path(__file__).parents[3] / "docs/reference/agent.md"
    assert EXAMPLE in page.read_text("utf-8")


def test_a_process_that_nothing_here_shows_to_be_the_node_needs_its_program():
    plain = AllowList((AllowedNodes(Pattern.parse("/camera*"), frozenset({"stop"})),))
    request = HostRequest("r/1.1", "stop", "/camera", 7)
    assert not plain.refusal(request, "python3 cam.py")
    assert "nothing on this host shows that process 7 ('python3 cam.py') is /camera" in plain.refusal(
        request, "python3 cam.py", shown=False
    )
    named = AllowList((AllowedNodes(Pattern.parse("/camera*"), frozenset({"stop"}), Pattern.parse("**cam.py")),))
    assert not named.refusal(request, "python3 cam.py", shown=False)
