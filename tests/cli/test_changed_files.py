"""Files that are not what a run saw."""

from roslens.cli.main import main
from roslens.cli.workplace.changed_files import and_more, changed_files
from roslens.cli.workplace.workplace import open_store


def test_what_changed_vanished_and_came(talking):
    assert main(["check", str(talking), "-q", "--jobs", "1", "--no-graph", "--fail-on", "never"]) == 0
    with open_store(str(talking)) as store:
        view = store.view()
        seen = {file.path for _, file in view.files()}
        assert changed_files(view, seen) == ()
        (talking / "talk/setup.py").unlink()
        (talking / "talk/talk/nodes.py").write_text("")
        assert changed_files(view) == ("talk/setup.py", "talk/talk/nodes.py")
        now = {*seen, "talk/new.py", "talk/picture.png"}
        assert changed_files(view, now) == ("talk/new.py", "talk/setup.py", "talk/talk/nodes.py")


def test_the_first_is_named():
    assert and_more(("a",)) == "a"
    assert and_more(("a", "b", "c")) == "a and 2 more"
