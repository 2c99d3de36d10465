"""The signals: what is measured of a live system, as rows of the table of quantities.

Values are in SI units; documents may write others (``25 Hz``, ``10 ms``, ``5 MB/s``, ``80 %``).
"""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity

_TRAFFIC = (EntityKind.CONNECTION, EntityKind.TOPIC)
_MACHINE = (EntityKind.HOST,)
_PROGRAM = (EntityKind.NODE, EntityKind.PROCESS)
_SERVED = (EntityKind.SERVICE,)
_COUNTED = "Of ROS 2 nodes that count themselves, where the preloaded library is there; a call without answer has none."
_BOTH = (EntityKind.HOST, EntityKind.NODE, EntityKind.PROCESS)

SIGNALS: tuple[Quantity, ...] = (
    Quantity("rate", "Rate", "Hz", _TRAFFIC,
             "Messages per second over the window: of a topic as they are sent, of a connection as they are received.",
             (Fold.SUM,), Better.NEITHER, "messages in the window / its length", decimals=2),
    Quantity("rate_received", "Rate received", "Hz", (EntityKind.TOPIC,),
             "Messages per second as they are received by the subscriber that gets fewest of them.", (),
             Better.NEITHER, limits="Of subscribers that are observed; none in a recording.", decimals=2),
    Quantity("period", "Mean period", "s", _TRAFFIC, "Mean time between messages.", (Fold.MEAN,), Better.NEITHER,
             decimals=6),
    Quantity("jitter", "Jitter", "s", _TRAFFIC, "Standard deviation of the times between messages.", (Fold.MAX,),
             decimals=6),
    Quantity("largest_gap", "Largest gap", "s", _TRAFFIC,
             "Longest time without a message, the one that is still going on included.", (Fold.MAX,), decimals=6),
    Quantity("bandwidth", "Bandwidth", "B/s", _TRAFFIC, "Serialised bytes per second.", (Fold.SUM,), Better.NEITHER),
    Quantity("message_size", "Message size", "B", _TRAFFIC, "Mean serialised size of a message.", (Fold.MEAN,),
             Better.NEITHER),
    Quantity("latency", "Mean latency", "s", _TRAFFIC, "Mean time from publishing to receipt.", (Fold.MEAN,),
             limits="Between hosts only as good as the offset of their clocks is known.", minimum=None, decimals=6),
    Quantity("latency_max", "Largest latency", "s", _TRAFFIC, "Longest time from publishing to receipt.",
             (Fold.MAX,), minimum=None, decimals=6),
    Quantity("age", "Mean age", "s", _TRAFFIC, "Mean time from the stamp in the header to receipt.", (Fold.MEAN,),
             limits="Only of messages whose type begins with a header.", minimum=None, decimals=6),
    Quantity("age_max", "Largest age", "s", _TRAFFIC, "Longest time from the stamp in the header to receipt.",
             (Fold.MAX,), minimum=None, decimals=6),
    Quantity("loss", "Loss", "%", _TRAFFIC, "Share of the published messages that did not arrive.", (Fold.MAX,),
             maximum=100, decimals=2),
    Quantity("processing", "Mean processing time", "s", _TRAFFIC,
             "Mean time from receipt of a message to the message that answers it.", (Fold.MAX,), decimals=6),
    Quantity("publishers", "Publishers", "", (EntityKind.TOPIC,), "How many nodes publish on the topic.", (),
             Better.NEITHER),
    Quantity("subscribers", "Subscribers", "", (EntityKind.TOPIC,), "How many nodes subscribe to the topic.", (),
             Better.NEITHER),
    Quantity("misfits", "Misfits", "", (EntityKind.TOPIC,),
             "How many pairs of a publisher and a subscriber exchange nothing, because their type, its definition or "
             "their quality of service does not fit.", (), limits="Of ROS 2 alone."),
    Quantity("cpu", "CPU", "%", _BOTH, "Share of one core; of a host the share of all cores.", (Fold.SUM,),
             limits="Nodes that share a process share its value.", decimals=1),
    Quantity("cpu_core_max", "Busiest core", "%", _MACHINE, "CPU of the busiest core.", maximum=100, decimals=1),
    Quantity("memory", "Memory", "B", _BOTH, "Resident memory; of a host all memory that is not available.",
             (Fold.SUM,)),
    Quantity("memory_share", "Memory share", "%", _BOTH, "Memory as share of the memory of the host.", (Fold.SUM,),
             maximum=100, decimals=1),
    Quantity("swap_share", "Swap share", "%", _MACHINE, "Swap in use.", maximum=100, decimals=1),
    Quantity("disk_free", "Free disk", "B", _MACHINE, "Least free space of the writable file systems.", (Fold.MIN,),
             Better.HIGHER),
    Quantity("disk_share", "Disk share", "%", _MACHINE, "Fullest of the writable file systems.", (Fold.MAX,),
             maximum=100, decimals=1),
    Quantity("disk_read", "Disk read", "B/s", _BOTH, "Bytes read from disks per second.", (Fold.SUM,), Better.NEITHER),
    Quantity("disk_write", "Disk write", "B/s", _BOTH, "Bytes written to disks per second.", (Fold.SUM,),
             Better.NEITHER),
    Quantity("network_in", "Network in", "B/s", _MACHINE, "Bytes received, all interfaces but loopback.", (Fold.SUM,),
             Better.NEITHER),
    Quantity("network_out", "Network out", "B/s", _MACHINE, "Bytes sent, all interfaces but loopback.", (Fold.SUM,),
             Better.NEITHER),
    Quantity("network_drops", "Network drops", "Hz", _MACHINE, "Packets per second that an interface dropped.",
             (Fold.SUM,), decimals=2),
    Quantity("resent", "Sent again", "%", _MACHINE, "Share of TCP segments that were retransmitted, in the last 5 s.",
             (Fold.MAX,), limits="Shows losses of the network that TCP hides, as in ROS 1; unknown for few segments.",
             maximum=100, decimals=2),
    Quantity("temperature", "Temperature", "degC", _MACHINE, "Hottest sensor.", (Fold.MAX,), minimum=None, decimals=1),
    Quantity("gpu", "GPU", "%", _MACHINE, "Load of the busiest GPU.", (Fold.MAX,), maximum=100, decimals=1),
    Quantity("gpu_memory_share", "GPU memory", "%", _MACHINE, "Fullest GPU memory.", (Fold.MAX,), maximum=100,
             decimals=1),
    Quantity("gpu_temperature", "GPU temperature", "degC", _MACHINE, "Hottest GPU.", (Fold.MAX,), minimum=None,
             decimals=1),
    Quantity("pressure_cpu", "CPU pressure", "%", _MACHINE, "Time in which some task waited for a CPU (PSI, 10 s).",
             (Fold.MAX,), maximum=100, decimals=2),
    Quantity("pressure_memory", "Memory pressure", "%", _MACHINE,
             "Time in which some task waited for memory (PSI, 10 s).", (Fold.MAX,), maximum=100, decimals=2),
    Quantity("pressure_io", "I/O pressure", "%", _MACHINE, "Time in which some task waited for I/O (PSI, 10 s).",
             (Fold.MAX,), maximum=100, decimals=2),
    Quantity("load", "Load", "", _MACHINE, "Mean number of runnable tasks of the last minute.", (Fold.MAX,),
             decimals=2),
    Quantity("clock_offset", "Clock offset", "s", _MACHINE, "Clock of the host ahead of the monitor's.", (),
             minimum=None, decimals=6),
    Quantity("clock_bound", "Clock bound", "s", _MACHINE, "Maximum error of the clock offset.", (), decimals=6),
    Quantity("threads", "Threads", "", _PROGRAM, "Threads of the process.", (Fold.SUM,), Better.NEITHER),
    Quantity("open_files", "Open files", "", _PROGRAM, "Open file descriptors of the process.", (Fold.SUM,)),
    Quantity("context_switches", "Context switches", "Hz", _PROGRAM, "Context switches per second.", (Fold.SUM,),
             decimals=1),
    Quantity("cpu_wait", "Wait for a CPU", "%", _PROGRAM,
             "Share of the time in which it wants to run and waits for a processor, all threads together.",
             (Fold.MAX,), limits="Of the first 64 threads; absent if the kernel has no schedstat.", decimals=1),
    Quantity("stopped", "Stopped", "s", _PROGRAM,
             "How long the process has been stopped, by a signal or a debugger; 0 while it runs.", (Fold.MAX,),
             limits="Up to a second too long: it counts from when the process was last observed running.", decimals=1),
    Quantity("hung", "Hung", "s", _PROGRAM,
             "How long the process has been waiting for the kernel (uninterruptible sleep), as for a disk or a driver "
             "that does not answer; 0 while it runs.", (Fold.MAX,),
             limits="Sampled once a second; a deadlock within the process does not count.",
             decimals=1),
    Quantity("restarts", "Restarts", "", _PROGRAM, "How often it was restarted since it was first observed.",
             (Fold.SUM,)),
    Quantity("calls", "Calls", "Hz", _SERVED, "Calls per second received by its servers.", (Fold.SUM,), Better.NEITHER,
             limits=_COUNTED, decimals=2),
    Quantity("response_time", "Mean response time", "s", _SERVED,
             "Mean time from receipt of a call by its server to the response.", (Fold.MAX,), limits=_COUNTED,
             decimals=6),
    Quantity("response_time_max", "Largest response time", "s", _SERVED,
             "Longest time from receipt of a call by its server to the response.", (Fold.MAX,), limits=_COUNTED,
             decimals=6),
    Quantity("client_calls", "Calls by clients", "Hz", _SERVED, "Calls per second sent by its clients.", (Fold.SUM,),
             Better.NEITHER, limits=_COUNTED, decimals=2),
    Quantity("client_response_time", "Mean response time for clients", "s", _SERVED,
             "Mean time from sending a call to receipt of the response.", (Fold.MAX,), limits=_COUNTED,
             decimals=6),
    Quantity("client_response_time_max", "Largest response time for clients", "s", _SERVED,
             "Longest time from sending a call to receipt of the response.", (Fold.MAX,), limits=_COUNTED,
             decimals=6),
)  # fmt: skip
"""Every signal, in the order in which tables show them."""

BY_KEY: dict[str, Quantity] = {signal.key: signal for signal in SIGNALS}

SUMMED = frozenset({"rate", "bandwidth"})
"""Signals of a topic that are sums over its publishers."""

RECEIVED = "rate_received"
"""Signal of a topic that is derived from the rates of its connections."""

ENDS = frozenset({"publishers", "subscribers", "misfits"})
"""Signals of a topic that are derived from the graph."""
