"""What is read of strangers: examples of it, words that mean something in it, and what reads it.

A reader returns, or raises what its documentation names; anything else is a failure, as is an answer that takes long.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from fnmatch import fnmatch
from functools import cache
from pathlib import Path
from typing import NamedTuple

from fuzz.words import BAG, CMAKE, CODE, MESSAGE, PACKED, PYTHON, TOML, XML, YAML

TESTS = Path(__file__).parents[1]
FIXTURES = TESTS / "fixtures"
EXAMPLES = TESTS.parent / "examples"
MOST_SEED_BYTES = 6_000


class Kind(NamedTuple):
    """A kind of input."""

    seeds: Callable[[], list[bytes]]
    words: str
    read: Callable[[bytes], object]


@cache
def _every() -> list[Path]:
    below = [path for root in (FIXTURES, EXAMPLES) for path in root.rglob("*") if "fuzz" not in path.parts]
    return sorted(path for path in below if path.suffix and path.is_file())


def _files(*patterns: str) -> list[bytes]:
    found = [path for path in _every() if any(fnmatch(path.name, pattern) for pattern in patterns)]
    return [path.read_bytes() for path in found if 0 < path.stat().st_size <= MOST_SEED_BYTES]


def _manifest(content: bytes) -> None:
    import msgspec

    from roslens.source.workspace.manifest import read_manifest

    package, failures = read_manifest(content, "src/arm/package.xml", {"ROS_VERSION": "2"})
    assert package is not None
    assert package.name
    msgspec.json.encode((package, failures))


def _repositories(content: bytes) -> None:
    from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
    from roslens.model.errors import UsageError
    from roslens.source.fetch.distribution import distribution_of
    from roslens.source.fetch.filter_file import filter_of
    from roslens.source.fetch.folder_name import is_folder_name
    from roslens.source.fetch.repos_file import lock_text, repositories_of, taken_of
    from roslens.source.fetch.urls import UrlError, checked

    try:
        data = load_yaml(content)
    except UnsafeYamlError:
        return
    if not isinstance(data, dict):
        return
    for read in (distribution_of, repositories_of, filter_of):
        try:
            found = read(data, "d.yaml")
        except UsageError:
            continue
        for one in getattr(found, "repositories", ()):
            is_folder_name(one.name)
            try:
                checked(one.url, files=False)
            except UrlError:
                continue
    taken = taken_of(data)
    again = taken_of(load_yaml(lock_text(taken)))
    assert sorted(one.wanted.name for one in again) == sorted({one.wanted.name for one in taken})


@cache
def _macros():
    from roslens.source.syntax.macro.macros import load_macros

    return load_macros()


def _cpp(content: bytes) -> None:
    from roslens.model.source import Language
    from roslens.source.extract.interpreter.vocabulary_index import indexed
    from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
    from roslens.source.extract.units.workspace_units import facts_of_workspace
    from roslens.source.measure.analyse_file import analyse_file
    from roslens.source.settings import MacroSettings

    analyse_file(content, Language.CPP, MacroSettings())
    facts_of_workspace(indexed({"pkg/a.cpp": program_of_cpp(content, _macros())}))


def _python(content: bytes) -> None:
    from roslens.model.source import Language
    from roslens.source.extract.interpreter.vocabulary_index import indexed
    from roslens.source.extract.lowering.python.python_program import program_of_python
    from roslens.source.extract.units.workspace_units import facts_of_workspace
    from roslens.source.measure.analyse_file import analyse_file
    from roslens.source.settings import MacroSettings

    analyse_file(content, Language.PYTHON, MacroSettings())
    facts_of_workspace(indexed({"pkg/a.py": program_of_python(content)}))


class _Given:
    """A workspace of one package and a file under every name that is asked for."""

    def __init__(self, content: bytes) -> None:
        self._content = content

    def package(self, name: str) -> str | None:
        return "pkg" if name == "pkg" else None

    def content(self, path: str) -> bytes | None:
        return self._content if path.startswith("pkg/") else None


def _launch(content: bytes) -> None:
    from roslens.source.extract.launch.launch_ros1 import evaluate_ros1
    from roslens.source.extract.launch.launch_ros2 import evaluate_ros2

    files = _Given(content)
    evaluate_ros1("pkg/launch/a.launch", files)
    for name in ("a.launch.xml", "a.launch.yaml", "a.launch.py"):
        evaluate_ros2(f"pkg/launch/{name}", files)


def _cmake(content: bytes) -> None:
    from roslens.source.extract.builds.targets import build_of

    for kind in ("catkin", "ament_cmake"):
        build_of("pkg", "pkg", kind, _Given(content), ["pkg/CMakeLists.txt", "pkg/src/a.cpp", "pkg/package.xml"])


def _yaml(content: bytes) -> None:
    from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
    from roslens.judge.reading.read_reference import GivenText, load_reference
    from roslens.judge.reading.read_time_line import parse_time_lines
    from roslens.live.window.signals import BY_KEY
    from roslens.model.errors import RoslensError
    from roslens.source.extract.parameters.parameter_file import ros1_parameters, ros2_parameters

    for read, refusal in (
        (load_yaml, UnsafeYamlError),
        (lambda text: ros1_parameters(text, "a.yaml"), RoslensError),
        (lambda text: ros2_parameters(text, "a.yaml"), RoslensError),
        (lambda text: load_reference([GivenText("a.yaml", text)], BY_KEY), RoslensError),
        (lambda text: parse_time_lines(text, "a.yaml"), RoslensError),
    ):
        try:
            read(content)
        except refusal as error:
            assert str(error)  # noqa: PT017 - every message is fine, a crash is not


def _recording(content: bytes) -> None:
    from roslens.live.adapters.bag.open_bag import open_bag
    from roslens.model.errors import UsageError

    with tempfile.NamedTemporaryFile(dir="/dev/shm" if Path("/dev/shm").is_dir() else None) as file:
        file.write(content)
        file.flush()
        try:
            bag = open_bag(Path(file.name))
        except UsageError as error:
            assert str(error)  # noqa: PT017 - see above
            return
        topics = [topic.name for topic in bag.topics]
        for _ in bag.tallies(0.5, topics):
            pass
        for _ in bag.fields({name: {"header.stamp.sec", "pose.position.x"} for name in topics}):
            pass
        bag.graph()
        bag.failures  # noqa: B018 - made when asked for


def _frames(content: bytes) -> None:
    """The first byte says how far the sender got: without the key, with it, or as a child process of the monitor."""
    from roslens.live.agent.link import Channel, LinkError, read_frame, read_pids, read_times, reported_time
    from roslens.model.wire import FrameReader, WireError

    way, body = content[0] % 3 if content else 0, content[1:]
    key = b"a key of more than sixteen bytes"
    agent, monitor = Channel(key, accepting=False), Channel(key, accepting=True)
    try:
        if way == 0:
            list(monitor.feed(body))
            assert not monitor.ready
        elif way == 1:
            list(monitor.feed(agent.hello()))
            ((_, proof),) = agent.feed(monitor.hello())
            ((_, answer), _) = monitor.feed(proof)
            list(agent.feed(answer))
            for letter, received in monitor.feed(agent.message("F", body)):
                assert letter == "F"
                _session_takes(read_frame(received))
        else:
            for frame in FrameReader().feed(body):
                _session_takes(frame)
    except (LinkError, WireError) as error:
        assert str(error)  # noqa: PT017 - see above
    for read in (read_pids, read_times, lambda piece: reported_time(piece, 1.0, 2.0)):
        try:
            read(body)
        except LinkError as error:
            assert str(error)  # noqa: PT017 - see above


def _session_takes(frame) -> None:
    from roslens.judge.reading.read_reference import GivenText, load_reference
    from roslens.live.join.session import Session
    from roslens.live.window.signals import BY_KEY

    reference = (EXAMPLES / "robot" / "rover.yaml").read_bytes()
    session = Session(load_reference([GivenText("rover.yaml", reference)], BY_KEY), start=0.0)
    for second in (1.0, 2.0):
        session.take([frame])
        session.look(second)


def _frame_seeds() -> list[bytes]:
    from roslens.live.agent.link import Channel, named_pids
    from roslens.model.entity import EntityId, EntityKind
    from roslens.model.failure import Failure
    from roslens.model.graph import Change, Event, Graph, Process
    from roslens.model.traffic.sample import Sample
    from roslens.model.traffic.tally import Moments, Tally
    from roslens.model.wire import VERSION, Frame, encode_frame

    host = EntityId(EntityKind.HOST, "base")
    tally = Tally("/scan", "/lidar", "/planner", 0.0, 1.0, 10, 100, 0.1, 0.9, Moments(9, 0.9, 0.09, 0.1, 0.1))
    graph = Graph("ros2", hosts=("base",), processes=(Process("base", 7, "node", 1.0, ("/lidar",)),))
    events = [Event(1.0, next(iter(Change)), "process:base/7", "exit code 1")]
    frames = [
        Frame(VERSION, "base/agent", 0, 1.0),
        Frame(VERSION, "base/agent", 1, 1.0, [tally], [Sample(host, 1.0, {"cpu": 5.0})], events, graph),
        Frame(VERSION, "base/ros2", 2, 1.0, [tally] * 3, failures=[Failure("ros", "gone", "a node")], looked=1.0),
    ]
    key = b"a key of more than sixteen bytes"
    greeting = Channel(key, accepting=False, nonce=bytes(range(16))).hello()
    encoded = [encode_frame(frame) for frame in frames]
    streams = [b"\x02" + one for one in encoded] + [b"\x02" + b"".join(encoded)]
    greetings = [b"\x00" + greeting + greeting[:4], b"\x01" + named_pids({1, 7})]
    return [*greetings, *(b"\x01" + one[4:] for one in encoded), *streams]


@cache
def _recordings(*kinds: str) -> list[bytes]:
    from live.adapters.bag.conftest import stamped, write_recording

    start, found = 1_700_000_000_000_000_000, []
    for kind in kinds:
        generation = "ros1" if kind.startswith("ros1") else "ros2"
        content = stamped(start, generation, 20)
        rows = [(f"/{'abc'[number % 3]}", start + number * 10_000_000, content) for number in range(20)]
        with tempfile.TemporaryDirectory() as folder:
            found.append(write_recording(Path(folder), kind, rows, 300).read_bytes())
    return found


def _requests(content: bytes) -> None:
    """What a stranger may send to an agent that acts, and what lies in a journal: the first byte says which."""
    from roslens.live.agent.message_line import LineError, MessageReader
    from roslens.live.agent.signed_request import Believing, RefusedError, _code
    from roslens.model.acting.order import Order, OrderError, OrderReader, Reply
    from roslens.store.journals.journal_entry import EntryError, read

    way, body = content[0] % 6 if content else 0, content[1:]
    key = b"k" * 32
    believing = Believing("arm", key)
    challenge = believing.challenge(0.0)
    try:
        if way == 0:
            list(MessageReader().feed(body))
        elif way == 1:
            believing.believed(body, 0.0)
        elif way == 2:
            # Even who has the key may send what is none.
            believing.believed(_code(key, body) + body, 0.0)
        elif way == 3:
            list(OrderReader(Order).feed(body))
        elif way == 4:
            list(OrderReader(Reply).feed(body))
        else:
            read(body)
    except (LineError, RefusedError, OrderError, EntryError) as error:
        assert str(error)  # noqa: PT017 - every message is fine, a crash is not
    else:
        assert way not in (1, 2), "nobody knows the challenge"
    assert challenge


def _request_seeds() -> list[bytes]:
    from roslens.live.agent.message_line import message
    from roslens.live.agent.signed_request import _ENCODER, Signed, sign
    from roslens.model.acting.host_request import HostRequest
    from roslens.model.acting.order import VERSION, Order, Reply, Verb, encode_order
    from roslens.store.journals.journal_entry import written

    asked = Signed(1, "arm", b"c" * 16, 3, HostRequest("r/1.0", "restart", "/driver", 77, ("/b",), {"grace": 2.0}))
    _, entry = written(0, 1.0, "decided", {"decision": "r/1.0", "because": [{"value": 3.5}]}, "")
    order = Order(VERSION, "r/1.0", Verb.DO, "publish", "", {"topic": "/stop", "fields": {"data": True}})
    return [
        b"\0" + message(b"C", b"c" * 16) + message(b"R", sign(asked, b"k" * 32)),
        b"\1" + sign(asked, b"k" * 32),
        b"\2" + _ENCODER.encode(asked),
        b"\3" + encode_order(order),
        b"\4" + encode_order(Reply(VERSION, "r/1.0", Verb.DO, True, "done", 0.5)),
        b"\5" + entry.rstrip(b"\n"),
    ]


def _read_as(grammar: str) -> Callable[[bytes], None]:
    """Return what reads as a check and a graph do, with the budget of a file; to leave it out is an answer."""

    def read(content: bytes) -> None:
        from shapes.readers import READERS

        from roslens.intake.file_budget import begin_reading
        from roslens.intake.time_budget import OverBudgetError

        begin_reading()
        try:
            READERS[grammar](content)
        except OverBudgetError as error:
            assert str(error)  # noqa: PT017 - see above

    return read


KINDS = {
    "manifest": Kind(lambda: _files("package*.xml"), XML, _manifest),
    "cpp": Kind(lambda: _files("*.cpp", "*.hpp"), CODE, _cpp),
    "python": Kind(lambda: _files("*.py"), PYTHON, _python),
    "launch": Kind(
        lambda: _files("*.launch", "*.launch.xml", "*launch.yaml", "*launch.py"),
        f"{XML} {PYTHON} {YAML}",
        _launch,
    ),
    "cmake": Kind(lambda: _files("CMakeLists.txt", "*.cmake"), CMAKE, _cmake),
    "yaml": Kind(lambda: _files("*.yaml", "*.yml"), YAML, _yaml),
    "repositories": Kind(lambda: _files("*.repos", "distribution.yaml", "filter.yaml"), YAML, _repositories),
    "bag": Kind(lambda: _recordings("ros1", "ros1_bz2", "ros1_lz4"), BAG, _recording),
    "mcap": Kind(lambda: _recordings("mcap", "mcap_zstd", "mcap_message"), BAG, _recording),
    "sqlite": Kind(lambda: _recordings("sqlite"), BAG, _recording),
    "messages": Kind(lambda: _files("*.msg", "*.srv", "*.action"), MESSAGE, _read_as("messages")),
    "robot": Kind(lambda: _files("*.urdf", "*.xacro"), XML, _read_as("robot descriptions")),
    "toml": Kind(lambda: _files("*.toml"), TOML, _read_as("TOML")),
    "frames": Kind(_frame_seeds, PACKED, _frames),
    "requests": Kind(_request_seeds, PACKED, _requests),
}  # fmt: skip


def words_of(kind: Kind) -> list[bytes]:
    """Return the words of a kind as bytes; those of text as UTF-8, other bytes as they are."""
    words = [word for word in kind.words.split(" ") if word]
    return [word.encode("latin-1" if max(word) < "\u0100" else "utf-8") for word in words] + [b" "]
