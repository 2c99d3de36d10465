"""Silenced findings from end to end: comments, [[ignore]], ``roslens accept``, and every report that shows them."""

import json
import re

import pytest

from roslens.cli.graph.site import site_of
from roslens.cli.main import main
from roslens.cli.workplace.workplace import open_store
from roslens.dashboard.routes import PAGES
from roslens.dashboard.view import Query, Request

MANY_CALLS = "def walk(step):\n" + "".join(f"    step.move_{number}()\n" for number in range(12)) + "    return step\n"


@pytest.fixture
def walking(talking):
    (talking / "talk/talk/walking.py").write_text(MANY_CALLS)
    configure(talking)
    return talking


def configure(root, text=""):
    (root / "roslens.toml").write_text(f'{text}\n[rules]\ndisable = ["*"]\n')


def check(root, capsys, *more, code=0):
    assert main(["check", str(root), "--format", "json", "--jobs", "1", "-q", "--no-graph", *more]) == code
    return json.loads(capsys.readouterr().out)


def calls(report):
    return [one for one in report["findings"] if one["rule"] == "ros.calls.max"]


def notes(report):
    return [one["rule"] for one in report["findings"] if one["rule"].startswith("roslens.")]


def test_a_comment_is_shown_as_set_aside(walking, capsys):
    path = walking / "talk/talk/walking.py"
    path.write_text(MANY_CALLS.replace("step):\n", "step):  # roslens: ignore[calls.max] table\n"))
    report = check(walking, capsys)
    assert calls(report) == []
    (one,) = report["set_aside"]
    assert (one["state"], one["reason"], one["by"]) == ("suppressed", "table", "talk/talk/walking.py:1")
    assert one["finding"]["rule"] == "ros.calls.max"
    assert one["finding"]["package"] == "talk"
    assert notes(report) == []
    path.write_text(path.read_text().replace("    step.move_1()\n", "").replace("    step.move_2()\n", ""))
    assert notes(check(walking, capsys)) == ["roslens.suppression_unused"]


def test_an_ignore_of_the_configuration(walking, capsys):
    text = '[[ignore]]\npaths = ["talk/talk/*"]\nrules = ["calls.max"]\nreason = "legacy"\n'
    configure(walking, text + text.replace("talk/talk/*", "gone/*"))
    report = check(walking, capsys)
    assert [one["by"] for one in report["set_aside"]] == ["[[ignore]] 1"]
    assert notes(report) == ["roslens.ignore_unused"]
    assert [one["path"] for one in report["findings"] if one["rule"] == "roslens.ignore_unused"] == ["roslens.toml"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[[ignore]]\npaths = ["x"]\n', "reason"),
        ('[[ignore]]\npaths = ["x"]\nreason = " "\n', "[[ignore]] 1 has no reason"),
        ('[[ignore]]\nreason = "x"\n', "no paths and no rules"),
        ('[[ignore]]\npath = ["x"]\nreason = "x"\n', "path"),
    ],
)
def test_a_wrong_ignore_is_told(walking, capsys, text, said):
    configure(walking, text)
    assert main(["check", str(walking), "-q"]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert "roslens.toml" in error


def test_accept_and_undo(walking, capsys):
    check(walking, capsys)
    accept = ["accept", "--path", str(walking)]
    assert main([*accept, "talk/talk/walking.py:1"]) == 2
    assert '--reason "why' in capsys.readouterr().err
    assert main([*accept, "calls.max@talk/talk/*", "--reason", "it is a table"]) == 0
    capsys.readouterr()
    report = check(walking, capsys)
    assert calls(report) == []
    (one,) = report["set_aside"]
    assert (one["state"], one["reason"]) == ("accepted", "it is a table")
    assert main([*accept, "--list"]) == 0
    assert "it is a table" in capsys.readouterr().out
    assert main([*accept, "--undo", one["by"][:8]]) == 0
    assert not (walking / "roslens.accepted.toml").exists()
    capsys.readouterr()
    assert len(calls(check(walking, capsys))) == 1


def test_accepted_survives_a_move_and_is_noted_when_gone(walking, capsys):
    found = calls(check(walking, capsys))[0]["fingerprint"]
    assert main(["accept", "--path", str(walking), found[:8], "--false-positive", "--reason", "x"]) == 0
    capsys.readouterr()
    old, new = walking / "talk/talk/walking.py", walking / "talk/talk/legs/walking.py"
    new.parent.mkdir()
    old.rename(new)
    report = check(walking, capsys)
    assert [(one["state"], one["finding"]["path"]) for one in report["set_aside"]] == [
        ("false_positive", "talk/talk/legs/walking.py")
    ]
    assert notes(report) == []
    new.write_text("")
    assert notes(check(walking, capsys)) == ["roslens.acceptance_unused"]


def test_an_accepted_file_that_is_wrong_is_a_failure_and_the_results_stand(walking, capsys):
    place = walking / "roslens.accepted.toml"
    place.write_text('[[accepted]]\nfingerprint = "x"\n')
    report = check(walking, capsys, code=3)
    assert len(calls(report)) == 1
    (failure,) = report["failures"]
    assert (failure["tool"], failure["path"], failure["line"]) == ("accepted", "roslens.accepted.toml", 1)
    assert main(["accept", "--path", str(walking), "calls.max@*", "--reason", "x"]) == 2
    assert "Fix the file first" in capsys.readouterr().err
    assert place.read_text() == '[[accepted]]\nfingerprint = "x"\n'


@pytest.mark.parametrize("given", ["ffffffff", "0", "nowhere.py:3", "calls.max@other/*"])
def test_an_id_that_means_nothing(walking, capsys, given):
    check(walking, capsys)
    assert main(["accept", "--path", str(walking), given, "--reason", "x"]) == 2
    assert f'"{given}" means no finding' in capsys.readouterr().err


def test_every_report_shows_what_is_set_aside(walking, capsys, tmp_path):
    configure(walking, '[[ignore]]\nrules = ["calls.max"]\nreason = "legacy"\n')
    sarif, markdown, tables = tmp_path / "a.sarif", tmp_path / "a.md", tmp_path / "tables"
    words = ["check", str(walking), "--jobs", "1", "-q", "--no-graph", "--format", f"sarif={sarif}"]
    assert main([*words, "--format", f"markdown={markdown}", "--format", f"csv={tables}"]) == 0
    assert "1 finding is set aside: 1 by [[ignore]]" in re.sub(r"\s+", " ", capsys.readouterr().out)
    assert "1 finding set aside: 1 ignored." in markdown.read_text()
    assert "ignored,legacy,[[ignore]] 1,ros.calls.max" in (tables / "set_aside.csv").read_text()
    (one,) = [one for one in json.loads(sarif.read_text())["runs"][0]["results"] if "suppressions" in one]
    assert one["suppressions"] == [
        {
            "kind": "external",
            "status": "accepted",
            "justification": "legacy",
            "properties": {"state": "ignored", "by": "[[ignore]] 1"},
        }
    ]


def test_the_page_of_findings_shows_what_is_set_aside(walking, capsys):
    configure(walking, '[[ignore]]\nrules = ["calls.max"]\nreason = "legacy"\n')
    check(walking, capsys)
    with open_store(str(walking)) as store:
        site = site_of(store.view())
        page = PAGES["findings"](site, Request())
        filtered = PAGES["findings"](site, Request(query=Query((("rule", "x"),))))
    assert [cell.value for cell in page.table("set_aside").rows[0]][3:] == ["[[ignore]]", "legacy", "[[ignore]] 1"]
    assert filtered.tables == ()


def test_what_breaks_several_limits_is_accepted_as_one_and_each_limit_can_be_suppressed(walking, capsys):
    path = walking / "talk/talk/walking.py"
    long = MANY_CALLS.replace(
        "    return", "".join(f"    step.value_{number} = {number}\n" for number in range(70)) + "    return"
    )
    path.write_text(long)

    def limits(report):
        return [one["rule"] for one in report["findings"] if one["path"].endswith("walking.py") and one.get("model")]

    assert "ros.function_limits" in limits(check(walking, capsys))
    assert main(["accept", "--path", str(walking), "function_limits@talk/talk/*", "--reason", "generated"]) == 0
    capsys.readouterr()
    report = check(walking, capsys)
    assert "ros.function_limits" not in limits(report)
    assert [one["finding"]["rule"] for one in report["set_aside"]] == ["ros.function_limits"]
    assert notes(report) == []
    path.write_text(long.replace("step):\n", "step):  # roslens: ignore[calls.max] table\n"))
    report = check(walking, capsys)
    assert "ros.eloc.max" in limits(report)
    assert "ros.function_limits" not in limits(report)


def test_a_comment_in_a_manifest_and_in_a_list_of_cmake(walking, capsys):
    manifest = walking / "talk/package.xml"
    (walking / "roslens.toml").write_text('[rules]\nenable = ["package.maintainer_email"]\n')
    text = manifest.read_text().replace(
        '<maintainer email="a@example.org">a</maintainer>', "<maintainer>a</maintainer>{}"
    )
    for comment, count in (("", 1), ("<!-- roslens: ignore[package.maintainer_email] asked -->", 0)):
        manifest.write_text(text.format(comment))
        main(["check", str(walking), "--format", "json", "--jobs", "1", "-q", "--no-graph", "--fail-on", "never"])
        report = json.loads(capsys.readouterr().out)
        assert len([one for one in report["findings"] if one["rule"] == "package.maintainer_email"]) == count
        assert [one["finding"]["path"] for one in report["set_aside"]] == ["talk/package.xml"] * (1 - count)
    manifest.write_text(manifest.read_text().replace("<maintainer>", '<maintainer email="a@example.org">'))
    main(["check", str(walking), "--format", "json", "--jobs", "1", "-q", "--no-graph", "--fail-on", "never"])
    assert notes(json.loads(capsys.readouterr().out)) == ["roslens.suppression_unused"]
