"""A process compiles each template once, however many sites it renders."""

import pytest
from jinja2 import Environment

from roslens.dashboard.render import environment


def test_a_second_environment_compiles_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    environment("served").get_template("keys.html")
    monkeypatch.setattr(Environment, "compile", lambda *arguments, **named: pytest.fail("compiled again"))
    assert environment("folder").get_template("keys.html").name == "keys.html"


def test_a_changed_template_is_compiled_again(tmp_path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("roslens.dashboard.render.TEMPLATES", tmp_path)
    for text in ("one", "two"):
        (tmp_path / "a.html").write_text(text)
        assert environment("served").get_template("a.html").render() == text
