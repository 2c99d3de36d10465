"""Cases of reactions: what is to be done is done, once, and nothing that does harm."""

from __future__ import annotations

import os
import signal

from wrong_ok.lines import Lines
from wrong_ok.mistakes import unless
from wrong_ok.scene import Scene

GONE = (
    "reactions:\n"
    '  - {id: back, when: {node: "/*", is: [gone, crashed], match: each}, cool_down: 1 s, '
    'do: [{restart: {node: "{entity}", whole_process: true}}]}\n'
)
"""As rash as can be: whatever is gone is started again."""


def _restarted(react: Lines, *nodes: str) -> bool:
    """Wait until nodes were started again and are there again."""
    wanted = {f"node:{one}" for one in nodes}

    def all_back(_: object) -> bool:
        decided = {one["fields"]["decision"]: one["fields"]["entity"] for one in react.said("decided")}
        back = {decided.get(one["fields"]["decision"], "") for one in react.said("verified")}
        return wanted <= back

    return react.until(all_back)


def _only(react: Lines, *nodes: str) -> list[str]:
    """Return decisions about other nodes than these."""
    allowed = {f"node:{one}" for one in nodes}
    entities = [one["fields"]["entity"] for one in react.said("decided")]
    return [f"something was done about {one}" for one in entities if one not in allowed]


def container(scene: Scene, nodes: int) -> list[str]:
    """A process of several nodes that is killed, and a reaction for each node."""
    scene.node("container", str(nodes))
    scene.node("named", "other")
    react = scene.react(GONE)
    (pid,) = scene.pids("container", str(nodes))
    os.kill(pid, signal.SIGKILL)
    parts = [f"/part{number}" for number in range(nodes)]
    if not _restarted(react, parts[0]):
        return [f"a process of {nodes} nodes was not started again"]
    # What was due for the others is done before what is due for another node, whose end comes later.
    (other,) = scene.pids("named", "other")
    os.kill(other, signal.SIGKILL)
    back = _restarted(react, "/other")
    found = len(scene.pids("container", str(nodes)))
    return [
        *unless(found == 1, f"a process of {nodes} nodes runs {found} times after a restart"),
        *unless(back, "a node that was killed after that was not started again"),
        *_only(react, *parts, "/other"),
    ]


def crashes(scene: Scene) -> list[str]:
    """A node that is killed three times, and is started again each time; meanwhile no second reactor may act."""
    scene.node("named", "cam")
    scene.node("named", "other")
    react = scene.react(
        "reactions:\n"
        '  - {id: back, when: {node: /cam, is: crashed}, cool_down: 1 s, do: [{restart: {node: "{entity}"}}]}\n'
    )  # fmt: skip
    for number in range(3):
        (pid,) = scene.pids("named", "cam")
        os.kill(pid, signal.SIGKILL)
        if not react.until(lambda line: line.get("what") == "verified"):
            return [f"crash {number + 1} of 3 was not reacted to"]
    second = scene.refused("reactions:\n  - {id: n, when: {node: /cam, is: gone}, do: [{notify: gone}]}\n")
    return unless("acts on ROS domain" in second, "a second reactor was let act beside the first")


def operator_stops(scene: Scene) -> list[str]:
    """An operator who ends four of five nodes; then another node crashes."""
    names = ("a", "b", "c", "d")
    nodes = [scene.node("named", name) for name in names]
    for name in ("teleop", "other"):
        scene.node("named", name)
    react = scene.react(GONE)
    for node in nodes:
        node.process.send_signal(signal.SIGINT)
        node.process.wait()
    noticed = react.until(lambda _: len(react.said("spared")) == len(names))
    (pid,) = scene.pids("named", "other")
    os.kill(pid, signal.SIGKILL)
    back = _restarted(react, "/other")
    return [
        *unless(noticed, f"only {len(react.said('spared'))} of 4 ends were noticed"),
        *(f"/{name}, which an operator ended, was started again" for name in names if scene.pids("named", name)),
        *unless(back, "a node that crashed after that was not started again"),
        *_only(react, "/other"),
    ]


def _struck(scene: Scene, react: Lines) -> list[str]:
    """Return what was done about a healthy robot, and whether it still is about one that is not."""
    wrong = _only(react)
    (pid,) = scene.pids("named", "other")
    os.kill(pid, signal.SIGKILL)
    back = _restarted(react, "/other")
    return [*(wrong or _only(react, "/other")), *unless(back, "a node that crashed after that was not started again")]


def stopped_observer(scene: Scene) -> list[str]:
    """The observer of ROS is stopped for 4 s, and goes on."""
    driver = scene.node("beats", "driver", "/beat", "10")
    scene.node("named", "other")
    react = scene.react(GONE)
    observer = scene.observer()
    os.kill(observer, signal.SIGSTOP)
    driver.says("sent", 40)
    os.kill(observer, signal.SIGCONT)
    driver.says("sent", 50)
    react.until(lambda _: False, 0.0)
    return _struck(scene, react)


def stopped_monitor(scene: Scene) -> list[str]:
    """The monitor is stopped for 8 s, and goes on."""
    driver = scene.node("beats", "driver", "/beat", "10")
    scene.node("named", "other")
    react = scene.react(GONE)
    react.printed.process.send_signal(signal.SIGSTOP)
    driver.says("sent", 80)
    react.printed.process.send_signal(signal.SIGCONT)
    react.until(lambda line: line.get("what") == "well")
    return _struck(scene, react)


def clock_jumps(scene: Scene) -> list[str]:
    """The wall clock of the host is set 30 s ahead, and back."""
    scene.set_clocks(0.0)
    driver = scene.node("beats", "driver", "/beat", "10")
    scene.node("named", "other")
    react = scene.react(GONE)
    found = []
    for ahead in (30.0, 0.0):
        scene.set_clocks(ahead)
        noticed = react.until(lambda line: line.get("what") == "unwell")
        found += unless(noticed, f"that the clock was set to {ahead:g} s ahead was not noticed")
        react.until(lambda line: line.get("what") == "well")
        found += unless(driver.says("sent", 30), "a node did not go on after the clock was set")
    react.until(lambda _: False, 0.0)
    return [*found, *_struck(scene, react)]
