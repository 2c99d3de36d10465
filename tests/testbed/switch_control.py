"""Changes the settings of a running switch, from Python or from a shell.

python -m testbed.switch_control SOCKET                              shows settings, counters and CPU time
python -m testbed.switch_control SOCKET sensor delay_ms=20 loss_percent=5
"""

import json
import socket
import sys
from pathlib import Path
from typing import Any

ANSWER_SIZE = 65536
LIMIT = 30.0


class SwitchControl:
    """Talks to the switch whose control socket is at `path`."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def state(self) -> dict[str, Any]:
        """Settings and counters of each host, frames delivered, and the CPU seconds the switch has used."""
        return self._ask({})

    def change(self, host: str, **settings: float) -> dict[str, Any]:
        """Changes what happens to the frames that `host` sends; `switch.Egress` says which settings there are.

        Raises:
            ValueError: The switch knows no such host or setting, or the value is not a number of zero or more.
        """
        return self._ask({"host": host, **settings})

    def _ask(self, request: dict[str, Any]) -> dict[str, Any]:
        with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as talk:
            talk.settimeout(LIMIT)
            talk.connect(str(self.path))
            talk.send(json.dumps(request).encode())
            answer: dict[str, Any] = json.loads(talk.recv(ANSWER_SIZE))
        if "error" in answer:
            raise ValueError(answer["error"])
        return answer


def main(arguments: list[str]) -> int:
    """Carries out one change and prints the state; returns the exit code."""
    try:
        path, *rest = arguments
        control = SwitchControl(Path(path))
        if rest:
            changes = dict(word.split("=", 1) for word in rest[1:])
            control.change(rest[0], **{key: float(value) for key, value in changes.items()})
        sys.stdout.write(json.dumps(control.state(), indent=2) + "\n")
    except (ValueError, OSError) as error:
        sys.stderr.write(f"{error}; expected: SOCKET [HOST SETTING=NUMBER...]\n")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
