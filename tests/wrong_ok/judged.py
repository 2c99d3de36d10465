"""Cases of what is wrong with a robot, and must not be called ok; and of what is right, and must be."""

from __future__ import annotations

from ros2_domain import own_domain

from wrong_ok.lines import Lines
from wrong_ok.mistakes import unless
from wrong_ok.scene import Scene

BEAT = "topic:/beat"


def _is(watch: Lines, entity: str, quantity: str, right: bool) -> list[str]:
    return unless(right, f"{quantity} of {entity} was {watch.states(entity, quantity)}")


def twins(scene: Scene) -> list[str]:
    """Two nodes of one name."""
    scene.node("beats", "twin", "/beat", "10")
    scene.node("beats", "twin", "/beat", "10")
    watch = scene.watch(
        "constraints:\n"
        '  - {node: "/**", expected: at most one}\n'
        "  - {topic: /beat, rate: 8..12 Hz, publishers: 1}\n"
    )  # fmt: skip
    wanted = [("node:/**", "presence", "high"), (BEAT, "publishers", "high"), (BEAT, "rate", "high")]
    watch.comes_to(*wanted)
    return [one for entity, what, state in wanted
            for one in _is(watch, entity, what, watch.states(entity, what)[-1:] == [state])]  # fmt: skip


def starved_subscriber(scene: Scene) -> list[str]:
    """A subscriber that takes every 13th message."""
    scene.node("fast")
    slow = scene.node("slow", "1.3")
    watch = scene.watch("defaults: {for: 2 s, margin: 5 %}\nconstraints:\n  - {topic: /big, loss: <= 10 %}\n")
    watch.comes_to(("topic:/big", "loss", "high"))
    slow.says("took", 4)
    watch.until(lambda _: False, 0.0)
    states = watch.states("topic:/big", "loss")
    return _is(watch, "topic:/big", "loss", "ok" not in states and states[-1:] == ["high"])


def starved_subscriber_ros1(scene: Scene) -> list[str]:
    """A subscriber of ROS 1 that takes every 13th message: what is sent is right, what it receives is not."""
    scene.master()
    scene.node_ros1("beats", "fast", "/big", "10", "point")
    slow = scene.node_ros1("hears", "slow", "/big", "1.3")
    watch = scene.watch(
        "defaults: {for: 2 s, margin: 5 %}\n"
        "constraints:\n"
        "  - {topic: /big, rate: 8..12 Hz, rate_received: 8..12 Hz, loss: <= 10 %}\n"
    )  # fmt: skip
    big = "topic:/big"
    watch.comes_to((big, "rate", "ok"), (big, "rate_received", "low"), (big, "loss", "high"))
    slow.says("took", 4)
    watch.until(lambda _: False, 0.0)
    return [
        *_is(watch, big, "rate", "low" not in watch.states(big, "rate")),
        *_is(watch, big, "rate_received", _never_ok(watch, big, "rate_received", "low")),
        *_is(watch, big, "loss", _never_ok(watch, big, "loss", "high")),
    ]


def _never_ok(watch: Lines, entity: str, quantity: str, state: str) -> bool:
    states = watch.states(entity, quantity)
    return "ok" not in states and states[-1:] == [state]


def other_domain(scene: Scene) -> list[str]:
    """Traffic of another domain, beside a participant without ROS in the one that is watched."""
    scene.node("beats", "driver", "/beat", "10", ROS_DOMAIN_ID=own_domain())
    scene.node("beats", "bare", "/bare", "10", counts=False, LD_PRELOAD=scene.built("bare"))
    scene.node("hears", "listener", "/bare")
    watch = scene.watch(
        "constraints:\n"
        "  - {topic: /bare, rate: 5..15 Hz}\n"
        "  - {topic: /beat, rate: 8..12 Hz, expected: always}\n"
    )  # fmt: skip
    watch.comes_to(("topic:/bare", "rate", "ok"), (BEAT, "presence", "absent"))
    return [
        *_is(watch, "topic:/bare", "rate", watch.states("topic:/bare", "rate")[-1:] == ["ok"]),
        *_is(watch, BEAT, "presence", watch.states(BEAT, "presence")[-1:] == ["absent"]),
        *_is(watch, BEAT, "rate", "ok" not in watch.states(BEAT, "rate")),
    ]


def client_without_server(scene: Scene) -> list[str]:
    """A server that is killed while its client goes on calling."""
    server = scene.node("server")
    client = scene.node("client")
    watch = scene.watch("constraints:\n  - {service: /get, expected: always}\n")
    watch.comes_to(("service:/get", "presence", "ok"))
    server.process.kill()
    watch.comes_to(("service:/get", "presence", "absent"))
    client.says("asked", 20)
    watch.until(lambda _: False, 0.0)
    states = watch.states("service:/get", "presence")
    return _is(watch, "service:/get", "presence", states.count("ok") == 1 and states[-1] == "absent")


def exact_value(scene: Scene) -> list[str]:
    """An exact value with a margin: what was wrong and is right again is ok again."""
    scene.node("beats", "driver", "/beat", "10")
    watch = scene.watch("defaults: {for: 1 s, margin: 5 %}\nconstraints:\n  - {topic: /beat, publishers: 1}\n")
    watch.comes_to((BEAT, "publishers", "ok"))
    second = scene.node("beats", "second", "/beat", "10")
    watch.comes_to((BEAT, "publishers", "high"))
    second.process.kill()
    watch.comes_to((BEAT, "publishers", "ok"))
    states = [one for one in watch.states(BEAT, "publishers") if one != "unknown"]
    return _is(watch, BEAT, "publishers", states == ["ok", "high", "ok"])


def own_loss_of_a_tap(scene: Scene) -> list[str]:
    """A tap that gets a part of what is sent: its loss is no low rate of the robot."""
    camera = scene.node("camera", "3000000", counts=False)
    watch = scene.watch(
        "defaults: {for: 2 s}\nconstraints:\n  - {topic: /image, rate: 5..15 Hz}\n", "--tap", "/image"
    )  # fmt: skip
    watch.until(lambda line: line.get("is") == "verdict" and line["quantity"] == "rate")
    sent_in_time = camera.says("sent", 60, 60 / 7, pause_s=1.0)
    watch.until(lambda _: False, 0.0)
    if not sent_in_time:
        # Nothing follows from a camera that the machine itself kept from sending.
        return []
    states = watch.states("topic:/image", "rate")
    return _is(watch, "topic:/image", "rate", set(states) <= {"ok", "unknown"})


def second_publisher_of_another_type(scene: Scene) -> list[str]:
    """A second publisher on a topic, of another type."""
    scene.node("beats", "driver", "/beat", "10")
    scene.node("hears", "listener", "/beat")
    scene.node("beats", "other", "/beat", "10", "string")
    watch = scene.watch("constraints:\n  - {topic: /beat, publishers: 1, misfits: 0}\n")
    watch.comes_to((BEAT, "publishers", "high"), (BEAT, "misfits", "high"))
    return [
        *_is(watch, BEAT, "publishers", watch.states(BEAT, "publishers")[-1:] == ["high"]),
        *_is(watch, BEAT, "misfits", watch.states(BEAT, "misfits")[-1:] == ["high"]),
    ]


def second_publisher_of_another_type_ros1(scene: Scene) -> list[str]:
    """A second publisher on a topic of ROS 1, of another type: the master keeps one type, and tells nobody."""
    scene.master()
    scene.node_ros1("beats", "driver", "/beat", "10")
    scene.node_ros1("hears", "listener", "/beat")
    watch = scene.watch("constraints:\n  - {topic: /beat, publishers: 1, misfits: 0}\n")
    watch.comes_to((BEAT, "publishers", "ok"), (BEAT, "misfits", "ok"))
    scene.node_ros1("beats", "other", "/beat", "10", "string")
    watch.comes_to((BEAT, "publishers", "high"), (BEAT, "misfits", "high"))
    misfits = [one for one in watch.states(BEAT, "misfits") if one != "unknown"]
    return [
        *_is(watch, BEAT, "publishers", watch.states(BEAT, "publishers")[-1:] == ["high"]),
        *_is(watch, BEAT, "misfits", misfits == ["ok", "high"]),
    ]


def restarted_master(scene: Scene) -> list[str]:
    """A ROS master that is restarted: nodes run on, and what they exchange is neither absent nor silent."""
    master = scene.master()
    driver = scene.node_ros1("beats", "driver", "/beat", "10")
    scene.node_ros1("hears", "listener", "/beat")
    watch = scene.watch("constraints:\n  - {topic: /beat, rate: 5..15 Hz}\n  - {node: /driver, expected: always}\n")
    healthy = ((BEAT, "rate", "ok"), ("node:/driver", "presence", "ok"))
    watch.comes_to(*healthy)
    master.process.kill()
    master.process.wait()
    scene.master()
    told = watch.until(lambda line: "the ROS master was restarted" in str(line))
    driver.says("sent", 50)
    watch.until(lambda _: False, 0.0)
    bad = [one for entity, what, _ in healthy for one in watch.states(entity, what) if one not in ("ok", "unknown")]
    return [
        *unless(told, "that the master was restarted was not told"),
        *unless(not bad, f"nodes that run on, and what they exchange, were called {bad}"),
    ]
