"""What is known of topics at an instant, as ages along paths ask for it."""

from __future__ import annotations

from roslens.live.system.topic import Topic
from roslens.live.system.world import World


class TopicLooks:
    """Looks at topics by name; their connections are brought to the present before."""

    def __init__(self, world: World, now: float) -> None:
        """Look at what there is now."""
        self._world = world
        self._now = now

    def value(self, name: str, key: str) -> float | None:
        """Return a signal of a topic; None where nothing is known of it."""
        topic = self._world.topics.get(name)
        return None if topic is None or topic.planless else self._settled(topic).value(key, 0)[0]

    def silence(self, name: str) -> float:
        """Return for how many seconds a topic has been silent for longer than is usual of it; 0 where it speaks."""
        topic = self._world.topics.get(name)
        views = () if topic is None else self._settled(topic).views(0)
        return min((window.quiet if window.silent else 0.0 for _, window in views), default=0.0)

    def _settled(self, topic: Topic) -> Topic:
        for connection in topic.all_connections():
            connection.settle(self._now)
        return topic
