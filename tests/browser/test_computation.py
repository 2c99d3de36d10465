"""The computation graph as readers use it: filters, focus, search, panel, keys, and the address that keeps it all."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from roslens.dashboard.computation.pages import computation_file

Visit = Callable[..., Page]


def element(page: Page, name: str) -> Locator:
    """Return an element of the picture by its whole name."""
    return page.locator(f'section.current .nodes [data-name="{name}"], main:not(.paged) .nodes [data-name="{name}"]')


def shown(page: Page) -> set[str]:
    """Return the names of the elements that can be seen."""
    found = page.locator(".nodes .node:not([hidden])").evaluate_all("all => all.map(one => one.dataset.name)")
    return set(found)


def test_noise_is_left_out_and_comes_back(visit: Visit) -> None:
    page = visit("/computation/rover")
    assert "/scan" in shown(page)
    assert "/rosout" not in shown(page)
    page.get_by_label("/rosout", exact=True).uncheck()
    page.get_by_label("what every node has").uncheck()
    assert "/rosout" in shown(page)
    expect(page).to_have_url(re.compile("noise=events%2Cparameters%2Clifecycle"))
    page.reload()
    assert "/rosout" in shown(page)
    page.get_by_label("/tf", exact=True).check()
    assert "/tf" not in shown(page)


def test_names_are_left_out_by_pattern(visit: Visit) -> None:
    page = visit("/computation/rover")
    page.get_by_label("Names to leave out").fill("/left,/sc*")
    page.get_by_label("Names to leave out").press("Enter")
    assert not {"/left/camera", "/left/image_raw", "/scan"} & shown(page)
    assert "/right/camera" in shown(page)


def test_topics_become_lines_and_marks_again(visit: Visit) -> None:
    page = visit("/computation/rover")
    marks = page.locator(".wires path").count()
    page.get_by_label("Topics", exact=True).select_option("lines")
    expect(page).to_have_url(re.compile("topics=lines"))
    assert "/scan" not in shown(page)
    page.locator(".wires path").evaluate_all(
        "found => found.forEach(one => one.dispatchEvent(new PointerEvent('pointerover', { bubbles: true })))"
    )
    assert page.locator(".wires path title").filter(has_text="/scan").count() == 1
    page.get_by_label("Topics", exact=True).select_option("marks")
    assert page.locator(".wires path").count() == marks
    assert "/scan" in shown(page)


def test_a_selection_tells_its_ends_and_their_lines(visit: Visit) -> None:
    page = visit("/computation/rover")
    element(page, "/scan").click()
    panel = page.locator("#graph-selected")
    expect(panel).to_contain_text("Who publishes (1)")
    expect(panel).to_contain_text("src/rover/lidar.cpp:44")
    expect(panel).to_contain_text("best effort, volatile, keep last 5")
    assert page.locator(".links .gives").count() == 1
    assert page.locator(".links .takes").count() == 1
    expect(page).to_have_url(re.compile("select=topic%2Fscan"))
    panel.get_by_role("button", name="/navigation/planner").click()
    expect(panel).to_contain_text("Publishes (3)")
    page.keyboard.press("o")
    expect(page).to_have_url(re.compile("/nodes/rover/navigation/planner"))


def test_focus_shows_what_is_near_with_inputs_on_the_left(visit: Visit) -> None:
    page = visit("/computation/rover?focus=node/odometry")
    assert shown(page) == {"/odometry", "/cmd_vel", "/odometry/reset", "/odom", "/tf"}
    left, middle, right = (element(page, name).bounding_box() or {} for name in ("/cmd_vel", "/odometry", "/odom"))
    assert left["x"] < middle["x"] < right["x"]
    page.get_by_role("button", name="One step more").click()
    assert "/navigation/planner" in shown(page)
    page.locator("#graph-canvas").focus()
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    expect(page.locator("#graph-crumbs")).to_be_hidden()
    assert "/lidar" in shown(page)


def test_names_far_away_stay_inside_of_the_picture(visit: Visit) -> None:
    page = visit("/computation/rover", viewport={"width": 900, "height": 420})
    expect(page.locator(".scene[transform]")).to_be_visible()
    page.get_by_role("button", name="All", exact=True).click()
    canvas = page.locator("#graph-canvas").bounding_box() or {}
    names = page.locator(".no-names .nodes .node.named text")
    assert names.count()
    for number in range(names.count()):
        box = names.nth(number).bounding_box() or {}
        assert canvas["x"] <= box["x"]
        assert box["x"] + box["width"] <= canvas["x"] + canvas["width"]


def test_a_mark_that_nothing_leaves_has_no_line_behind_it(visit: Visit) -> None:
    page = visit("/computation/rover", viewport={"width": 900, "height": 420})
    expect(page.locator(".scene[transform]")).to_be_visible()
    page.get_by_role("button", name="All", exact=True).click()
    leads = page.locator(".nodes .node:not([hidden]) .lead").evaluate_all(
        "found => found.filter(one => one.checkVisibility()).map(one => Number(one.closest('.node').dataset.n))"
    )
    giving = page.evaluate("JSON.parse(document.getElementById('graph-data').textContent).wires.map(one => one.source)")
    assert leads
    assert set(leads) <= set(giving)


def test_what_is_searched_for_stands_out(visit: Visit) -> None:
    page = visit("/computation/rover")
    page.get_by_label("Find", exact=True).fill("camera")
    expect(page.locator(".node.found")).to_have_count(4)
    page.get_by_label("Find", exact=True).press("Enter")
    expect(page).to_have_url(re.compile("find=camera"))
    expect(page.locator(".node.selected")).to_have_count(1)


def test_by_keys_alone(visit: Visit) -> None:
    page = visit("/computation/rover")
    page.locator("#graph-canvas").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    expect(page.locator(".node.selected")).to_have_count(1)
    page.keyboard.press("f")
    expect(page.locator("#graph-crumbs")).to_be_visible()
    page.keyboard.press("t")
    expect(page.get_by_role("heading", name="Endpoints")).to_be_visible()
    page.keyboard.press("t")
    expect(page.locator("#graph-svg")).to_be_visible()


def test_tables_follow_the_filters(visit: Visit) -> None:
    page = visit("/computation/rover?table=1")
    rows = page.locator("#endpoints tbody tr:visible")
    expect(rows.filter(has_text="/scan")).to_have_count(2)
    expect(rows.filter(has_text="/rosout")).to_have_count(0)
    page.get_by_label("Names to leave out").fill("/scan")
    page.get_by_label("Names to leave out").press("Enter")
    expect(rows.filter(has_text="/scan")).to_have_count(0)
    expect(page.locator("#endpoints .count")).to_have_text(re.compile(r"\d+ of \d+ shown"))


def test_without_scripts_picture_and_tables_stand(visit: Visit) -> None:
    page = visit("/computation/rover", java_script_enabled=False)
    expect(page.locator("#graph-svg")).to_be_visible()
    expect(page.get_by_role("heading", name="Endpoints")).to_be_visible()
    expect(page.locator("#endpoints tbody tr").first).to_be_visible()
    page.get_by_label("/tf", exact=True).check()
    page.get_by_role("button", name="Apply").click()
    assert "/tf" not in shown(page)
    assert "/rosout" not in shown(page)


@pytest.mark.parametrize("path", ["/computation/rover", "/nodes/rover/navigation/planner", "/topics/rover/topic/scan"])
@pytest.mark.parametrize("width", [360, 800])
def test_narrow_pages_do_not_scroll_sideways(visit: Visit, path: str, width: int) -> None:
    page = visit(path, viewport={"width": width, "height": 700})
    assert page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth") <= 0


@pytest.mark.parametrize(
    "path",
    [
        "/computation/rover",
        "/nodes/rover/rover_follower",
        "/topics/rover/topic/scan",
        "/graph",
        "/",
        "/packages/rover_base",
    ],
)
def test_pages_of_long_names_do_not_scroll_sideways_on_a_phone(visit_example: Visit, path: str) -> None:
    page = visit_example(path, viewport={"width": 420, "height": 860})
    assert page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth") <= 0


@pytest.fixture(scope="session")
def one_file(made_up: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("computation") / "large.html"
    computation_file({"large": made_up.large(), "rover": made_up.robot()}, path)
    return path


def open_file(browser: Browser, path: Path, fragment: str = "") -> tuple[Page, list[str]]:
    page = browser.new_context(viewport={"width": 1280, "height": 800}).new_page()
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.on(
        "request", lambda request: None if request.url.startswith(("file:", "data:")) else problems.append(request.url)
    )
    page.goto(path.as_uri() + fragment)
    return page, problems


def test_a_large_system_in_one_file_starts_quickly_and_readably(browser: Browser, one_file: Path) -> None:
    page, problems = open_file(browser, one_file)
    expect(page.locator("section.current .nodes .node:not([hidden])")).to_have_count(80)
    expect(page.locator("section.current .scene[transform]")).to_be_visible()
    # It begins with a part of it, in which every node has its name; the whole has them as far as there is room.
    expect(page.locator("section.current svg.no-names")).to_have_count(0)
    page.locator("section.current").get_by_role("button", name="All", exact=True).click()
    nodes = page.locator("section.current .nodes .node.node:not([hidden])")
    named = page.locator("section.current .nodes .node.node.named")
    expect(page.locator("section.current svg.no-names")).to_have_count(1)
    assert named.count() >= 0.6 * nodes.count()
    # Names touch neither each other nor the boxes of other nodes.
    boxes = page.locator("section.current .nodes .node:not([hidden])").evaluate_all(
        """found => found.map(one => [one.querySelector(".outline"), one.querySelector("text")].map(part =>
        part.checkVisibility() ? (({left, right, top, bottom}) => [left, right, top, bottom])(
        part.getBoundingClientRect()) : null))"""
    )
    names = [(number, text) for number, (_, text) in enumerate(boxes) if text]
    assert len(names) > 20
    for number, name in names:
        for other, parts in enumerate(boxes):
            if other == number:
                continue
            for part in parts:
                apart = (
                    not part
                    or part[1] <= name[0]
                    or name[1] <= part[0]
                    or part[3] <= name[2] + 1
                    or name[3] <= part[2] + 1
                )
                assert apart, (number, other)
    page.goto(one_file.as_uri() + "#computation/rover")
    expect(page.locator("section.current .nodes .node:not([hidden])")).to_have_count(22)
    page.locator("section.current .nodes").get_by_text("detector", exact=True).click()
    expect(page.locator("section.current .panel")).to_contain_text('camera == "true"')
    assert not problems
    page.context.close()


def test_pages_of_one_file_lead_to_each_other(browser: Browser, one_file: Path) -> None:
    page, problems = open_file(browser, one_file, "#topics/rover/topic/scan")
    page.get_by_role("link", name="/navigation/planner").click()
    expect(page.locator("section.current h1")).to_have_text("/navigation/planner")
    expect(page.locator('[data-nav="computation/rover"]')).to_have_attribute("aria-current", "page")
    page.get_by_role("link", name="Show on the graph").locator("visible=true").click()
    expect(page.locator("section.current .panel h2")).to_have_text("/navigation/planner")
    assert not problems
    page.context.close()


PHONE = {"viewport": {"width": 420, "height": 860}, "has_touch": True, "is_mobile": True}


def zoom_of(page: Page) -> float:
    """Return the zoom of the picture at rest."""
    expect(page.locator("#graph-canvas")).not_to_have_class(re.compile("moving"))
    transform = page.locator(".scene").get_attribute("transform") or ""
    return float(re.findall(r"scale\(([\d.]+)\)", transform)[0])


def test_a_small_screen_begins_where_most_is_and_names_can_be_read(visit: Visit) -> None:
    page = visit("/computation/rover", **PHONE)
    expect(page.locator(".scene[transform]")).to_be_visible()
    start = zoom_of(page)
    assert start >= 0.66
    expect(page.locator("#graph-svg")).not_to_have_class(re.compile("no-names"))
    canvas = page.locator("#graph-canvas").bounding_box() or {}
    boxes = page.locator(".nodes .node:not([hidden])").evaluate_all(
        "found => found.map(one => one.getBoundingClientRect()).map(box => [box.left, box.top, box.right, box.bottom])"
    )
    inside = [
        box
        for box in boxes
        if box[0] >= canvas["x"]
        and box[2] <= canvas["x"] + canvas["width"]
        and box[1] >= canvas["y"]
        and box[3] <= canvas["y"] + canvas["height"]
    ]
    assert len(inside) >= 3
    page.get_by_role("button", name="All", exact=True).tap()
    assert zoom_of(page) < start
    page.get_by_role("button", name="Zoom in").tap()
    expect(page).to_have_url(re.compile("view="))
    page.reload()
    expect(page.locator(".scene[transform]")).to_be_visible()
    assert zoom_of(page) < start


def test_two_fingers_zoom_and_move_the_picture(visit: Visit) -> None:
    page = visit("/computation/rover", **PHONE)
    expect(page.locator(".scene[transform]")).to_be_visible()
    before = zoom_of(page)
    canvas = page.locator("#graph-canvas").bounding_box() or {}
    x, y = canvas["x"] + canvas["width"] / 2, canvas["y"] + canvas["height"] / 2
    wire = page.context.new_cdp_session(page)

    def fingers(kind: str, *points: tuple[float, float]) -> None:
        told = [{"x": at[0], "y": at[1], "id": number} for number, at in enumerate(points)]
        wire.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": told})

    fingers("touchStart", (x - 40, y), (x + 40, y))
    for step in range(1, 6):
        fingers("touchMove", (x - 40 - 8 * step, y), (x + 40 + 8 * step, y))
    fingers("touchEnd")
    expect(page).to_have_url(re.compile("view="))
    apart = zoom_of(page)
    assert 1.7 < apart / before < 2.3
    transform = page.locator(".scene").get_attribute("transform") or ""
    fingers("touchStart", (x - 40, y), (x + 40, y))
    for step in range(1, 6):
        fingers("touchMove", (x - 40, y + 10 * step), (x + 40, y + 10 * step))
    fingers("touchEnd")
    expect(page.locator(".scene")).not_to_have_attribute("transform", transform)
    assert zoom_of(page) == pytest.approx(apart, rel=0.05)
    down = [
        float(re.findall(r"translate\(\S+ ([-\d.]+)", one)[0])
        for one in (transform, page.locator(".scene").get_attribute("transform") or "")
    ]
    assert down[1] - down[0] == pytest.approx(50, abs=8)


def test_the_panel_lists_the_nodes(visit: Visit) -> None:
    page = visit("/computation/rover")
    panel = page.locator("#graph-selected")
    expect(panel).to_contain_text("Nodes (8)")
    listed = set(panel.locator(".pick").all_text_contents())
    nodes = set(page.locator(".nodes .node.node:not([hidden])").evaluate_all("all => all.map(one => one.dataset.name)"))
    assert {"/odometry", "/lidar"} <= listed & nodes
    panel.get_by_role("button", name="/odometry", exact=True).press("Enter")
    expect(page).to_have_url(re.compile("select=node%2Fodometry"))


@pytest.mark.parametrize(
    "query", ["", "topics=lines", "noise=tf,debug&hide=/scan,/status,/mission", "focus=node/lidar"]
)
def test_no_way_to_draw_it_hides_a_finding(visit: Visit, made_up: Any, query: str) -> None:
    page = visit(f"/computation/rover?{query}")
    told = page.locator("#graph-selected .reported > li")
    expect(told).to_have_count(len(made_up.robot_findings()))
    for one in made_up.robot_findings():
        assert told.filter(has_text=one.message.replace("`", "")).count() == 1
    expect(page.locator("#findings tbody tr:visible")).to_have_count(len(made_up.robot_findings()))


def test_a_finding_leads_to_what_it_is_about(visit: Visit) -> None:
    page = visit("/computation/rover?topics=lines")
    panel = page.locator("#graph-selected")
    panel.locator(".reported li").first.get_by_role("button", name="/scan").click()
    expect(panel.locator("h2")).to_have_text("/scan")
    expect(panel.locator(".reported li")).to_contain_text("nothing arrives")
    expect(page.locator(".links path")).to_have_count(1)
    page = visit("/computation/rover?hide=/scan")
    page.locator("#graph-selected .reported li").first.get_by_role("link", name="/scan").click()
    expect(page).to_have_url(re.compile("/topics/rover/topic/scan"))


def test_lines_between_nodes_have_names_and_marks_and_can_be_selected(visit: Visit) -> None:
    page = visit("/computation/rover?topics=lines&view=1.2,500,300")
    names = page.locator(".line-names [data-line]")
    expect(names.filter(has_text="scan")).to_have_count(1)
    assert names.filter(has_text="scan").locator(".glyph.error").count() == 1
    assert re.search(r"\d (topics|names)", " ".join(names.all_text_contents()))
    names.filter(has_text="scan").locator("text").dispatch_event("click")
    expect(page.locator("#graph-selected h2")).to_have_text("/scan")
    expect(page).to_have_url(re.compile("select=topic%2Fscan"))
    page.locator("#graph-selected").get_by_role("button", name="Clear").click()
    names.filter(has_text=re.compile(r"\d (topics|names)")).first.locator("text").dispatch_event("click")
    assert page.locator("#graph-selected .pick").count() >= 2
    page.get_by_label("Topics", exact=True).select_option("marks")
    expect(names).to_have_count(0)


def test_names_of_lines_stand_on_their_lines_and_once_where_several_share_a_part(visit: Visit) -> None:
    page = visit("/computation/rover?topics=lines&view=1.2,500,300")
    expect(page.locator(".line-names text").first).to_be_attached()
    names = page.evaluate("""() => [...document.querySelectorAll(".line-names [data-line]")].flatMap((one) => {
      const text = one.querySelector("text");
      if (!text) return [];
      const [x, y] = one.getAttribute("transform").match(/-?[\\d.]+/g).map(Number);
      const line = document.querySelector(`.reach [data-line="${one.dataset.line}"]`);
      const point = new DOMPoint(x, y);
      return [{ text: text.textContent, x, y, on: line.isPointInStroke(point) }];
    })""")
    assert len(names) > 3
    assert [one for one in names if not one["on"]] == []
    for one, other in combinations(names, 2):
        if one["text"] == other["text"] and abs(one["y"] - other["y"]) < 1:
            assert abs(one["x"] - other["x"]) > 30, (one, other)


def test_a_name_stands_on_the_level_part_that_no_other_line_shares(visit: Visit) -> None:
    page = visit("/computation/rover?topics=lines")
    paths = [
        "M0 50H100q7 0 7 7V93q0 7 7 7H300m-6 -3l6 3l-6 3",
        "M0 50H100q7 0 7 7V193q0 7 7 7H300m-6 -3l6 3l-6 3",
    ]
    found = page.evaluate(
        """async (paths) => {
          const { Levels } = await import("/web/graph/levels.js");
          const levels = new Levels(paths);
          return paths.map((path) => levels.places(path, 60));
        }""",
        paths,
    )
    for places, y in zip(found, (100, 200), strict=True):
        assert [(one["y"], one["shared"]) for one in places] == [(y, 0)] * 3 + [(50, 1)] * 3
        assert all(114 + 30 <= one["x"] <= 300 - 30 for one in places[:3])


def test_a_way_leads_from_one_to_another_along_the_arrows(visit: Visit) -> None:
    page = visit("/computation/rover?select=node/lidar")
    field = page.get_by_label("Path from the selection to")
    field.fill("/cmd_vel")
    field.press("Enter")
    way = page.locator("ol.way li")
    expect(way.first).to_contain_text("/lidar")
    expect(way.last).to_contain_text("/cmd_vel")
    expect(element(page, "/cmd_vel")).to_have_class(re.compile("on-way"))
    expect(page).to_have_url(re.compile("to=%2Fcmd_vel"))
    page.go_back()
    expect(way).to_have_count(0)


def test_only_what_has_findings_and_its_neighbours(visit: Visit) -> None:
    page = visit("/computation/rover")
    every = shown(page)
    page.get_by_label("Only what has findings, and what is joined to it").check()
    some = shown(page)
    assert "/scan" in some
    assert some < every
    expect(page).to_have_url(re.compile("bad=1"))
    page.reload()
    expect(page.locator(".nodes .node:not([hidden])")).to_have_count(len(some))
    assert shown(page) == some


def test_the_picture_is_kept_as_svg_and_as_png(visit: Visit) -> None:
    page = visit("/computation/rover")
    with page.expect_download() as svg:
        page.get_by_role("link", name="SVG").click()
    assert b"<svg" in Path(svg.value.path()).read_bytes()[:100]
    with page.expect_download() as png:
        page.get_by_role("button", name="PNG").click()
    assert png.value.suggested_filename == "rover.png"
    assert Path(png.value.path()).read_bytes().startswith(b"\x89PNG")


def test_a_small_map_says_where_the_reader_is_while_not_all_is_in_sight(visit: Visit) -> None:
    page = visit("/computation/rover")
    small = page.locator("svg.minimap")
    expect(small).to_be_hidden()
    for _ in range(4):
        page.get_by_role("button", name="Zoom in").click()
    expect(small).to_be_visible()
    before = page.locator("#graph-svg .scene").get_attribute("transform")
    small.click(position={"x": 5, "y": 5})
    expect(page.locator("#graph-svg .scene")).not_to_have_attribute("transform", before or "")


def test_the_small_map_stands_where_it_covers_the_fewest_boxes(visit: Visit) -> None:
    page = visit("/computation/rover")
    for _ in range(4):
        page.get_by_role("button", name="Zoom in").click()
    covered = page.evaluate("""() => {
      const shown = document.querySelector(".minimap").getBoundingClientRect();
      const room = document.querySelector("#graph-canvas").getBoundingClientRect();
      const boxes = [...document.querySelectorAll("#graph-svg .node")].map((one) => one.getBoundingClientRect());
      const [width, height] = [shown.width, shown.height];
      const within = (one, left, top) =>
        one.right > left && one.left < left + width && one.bottom > top && one.top < top + height;
      const below = (left, top) => boxes.filter((one) => within(one, left, top)).length;
      const right = room.right - 10 - width;
      const [left, top, low] = [room.left + 10, room.top + 10, room.bottom - 10 - height];
      const corners = [[left, low], [left, top], [right, top]];
      return [[shown.left, shown.top], ...corners].map(([x, y]) => below(x, y));
    }""")
    assert covered[0] == min(covered)


def test_the_title_of_a_box_stays_in_sight(visit: Visit) -> None:
    page = visit("/computation/rover", viewport={"width": 1280, "height": 800})
    title = page.locator("#graph-svg .titles text", has_text="/navigation")
    box = "one => { const {top, bottom} = one.getBoundingClientRect(); return [top, bottom]; }"
    canvas = page.locator("#graph-canvas").evaluate(box)
    element(page, "/navigation/planner").locator("rect").click()
    for _ in range(4):
        page.keyboard.press("+")
    expect(page.locator("#graph-svg .scene")).to_have_attribute("transform", re.compile(r"scale\(3"))
    top, bottom = title.evaluate(box)
    assert canvas[0] <= top
    assert bottom <= canvas[1]
