"""`make testbed`: the robot on three hosts until Ctrl-C, with the commands that look into them and break them.

It helps itself: `roslens react` and agents do what `actions.yaml` says, and what they write down is printed.
With `--no-reactions` nodes that end, or are killed, are started again after a while, and nothing else is done.
"""

import argparse
import shlex
import sys
import time
from pathlib import Path

from roslens.cli.page.watch_screen import time_of_day
from roslens.report.history.journal_text import journal_line
from roslens.store.journals.read_journal import JournalReader
from testbed import robot_ros1, robot_ros2
from testbed.action_table import FAKED
from testbed.clock import library
from testbed.hosts import INTERFACE, Bed, Host
from testbed.machine import BedError
from testbed.reacting import Reacting
from testbed.robot import HOSTS, NODES, Robot
from testbed.robot_ros1 import Ros1Robot
from testbed.robot_ros2 import Ros2Robot
from testbed.watched import MONITOR, ROSLENS

TESTS = Path(__file__).parents[1]
STEP = 0.2
WELL_LIMIT = 60.0
_LEAK = "import time; kept = [(bytearray(1_000_000), time.sleep(0.1)) for _ in range(200)]"


def say(text: str = "") -> None:
    """Writes a line."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def make_robot(generation: str | None, bed: Bed, clocks: bool) -> Robot:
    """The robot of the generation asked for, else of the one that is here; raises BedError where there is none."""
    faked = HOSTS if clocks else ()
    made = Ros2Robot if generation_of(generation) == "ros2" else Ros1Robot
    return made(bed, faked_clocks=faked)


def generation_of(asked: str | None) -> str:
    """The generation asked for, else the one that is here; raises BedError where there is none."""
    reasons = {"ros2": robot_ros2.why_not, "ros1": robot_ros1.why_not}
    for name, why_not in reasons.items():
        if asked in (None, name) and why_not() is None:
            return name
    found = [f"{name}: {why_not()}" for name, why_not in reasons.items() if asked in (None, name)]
    raise BedError("no ROS to run the robot with. " + "; ".join(found))


def write_entrance(robot: Robot, host: Host) -> Path:
    """Makes a script that runs a command in a host, or a shell, with the robot's environment."""
    entrance = robot.bed.folder / f"in-{host.name}"
    variables = [f"{key}={value}" for key, value in host.environment(robot.environment(host)).items()]
    words = shlex.join(["nsenter", "--all", f"--target={host.pid}", "--wd=.", "--", "env", "-i", *variables])
    entrance.write_text(f'#!/bin/sh\n[ $# -gt 0 ] || set -- bash\nexec {words} TERM="$TERM" "$@"\n')
    entrance.chmod(0o755)
    return entrance


def describe(robot: Robot, clocks: bool, *, reacts: bool) -> None:
    """Prints what runs where, and a command for each fault."""
    bed = robot.bed
    into = {host.name: write_entrance(robot, host) for host in bed}
    say(f"A {robot.generation} robot on three hosts, joined by a {bed.link!r} link. Ctrl-C ends it.\n")
    for host in bed:
        nodes = [f"{node.name} ({robot.processes[node.name].pid})" for node in NODES if node.host == host.name]
        say(f"  {host.name:8} {host.address}  {', '.join(nodes):32} {into[host.name]} [COMMAND...]")
    say(f"\nRun something in a host, with the robot's environment:\n  {into['base']} ps ax")
    say("\nBreak it, and mend it:")
    lidar, sensor = robot.processes["lidar"].pid, bed["sensor"]
    mend, back = f"kill -CONT {lidar}", "comes back by itself"
    if reacts:
        mend, back = "it is ended and started again", "is started again"
    rows = {
        "freeze": f"kill -STOP {lidar}    # {mend}",
        "crash": f"kill -9 {lidar}       # it {back}, with another process id",
        "CPU burn": f"{into['sensor']} sh -c 'while :; do :; done'",
        "memory leak": f"{into['sensor']} python3 -c '{_LEAK}'",
        "full disk": f"{into['sensor']} dd if=/dev/zero of={sensor.disk}/filler bs=64k    # rm it there, the same way",
        "unplugged": f"ip -n {sensor.namespace} link set {INTERFACE} down    # up",
        **_link_rows(bed),
    }
    if clocks:
        rows["clock offset"] = f"echo -0.25 >{sensor.folder}/clock    # echo +0"
    elif library() is not None:
        rows["clock offset"] = "start with make testbed ARGS=--clocks"
    for what, how in rows.items():
        say(f"  {what:13} {how}")
    say()


def _link_rows(bed: Bed) -> dict[str, str]:
    if bed.switch is not None:
        change = f"PYTHONPATH={TESTS} {sys.executable} -m testbed.switch_control {bed.switch.path} sensor"
        return {
            "delay": f"{change} delay_ms=20 jitter_ms=5    # =0",
            "loss": f"{change} loss_percent=5    # =0",
            "rate": f"{change} rate_bit=1e6    # =0",
        }
    sensor = bed["sensor"]
    bucket = f"tc -n {sensor.namespace} qdisc replace dev {INTERFACE} root tbf rate 1mbit burst 32kb latency 400ms"
    return {"rate": f"{bucket}    # qdisc del dev {INTERFACE} root", "delay, loss": "need the link 'shaped'"}


def describe_reactions(reacting: Reacting) -> None:
    """Prints what is done about faults, and how to look into that and stop it."""
    folder, entrance = reacting.bed.folder, f"{reacting.bed.folder}/in-{MONITOR}"
    roslens = f"{entrance} env XDG_STATE_HOME={reacting.environment['XDG_STATE_HOME']} {ROSLENS}"
    say(f"`roslens react --mode act` on {MONITOR} and agents on the others do what these reactions say:")
    say(f"  {folder}/actions.yaml    # edit it: what is right holds within seconds")
    say("\nHold everything, go on, and look whether the journal is whole:")
    say(f"  {roslens} react --hold 'I look at it'")
    say(f"  {roslens} react --release")
    say(f"  {roslens} journal --verify {folder}/journal.jsonl\n")


def follow(reacting: Reacting, lasts: float | None) -> None:
    """Prints the journal as it grows, until the time is over; raises BedError where `roslens react` ends."""
    reader = JournalReader(reacting.bed.folder / "journal.jsonl")
    until = time.monotonic() + lasts if lasts is not None else float("inf")
    try:
        while time.monotonic() < until:
            for entry in reader.entries():
                say(journal_line(entry, time_of_day))
            if not reacting.monitor.running:
                raise BedError(f"roslens react ended with {reacting.monitor.code}: {reacting.monitor.output()[-1000:]}")
            time.sleep(STEP)
    finally:
        reader.close()


def react(generation: str, clocks: bool, lasts: float | None) -> None:
    """Runs the robot that helps itself."""
    reacting = Reacting(generation, faked_clock=FAKED if clocks else "")
    with reacting:
        describe(reacting.robot, clocks, reacts=True)
        describe_reactions(reacting)
        reacting.wait("roslens react sees the robot", reacting.well, WELL_LIMIT)
        say("It is watched, and all that is done is told here:")
        follow(reacting, lasts)


def watch(robot: Robot, comes_back: float, lasts: float | None) -> None:
    """Starts nodes again some seconds after their end, until the time is over."""
    ended: dict[str, float] = {}
    until = time.monotonic() + lasts if lasts is not None else float("inf")
    while time.monotonic() < until:
        for name, process in robot.processes.items():
            if process.running:
                continue
            if name not in ended:
                say(f"{name} ended with {process.code}; it comes back in {comes_back:g} s")
                ended[name] = time.monotonic()
            elif time.monotonic() - ended[name] >= comes_back:
                process.start_again()
                say(f"{name} is back as {process.pid}")
                del ended[name]
        time.sleep(STEP)


def main() -> int:
    """Returns 0 after the time asked for or Ctrl-C, 2 where the bed cannot be made."""
    parser = argparse.ArgumentParser(prog="make testbed ARGS=...", description="A robot on three hosts on one machine.")
    parser.add_argument("--generation", choices=["ros1", "ros2"], help="ros2 where it is there, else ros1")
    parser.add_argument("--link", choices=["shaped", "bulk"], default="shaped", help="what joins the hosts")
    parser.add_argument("--clocks", action="store_true", help="run nodes under faketime, for clock offsets")
    parser.add_argument("--comes-back", type=float, default=10, metavar="S", help="start ended nodes again after this")
    parser.add_argument("--for", type=float, metavar="S", dest="lasts", help="end by itself after this")
    parser.add_argument(
        "--reactions", action=argparse.BooleanOptionalAction, default=True, help="let it help itself (default)"
    )
    chosen = parser.parse_args()
    reacts = chosen.reactions and chosen.link == "shaped"
    try:
        if reacts:
            react(generation_of(chosen.generation), chosen.clocks, chosen.lasts)
            return 0
        with Bed(HOSTS, chosen.link) as bed, make_robot(chosen.generation, bed, chosen.clocks) as robot:
            describe(robot, chosen.clocks, reacts=False)
            say(f"All topics are heard on brain after {robot.listen('brain', 0.1).waited:.1f} s.")
            watch(robot, chosen.comes_back, chosen.lasts)
    except BedError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    except KeyboardInterrupt:
        say("ending")
    return 0


if __name__ == "__main__":
    sys.exit(main())
