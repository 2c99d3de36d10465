"""What launch files came to before, as long as all files that were read for it are the same.

Whoever evaluates a launch file asks here first: rules on launch files and computation graphs have one evaluation in
common. Most launch files read no variable of the environment; these are known whatever its variables are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import msgspec

from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.launched import Launch, Setting
from roslens.source.extract.facts.noted_files import Asked, FileAnswers, NotedFiles
from roslens.source.extract.ir.program_codec import plain, squeezed
from roslens.source.keys import analyser_version, key_of
from roslens.store.cache import Cache


class _KeptLaunch(msgspec.Struct, frozen=True, array_like=True):
    """A launch file that was evaluated.

    Attributes:
        asked: what was asked about files.
        launch: what it comes to, without the parameters of its nodes.
        settings: of all nodes, each once: nodes of one file of parameters have hundreds in common.
        of_nodes: places of those of each node in ``settings``.
    """

    asked: tuple[Asked, ...]
    launch: Launch
    settings: tuple[Setting, ...]
    of_nodes: tuple[tuple[int, ...], ...]


_encode = msgspec.msgpack.Encoder().encode
_decode = msgspec.msgpack.Decoder(_KeptLaunch).decode


class _NotedEnvironment(Mapping[str, str]):
    """Variables of an environment, noting whether one was asked for."""

    def __init__(self, variables: Mapping[str, str]) -> None:
        self._variables = variables
        self.is_asked = False

    def __bool__(self) -> bool:
        # Whether there are variables at all says nothing of one.
        return True

    def __getitem__(self, name: str) -> str:
        self.is_asked = True
        return self._variables[name]

    def __iter__(self) -> Iterator[str]:
        self.is_asked = True
        return iter(self._variables)

    def __len__(self) -> int:
        self.is_asked = True
        return len(self._variables)


class KnownLaunches:
    """The launch files of a workspace with arguments.

    Attributes:
        is_lasting: whether the next run would find the same: no budget ended an evaluation, and no file changed.
        new: what was evaluated, as it is kept.
    """

    def __init__(self, cache: Cache, files: Files) -> None:
        """Know nothing yet.

        Args:
            cache: what earlier runs learned.
            files: that may be read.
        """
        self._cache = cache
        self._files = files
        self._answers = FileAnswers(files)
        self._start = f"graph:launch:{analyser_version()}"
        self.new: dict[str, bytes] = {}
        self._asked: dict[tuple[str, str], Asked] = {}
        self.is_lasting = True

    @property
    def asked(self) -> tuple[Asked, ...]:
        """What was asked about files for all of them; no answer counts unless :attr:`is_lasting`."""
        return tuple(self._asked.values())

    def _note(self, asked: tuple[Asked, ...]) -> None:
        for one in asked:
            # A file that changed meanwhile has two answers.
            self.is_lasting = self._asked.setdefault((one.what, one.of), one) == one and self.is_lasting

    def launch(
        self,
        given: tuple[object, ...],
        environment: Mapping[str, str],
        evaluate: Callable[[Files, Mapping[str, str]], Launch],
    ) -> Launch:
        """Return what a launch file comes to; it is evaluated where that is not known, or a budget ended it before.

        Args:
            given: all that the result depends on besides files and the environment: the path, the arguments.
            environment: variables that are known.
            evaluate: evaluates it with files and the environment.
        """
        slot = f"{self._start}:{key_of(*given)}"
        in_environment = f"{slot}:{key_of(sorted(environment.items()))}"
        kept = self._cache.get((slot, in_environment))
        for packed in kept.values():
            try:
                known = _decode(plain(packed))
                if self._answers.same(known.asked):
                    found = _whole(known)
                    self._note(known.asked)
                    return found
            except (msgspec.DecodeError, IndexError, ValueError):
                pass  # What a damaged cache holds is made again.
        noted, variables = NotedFiles(self._files), _NotedEnvironment(environment)
        found = evaluate(noted, variables)
        self._note(noted.asked)
        self.is_lasting = self.is_lasting and not found.cut
        if not found.cut:
            self.new[in_environment if variables.is_asked else slot] = squeezed(_encode(_apart(noted.asked, found)))
        return found

    def keep(self) -> None:
        """Write what is new."""
        self._cache.replace(self.new)
        self.new = {}


def launch_key(launch: Launch) -> str:
    """Return a key of what a launch file comes to, whatever was read for it."""
    return key_of(_apart((), launch))


def _apart(asked: tuple[Asked, ...], launch: Launch) -> _KeptLaunch:
    places: dict[Setting, int] = {}
    # Most are one object that many nodes have, by which it is found faster than by its value.
    known: dict[int, int] = {}
    of_nodes: list[tuple[int, ...]] = []
    for node in launch.nodes:
        for one in node.settings:
            if id(one) not in known:
                known[id(one)] = places.setdefault(one, len(places))
        of_nodes.append(tuple(known[id(one)] for one in node.settings))
    nodes = tuple(msgspec.structs.replace(node, settings=()) for node in launch.nodes)
    return _KeptLaunch(asked, msgspec.structs.replace(launch, nodes=nodes), tuple(places), tuple(of_nodes))


def _whole(kept: _KeptLaunch) -> Launch:
    settings = kept.settings
    nodes = tuple(
        msgspec.structs.replace(node, settings=tuple(settings[place] for place in places))
        for node, places in zip(kept.launch.nodes, kept.of_nodes, strict=True)
    )
    return msgspec.structs.replace(kept.launch, nodes=nodes)
