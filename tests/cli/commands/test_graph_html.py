"""``roslens graph --html``: the picture as one file."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslens.cli.main import main

EXAMPLE = str(Path(__file__).parents[3] / "examples" / "workspace")


def test_the_graph_of_a_launch_file_is_one_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "rover.html"
    assert main(["graph", EXAMPLE, "--launch", "rover_bringup/rover.launch.py", "--html", str(out)]) == 0
    assert capsys.readouterr().out == f"{out}\n"
    text = out.read_text(encoding="utf-8")
    assert 'id="computation/rover.launch.py"' in text
    assert "/rover_follower" in text
    assert 'class="element-findings"' in text


def test_packages_of_both_generations_are_two_graphs(tmp_path: Path) -> None:
    out = tmp_path / "all.html"
    assert main(["graph", EXAMPLE, "--html", str(out)]) == 0
    assert out.read_text(encoding="utf-8").count('data-graph="computation"') == 2


@pytest.mark.parametrize("more", [["--format", "json"], ["-o", "x"], ["--diff", "a", "b"]])
def test_it_stands_alone(more: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["graph", EXAMPLE, "--html", str(tmp_path / "x.html"), *more]) == 2
    assert "--html FILE alone" in capsys.readouterr().err
