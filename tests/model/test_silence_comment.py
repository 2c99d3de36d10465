"""The comment that silences a rule is one in the language that the rule reads."""

import pytest

from roslens.model.finding import RuleInfo
from roslens.model.words.silence_comment import measured_text, silence_comment


@pytest.mark.parametrize(
    ("rule", "languages", "comment"),
    [
        ("node.x", ("cpp",), "// roslens: ignore[node.x] reason"),
        ("python.x", ("python",), "# roslens: ignore[python.x] reason"),
        ("cmake.x", (), "# roslens: ignore[cmake.x] reason"),
        ("package.x", (), "<!-- roslens: ignore[package.x] reason -->"),
        ("graph.x", (), "roslens: ignore[graph.x] reason"),
        ("launch.x", (), "roslens: ignore[launch.x] reason"),
    ],
)
def test_the_comment(rule, languages, comment):
    assert silence_comment(RuleInfo(rule, "t", "d", languages=languages)) == comment


def test_what_nobody_read_is_not_measured():
    assert measured_text(RuleInfo("a", "t", "d")) == ""
