"""The package graph's colours: relative to what is visible, under tags, per thousand lines, by a metric."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from playwright.sync_api import Page, expect

Visit = Callable[..., Page]
Steps = Callable[[list[float]], list[str]]


def fills(page: Page) -> list[str]:
    """Return the step of the ramp of each package, in the order of the twin."""
    classes = page.locator("#nodes .node").evaluate_all("found => found.map(one => one.getAttribute('class'))")
    return [re.findall(r"\bs[0-5n]\b", names)[0] for names in classes]


def legend_counts(page: Page) -> list[int]:
    """Return how many packages the legend says that each step holds."""
    return [int(text.split()[0].replace(",", "")) for text in page.locator("#legend-steps small").all_inner_texts()]


def test_edges_are_drawn_for_dependencies_and_lead_in_the_twin(visit: Visit, facts: Any) -> None:
    page = visit("/graph?table=1")
    path = page.locator("#scene > .edges").first.get_attribute("d")
    assert path
    assert path.count("M") > len(facts.nodes) / 2
    needs = page.locator("#graph-table tbody tr").evaluate_all(
        "found => found.map(row => [Number(row.dataset.id), row.cells[4].textContent.trim()])"
    )
    assert len(needs) == len(facts.nodes)
    for place, text in needs:
        assert set(text.split()) == {facts.names[other] for other in facts.nodes[place]["needs"]}


def test_darker_means_more_findings(visit: Visit, facts: Any, steps: Steps) -> None:
    page = visit("/graph")
    found = facts.findings()
    expect(page.locator("#legend-title")).to_have_text(
        f"Findings in own code, relative to the {len(found)} packages shown"
    )
    assert fills(page) == steps(found)
    assert sum(legend_counts(page)) == len(found)
    expect(page.locator("#legend-steps li").last).to_contain_text(str(max(found)))


def test_excluding_a_tag_by_completion_recolours_and_is_kept(visit: Visit, facts: Any, steps: Steps) -> None:
    page = visit("/graph")
    before = fills(page)
    page.locator("#exclude-chips").click()
    options = page.locator("#exclude ~ .chips .options li")
    everything = dict(
        zip(
            options.evaluate_all("found => found.map(one => one.dataset.tag)"),
            options.locator("small").all_inner_texts(),
            strict=True,
        )
    )
    assert everything["calls"] == f"{sum(facts.findings('calls')):,}"
    page.keyboard.type("call")
    expect(options).to_have_count(1)
    page.keyboard.press("Enter")
    expect(page.locator(".chip.out")).to_contain_text("calls")
    expect(page).to_have_url(re.compile("exclude=calls"))
    after = steps(facts.findings(exclude="calls"))
    assert fills(page) == after
    assert after != before
    page.reload()
    expect(page.locator(".chip.out")).to_contain_text("calls")
    assert fills(page) == after
    page.get_by_role("button", name="take calls away").click()
    expect(page.locator(".chip.out")).to_have_count(0)
    assert fills(page) == before


def test_including_a_tag_shows_only_its_findings(visit: Visit, facts: Any, steps: Steps) -> None:
    page = visit("/graph")
    page.locator("#include-chips").click()
    page.keyboard.press("ArrowDown")
    page.locator("#include ~ .chips .options li", has_text="google").first.click()
    expect(page).to_have_url(re.compile("include=google"))
    found = facts.findings("google")
    assert fills(page) == steps(found)
    labels = page.locator("#nodes .node").evaluate_all("found => found.map(one => one.getAttribute('aria-label'))")
    assert labels == [f"{name}: {count} findings in own code" for name, count in zip(facts.names, found, strict=True)]
    page.locator("#include-chips").press("Backspace")
    expect(page.locator(".chips .chip")).to_have_count(0)


def test_per_kloc_and_metric_colour_and_own_code(visit: Visit, facts: Any, steps: Steps) -> None:
    page = visit("/graph")
    found = facts.findings()
    page.locator("#colour").select_option("kloc")
    expect(page.locator("#legend-title")).to_contain_text("Findings per 1,000 lines of own code")
    expect(page).to_have_url(re.compile("colour=kloc"))
    every = facts.findings(own=False)
    assert every != found
    rates = [
        1000 * count / node["loc"] if node["loc"] else None for count, node in zip(found, facts.nodes, strict=True)
    ]
    known = steps([rate for rate in rates if rate is not None])
    assert fills(page) == ["sn" if rate is None else known.pop(0) for rate in rates]
    expect(page.locator("#legend-steps")).to_contain_text("not measured")
    metric = facts.metrics["loc"]
    page.locator("#colour").select_option("metric:loc")
    expect(page.locator("#legend-title")).to_contain_text(metric["title"])
    largest = max(range(len(found)), key=lambda place: metric["values"][place] or 0)
    assert fills(page)[largest] == "s5"
    page.reload()
    expect(page.locator("#colour")).to_have_value("metric:loc")
    assert fills(page)[largest] == "s5"
    page.locator("#colour").select_option("findings")
    assert fills(page) == steps(found)
    page.get_by_label("tests, generated and vendored code too").check()
    expect(page).to_have_url(re.compile("aside=1"))
    expect(page.locator("#legend-title")).to_contain_text("Findings in all code")
    assert fills(page) == steps(every)


def test_colours_are_relative_to_the_focus(visit: Visit, facts: Any, steps: Steps) -> None:
    found = facts.findings()
    # A package whose neighbours are all paler than the darkest of the workspace.
    name = next(
        name for name in facts.names if len(near := facts.around(name, 1)) > 2
        and 0 < max(found[facts.names.index(other)] for other in near) < max(found) / 4
    )  # fmt: skip
    page = visit(f"/graph?focus={name}")
    near = [facts.names.index(other) for other in facts.around(name, 1)]
    expect(page.locator("#legend-title")).to_contain_text(f"relative to the {len(near)} packages shown")
    shown = fills(page)
    assert [shown[place] for place in near] == steps([found[place] for place in near])
    assert "s5" in {shown[place] for place in near}


def test_a_metric_says_that_tags_do_not_colour_it(visit: Visit) -> None:
    page = visit("/graph?colour=metric:loc")
    told = page.locator("#legend-unfiltered")
    expect(told).to_be_hidden()
    before = fills(page)
    page.get_by_label("tests, generated and vendored code too").check()
    expect(told).to_contain_text("A metric has no tags")
    assert fills(page) == before
    page.get_by_label("tests, generated and vendored code too").uncheck()
    expect(told).to_be_hidden()
    page = visit("/graph?colour=metric:loc&include=calls")
    expect(page.locator("#legend-unfiltered")).to_be_visible()
    page.locator("#colour").select_option("findings")
    expect(page.locator("#legend-unfiltered")).to_be_hidden()


def test_the_legend_explains_every_kind_of_line(visit: Visit) -> None:
    page = visit("/graph")
    assert page.locator("#scene > .edges.cycles").get_attribute("d")
    legend = page.locator("#graph-legend .lines li")
    assert legend.all_inner_texts() == ["what the selected package needs", "what needs it", "dependency cycle"]
    looks = "found => found.map(one => { const s = getComputedStyle(one); return s.stroke + s.strokeDasharray; })"
    swatches = legend.locator("path").evaluate_all(looks)
    assert len(set(swatches)) == 3
    drawn = page.locator("#scene > .edges.cycles").evaluate_all(looks)
    assert drawn == swatches[2:]
