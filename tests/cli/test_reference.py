from pathlib import Path

import pytest

from roslens.cli.reference import main, pages

REFERENCE = Path(__file__).parents[2] / "docs" / "reference"


def test_every_page_is_fresh():
    wanted = pages()
    assert len(wanted) > 300
    stale = [path for path, text in wanted.items() if _kept(path) != text]
    assert stale == [], "`make docs` writes them anew"


def _kept(path: str) -> str:
    place = REFERENCE / path
    return place.read_text("utf-8") if place.exists() else ""


def test_help_writes_nothing(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        main(["--help"])
    assert ended.value.code == 0
    assert "folder" in capsys.readouterr().out
    assert list(tmp_path.iterdir()) == []
