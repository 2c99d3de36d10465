"""Lists of findings: filters in the address, groups, keys, each finding in full."""

from __future__ import annotations

import json
import re
from collections.abc import Callable

from playwright.sync_api import Page, expect

Visit = Callable[..., Page]
Fetch = Callable[[str], str]


def test_filters_work_in_place_and_live_in_the_address(visit: Visit, fetch: Fetch) -> None:
    page = visit("/findings")
    total = json.loads(fetch("/findings.json"))["total"]
    expect(page.locator("#findings .count").first).to_contain_text(f"of {total:,} shown")
    page.get_by_label("Severity").select_option("error")
    expect(page).to_have_url(re.compile("severity=error"))
    errors = json.loads(fetch("/findings.json?severity=error"))["total"]
    assert 0 < errors < total
    expect(page.locator("#findings")).to_have_attribute("data-total", str(errors))
    assert set(page.locator(".finding").evaluate_all("all => all.map(one => one.dataset.severity)")) == {"error"}
    page.locator("#include-chips").click()
    page.keyboard.type("manif")
    page.keyboard.press("Enter")
    expect(page).to_have_url(re.compile("include=manifest"))
    expect(page.locator(".finding")).to_have_count(
        json.loads(fetch("/findings.json?include=manifest&severity=error"))["total"]
    )
    page.reload()
    expect(page.get_by_label("Severity")).to_have_value("error")
    expect(page.locator(".chips .chip")).to_contain_text("manifest")
    page.get_by_role("link", name="Clear filters").click()
    expect(page.locator("#findings")).to_have_attribute("data-total", str(total))
    page.wait_for_load_state()  # a page of its own, which filters in place once its script runs
    page.locator("#text").fill("costmap")
    page.keyboard.press("Enter")
    expect(page).to_have_url(re.compile("text=costmap"))
    wanted = json.loads(fetch("/findings.json?text=costmap"))["total"]
    expect(page.locator("#findings")).to_have_attribute("data-total", str(wanted))
    page.get_by_label("Code").select_option("vendored")
    expect(page.get_by_text("No finding matches these filters.").first).to_be_visible()


def test_groups_by_rule_and_by_file(visit: Visit) -> None:
    page = visit("/findings")
    expect(page.locator(".group h3 code").first).to_be_visible()
    page.get_by_label("Group by").select_option("file")
    expect(page).to_have_url(re.compile("group=file"))
    expect(page.locator(".group h3 .title").first).to_contain_text("/")
    page.reload()
    expect(page.get_by_label("Group by")).to_have_value("file")


def test_keys_walk_open_and_lead_to_the_line(visit: Visit) -> None:
    page = visit("/findings?severity=warning")
    findings = page.locator(".finding")
    page.keyboard.press("j")
    expect(findings.nth(0)).to_have_class(re.compile("current"))
    page.keyboard.press("j")
    page.keyboard.press("j")
    page.keyboard.press("k")
    expect(findings.nth(1)).to_have_class(re.compile("current"))
    expect(page.locator(".finding.current")).to_have_count(1)
    page.keyboard.press("Enter")
    expect(findings.nth(1).locator("details")).to_have_attribute("open", "")
    more = findings.nth(1).locator(".more")
    for word in ("Rule", "Place", "Package", "Tool", "Tags"):
        expect(more.get_by_text(word, exact=True)).to_be_visible()
    page.keyboard.press("e")
    page.keyboard.press("e")
    assert page.locator(".finding > details[open]").count() in {0, findings.count()}
    place = findings.nth(1).locator("a.place").first.get_attribute("href")
    assert place
    page.keyboard.press("o")
    expect(page).to_have_url(re.compile(re.escape(place)))
    row = page.locator(f"#{place.partition('#')[2]}")
    expect(row).to_be_in_viewport()
    expect(row.locator(".margin-note").first).to_be_visible()


def test_package_page_has_findings_metrics_and_functions(visit: Visit, fetch: Fetch) -> None:
    page = visit("/packages")
    page.locator("#packages tbody tr").first.get_by_role("link").first.click()
    expect(page).to_have_url(re.compile("/packages/."))
    page.wait_for_load_state()
    name = page.locator("h1").inner_text()
    document = json.loads(fetch(f"/packages/{name}.json"))
    assert document["key"] == name
    first = page.locator("#findings .finding").first
    first.locator("summary").click()
    expect(first.locator(".excerpt .hit")).to_have_count(1)
    for table in ("metrics", "functions"):
        assert page.locator(f"section.table#{table} tbody tr").count() > 0
    page.get_by_label("Group by").select_option("file")
    expect(page).to_have_url(re.compile("group=file"))
    expect(page.locator("#findings .group h3 .title a").first).to_be_visible()
    page.get_by_role("link", name="Show on the graph").click()
    expect(page.locator("#graph-selected h2")).to_have_text(name)


def test_packages_are_filtered_by_name_and_tag(visit: Visit) -> None:
    page = visit("/packages")
    page.locator("#text").fill("planner")
    page.keyboard.press("Enter")
    expect(page).to_have_url(re.compile("text=planner"))
    names = page.locator("#packages tbody th").all_inner_texts()
    assert names
    assert all("planner" in name for name in names)
    page.get_by_label("Columns").select_option("all")
    expect(page).to_have_url(re.compile("columns=all"))


def test_a_note_beside_code_has_one_line_until_it_is_clicked(visit: Visit, flagged_file: str) -> None:
    page = visit(flagged_file)
    note = page.locator(".margin .margin-note").first
    text = note.locator(".message")
    line = note.evaluate("one => parseFloat(getComputedStyle(one).lineHeight)")
    text.evaluate("one => { one.textContent = 'a long message about this line '.repeat(12); }")
    assert note.evaluate("one => one.clientHeight") < 2 * line
    note.click(position={"x": 60, "y": 8})
    assert note.evaluate("one => one.clientHeight") > 2 * line
    page.locator("h1").click()
    assert note.evaluate("one => one.clientHeight") < 2 * line


def test_a_list_that_is_cut_says_how_many_there_are_once(visit: Visit) -> None:
    count = visit("/findings?role=gated").locator("#findings .bar-line .count").first
    assert re.fullmatch(r"[\d,]+ of [\d,]+ shown", count.inner_text())
    all_of_it = visit("/findings").locator("#findings .bar-line .count").first
    assert re.fullmatch(r"[\d,]+ of [\d,]+ shown: [\d,]+ in own code and [\d,]+ elsewhere", all_of_it.inner_text())


def test_numbers_of_findings_are_worded_as_such(visit: Visit) -> None:
    for path in ("/", "/packages/nav2_util"):
        for one in visit(path).locator(".figures li:has(.mark)").all_inner_texts():
            number, word = one.split()
            assert word.endswith("s") is (number != "1")
