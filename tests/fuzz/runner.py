"""Cases one after the other in a process of their own, which may crash; what fails is kept as a file."""

from __future__ import annotations

import faulthandler
import hashlib
import mmap
import os
import random
import resource
import signal
import time
import traceback
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from pace import slowness

from fuzz.kinds import FIXTURES, KINDS, Kind, words_of
from fuzz.mutator import MOST_BYTES, mutated

KEPT = FIXTURES / "fuzz"
LONGEST_S = 5.0
"""Processor time for a case on a calm machine."""
MOST_MEMORY = 4_000_000_000
_LENGTH = 4


class Failed(NamedTuple):
    """A case that was not answered as it should be."""

    content: bytes
    why: str


class TooSlowError(Exception):
    """A case took longer than it may."""


def why_it_fails(kind: Kind, content: bytes, longest_s: float) -> str:
    """Return the last lines of what went wrong with a case; empty where it was answered."""

    def too_slow(_number: int, _frame: object) -> None:
        raise TooSlowError(f"more than {longest_s:.0f} s of a processor for {len(content):,} bytes")

    before = signal.signal(signal.SIGVTALRM, too_slow)
    signal.setitimer(signal.ITIMER_VIRTUAL, longest_s)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            kind.read(content)
    except Exception:  # noqa: BLE001 - whatever it is, it was not to be
        return "".join(traceback.format_exc(limit=-6))
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)
    return ""


def kept(name: str) -> list[Path]:
    """Return the cases of a kind that failed once."""
    return sorted(path for path in (KEPT / name).glob("*") if path.is_file())


def cases(name: str, seed: int, many: int | None, seconds: float) -> Iterator[bytes]:
    """Yield so many cases, or as many as fit into so many seconds."""
    kind, chance = KINDS[name], random.Random(f"{seed} {name}")
    seeds, words = [*kind.seeds(), *(path.read_bytes() for path in kept(name))], words_of(kind)
    end = time.monotonic() + seconds
    done = 0
    while (many is None or done < many) and time.monotonic() < end:
        yield mutated(chance, seeds, words)
        done += 1


def run(name: str, seed: int, many: int | None, seconds: float = 1e9) -> tuple[int, list[Failed]]:
    """Try cases in a process of their own; return how many, and those that failed, one for each way to fail.

    A case that ends the process is one that failed; others follow with another seed.
    """
    with mmap.mmap(-1, MOST_BYTES + 64) as shared:
        done, failed, end = 0, [], time.monotonic() + seconds
        while (many is None or done < many) and time.monotonic() < end:
            pid = os.fork()
            if pid == 0:
                _child(name, seed, None if many is None else many - done, end - time.monotonic(), shared)
            _, status = os.waitpid(pid, 0)
            tried, size = (int.from_bytes(shared[at : at + 8], "little") for at in (0, 8))
            content, seed, done = bytes(shared[16 : 16 + size]), seed + 1_000_003, done + tried
            if os.WIFSIGNALED(status):
                failed.append(Failed(content, f"the process was ended by {signal.Signals(os.WTERMSIG(status)).name}"))
            elif os.WEXITSTATUS(status):
                failed.append(
                    Failed(content, why_it_fails(KINDS[name], content, LONGEST_S * slowness()) or "not again")
                )
            else:
                break
            if len(failed) >= 20:
                break
    return done, failed


def _child(name: str, seed: int, many: int | None, seconds: float, shared: mmap.mmap) -> None:
    code = 2
    faulthandler.disable()
    try:
        resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        kind, longest_s = KINDS[name], LONGEST_S * slowness()
        code = 0
        for number, content in enumerate(cases(name, seed, many, seconds)):
            shared[0:16] = (number + 1).to_bytes(8, "little") + len(content).to_bytes(8, "little")
            shared[16 : 16 + len(content)] = content
            if why_it_fails(kind, content, longest_s):
                code = 1
                break
    finally:
        os._exit(code)


def shrunk(content: bytes, fails: Callable[[bytes], bool], seconds: float = 60.0) -> bytes:
    """Return a shorter case that fails too, without pieces that do not matter."""
    end, size = time.monotonic() + seconds, max(len(content) // 2, 1)
    while size and time.monotonic() < end:
        at = 0
        while at < len(content) and time.monotonic() < end:
            shorter = content[:at] + content[at + size :]
            if fails(shorter):
                content = shorter
            else:
                at += size
        size //= 2
    return content


def keep(name: str, content: bytes) -> Path:
    """Write a case where every later run tries it."""
    path = KEPT / name / hashlib.sha256(content).hexdigest()[:12]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    return path
