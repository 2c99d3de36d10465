"""Code in messages is code in Markdown, and nothing else of them is markup."""

import pytest

from roslens.report.run.to_markdown import _prose


@pytest.mark.parametrize(
    ("message", "written"),
    [
        ("`std::this_thread::sleep_for` in a callback", "`std::this_thread::sleep_for` in a callback"),
        ("`a|b` and *no* emphasis", "`a\\|b` and \\*no\\* emphasis"),
        ("a lone ` stays", "a lone \\` stays"),
        ("`x` and a lone ` stays", "`x` and a lone \\` stays"),
        ("`` is empty", "\\`\\` is empty"),
        ("[a](http://b) <b> @team", "\\[a\\](http://b) \\<b\\> @\N{ZERO WIDTH SPACE}team"),
    ],
)
def test_code_and_text(message, written):
    assert _prose(message) == written
