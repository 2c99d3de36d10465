"""``roslens graph --format svg``."""

from __future__ import annotations

from xml.etree import ElementTree as ET

from roslens.cli.main import main


def test_one_launch_file_is_one_svg_with_what_does_not_fit(talking, tmp_path, capsys):
    out = tmp_path / "talk.svg"
    launch = ["graph", str(talking), "--jobs", "1", "--launch", "talk/robot.launch.xml", "--format", "svg"]
    assert main([*launch, "-o", str(out)]) == 0
    ET.parse(out)
    assert "topic /chatter" in out.read_text()
    assert "/rosout" not in out.read_text().partition(" hidden: ")[0]
    assert 'class="mark error"' in out.read_text()
    capsys.readouterr()
    assert main([*launch, "--all"]) == 0
    assert "topic /rosout" in capsys.readouterr().out


def test_one_svg_is_one_picture(tmp_path, capsys):
    assert main(["graph", str(tmp_path), "--format", "svg", "--no-cache"]) == 2
    assert "--format svg without any node" in capsys.readouterr().err
