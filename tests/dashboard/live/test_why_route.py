"""Why something is as it is, over HTTP: an answer, nothing of what no answer is about, and of no other site."""

import json

import pytest
from cli.commands.test_why import every, recording
from dashboard.conftest import Client
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.cli.commands.serve import _beside
from roslens.cli.main import parser
from roslens.cli.page.why_page import WhyPage
from roslens.dashboard.live.app import create_live_app
from roslens.live.agent.ros_environments import RosEnvironments
from roslens.model.answers.ros_process import RosProcess


@pytest.fixture
def robot():
    robot = ScriptedRobot()
    robot.gone.add("/lidar")
    robot.run(12)
    return robot


@pytest.fixture
def client(robot):
    return Client(create_live_app(robot.page.newest, why=robot.page.why.page))


def test_a_topic_whose_publisher_ended_has_its_cause_and_steps(client):
    found = json.loads(client.get("/why.json", params={"select": "topic:/scan"}).content)
    assert found["entity"] == "topic:/scan"
    assert found["cause"]["asks"] == "made by"
    assert {one["asks"] for one in found["steps"]} >= {"exists", "made by", "used by"}


def test_a_connection_asks_for_its_topic_and_what_no_answer_is_about_is_no_error(client):
    connection = "connection:/lidar > /scan > /slam"
    assert client.get("/why.json", params={"select": connection}).json()["entity"] == "topic:/scan"
    for entity in ("host:rover", "nothing", "", "parameter:/a b"):
        answer = client.get("/why.json", params={"select": entity})
        assert (answer.status_code, answer.content) == (204, b"")


def test_pages_of_other_sites_are_refused(client):
    answer = client.get("/why.json", params={"select": "topic:/scan"}, headers={"sec-fetch-site": "cross-site"})
    assert answer.status_code == 403


def test_alerts_have_the_first_cause_and_the_page_shows_it_without_script(robot, client):
    alerts = {one.entity: one for one in robot.page.state().alerts}
    (scan,) = (one for entity, one in alerts.items() if entity in ("topic:/scan", "node:/lidar"))
    assert scan.why
    assert scan.why in client.get("/").text


def test_a_recording_is_asked_what_it_has(tmp_path):
    bag = recording(tmp_path / "drive", {"/a": every(0.1, 20), "/b": every(0.1, 60)})
    options = parser().parse_args(["serve", str(tmp_path), "--bag", str(bag)])
    with _beside(options, "", None) as (page, _):
        found = json.loads(page.why.page("topic:/a"))
        assert found["looked_at"] == ["recording: drive"]
        assert found["cause"]["says"].startswith("it stopped: the last message came at 20.00 s")
        assert json.loads(page.why.page("topic:/b"))["cause"] is None


def test_programs_of_another_domain_are_looked_for_once_in_a_while(robot):
    calls = []

    def processes():
        calls.append(1)
        return RosEnvironments((RosProcess(7, "/opt/lidar_node", 0, domain="9"),))

    now = [0.0]
    page = WhyPage(
        lambda: robot.page.looked, steady=lambda: now[0], live=True, processes=processes, environment={}
    )  # fmt: skip
    first = page.answer("topic:/scan")
    assert "cannot meet" in first.cause.says
    page.answer("topic:/odom")
    assert len(calls) == 1
    now[0] += 11
    page.answer("topic:/odom")
    assert len(calls) == 2
