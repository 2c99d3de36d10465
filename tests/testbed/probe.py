"""Measures a link between two hosts: round trips and loss by UDP, throughput by TCP. Standard library only.

python probe.py echo                                 answers datagrams and swallows streams, until it is ended
python probe.py ask ADDRESS COUNT INTERVAL_S         round trips; writes {"sent", "answered", "rtt_ms": [...]}
python probe.py pour ADDRESS MEGABYTES               a stream; writes {"bytes", "seconds"}
python probe.py clock                                writes the wall clock, seconds since 1970
"""

import json
import select
import socket
import struct
import sys
import threading
import time

PORT = 7007
SO_RCVBUFFORCE = 33  # <asm-generic/socket.h>; the usual option stops at the machine's limit of 208 kB
SETTLING = 3.0  # seconds without an answer after which nothing more is expected
WAITING = 4 << 20  # bytes of datagrams that wait for a program that gets no processor for a while
CHUNK = bytes(1 << 16)


def echo() -> None:
    """Answers every datagram with its content; reads streams to their end and answers how many bytes they had."""
    streams = socket.create_server(("", PORT))
    threading.Thread(target=_swallow, args=(streams,), daemon=True).start()
    with _datagrams() as answers:
        answers.bind(("", PORT))
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        while True:
            answers.sendto(*answers.recvfrom(65536))


def _datagrams() -> socket.socket:
    """A socket that loses nothing by itself: what is missing was lost on the way."""
    one = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    one.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, WAITING)
    return one


def _swallow(streams: socket.socket) -> None:
    while True:
        stream, _ = streams.accept()
        with stream:
            size = 0
            while chunk := stream.recv(1 << 20):
                size += len(chunk)
            stream.sendall(struct.pack("!Q", size))


def ask(address: str, count: int, interval: float) -> dict[str, object]:
    """Sends `count` small datagrams, one each `interval` seconds, and collects the answers."""
    trips: dict[int, float] = {}
    with _datagrams() as talk:
        talk.connect((address, PORT))
        began = time.monotonic()
        sent, heard = 0, began
        while len(trips) < count:
            now = time.monotonic()
            if sent < count and now >= began + sent * interval:
                talk.send(struct.pack("!Id", sent, now))
                sent, heard = sent + 1, now
            soon = began + sent * interval - now if sent < count else SETTLING
            if select.select([talk], [], [], max(0.0, soon))[0]:
                number, then = struct.unpack("!Id", talk.recv(64))
                heard = time.monotonic()
                trips[number] = (heard - then) * 1000
            elif sent == count and time.monotonic() - heard >= SETTLING:
                break
    return {"sent": sent, "answered": len(trips), "rtt_ms": [round(trips[n], 3) for n in sorted(trips)]}


def pour(address: str, megabytes: int) -> dict[str, object]:
    """Sends `megabytes` million bytes as one stream; the time ends when the receiver has confirmed them."""
    left = size = megabytes * 1_000_000
    began = time.monotonic()
    with socket.create_connection((address, PORT)) as stream:
        while left:
            left -= stream.send(CHUNK[:left])
        stream.shutdown(socket.SHUT_WR)
        (arrived,) = struct.unpack("!Q", stream.recv(8, socket.MSG_WAITALL))
    return {"bytes": arrived, "sent": size, "seconds": time.monotonic() - began}


def main(arguments: list[str]) -> None:
    """Runs what the first argument names."""
    verb, rest = arguments[0], arguments[1:]
    if verb == "echo":
        echo()
    elif verb == "ask":
        sys.stdout.write(json.dumps(ask(rest[0], int(rest[1]), float(rest[2]))))
    elif verb == "pour":
        sys.stdout.write(json.dumps(pour(rest[0], int(rest[1]))))
    else:
        sys.stdout.write(json.dumps(time.time()))


if __name__ == "__main__":
    main(sys.argv[1:])
