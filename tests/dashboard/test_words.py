"""What pages and the terminal say, in the words that readers of navigation2 found: none of those they stumbled over."""

from __future__ import annotations

import io
import re
from pathlib import Path

import pytest
from dashboard.conftest import Client
from dashboard.live.scripted_robot import ScriptedRobot

import roslens
from roslens.cli.page.watch_screen import nameless
from roslens.cli.terminal.streams import LineProgress
from roslens.dashboard.server import create_app
from roslens.judge.quality.constraint import Constraint
from roslens.judge.ranges.range import Range
from roslens.live.system.tree import SystemView
from roslens.model.entity import EntityKind
from roslens.model.graph import Role
from roslens.model.graphs.end import VERB
from roslens.model.verdict import State

TEXTS = [
    (path, path.read_text("utf-8"))
    for folder in ("dashboard", "cli", "report", "source/rules")
    for suffix in ("*.py", "*.html", "*.js")
    for path in sorted((Path(roslens.__file__).parent / folder).rglob(suffix))
    if "vendor" not in path.parts
]
STUMBLED_OVER = (
    "What the quality models ask", "Holds?", "weighted methods per class", "subscribes topic", "Overrides that nobody",
    "most findings per kloc", "observed by inside", "is absent, expected", "cpp source",
)  # fmt: skip


@pytest.mark.parametrize("words", STUMBLED_OVER)
def test_nothing_says_it_the_old_way(words: str) -> None:
    assert [path.name for path, text in TEXTS if words in text] == []


def test_a_limit_says_how_many_are_outside(client: Client) -> None:
    page = client.get("/metrics/cyclomatic_complexity").text
    assert "Limits of each quality model" in page
    assert re.search(r"</svg>\d+ above|</svg>all within", page)


def test_who_hears_a_topic_subscribes_to_it() -> None:
    assert VERB[Role.SUBSCRIPTION] == "subscribes to"


def test_a_step_of_unknown_length_has_no_number_of_all() -> None:
    lines = io.StringIO()
    progress = LineProgress(lines, verbose=True)
    progress.step("Evaluating nodes", 0)
    progress.advance(1, "talker")
    progress.step("Parsing", 2)
    progress.advance(1, "a.cpp")
    assert lines.getvalue().splitlines() == ["Evaluating nodes: 1 talker", "Parsing: 2", "Parsing: 1/2 a.cpp"]


def test_a_service_of_which_nobody_knows_the_server_has_no_publisher() -> None:
    def part(kind: str, *children: SystemView) -> SystemView:
        return SystemView(f"{kind}:", "", kind, children=children)

    assert nameless(part("node", part("service"))) == "(server unknown)"
    assert nameless(part("node", part("topic"))) == "(publisher unknown)"


def test_nodes_that_do_not_run_are_on_no_host() -> None:
    def node(name: str, state: State | None) -> SystemView:
        return SystemView(f"node:{name}", name, "node", state)

    def host(*nodes: SystemView) -> SystemView:
        return SystemView("host:", "", "host", children=nodes)

    assert nameless(host(node("/a", State.ABSENT), node("", None))) == "(not running)"
    assert nameless(host(node("/a", State.ABSENT), node("/b", None))) == "(host unknown)"
    assert nameless(host(node("", None))) == "(host unknown)"


def test_a_topic_that_says_nothing_is_silent() -> None:
    robot = ScriptedRobot()
    robot.rates["/scan"] = 0
    robot.run(20)
    (alert,) = [one for one in robot.page.snapshot(robot.session, robot.now, "").alerts if one.entity == "topic:/scan"]
    assert alert.message.startswith("is silent, expected 8..12 Hz")
    assert re.search(r"silent for 2\d\.\d s", alert.evidence)


def test_the_number_comes_first_and_the_limit_behind_it() -> None:
    made = Constraint("calls", EntityKind.FUNCTION, "calls", Range(None, 10))
    assert "limit 10" in made.breach_text(30, "max")


def test_the_run_says_whether_it_passes_in_a_sentence(client: Client) -> None:
    assert ": fails</b>" not in client.get("/").text


@pytest.fixture(scope="module")
def client(site: object) -> Client:
    return Client(create_app(site))  # type: ignore[arg-type]
