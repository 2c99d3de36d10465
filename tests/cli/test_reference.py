from pathlib import Path

import pytest

from roslens.cli.reference import main, pages

REFERENCE = Path(__file__).parents[2] / "docs" / "reference"


@pytest.mark.parametrize("path", sorted(pages()))
def test_the_page_is_fresh(path: str):
    assert (REFERENCE / path).read_text("utf-8") == pages()[path], "`make docs` writes it anew"


def test_help_writes_nothing(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        main(["--help"])
    assert ended.value.code == 0
    assert "folder" in capsys.readouterr().out
    assert list(tmp_path.iterdir()) == []
