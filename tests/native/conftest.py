import os
import subprocess
from pathlib import Path

import pytest

from roslens.live.inside import slots

ROOT = Path(__file__).parents[2]
NATIVE = ROOT / "native"
STRICT = ["-Wall", "-Wextra", "-Werror"]
SANITIZED = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]


@pytest.fixture(scope="session")
def build():
    """hatch_build, which knows the compiler and its flags."""
    import importlib.util

    specification = importlib.util.spec_from_file_location("hatch_build", ROOT / "hatch_build.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    if not module.compiler():
        pytest.skip("no C compiler")
    return module


class Built:
    """The library, the fake middlewares, and the programs around them."""

    def __init__(self, build, folder):
        self.folder = folder
        self._compiler = build.compiler()
        self._flags = [*build.FLAGS, "-g", *STRICT]
        sources = [str(path) for path in sorted(NATIVE.glob("*.c"))]
        self.hook = self._shared("hook", *sources, "-ldl")
        for name, flags in (("", []), ("humble", ["-DHUMBLE"]), ("ancient", ["-DANCIENT"])):
            self._middleware(folder / name, flags)
        self.drive = self._program("drive", "-rdynamic", self._test("drive.c"), "-ldl")
        self.sanitized = self._program(
            "sanitized", "-rdynamic", *SANITIZED, self._test("drive.c"), *sources, "-ldl"
        )  # the library is part of the program, as the sanitizers want to be there first
        self.cost = self._program("cost", self._test("cost.c"), f"-L{folder}", "-lrmw_fake", "-Wl,-rpath,$ORIGIN")

    def _middleware(self, folder, flags):
        folder.mkdir(exist_ok=True)
        self._run("-shared", *flags, "-o", folder / "librmw_fake.so", self._test("fake_rmw.c"))
        self._run(
            "-shared", "-o", folder / "libscenario.so", self._test("scenario.c"), self._test("fake_type.c"),
            f"-L{folder}", "-lrmw_fake", "-Wl,-rpath,$ORIGIN",
        )  # fmt: skip

    def _test(self, name):
        return str(NATIVE / "tests" / name)

    def _shared(self, name, *arguments):
        return self._run("-shared", "-o", self.folder / f"lib{name}.so", *arguments)

    def _program(self, name, *arguments):
        return self._run("-o", self.folder / name, *arguments)

    def _run(self, *arguments):
        done = subprocess.run(
            [*self._compiler, *self._flags, *map(str, arguments)], capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return arguments[arguments.index("-o") + 1]


@pytest.fixture(scope="session")
def built(build, tmp_path_factory):
    return Built(build, tmp_path_factory.mktemp("built"))


class Node:
    """A program that does with the middleware what it is asked for, and whose counters can be read."""

    def __init__(self, built, counters, *, sanitized=False, release="", scope="local", environment=None):
        self.counters = counters
        program = built.sanitized if sanitized else built.drive
        preloaded = {} if sanitized else {"LD_PRELOAD": str(built.hook)}
        self.process = subprocess.Popen(
            [program, built.folder / release / "libscenario.so", scope],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, **preloaded, slots.VARIABLE: str(counters), **(environment or {})},
        )

    def say(self, *lines):
        """Give all lines; return the answers."""
        self.process.stdin.write("".join(f"{line}\n" for line in lines))
        self.process.stdin.flush()
        answers = [self.process.stdout.readline() for _ in lines]
        assert answers[-1], self.process.stderr.read()
        return [int(answer) for answer in answers]

    def claim(self, text):
        """Set what the hook in Python claims; "self" is the process of the node, an empty text takes the claim away."""
        process, _, directions = text.partition(" ")
        number = str(self.process.pid) if process == "self" else process
        self.say(f"environment ROSLENS_RCLPY_HOOK {number} {directions}")

    def file(self):
        """The bytes of the counter file."""
        (path,) = self.counters.glob(f"*{slots.SUFFIX}")
        return path.read_bytes()

    def slots(self):
        """The bytes of the slots in use."""
        raw = self.file()
        (used,) = slots.struct.unpack_from("=I", raw, slots.USED_AT)
        ends = [slots.HEADER_BYTES + number * slots.SLOT_BYTES for number in range(used + 1)]
        return [raw[start : start + slots.SLOT_BYTES] for start in ends[:-1]]

    def state(self):
        """What the library says of itself."""
        return slots.HEADER.unpack_from(self.file())[10].rstrip(b"\0").decode()

    def close(self):
        """End it; return what it said on standard error."""
        _, errors = self.process.communicate("exit\n", timeout=60)
        return errors


@pytest.fixture
def node(built, tmp_path):
    """Starts nodes, and sees that each ends well and quietly."""
    started = []

    def start(**options):
        started.append(Node(built, tmp_path / f"counters{len(started)}", **options))
        return started[-1]

    yield start
    for one in started:
        if one.process.poll() is None:
            assert one.close() == ""
            assert one.process.returncode == 0


@pytest.fixture(params=["preloaded", "sanitized"])
def either(request, node):
    """Starts nodes with the library preloaded; and with it built in, where sanitizers watch it."""
    return lambda **options: node(sanitized=request.param == "sanitized", **options)
