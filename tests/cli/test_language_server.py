"""``roslens lsp`` as an editor speaks with it: messages over standard input and output."""

import sys
from importlib.util import find_spec

import pytest
from cli.broken_parser import BREAKING
from cli.editor_client import Editor

from roslens.cli.main import main

MANY_CALLS = "def walk(step):\n" + "".join(f"    step.move_{number}()\n" for number in range(12)) + "    return step\n"


@pytest.fixture
def editor(talking):
    if find_spec("pygls") is None:
        pytest.skip("pygls is not installed: pip install 'roslens[lsp]'")
    (talking / "talk/talk/walking.py").write_text(MANY_CALLS)
    (talking / "roslens.toml").write_text('[rules]\ndisable = ["*"]\n')
    made = Editor(talking)
    yield made
    made.end()


@pytest.mark.heavy
def test_an_editor_is_answered(editor):
    path = "talk/talk/walking.py"
    uri = (editor.root / path).as_uri()
    capabilities = editor.start()
    assert capabilities["hoverProvider"]
    assert capabilities["codeActionProvider"]["codeActionKinds"] == ["quickfix", "source.fixAll.roslens"]
    found = {one["code"]: one for one in editor.open(path)}
    assert found["ros.calls.max"]["range"] == {
        "start": {"line": 0, "character": 0},
        "end": {"line": 0, "character": 15},
    }
    assert found["ros.calls.max"]["source"] == "roslens"
    place = {"textDocument": {"uri": uri}, "position": {"line": 0, "character": 6}}
    hover = editor.send("textDocument/hover", place)
    assert "**Calls above 10** (`ros.calls.max`)" in hover["contents"]["value"]
    nowhere = editor.send("textDocument/hover", {**place, "position": {"line": 5, "character": 0}})
    assert nowhere is None
    asked = {"textDocument": {"uri": uri}, "range": found["ros.calls.max"]["range"], "context": {"diagnostics": []}}
    actions = editor.send("textDocument/codeAction", asked)
    (action,) = [one for one in actions if "ros.calls.max" in one["title"]]
    (edit,) = action["edit"]["changes"][uri]
    lines = (editor.root / path).read_text().splitlines(keepends=True)
    at = edit["range"]["start"]
    assert (at["line"], edit["newText"]) == (0, "  # roslens: ignore[ros.calls.max] ")
    lines[0] = lines[0][: at["character"]] + edit["newText"] + "a table" + lines[0][at["character"] :]
    (editor.root / path).write_text("".join(lines))
    assert "ros.calls.max" not in {one["code"] for one in editor.save(path)}
    # A file that is new, and one that is of no package.
    (editor.root / "talk/talk/fresh.py").write_text(MANY_CALLS)
    assert "ros.calls.max" in {one["code"] for one in editor.open("talk/talk/fresh.py")}
    (editor.root / "loose.txt").write_text("")
    assert editor.open("loose.txt") == []
    assert editor.stop() == 0


MODES = """\
def mode(name, größe):
    if größe is 3 and name is "auto":
        return 1
    return name is not "off"
"""


def applied(text, edits):
    """Return a text with edits of the protocol made, columns in units of UTF-16."""
    lines = text.splitlines(keepends=True)

    def offset(place):
        line = lines[place["line"]].encode("utf-16-le")[: 2 * place["character"]].decode("utf-16-le")
        return sum(map(len, lines[: place["line"]])) + len(line)

    for edit in sorted(edits, key=lambda one: offset(one["range"]["start"]), reverse=True):
        start, end = offset(edit["range"]["start"]), offset(edit["range"]["end"])
        text = text[:start] + edit["newText"] + text[end:]
    return text


@pytest.mark.heavy
def test_an_editor_fixes_one_finding_or_all(editor):
    (editor.root / "roslens.toml").write_text('[rules]\nprofiles = []\nenable = ["python.is_literal"]\n')
    path = "talk/talk/modes.py"
    place = editor.root / path
    place.write_text(MODES)
    uri = place.as_uri()
    editor.start()
    found = [one for one in editor.open(path) if one["code"] == "python.is_literal"]
    assert len(found) == 3

    def actions(line, *only):
        context = {"diagnostics": [], **({"only": list(only)} if only else {})}
        at = {"start": {"line": line, "character": 0}, "end": {"line": line, "character": 0}}
        return editor.send("textDocument/codeAction", {"textDocument": {"uri": uri}, "range": at, "context": context})

    fixes = [one for one in actions(3, "quickfix") if one.get("isPreferred")]
    (fix,) = fixes
    assert fix["title"].startswith("Fix python.is_literal: ")
    assert fix["diagnostics"][0]["range"]["start"]["line"] == 3
    assert applied(MODES, fix["edit"]["changes"][uri]) == MODES.replace("is not", "!=")
    (everything,) = actions(0, "source.fixAll")
    assert everything["kind"] == "source.fixAll.roslens"
    fixed = MODES.replace("is not", "!=").replace(" is ", " == ")
    assert applied(MODES, everything["edit"]["changes"][uri]) == fixed
    assert [one["kind"] for one in actions(0)][-1] == "source.fixAll.roslens"
    assert not [one for one in actions(0) if one.get("isPreferred")]
    # What the editor changed and did not save is not what was looked at.
    change = {"textDocument": {"uri": uri, "version": 2}, "contentChanges": [{"text": "\n" + MODES}]}
    editor.notify("textDocument/didChange", change)
    assert not [one for one in actions(3) if one.get("isPreferred") or one["kind"] != "quickfix"]
    place.write_text(fixed)
    assert not [one for one in editor.save(path) if one["code"] == "python.is_literal"]
    assert editor.stop() == 0


@pytest.mark.heavy
def test_a_fix_may_change_another_file(editor):
    (editor.root / "roslens.toml").write_text('[rules]\nprofiles = []\nenable = ["package.undeclared_dependency"]\n')
    (editor.root / "talk/launch/fleet.launch.xml").unlink()
    uri = (editor.root / "talk/talk/nodes.py").as_uri()
    editor.start()
    editor.open("talk/talk/nodes.py")
    at = {"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 0}}
    asked = {"textDocument": {"uri": uri}, "range": at, "context": {"diagnostics": []}}
    (fix,) = [one for one in editor.send("textDocument/codeAction", asked) if one.get("isPreferred")]
    ((changed, edits),) = fix["edit"]["changes"].items()
    assert changed == (editor.root / "talk/package.xml").as_uri()
    text = (editor.root / "talk/package.xml").read_text()
    assert "<exec_depend>rclpy</exec_depend>" in applied(text, edits)
    assert editor.stop() == 0


@pytest.mark.heavy
def test_a_wrong_configuration_is_shown_and_the_server_goes_on(editor):
    (editor.root / "roslens.toml").write_text("modles = []\n")
    editor.start()
    assert editor.open("talk/talk/walking.py") == []
    (shown,) = [one["params"]["message"] for one in editor.reported if one.get("method") == "window/showMessage"]
    assert "unknown key 'modles'" in shown
    assert editor.stop() == 0


@pytest.mark.heavy
@pytest.mark.skipif(sys.platform != "linux", reason="the kernel's bounds are those of Linux")
def test_a_file_of_any_kind_that_breaks_its_reader_costs_itself_alone(editor, tmp_path):
    editor.process.kill()
    editor.process.wait()
    places = {
        "talk/package.xml": "",
        "talk/CMakeLists.txt": "project(talk)\n",
        "talk/launch/fleet.launch.xml": "",
        "talk/talk/small.py": "step = 1\n",
        "talk/src/small.cpp": "int f() { return 1; }\n",
    }
    for path, text in places.items():
        place = editor.root / path
        place.parent.mkdir(exist_ok=True)
        if text:
            place.write_text(text)
    (editor.root / "roslens.toml").unlink()
    hooks = tmp_path / "hooks"
    hooks.mkdir()
    (hooks / "sitecustomize.py").write_text(BREAKING)
    second = Editor(editor.root, PYTHONPATH=str(hooks), BROKEN_BY=":".join(places))
    try:
        second.start()
        assert "ros.calls.max" in {one["code"] for one in second.open("talk/talk/walking.py")}
        for path in places:
            lost = [one["message"] for one in second.open(path) if one["code"] == "roslens.not_analysed"]
            assert len(lost) == 1, (path, lost)
            assert "or breaks the parser" in lost[0]
        assert "ros.calls.max" in {one["code"] for one in second.save("talk/talk/walking.py")}
        assert second.stop() == 0
    finally:
        second.end()


def test_without_pygls_it_says_what_to_install(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "pygls", None)
    monkeypatch.setitem(sys.modules, "pygls.lsp", None)
    monkeypatch.setitem(sys.modules, "pygls.lsp.server", None)
    monkeypatch.setitem(sys.modules, "lsprotocol", None)
    monkeypatch.delitem(sys.modules, "roslens.cli.editor.language_server", raising=False)
    assert main(["lsp"]) == 2
    assert "pip install 'roslens[lsp]'" in capsys.readouterr().err
