"""The exit codes that README's table promises; those of streams and signals are tested where these are."""

import json

import pytest

from roslens.cli.main import main
from roslens.cli.terminal import boundary

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>"""
LONG = "int f() { " + "if (g()) h(); " * 40 + "}\n"
BROKEN = "int f( { ]] } class ; struct { = = ) ]\n" * 20


@pytest.fixture
def arm(tmp_path):
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm" / "package.xml").write_text(MANIFEST)
    return tmp_path / "arm"


def check(folder, *words):
    return main(["check", str(folder), "--jobs", "1", "--no-store", "--no-cache", *words])


def test_clean_is_0(arm):
    (arm / "clean.py").write_text('"""Nothing."""\n')
    assert check(arm, "--fail-on", "error") == 0


def test_findings_at_or_above_fail_on_are_1(arm):
    (arm / "long.cpp").write_text(LONG)
    assert check(arm, "--fail-on", "note") == 1
    assert check(arm, "--fail-on", "never") == 0


def test_usage_and_bad_input_are_2(arm, capsys):
    for words in (["--no-such-option"], ["--format", "no-such-format"]):
        with pytest.raises(SystemExit) as ended:
            raise SystemExit(check(arm, *words))
        assert ended.value.code == 2
        assert words[-1] in capsys.readouterr().err
    assert check(arm / "not there") == 2
    (arm / "roslens.toml").write_text("no = [toml\n")
    assert check(arm) == 2


def test_own_code_that_does_not_parse_is_3_and_stated(arm, capsys):
    (arm / "broken.cpp").write_text(BROKEN)
    assert check(arm, "--format", "json", "--fail-on", "never") == 3
    (failure,) = json.loads(capsys.readouterr().out)["failures"]
    assert "broken.cpp" in json.dumps(failure)
    for role in ("test", "thirdparty"):
        (arm / role).mkdir(exist_ok=True)
        (arm / "broken.cpp").rename(arm / role / "broken.cpp")
        assert check(arm, "--fail-on", "never") == 0, role
        (arm / role / "broken.cpp").rename(arm / "broken.cpp")


def test_a_bug_is_70(arm, monkeypatch, tmp_path):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))

    def broken(*_, **__):
        raise ZeroDivisionError

    assert boundary.guarded(broken, ["check"]) == 70
    assert [*tmp_path.glob("roslens-bug-*.txt")]
