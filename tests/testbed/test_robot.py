import statistics
from pathlib import Path

import pytest
from pace import slowness

from testbed import faults, leftovers, robot_ros1, robot_ros2
from testbed.clock import library, shifted
from testbed.hosts import Bed
from testbed.machine import BedError
from testbed.robot import HOSTS, NODES, RATES, Robot
from testbed.robot_ros1 import Ros1Robot
from testbed.robot_ros2 import Ros2Robot

pytestmark = pytest.mark.real

ROBOTS = {"ros1": (Ros1Robot, robot_ros1.why_not), "ros2": (Ros2Robot, robot_ros2.why_not)}
BRISK = {topic for topic, rate in RATES.items() if rate > 1}


NIGHTLY = pytest.mark.nightly
EITHER = pytest.mark.parametrize("kind", [pytest.param("ros1", marks=NIGHTLY), "ros2"], indirect=True)


@pytest.fixture(params=sorted(ROBOTS))
def kind(request, allowed) -> type[Robot]:
    made, why_not = ROBOTS[request.param]
    if reason := why_not():
        pytest.skip(reason)
    return made


PACES = (1, 4, 16)
"""How many times slower the robot is driven, until the machine keeps up with it: a link that loses what is sent, or a
topic that nobody hears, shows at every pace."""


@pytest.mark.slow
@pytest.mark.timeout(900)
@pytest.mark.parametrize(
    ("kind", "link"),
    [
        ("ros1", "shaped"),
        pytest.param("ros2", "bulk", marks=NIGHTLY),
        pytest.param("ros1", "bulk", marks=NIGHTLY),
        pytest.param("ros2", "shaped", marks=NIGHTLY),
    ],
    indirect=["kind"],
)
def test_every_topic_is_heard_on_another_host_at_its_rate(kind, link):
    for pace in PACES:
        rates = heard_at(pace, kind, link)
        wanted = pytest.approx({topic: RATES[topic] / pace for topic in BRISK}, rel=0.1)
        if rates == wanted:
            break
    assert rates == wanted


def heard_at(pace, kind, link):
    """The rates that `brain` hears of the robot driven `pace` times slower: the first as wanted, else the last of some.

    The planner decides as often as odometry comes; the other three have a clock of their own.
    """
    slower = {node.name: {"rate": rate / pace} for node in NODES[:3] for rate in node.rates.values()}
    wanted = pytest.approx({topic: RATES[topic] / pace for topic in BRISK}, rel=0.1)
    with Bed(HOSTS, link) as bed, kind(bed, loads=slower) as robot:
        for _ in range(3):  # on a busy machine nodes stumble
            heard = robot.listen("brain", 3.0 * pace, limit=60.0)
            assert heard.waited < 20 * slowness()
            rates = {topic: heard.rates[topic] for topic in BRISK}
            if rates == wanted:
                break
        assert all(process.running for process in robot.processes.values())
        pids = [process.pid for process in robot.processes.values()]
    assert [pid for pid in pids if Path(f"/proc/{pid}").exists()] == []
    assert leftovers.namespaces(bed.stem) == []
    assert bed.stem not in Path("/proc/self/mountinfo").read_text()
    return rates


@pytest.mark.slow
def test_the_master_knows_who_publishes_what(allowed):
    if reason := robot_ros1.why_not():
        pytest.skip(reason)
    with Bed(HOSTS) as bed, Ros1Robot(bed, statistics=True) as robot:
        robot.listen("sensor", 0.1, topics=[*BRISK, "/statistics"])
        publishers = robot.publishers()
        assert {topic: publishers[topic] for topic in RATES} == {
            topic: [f"/{node.name}"] for node in NODES for topic in node.rates
        }
        with pytest.raises(BedError, match=r"(?i)unknown node"):
            robot.ask_master("lookupNode", "/nobody")


@pytest.mark.slow
@EITHER
def test_loads_and_faults_show_in_what_is_heard(kind):
    with Bed(HOSTS, "shaped") as bed, kind(bed, loads={"lidar": {"rate": 5}}) as robot:
        assert soon_near(lambda: robot.listen("base", 2.0, topics=["/scan"]).rates["/scan"], 5, 1) == pytest.approx(
            5, abs=1
        )
        with faults.frozen(robot.processes["camera"]), pytest.raises(BedError, match="/camera/image"):
            robot.listen("base", 0.1, topics=["/camera/image", "/scan"], limit=4)
        with faults.killed(robot.processes["lidar"]), pytest.raises(BedError, match="/scan"):
            robot.listen("base", 0.1, topics=["/scan", "/odom"], limit=4)
        back = lambda: robot.listen("base", 1.0, topics=["/scan", "/camera/image"]).rates["/camera/image"]  # noqa: E731
        assert soon_near(back, 10, 5) >= 5


def soon_near(measure, wanted, within, tries=6):
    """What was measured last: as soon as it is near what is wanted, or in the last of a few tries on a busy machine."""
    for _ in range(tries):
        found = measure()
        if abs(found - wanted) <= within:
            break
    return found


@pytest.mark.slow
@pytest.mark.table
@pytest.mark.skipif(library() is None, reason="faketime is not installed: apt-get install faketime")
def test_a_clock_offset_moves_the_stamps_of_a_host(kind):
    with Bed(HOSTS) as bed, kind(bed, faked_clocks=["base"]) as robot:

        def age():
            return statistics.median(robot.stamp_ages("brain", "/odom", 1.0))

        # Faketime reads the offset once a second, and nodes come late on a busy machine.
        before = soon_near(age, 0.0, 0.02)
        with shifted(bed["base"], -0.25):
            assert soon_near(age, before + 0.25, 0.03) - before == pytest.approx(0.25, abs=0.03)
        assert soon_near(age, before, 0.03) == pytest.approx(before, abs=0.03)
        rate = soon_near(lambda: robot.listen("brain", 1.0, topics=["/odom"]).rates["/odom"], 50, 5)
        assert rate == pytest.approx(50, rel=0.1)
