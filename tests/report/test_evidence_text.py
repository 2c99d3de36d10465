"""Evidence as text, JSON, Markdown and a page."""

import json

import pytest

from roslens.dashboard.evidence_page import evidence_page
from roslens.model.requirement import Evidence, Item, Met
from roslens.model.source import Location
from roslens.report.run.evidence_text import evidence_json, evidence_markdown, evidence_text, verdict
from roslens.source.evidence.requirements import BY_NUMBER, REQUIREMENTS


@pytest.fixture
def evidence():
    def state(number):
        return {"1.ii": Met.NOT_MET, "2.iii": Met.NOT_KNOWN}.get(number, Met.MET)

    where = (Location("arm/package.xml", 4),)
    items = tuple(Item(one, state(one.number), f"shown <{one.number}>", where) for one in REQUIREMENTS)
    return Evidence("arm", "0.3.0", 2, items)


def test_levels(evidence):
    assert evidence.highest_shown == evidence.highest_open == 4
    assert verdict(evidence) == (
        "arm 0.3.0 claims level 2; all that level 4 requires is shown to be met; "
        "of the claimed level this is not met: 1.ii"
    )
    better = Evidence("arm", "1.0.0", 0, evidence.items[:1] + evidence.items[2:])
    assert (better.highest_open, better.highest_shown) == (1, 2)
    assert verdict(better).endswith("no evidence contradicts level 1, with 1 requirements not known")


def test_text(evidence):
    text = evidence_text(evidence)
    assert "✗ not met    RRR-  1.ii    is at a stable version (1.0.0 or above)\n" in text
    assert "shown <1.ii> (arm/package.xml:4)" in text


def test_json(evidence):
    document = json.loads(evidence_json(evidence))
    assert document["highest_shown"] == 4
    assert document["items"][1]["met"] == "not met"
    assert document["items"][1]["where"] == [{"path": "arm/package.xml", "line": 4}]


def test_a_declaration_claims_no_more_than_is_shown(evidence):
    text = evidence_markdown(evidence)
    assert "all that **Quality Level 4** requires" in text
    assert (
        "- ✗ **[1.ii]** is at a stable version (1.0.0 or above): *not met*. Shown <1.ii>. See `arm/package.xml:4`.\n"
        in text
    )
    assert text.count("**To be said by the maintainers.**") == 1
    assert text.count("\n## ") == 7


def test_a_page_escapes_what_it_shows(evidence):
    page = evidence_page(evidence)
    assert "shown &lt;1.ii&gt;" in page
    assert '<span class="not">✗ not met</span>' in page


def test_requirements_are_those_of_the_rep():
    assert len(REQUIREMENTS) == len(BY_NUMBER) == 32
    assert sum(one.weights[3].value == "required" for one in REQUIREMENTS) == 2
