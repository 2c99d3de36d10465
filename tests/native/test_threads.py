"""Many threads write, another process reads: nothing is missed, and nothing half written is seen."""

import mmap
import threading

from native.series import series

from roslens.live.inside import slots
from roslens.live.inside.slots import PUBLISHED, TAKEN
from roslens.live.inside.snapshot import snapshot

THREADS, MESSAGES = 6, 20_000


def test_threads_on_the_same_handles_while_others_come_and_go(either):
    node = either()
    node.say(
        "publisher /out / n", "subscription /in / n", f"message 1700000000000000000 1700000000000001000 5 {'11' * 16}"
    )
    done = threading.Event()
    seen = []
    # A slot is given on ten seconds after its endpoint ended: where the machine is that slow, the counts of handles
    # that went are with whoever read them in time, as readers of nodes do.
    went = {}

    def read():
        (path,) = node.counters.iterdir()
        with path.open("rb") as file, mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ) as mapped:
            view = memoryview(mapped)
            while not done.is_set():
                (used,) = slots.struct.unpack_from("=I", view, slots.USED_AT)
                for number in range(used):
                    at = slots.HEADER_BYTES + number * slots.SLOT_BYTES
                    one = snapshot(view[at : at + slots.SLOT_BYTES])
                    if one is not None and one.topic in ("/in", "/out"):
                        seen.append((one.kind, one.messages, series(one)[1][0]))
                    elif one is not None and one.topic == "/even":
                        went[number, one.generation] = one.messages
            view.release()

    reader = threading.Thread(target=read)
    reader.start()
    try:
        node.say(f"threads {THREADS + 1} 0 1 {MESSAGES}")
    finally:
        done.set()
        reader.join()
    found = {}
    for number, raw in enumerate(node.slots()):
        one = snapshot(memoryview(raw))
        found.setdefault((one.kind, one.topic), []).append(one)
        if one.topic == "/even":
            went[number, one.generation] = one.messages
    (out,), (taken,) = found[PUBLISHED, "/out"], found[TAKEN, "/in"]
    assert out.messages == taken.messages == series(taken)[1][0] == THREADS * MESSAGES
    assert series(out)[0][0] <= THREADS * MESSAGES - 1
    assert (taken.lost, taken.pending) == (0, 0)
    assert sum(went.values()) == MESSAGES // 1000
    assert slots.HEADER.unpack_from(node.file())[7:9] == (0, 0)
    assert all(messages == latencies for kind, messages, latencies in seen if kind == TAKEN)
    assert [messages for kind, messages, _ in seen if kind == TAKEN] == sorted(
        messages for kind, messages, _ in seen if kind == TAKEN
    )
