"""What counting costs a user's node: a relay at 1 kHz, a few messages with the hook and a few without, in turn.

    python benchmarks/relay.py [PYTHON WITH RCLPY] [--hertz N] [--seconds S] [--without-library]

One process publishes a stamped message so many times a second; another, started as `roslens run` starts it, takes it
and publishes it again. What its spinning thread spends on each message, from waiting for it to having published it, is
taken in blocks of 25 messages that are counted and not counted in turn, and each block is compared with those beside
it: what else the machine does costs both the same. Caches are as cold as they are in a node that waits between two
messages, which is why this is more than what `inside_python.py` and `preload.py` find in a tight loop.

`--without-library` is the hook in Python alone, as where there was no C compiler; `--noise` counts in no block.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from roslens.live.inside import slots
from roslens.live.inside.environment import environment
from roslens.live.inside.preload import PRELOAD

ROOT = Path(__file__).parents[1]
DOMAIN = "86"
BLOCK = 25

SOURCE = """
import os, sys, time
import rclpy
from std_msgs.msg import Header
hertz = float(sys.argv[1])
rclpy.init()
out = rclpy.create_node('source').create_publisher(Header, 'in', 10)
message = Header(frame_id='map')
next_ = time.monotonic()
while os.getppid() != 1:
    next_ = max(next_ + 1 / hertz, time.monotonic() - 0.01)
    time.sleep(max(0.0, next_ - time.monotonic()))
    message.stamp.sec, message.stamp.nanosec = divmod(time.time_ns(), 1_000_000_000)
    out.publish(message)
"""

RELAY = """
import ctypes, statistics, sys, time
import rclpy
from std_msgs.msg import Header
seconds, block, way = float(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
rclpy.init()
node = rclpy.create_node('relay')
out = node.create_publisher(Header, 'out', 10)
if way == 'library':
    program = ctypes.PyDLL(None)
    middleware = next(line.split()[-1] for line in open('/proc/self/maps') if 'librmw_fastrtps_cpp' in line)
    assert program.toggle_find(middleware.encode()), 'the middleware was not found'
    def count(yes):
        program.toggle_past(not yes)
elif way == 'python':
    from roslens_inside.rclpy_hook import HOOK
    hooked = [(owner, name, getattr(owner, name)) for owner, name, _ in HOOK.undo]
    assert hooked, 'nothing is hooked'
    def count(yes):
        for owner, name, function in (hooked if yes else HOOK.undo):
            setattr(owner, name, function)
else:
    def count(yes):
        pass
spent, before, blocks, number, counted = [], 0, [], 0, True
def relay(message):
    global before, number, counted, spent
    out.publish(message)
    number += 1
    spent.append(time.thread_time_ns() - before)
    if number % block == 0:
        blocks.append((counted, statistics.median(spent[2:])))
        counted, spent = not counted, []
        count(counted)
    before = time.thread_time_ns()
node.create_subscription(Header, 'in', relay, 10)
end = time.monotonic() + 3
while time.monotonic() < end:
    rclpy.spin_once(node, timeout_sec=1)
blocks.clear()
begun, first = time.monotonic(), number
while time.monotonic() < begun + seconds:
    rclpy.spin_once(node, timeout_sec=1)
rate = (number - first) / (time.monotonic() - begun)
added = [
    (now - (one + other) / 2) * (1 if counted else -1) / 1000
    for (_, one), (counted, now), (_, other) in zip(blocks, blocks[1:], blocks[2:])
]
off = statistics.median(of for counted, of in blocks if not counted) / 1000
middle = statistics.median(added)
error = statistics.median(abs(one - middle) for one in added) * 1.4826 * 1.2533 / len(added) ** 0.5
print(off, middle, error, len(added), rate)
"""


def toggle(folder: str) -> str:
    """Return the library that leads past the hook, made for this."""
    library = f"{folder}/libtoggle.so"
    words = ["cc", "-std=c11", "-D_GNU_SOURCE", "-O2", "-fPIC", "-shared", "-o", library]
    subprocess.run([*words, str(ROOT / "native/tests/toggle.c"), "-ldl"], check=True)
    return library


def main() -> None:
    """Print what the hook adds."""
    parser = argparse.ArgumentParser()
    parser.add_argument("python", nargs="?", default="build/ros2/bin/python")
    parser.add_argument("--hertz", type=float, default=1000.0)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--without-library", action="store_true", help="count by the hook in Python alone")
    parser.add_argument("--noise", action="store_true", help="count in no block")
    options = parser.parse_args()
    if not Path(options.python).exists():
        sys.exit(f"no {options.python}: name a Python with rclpy")
    way = "none" if options.noise else "python" if options.without_library else "library"
    with tempfile.TemporaryDirectory() as folder:
        plain = {name: text for name, text in os.environ.items() if name not in (slots.VARIABLE, "PYTHONPATH")}
        plain.update(ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST", ROS_DOMAIN_ID=DOMAIN)
        counting = plain | environment(plain | {slots.VARIABLE: folder})
        counting[PRELOAD] = "" if options.without_library else f"{toggle(folder)}:{counting[PRELOAD]}"
        source = subprocess.Popen([options.python, "-c", SOURCE, str(options.hertz)], env=plain)
        try:
            words = [options.python, "-c", RELAY, str(options.seconds), str(BLOCK), way]
            ended = subprocess.run(words, env=counting, stdout=subprocess.PIPE, text=True, check=True)
        finally:
            source.kill()
    off, added, error, blocks, rate = (float(word) for word in ended.stdout.split())
    print(f"a message relayed takes {off:.0f} us of a core without the hook, at {rate:.0f} messages/s")
    print(f"the hook ({way}) adds {added:.1f} us to it (standard error {error:.1f} us, {blocks:.0f} blocks of {BLOCK})")


if __name__ == "__main__":
    main()
