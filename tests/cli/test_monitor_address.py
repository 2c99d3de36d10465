import pytest
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.cli.top.feed import AddressFeed
from roslens.cli.watch.monitor_address import fetched
from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.policy import Access
from roslens.dashboard.live.serving import LivePage
from roslens.model.errors import UsageError

pytestmark = pytest.mark.timed


@pytest.fixture
def robot():
    made = ScriptedRobot()
    made.run(2)
    return made


def test_a_monitor_is_asked_by_host_and_port_and_by_its_address(robot):
    with LivePage(robot.page.newest, detail=robot.page.detail, graph=robot.page.graph) as page:
        assert fetched(page.url, "snapshot.json", {}) == robot.page.newest()
        assert b"/lidar" in fetched(page.url.removeprefix("http://"), "graph.json", {})
        assert fetched(page.url, "detail.json?select=node:/nobody", {}) == b""
        with pytest.raises(UsageError, match="404"):
            fetched(page.url, "nothing.json", {})


def test_a_token_is_sent_that_the_address_or_the_environment_has(robot):
    token = "t" * 32
    access = Access({token: Person("vera", Role.VIEW)}, view_needs_token=True)
    with LivePage(robot.page.newest, access=access) as page:
        with pytest.raises(UsageError, match="asks for a token"):
            fetched(page.url, "snapshot.json", {})
        assert fetched(f"{page.url}?token={token}", "snapshot.json", {})
        assert fetched(page.url, "snapshot.json", {"ROSLENS_TOKEN": token})


def test_all_that_is_known_of_an_entity_comes_from_a_page(robot):
    with LivePage(robot.page.newest, detail=robot.page.detail) as page:
        feed = AddressFeed(page.url, lambda address, document: fetched(address, document, {}))
        assert feed.snapshot().rows
        assert feed.detail("topic:/scan").entity == "topic:/scan"
        assert feed.detail("node:/nobody") is None


@pytest.mark.parametrize("address", ["ftp://robot", "file:///etc/passwd", "http://"])
def test_what_is_no_address_is_refused(address):
    with pytest.raises(UsageError, match="HOST:PORT"):
        fetched(address, "snapshot.json", {})
