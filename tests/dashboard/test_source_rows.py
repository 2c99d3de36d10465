"""Source as HTML: lines with their numbers and findings; what stands in a file is text, never mark-up."""

from __future__ import annotations

from roslens.dashboard.sources.source_rows import CodeLine, excerpt_html, source_html
from roslens.dashboard.sources.source_text import Excerpt
from roslens.model.finding import Finding, Severity

NASTY = "</code><script>alert('a & \"b\"')"
FINDING = Finding("r", Severity.WARNING, "m", path="a.cpp", line=2)


def test_a_line_has_its_number_and_what_was_found_on_it() -> None:
    lines = [CodeLine(1, (("k", "int"), ("", " a;"))), CodeLine(2, (), (FINDING,))]
    first, second = source_html(lines, lambda findings: f"<p>{len(findings)}</p>").splitlines()
    assert 'id="L1"' in first
    assert '<code><span class="k">int</span> a;</code></div>' in first
    assert 'class="row flagged" id="L2"' in second
    assert '<div class="margin"><p>1</p></div>' in second
    assert 'class="glyph warning"' in second


def test_text_is_escaped_wherever_it_stands() -> None:
    whole = source_html([CodeLine(1, (("s", NASTY), ("", NASTY)))], lambda _: "")
    part = excerpt_html(Excerpt(((1, True, (("s", NASTY), ("", NASTY))),)))
    escaped = "&lt;/code&gt;&lt;script&gt;alert(&#39;a &amp; &#34;b&#34;&#39;)"
    for html in (whole, part):
        assert html.count(escaped) == 2
        assert "<script" not in html


def test_an_excerpt_marks_the_lines_of_the_finding() -> None:
    excerpt = Excerpt(((4, False, (("", "a"),)), (5, True, (("", "b"),))))
    assert excerpt_html(excerpt) == '<span class="l"><i>4</i>a</span><span class="l hit"><i>5</i>b</span>'
    assert excerpt_html(Excerpt(())) == ""
