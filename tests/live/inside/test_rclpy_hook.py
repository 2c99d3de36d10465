"""The hook on classes shaped like those of rclpy, in a process of its own: it replaces what it finds for good."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from roslens.live.inside.counters import CounterReader
from roslens.live.inside.environment import environment
from roslens.live.inside.opened_file import open_file

FAKE = {
    "__init__.py": "",
    "executors.py": """
class Executor:
    def _take_subscription(self, sub):
        with sub.handle:
            taken = sub.handle.take_message(sub.msg_type, sub.raw)
            if taken is None:
                return None
            return lambda: sub.callback(taken[0])
    def _take_timer(self, timer):
        return timer
""",
    "publisher.py": """
class Publisher:
    def __init__(self, handle):
        self.handle = handle
    def publish(self, msg):
        with self.handle:
            self.handle.publish(msg)
""",
}
NODE = """
from rclpy.executors import Executor
from rclpy.publisher import Publisher
class Handle:
    sent = []
    def __init__(self, topic, queue=()): self.topic, self.queue = topic, list(queue)
    def __enter__(self): pass
    def __exit__(self, *_): pass
    def get_topic_name(self): return self.topic
    def get_logger_name(self): return 'ns.relay'
    def publish(self, msg): self.sent.append(msg)
    def take_message(self, kind, raw): return self.queue.pop(0) if self.queue else None
class Sub:
    msg_type, raw = object, True
    def __init__(self, handle, callback): self.handle, self.callback = handle, callback
def info(n):
    return {'source_timestamp': n, 'received_timestamp': n + 1000, 'publication_sequence_number': n,
            'publisher_gid': {'data': b'0123456789abcdef'}}
out = Publisher(Handle('/out'))
sub = Sub(Handle('/in', [(b'abc', info(n)) for n in (1, 2, 4)]), out.publish)
executor = Executor()
for _ in range(4):
    call = executor._take_subscription(sub)
    if call: call()
executor._take_timer(None)
out.publish('of a timer')
"""


def run(
    tmp_path: Path, code: str, fake=FAKE, look=id, **variables: str
) -> tuple[subprocess.CompletedProcess, dict, list]:
    package = tmp_path / "rclpy"
    package.mkdir()
    for name, text in fake.items():
        (package / name).write_text(text)
    counters = tmp_path / "counters"
    base = {**os.environ, "ROSLENS_COUNTERS": str(counters), "PYTHONPATH": str(tmp_path), **variables}
    reader = CounterReader(str(counters))
    reader.read(0.0)
    # The folder is read before the process, which waits for it, may take its file away.
    waiting = code + "\nprint('done', flush=True); import sys; sys.stdin.read()"
    with subprocess.Popen(
        [sys.executable, "-c", waiting], env=base | environment(base) | {"LD_PRELOAD": ""}, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    ) as process:  # fmt: skip
        said = process.stdout.readline()
        counted = reader.read(5.0)
        look(counters)
        _, errors = process.communicate()
    failures = reader.failures()
    reader.close()
    assert said == "done\n", errors
    return {(one.tally.topic, one.answers): one.tally for one in counted}, failures


def test_takes_publishes_and_answers_are_counted(tmp_path):
    tallies, failures = run(tmp_path, NODE)
    assert failures == []
    assert tallies["/in", ""].count == 3
    assert tallies["/in", ""].subscriber == "/ns/relay"
    assert tallies["/in", ""].bytes == 9
    assert tallies["/in", ""].latency.mean == pytest.approx(1e-6)
    assert tallies["/out", ""].count == 4
    assert tallies["/out", ""].publisher == "/ns/relay"
    assert tallies["/out", "/in"].processing.count == 3


ENDING = """
import gc
kept, destroyed, collected = (Publisher(Handle(topic)) for topic in ('/kept', '/destroyed', '/collected'))
for one in (kept, destroyed, collected): one.publish('once')
destroyed.destroy()
destroyed.destroy()
del one, collected
taken = Sub(Handle('/of_a_subscription', [(b'abc', info(1))]), id)
executor._take_subscription(taken)
del taken
gc.collect()
"""


def test_slots_of_publishers_and_subscriptions_that_were_destroyed_say_so(tmp_path):
    ended = {}

    def look(counters):
        (path,) = counters.glob("*.counters")
        file = open_file(path)
        for number in range(len(file.tokens())):
            one = file.slot(number, None)
            ended[one.topic] = bool(one.ended)
        file.close()

    publisher = FAKE["publisher.py"] + "    def destroy(self):\n        self.handle = self.handle\n"
    tallies, failures = run(tmp_path, NODE + ENDING, {**FAKE, "publisher.py": publisher}, look=look)
    assert failures == []
    assert ended == {
        "/in": False, "/out": False, "/kept": False, "/destroyed": True, "/collected": True, "/of_a_subscription": True,
    }  # fmt: skip
    assert tallies["/destroyed", ""].count == tallies["/collected", ""].count == 1


def test_an_rclpy_that_tells_no_publisher_is_counted_without_losses(tmp_path):
    old = NODE.replace("'publication_sequence_number': n,", "").replace(
        "'publisher_gid': {'data': b'0123456789abcdef'}", ""
    )
    tallies, failures = run(tmp_path, old)
    assert failures == []
    assert (tallies["/in", ""].count, tallies["/in", ""].lost) == (3, -1)


def test_a_handle_is_entered_and_left_as_without_the_hook(tmp_path):
    handle = """
    log = []
    def __enter__(self): self.log.append('in'); return self
    def __exit__(self, *why): self.log.append(why[0]); return why[0] is KeyError
    def take_message(self, kind, raw): raise self.error
"""
    code = (
        NODE.split("out = ")[0]
        + "class Broken(Handle):"
        + handle
        + """
sub = Sub(Broken('/in'), None)
executor = Executor()
Broken.error = KeyError()
executor._take_subscription(sub)
Broken.error = OSError()
try:
    executor._take_subscription(sub)
    assert False
except OSError:
    pass
assert Broken.log == ['in', KeyError, 'in', OSError]
assert sub.roslens_counters.handle.topic == '/in'
"""
    )
    assert run(tmp_path, code)[1] == []


def test_another_rclpy_is_left_alone_and_said(tmp_path):
    other = FAKE | {"executors.py": "class Executor:\n    def _take_it(self, sub): pass\n"}
    _, failures = run(tmp_path, "import rclpy.executors", other)
    assert [failure.what.partition(": ")[2] for failure in failures] == [
        "rclpy: not counting: Executor._take_subscription is not there"
    ]


def test_an_error_of_the_hook_ends_the_hook_and_not_the_node(tmp_path):
    broken = NODE.replace("'received_timestamp': n + 1000,", "")
    tallies, failures = run(tmp_path, broken + "\nassert Handle.sent == [b'abc'] * 3 + ['of a timer']")
    assert "rclpy: stopped after KeyError: 'received_timestamp'" in failures[0].what
    assert ("/out", "") not in tallies


def test_the_sitecustomize_that_is_hidden_runs(tmp_path):
    (tmp_path / "sitecustomize.py").write_text("import builtins\nbuiltins.was_here = __file__\n")
    run(tmp_path, f"assert was_here == {str(tmp_path / 'sitecustomize.py')!r}")


def test_a_process_without_rclpy_makes_no_file(tmp_path):
    tallies, _ = run(tmp_path, "import sys; assert 'roslens_inside.rclpy_hook' not in sys.modules")
    assert tallies == {}
    assert not (tmp_path / "counters").exists()


def test_a_child_that_forks_off_counts_in_no_file_of_its_parent(tmp_path):
    fork = "\nimport os\nchild = os.fork()\nif not child:\n    out.publish('child'); os._exit(0)\nos.waitpid(child, 0)"
    tallies, _ = run(tmp_path, NODE + fork)
    assert tallies["/out", ""].count == 4


def test_inspection_sees_the_module_as_without_the_hook(tmp_path):
    run(
        tmp_path,
        "import inspect, rclpy.executors as e; assert 'def _take_timer' in inspect.getsource(e); "
        "assert type(e.__spec__.loader).__name__ == type(e.__loader__).__name__ == 'SourceFileLoader'",
    )


STAMPED = """
class Stamp:
    __slots__ = ('_sec', '_nanosec')
    sec, nanosec = property(lambda self: self._sec), property(lambda self: self._nanosec)
    def __init__(self, sec): self._sec, self._nanosec = sec, 250
class Header:
    __slots__ = ('_stamp',)
    stamp = property(lambda self: self._stamp)
    def __init__(self, sec): self._stamp = Stamp(sec)
class Generated:
    __slots__ = ('_header',)
    header = property(lambda self: self._header)
    def __init__(self, sec): self._header = Header(sec)
    @staticmethod
    def get_fields_and_field_types(): return {'header': 'std_msgs/Header', 'data': 'string'}
class Other:
    def __init__(self, sec): self.header = Header(sec)
    get_fields_and_field_types = Generated.get_fields_and_field_types
executor = Executor()
for kind in (Generated, Other):
    second = 10 ** 9
    queue = [(kind(sec), info(7 * second + number)) for number, sec in enumerate((5, 0, 6))]
    sub = Sub(Handle('/' + kind.__name__, queue), None)
    sub.msg_type, sub.raw = kind, False
    for _ in queue: executor._take_subscription(sub)
"""


def test_ages_are_those_of_the_stamps_however_a_message_keeps_them(tmp_path):
    tallies, failures = run(tmp_path, NODE + STAMPED)
    assert failures == []
    for topic in ("/Generated", "/Other"):
        assert (tallies[topic, ""].count, tallies[topic, ""].age.count) == (3, 2)  # one had no stamp
        assert tallies[topic, ""].age.total == pytest.approx(3.0 + 2 * 750e-9 + 2e-9, abs=1e-9)


def test_what_answers_several_topics_is_counted_for_each(tmp_path):
    more = """
other = Sub(Handle('/scan', [(b'abc', info(n)) for n in (1, 2)]), out.publish)
again = Sub(Handle('/in', [(b'abc', info(n)) for n in (5, 6)]), out.publish)
for sub in (other, again, again, other):
    executor._take_subscription(sub)()
"""
    tallies, failures = run(tmp_path, NODE + more)
    assert failures == []
    assert tallies["/out", ""].count == 8
    assert (tallies["/out", "/in"].processing.count, tallies["/out", "/scan"].processing.count) == (5, 2)


def test_beside_the_library_python_counts_nothing_and_tells_what_the_library_does_not_see(tmp_path):
    """Timers, guard conditions and waitables; messages and services it sees itself."""
    fake = FAKE | {
        "executors.py": FAKE["executors.py"]
        + """
    def _take_guard_condition(self, one): return 'guard'
    def _take_waitable(self, one): return 'waitable'
"""
    }
    code = """
import ctypes, sys
calls = []
class Library:
    class Function:
        def __init__(self, name): self.name = name
        def __call__(self): calls.append(self.name)
    def __init__(self, name): assert name is None
    roslens_count_answers, roslens_forget_taken = Function('answers'), Function('forget')
ctypes.PyDLL = Library
import os
os.environ['LD_PRELOAD'] = 'library'
from rclpy.executors import Executor
from rclpy.publisher import Publisher
assert Executor._take_subscription.__name__ == '_take_subscription' and not hasattr(Publisher.publish, '__wrapped__')
assert calls == ['answers'], calls
executor = Executor()
executor._take_timer(None)
assert (executor._take_guard_condition(1), executor._take_waitable(1)) == ('guard', 'waitable')
assert calls == ['answers'] + ['forget'] * 3, calls
"""
    tallies, failures = run(tmp_path, code, fake)
    assert (tallies, failures) == ({}, [])
