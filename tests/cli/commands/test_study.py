"""The command as a user gives it."""

import re
import subprocess
from pathlib import Path

import pytest

from roslens.cli.main import main

FIXTURES = Path(__file__).parents[2] / "fixtures" / "study"
PAPER = ["--csv", str(FIXTURES / "package_repo_metrics.csv"), "--csv", str(FIXTURES / "package_compliance.csv")]


def test_the_paper_as_text(capsys):
    assert main(["study", *PAPER]) == 0
    out = capsys.readouterr().out
    assert out.startswith("180 packages of 45 repositories; commits, contributors")
    assert re.search(r"^LOC +180 +461 +1,454\.15 +3,779\.17 ", out, re.MULTILINE)
    assert "does not hold  Findings of MAC are below a dozen.\n               12 in 8 packages" in out


def test_the_paper_as_latex_and_csv(capsys):
    assert main(["study", *PAPER, "--format", "latex"]) == 0
    out = capsys.readouterr().out
    assert r"\#RQV & 180 & 3 & 8.03 & 26.80 & 0 & 1 & 7 & 333 &  &  \\" in out
    assert r"MIN\_COM\_RATIO & metric & 639 & 91 & 13 & 131 & 495 \\" in out
    assert main(["study", *PAPER, "--format", "csv"]) == 0
    out = capsys.readouterr().out
    assert "figures,LOC,180,461,1454.15,3779.17,20,243.25,1247.25,36353,,\n" in out.replace("\r", "")
    assert out.count("correlations,") == 55


def test_the_paper_as_a_page(tmp_path):
    page = tmp_path / "study.html"
    assert main(["study", *PAPER, "--by", "role", "--format", "html", "-o", str(page)]) == 0
    text = page.read_text()
    assert "✗ does not hold" in text
    assert text.count("<g><title>driver: n 99") == 11
    assert str(FIXTURES) not in text


def test_a_page_without_groups(tmp_path):
    page = tmp_path / "study.html"
    assert main(["study", *PAPER, "--format", "html", "-o", str(page)]) == 0
    text = page.read_text()
    assert '<td class="num">36,353</td>' in text
    assert "By role" not in text


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--csv", "a.csv", "."], "--csv and runs; expected one of them"),
        (["--format", "html"], "--format html; expected -o FILE"),
        (PAPER[2:], "expected one table with a column `package`, or the tables"),
        (["--csv", "missing.csv"], "No such file"),
    ],
)
def test_what_makes_no_sense_is_told(capsys, arguments, message):
    assert main(["study", *arguments]) == 2
    assert message in capsys.readouterr().err


def test_runs_of_a_workspace(tmp_path, capsys, monkeypatch):
    for name, lines in (("one", 3), ("two", 9), ("three", 5)):
        package = tmp_path / name
        package.mkdir()
        (package / "package.xml").write_text(f"<package><name>{name}</name></package>")
        (package / "node.py").write_text("".join(f"x{n} = {n}\n" for n in range(lines)))
    monkeypatch.chdir(tmp_path)
    main(["check", "-q", "--fail-on", "never", "-o", "out.json"])
    capsys.readouterr()
    assert main(["study", "--by", "language"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("3 packages of 0 repositories")
    assert re.search(r"^Lines of code +python +3 +5 ", out, re.MULTILINE)
    assert main(["study", "--quantity", "beauty"]) == 2
    assert 'no quantity "beauty" in these runs' in capsys.readouterr().err
    assert main(["study", "99"]) == 2


def test_roles_of_a_workspace(tmp_path, capsys, monkeypatch):
    for name, file in (("pr2_teleop", "keys.py"), ("arm_msgs", "msg/Arm.msg")):
        path = tmp_path / name / file
        path.parent.mkdir(parents=True)
        path.write_text("def main():\n    pass\n" if file.endswith(".py") else "")
        (tmp_path / name / "package.xml").write_text(
            f"<package><name>{name}</name><run_depend>rospy</run_depend></package>"
        )
    monkeypatch.chdir(tmp_path)
    main(["check", "-q", "--fail-on", "never", "-o", "out.json"])
    capsys.readouterr()
    assert main(["roles"]) == 0
    first, second = capsys.readouterr().out.splitlines()
    assert re.match(r"arm_msgs +library +interfaces +1 definitions of interfaces and no code; ", first)
    assert re.match(r'pr2_teleop +application +"teleop" in its name or repository; ', second)
    assert main(["roles", "--format", "csv", "--package", "arm_msgs"]) == 0
    assert capsys.readouterr().out.splitlines()[1].startswith("arm_msgs,library,interfaces,")
    assert main(["roles", "--package", "nav"]) == 2
    assert 'no package "nav" in this run; expected one of arm_msgs, pr2_teleop' in capsys.readouterr().err
    assert main(["study", "--by", "role"]) == 0
    assert "interfaces" in capsys.readouterr().out


def test_percentiles_of_a_workspace(tmp_path, capsys, monkeypatch):
    (tmp_path / "package.xml").write_text("<package><name>large</name></package>")
    (tmp_path / "node.py").write_text("".join(f"x{n} = {n}\n" for n in range(30)))
    monkeypatch.chdir(tmp_path)
    main(["check", "-q", "--fail-on", "never", "-o", "out.json"])
    capsys.readouterr()
    assert main(["percentile", "--quantity", "loc"]) == 0
    out = capsys.readouterr().out
    assert re.search(
        r"^  Lines of code  30 lines  \d+ of all \(\d+\), \d+ of library \(\d+\), \d+ of python", out, re.MULTILINE
    )
    assert main(["percentile", "--quantity", "beauty"]) == 2
    assert 'no quantity "beauty" in the field ros-2026' in capsys.readouterr().err
    assert main(["percentile", "--package", "other"]) == 2


def test_evidence_of_a_package(tmp_path, capsys, monkeypatch):
    (tmp_path / "package.xml").write_text(
        "<package><name>arm</name><version>2.0.0</version><license>MIT</license></package>"
    )
    (tmp_path / "node.py").write_text("# Copyright 2026\n")
    monkeypatch.chdir(tmp_path)
    main(["check", "-q", "--fail-on", "never", "-o", "out.json"])
    capsys.readouterr()
    assert main(["evidence", "arm"]) == 0
    out = capsys.readouterr().out
    assert "✓ met        RRRR  3.iv    states a copyright in each source file" in out
    assert "✗ not met    RRRR  3.iii   declares its licence" in out
    page = tmp_path / "page.html"
    assert main(["evidence", "arm", "--format", "html", "-o", str(page)]) == 0
    assert "Evidence on arm" in page.read_text()
    assert main(["evidence", "arms"]) == 2
    assert 'no package "arms" in this run; expected such as arm' in capsys.readouterr().err


def test_evidence_of_a_run_without_packages(tmp_path, capsys):
    (tmp_path / "README").write_text("x")
    main(["check", str(tmp_path), "-q", "-o", str(tmp_path / "out.json")])
    capsys.readouterr()
    assert main(["evidence", "arm", "--workspace", str(tmp_path)]) == 2
    assert 'no package "arm" in this run; expected a run that has packages' in capsys.readouterr().err


def test_process_metrics_are_of_repositories(tmp_path, capsys, monkeypatch):
    words = ["git", "-c", "user.name=a", "-c", "user.email=a@b.example", "-C"]
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
        (tmp_path / name / "node.py").write_text("x = 1\n")
        for more in (["init", "-q"], ["add", "."], ["commit", "-q", "-m", "first"]):
            subprocess.run([*words, tmp_path / name, *more], check=True)
    monkeypatch.chdir(tmp_path)
    main(["check", "-q", "--process-metrics", "--fail-on", "never", "-o", "out.json"])
    capsys.readouterr()
    assert main(["study", "--quantity", "revisions", "--quantity", "loc"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("2 packages of 2 repositories; commits, contributors and issues are those of repositories")
    assert re.search(r"^Revisions +2 +1 +1 +0 ", out, re.MULTILINE)
