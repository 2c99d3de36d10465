"""Moving through the package graph: zoom, pan, names, selection, panel, focus, table, and the address that keeps it."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from playwright.sync_api import Locator, Page, expect

Visit = Callable[..., Page]


def node(page: Page, facts: Any, name: str) -> Locator:
    """Return the disc and name of a package."""
    return page.locator(f'#nodes .node[data-n="{facts.names.index(name)}"]')


def scale(page: Page) -> float:
    """Return the zoom of the picture at rest."""
    expect(page.locator("#graph-canvas")).not_to_have_class(re.compile("moving"))
    transform = page.locator("#scene").get_attribute("transform") or ""
    return float(re.findall(r"scale\(([\d.]+)\)", transform)[0])


def offset(page: Page) -> tuple[float, float]:
    """Return where the origin of the picture stands."""
    expect(page.locator("#graph-canvas")).not_to_have_class(re.compile("moving"))
    transform = page.locator("#scene").get_attribute("transform") or ""
    x, y = re.findall(r"translate\(([-\d.]+) ([-\d.]+)\)", transform)[0]
    return float(x), float(y)


def names_shown(page: Page) -> int:
    """Return how many names can be read."""
    return int(
        page.locator("#nodes .node text").evaluate_all("found => found.filter(one => one.checkVisibility()).length")
    )


def busiest(facts: Any) -> str:
    """Return the package with most neighbours."""
    return max(facts.names, key=lambda name: len(facts.neighbours(name)))


def test_zoom_by_buttons_wheel_and_keys_reveals_names(visit: Visit, facts: Any) -> None:
    page = visit("/graph", viewport={"width": 1000, "height": 640})
    whole = scale(page)
    few = names_shown(page)
    assert few < len(facts.names)
    page.get_by_role("button", name="Zoom in").click()
    assert scale(page) > whole
    page.get_by_role("button", name="Zoom out").click()
    assert abs(scale(page) - whole) < 0.01
    page.locator("#graph-canvas").hover()
    page.mouse.wheel(0, -600)
    expect(page.locator("#graph-svg")).not_to_have_class(re.compile("no-names"))
    assert names_shown(page) == len(facts.names)
    page.mouse.wheel(0, 900)
    expect(page.locator("#graph-svg")).to_have_class(re.compile("no-names"))
    small = scale(page)
    page.keyboard.press("+")
    larger = scale(page)
    assert larger > small
    page.keyboard.press("-")
    assert scale(page) < larger
    page.keyboard.press("0")
    expect(page).not_to_have_url(re.compile("view="))
    assert abs(scale(page) - whole) < 0.01


def test_names_touch_neither_discs_nor_each_other(visit: Visit) -> None:
    page = visit("/graph", viewport={"width": 1000, "height": 640})
    boxes = page.locator("#nodes .node").evaluate_all(
        """found => found.map(one => [one.querySelector("circle"), one.querySelector("text")].map(part =>
        part.checkVisibility() ? (({left, right, top, bottom}) => [left, right, top, bottom])(
        part.getBoundingClientRect()) : null))"""
    )
    names = [(place, text) for place, (_, text) in enumerate(boxes) if text]
    assert len(names) > 5
    for place, (left, right, top, bottom) in names:
        for other, parts in enumerate(boxes):
            for box in parts if other != place else ():
                # A line of text is higher than its letters: two pixels of it may touch.
                assert box is None or not (
                    box[0] < right - 1 and left + 1 < box[1] and box[2] < bottom - 2 and top + 2 < box[3]
                ), f"the name of {place} lies on {other}"


def test_pan_by_drag_and_keys_is_kept_in_the_address(visit: Visit) -> None:
    page = visit("/graph")
    x, y = offset(page)
    box = page.locator("#graph-canvas").bounding_box()
    assert box
    page.mouse.move(box["x"] + 20, box["y"] + 20)
    page.mouse.down()
    page.mouse.move(box["x"] + 90, box["y"] + 70, steps=4)
    page.mouse.up()
    assert offset(page) == (round(x + 70, 2), round(y + 50, 2))
    expect(page).to_have_url(re.compile("view="))
    page.locator("#graph-canvas").press("Shift+ArrowRight")
    page.locator("#graph-canvas").press("Shift+ArrowDown")
    assert offset(page) == (round(x - 10, 2), round(y - 30, 2))
    moved = offset(page)
    expect(page).to_have_url(re.compile("view="))
    page.reload()
    restored = offset(page)
    assert max(abs(restored[0] - moved[0]), abs(restored[1] - moved[1])) < 2


def test_select_highlights_neighbours_and_fills_the_panel(visit: Visit, facts: Any) -> None:
    page = visit("/graph")
    name = busiest(facts)
    node(page, facts, name).locator("circle").click()
    expect(page).to_have_url(re.compile(f"select={name}"))
    expect(node(page, facts, name)).to_have_class(re.compile("selected"))
    near = page.locator("#nodes .node.near").evaluate_all("found => found.map(one => Number(one.dataset.n))")
    assert {facts.names[place] for place in near} == facts.neighbours(name)
    expect(page.locator("#links path")).to_have_count(len(facts.neighbours(name)))
    panel = page.locator("#graph-selected")
    expect(panel.locator("h2")).to_have_text(name)
    needs = [facts.names[place] for place in facts.nodes[facts.names.index(name)]["needs"]]
    if needs:
        panel.get_by_role("button", name=needs[0], exact=True).click()
        expect(panel.locator("h2")).to_have_text(needs[0])
    page.reload()
    expect(panel.locator("h2")).to_have_text(needs[0] if needs else name)
    page.keyboard.press("Escape")
    expect(page.locator("#nodes .node.selected")).to_have_count(0)
    expect(page).not_to_have_url(re.compile("select="))


def test_panel_collapses_and_the_address_says_so(visit: Visit) -> None:
    page = visit("/graph")
    panel = page.locator("#graph-panel")
    expect(panel).to_be_visible()
    page.get_by_role("button", name="Panel").click()
    expect(panel).to_be_hidden()
    expect(page).to_have_url(re.compile("panel=0"))
    page.reload()
    expect(panel).to_be_hidden()
    page.keyboard.press("s")
    expect(panel).to_be_visible()


def test_focus_grows_by_steps_and_clears(visit: Visit, facts: Any) -> None:
    page = visit("/graph")
    name = min(facts.names, key=lambda one: (len(facts.neighbours(one)) == 0, len(facts.neighbours(one)), one))
    nodes = page.locator("#nodes .node:not([hidden])")
    page.goto(page.url + f"?select={name}")
    page.keyboard.press("f")
    crumbs = page.locator("#graph-crumbs")
    expect(crumbs.locator("strong")).to_have_text(name)
    expect(nodes).to_have_count(len(facts.around(name, 1)))
    page.keyboard.press("f")
    expect(nodes).to_have_count(len(facts.around(name, 2)))
    expect(page).to_have_url(re.compile(f"focus={name}.*hops=2|hops=2.*focus={name}"))
    page.reload()
    expect(nodes).to_have_count(len(facts.around(name, 2)))
    crumbs.get_by_role("button", name="One step more").click()
    expect(nodes).to_have_count(len(facts.around(name, 3)))
    crumbs.get_by_role("button", name="One step fewer").click()
    crumbs.get_by_role("button", name="One step fewer").click()
    expect(nodes).to_have_count(len(facts.around(name, 1)))
    crumbs.get_by_text("All packages").click()
    expect(crumbs).to_be_hidden()
    expect(nodes).to_have_count(len(facts.names))
    expect(page).not_to_have_url(re.compile("focus="))
    page.keyboard.press("f")
    expect(crumbs).to_be_visible()
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    expect(crumbs).to_be_hidden()


def test_double_click_focuses(visit: Visit, facts: Any) -> None:
    page = visit("/graph")
    name = busiest(facts)
    node(page, facts, name).locator("circle").dblclick()
    expect(page.locator("#graph-crumbs strong")).to_have_text(name)


def test_table_twin_follows_filter_focus_and_sort(visit: Visit, facts: Any) -> None:
    page = visit("/graph")
    page.keyboard.press("t")
    table = page.locator("#graph-table")
    expect(table).to_be_visible()
    expect(page.locator("#graph-view")).to_be_hidden()
    expect(page).to_have_url(re.compile("table=1"))
    found = facts.findings()
    first = table.locator("tbody tr").first
    expect(first.locator("td").first).to_have_text(f"{max(found):,}")
    table.get_by_role("link", name="Package", exact=True).click()
    expect(first.locator("th")).to_have_text(min(facts.names))
    page.reload()
    expect(table).to_be_visible()
    expect(first.locator("th")).to_have_text(min(facts.names))
    name = busiest(facts)
    page.goto(page.url + f"&focus={name}")
    expect(table.locator("tbody tr:not([hidden])")).to_have_count(len(facts.around(name, 1)))
    page.get_by_role("button", name="Table").click()
    expect(table).to_be_hidden()


def test_a_small_screen_begins_where_the_darkest_are(visit: Visit) -> None:
    page = visit("/graph", viewport={"width": 420, "height": 860}, has_touch=True, is_mobile=True)
    expect(page.locator(".scene[transform]")).to_be_visible()
    canvas = page.locator("#graph-canvas").bounding_box() or {}
    boxes = page.locator("#nodes .node.s5 circle").evaluate_all(
        "found => found.map(one => one.getBoundingClientRect()).map(box => [box.left, box.top, box.right, box.bottom])"
    )
    assert any(
        box[0] >= canvas["x"]
        and box[2] <= canvas["x"] + canvas["width"]
        and box[1] >= canvas["y"]
        and box[3] <= canvas["y"] + canvas["height"]
        for box in boxes
    )
    assert scale(page) >= 0.66


def test_everything_at_once_is_restored(visit: Visit, facts: Any) -> None:
    name = busiest(facts)
    page = visit(f"/graph?colour=kloc&exclude=calls&focus={name}&hops=2&select={name}&panel=0&aside=1&view=0.9,200,100")
    for _ in range(2):
        expect(page.locator("#colour")).to_have_value("kloc")
        expect(page.locator(".chip.out")).to_contain_text("calls")
        expect(page.locator("#graph-crumbs strong")).to_have_text(name)
        expect(page.locator("#nodes .node:not([hidden])")).to_have_count(len(facts.around(name, 2)))
        expect(page.locator("#nodes .node.selected")).to_have_count(1)
        expect(page.locator("#graph-panel")).to_be_hidden()
        expect(page.get_by_label("tests, generated and vendored code too")).to_be_checked()
        assert scale(page) == 0.9
        page.reload()


def test_keyboard_alone_selects_focuses_and_opens(visit: Visit, facts: Any) -> None:
    page = visit("/graph")
    for _ in range(40):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.id") == "graph-canvas":
            break
    expect(page.locator("#graph-canvas")).to_be_focused()
    page.keyboard.press("ArrowRight")
    first = page.evaluate("document.activeElement.dataset.n")
    page.keyboard.press("ArrowRight")
    second = page.evaluate("document.activeElement.dataset.n")
    assert first != second
    page.keyboard.press("Enter")
    name = facts.names[int(second)]
    expect(page.locator("#graph-selected h2")).to_have_text(name)
    page.keyboard.press("f")
    expect(page.locator("#graph-crumbs strong")).to_have_text(name)
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    expect(page.locator("#graph-crumbs")).to_be_hidden()
    page.keyboard.press("Enter")
    page.keyboard.press("o")
    expect(page).to_have_url(re.compile(f"/packages/{name}"))


def test_on_a_narrow_screen_no_name_is_cut_where_the_picture_ends(visit: Visit) -> None:
    page = visit("/graph?view=1,-40,0", viewport={"width": 420, "height": 800})
    expect(page.locator("#nodes .node").first).to_be_attached()
    cut = page.evaluate(
        """() => {
        const canvas = document.getElementById("graph-canvas").getBoundingClientRect();
        const seen = [...document.querySelectorAll("#nodes .node:not([hidden])")].filter((one) => {
          const disc = one.querySelector("circle").getBoundingClientRect();
          const name = one.lastElementChild.getBoundingClientRect();
          const there = disc.right > canvas.left + 1 && disc.left < canvas.right - 1;
          return there && name.width && name.width < canvas.width - 20;
        });
        const outside = seen.filter((one) => {
          const name = one.lastElementChild.getBoundingClientRect();
          return name.left < canvas.left - 1 || name.right > canvas.right + 1;
        });
        return [seen.length, outside.map((one) => one.textContent.trim())];
      }"""
    )
    assert cut[0] > 0
    assert cut[1] == []
