"""What rcl refuses of files of parameters: by parse.c, and by rcl itself in files made up by chance."""

import random
import subprocess
from pathlib import Path

import pytest

from roslens.source.extract.parameters.rcl_refusal import MOST_BYTES, refusal

WHEELS = Path(__file__).parents[4] / "build" / "ros2"

TAKEN = {
    "any node": "/**:\n  ros__parameters:\n    a: 1\n",
    "patterns": "/front/**:\n  ros__parameters:\n    a: 1\n/*:\n  left:\n    ros__parameters: {b: 2}\n",
    "lists": "n:\n  ros__parameters:\n    a: [1, 2]\n    b: [1.0, .5]\n    c: [a, 'b']\n    d: []\n",
    "null is a text": "n:\n  ros__parameters:\n    a: ~\n    b: null\n    c: [null, x]\n",
    "no parameters": "n:\n  ros__parameters: {}\n",
    "twice": "n:\n  ros__parameters:\n    a: 1\n  ros__parameters:\n    b: 2\n",
    "a tag": "n:\n  ros__parameters:\n    a: [!!str 1, b]\n",
    "what is put there": "n:\n  ros__parameters:\n    a: [$(var x), 1]\n",
    "a name that is put there": "<robot_namespace>/n:\n  ros__parameters:\n    a: 1\n",
    "empty": "",
    "a comment": "# nothing\n",
    "two documents": "n:\n  ros__parameters:\n    a: 1\n---\nm:\n  ros__parameters:\n    a: 1\n",
}
REFUSED = {
    "outside": ("n:\n  a: 1\n", 2, "'a' has the value '1' outside of ros__parameters"),
    "no node": ("ros__parameters:\n  a: 1\n", 1, "no name of a node before ros__parameters"),
    "whole and real": ("n:\n  ros__parameters:\n    a: [1, 0.5]\n", 3, "'0.5' is a floating-point number in a list"),
    "text and whole": ("n:\n  ros__parameters:\n    a: ['1', 1]\n", 3, "'1' is an integer in a list that begins with"),
    "list of lists": ("n:\n  ros__parameters:\n    a: [[1], [2]]\n", 3, "a list in a list"),
    "nothing": ("n:\n  ros__parameters:\n    a:\n", 3, "nothing behind 'a'"),
    "all commented out": ("n:\n  ros__parameters:\n    # a: 1\n", 2, "nothing behind 'ros__parameters'"),
    "alias": ("n:\n  ros__parameters:\n    a: &x 1\n    b: *x\n", 4, "the alias '*x'"),
    "name": ("my-node:\n  ros__parameters:\n    a: 1\n", 2, "'my-node' in 'my-node' is no name of a node"),
    "digit": ("ns/2nd:\n  ros__parameters:\n    a: 1\n", 2, "'2nd' in 'ns/2nd' is no name of a node"),
    "empty table": ("n:\n  ros__parameters:\n    a: {}\n    b: 1\n", 4, "'b' has the value '1' outside"),
    "tab": ("n:\n  ros__parameters:\n\ta: 1\n", 3, "a tab in the indentation"),
    "colon": ("n:\n  ros__parameters:\n    a: b: c\n", 3, "no YAML at 'a: b: c'"),
    "list": ("- n:\n    ros__parameters:\n      a: 1\n", 1, "a list as a key"),
}


@pytest.mark.parametrize("text", TAKEN.values(), ids=TAKEN)
def test_what_rcl_takes(text):
    assert refusal(text.encode()) is None


@pytest.mark.parametrize(("text", "line", "what"), REFUSED.values(), ids=REFUSED)
def test_what_rcl_refuses(text, line, what):
    found = refusal(text.encode())
    assert found.line == line
    assert found.what.startswith(what)
    assert found.expected


def test_an_encoding_other_than_utf_8_is_told_with_its_place():
    found = refusal("n:\n  ros__parameters:\n    a: café\n".encode("latin-1"))
    assert (found.line, found.column, found.what) == (3, 11, "the byte 0xe9, which is not UTF-8")
    assert refusal("n:\n  ros__parameters:\n    a: café\n".encode("utf-16")) is None


def test_what_pyyaml_takes_is_marked():
    assert refusal(b"n:\n  ros__parameters:\n    a:\n").taken_elsewhere
    assert not refusal(b"n:\n  ros__parameters:\n    a: [1, 0.5]\n").taken_elsewhere


def test_deep_and_large_files_are_followed_within_bounds():
    assert refusal(b"[" * 2000) is not None
    assert refusal(b"{k: " * 2000 + b"1" + b"}" * 2000) is None
    long = b"n:\n  ros__parameters:\n" + b"".join(b"    k%d: 1\n" % one for one in range(100_000))
    assert refusal(long) is None
    assert refusal(b"- " * MOST_BYTES) is None


VALUES = (
    "1", "1.0", "true", "abc", "'x'", "''", "", "~", "[1, 2]", "[1, 2.0]", "[]", "{}", "{a: 1}", "[[1]]", "[[1],[2]]",
    "[{a: 1}]", "[{a: 1, b: 2}]", "*x", "&x 3", "!!str 1", "[a, 1]", "0x1F", "08", "1e3", "off", "{a: {b: 1}}",
    "[yes, no]", '"1"', "- 1", "!foo 1",
)  # fmt: skip
KEYS = ("node", "/**", "/ns/node", "ros__parameters", "p", "a.b", "my-node", "*", "/*", "2x", "/**/n", "''")


def lines(chance, depth, indent):
    for _ in range(chance.randint(1, 3)):
        key = chance.choice(("ros__parameters",) * 9 + KEYS if depth == 2 else KEYS)
        if depth < 2 or (depth < 5 and chance.random() < 0.6):
            yield f"{' ' * indent}{key}:"
            yield from lines(chance, depth + 1, indent + chance.choice((2, 2, 4)))
        else:
            yield f"{' ' * indent}{key}: {chance.choice(VALUES)}"


SERVER = """
import ctypes, sys
utils = ctypes.CDLL(sys.argv[1] + "/librcutils.so", mode=ctypes.RTLD_GLOBAL)
library = ctypes.CDLL(sys.argv[1] + "/librcl_yaml_param_parser.so")
class Allocator(ctypes.Structure):
    _fields_ = [(name, ctypes.c_void_p) for name in ("allocate", "deallocate", "reallocate", "zero_allocate", "state")]
utils.rcutils_get_default_allocator.restype = Allocator
library.rcl_yaml_node_struct_init.argtypes = [Allocator]
library.rcl_yaml_node_struct_init.restype = ctypes.c_void_p
library.rcl_parse_yaml_file.argtypes = [ctypes.c_char_p, ctypes.c_void_p]
library.rcl_parse_yaml_file.restype = ctypes.c_bool
library.rcl_yaml_node_struct_fini.argtypes = [ctypes.c_void_p]
for line in sys.stdin:
    parameters = library.rcl_yaml_node_struct_init(utils.rcutils_get_default_allocator())
    taken = library.rcl_parse_yaml_file(line.rstrip().encode(), parameters)
    utils.rcutils_reset_error()
    if taken:
        library.rcl_yaml_node_struct_fini(parameters)
    print(int(taken), flush=True)
"""


class Rcl:
    """``rcl_parse_yaml_file`` in the Python that has the wheels of ROS 2."""

    def __init__(self, path):
        self.path = path
        command = [str(WHEELS / "bin" / "python"), "-c", SERVER, str(WHEELS / "lib")]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def takes(self, text):
        self.path.write_text(text, "utf-8")
        self.process.stdin.write(f"{self.path}\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().strip() == "1"


@pytest.fixture
def rcl(tmp_path):
    found = Rcl(tmp_path / "made_up.yaml")
    yield found
    found.process.stdin.close()
    found.process.wait(10)
    found.process.stdout.close()


@pytest.mark.real
@pytest.mark.skipif(not WHEELS.is_dir(), reason="rcl is not installed: make parts")
def test_files_made_up_by_chance_are_judged_as_rcl_judges_them(rcl):
    for name, text in TAKEN.items():
        # What is put into a file before rcl reads it is not there yet.
        assert rcl.takes(text) or "put there" in name, name
    for name, (text, _line, _what) in REFUSED.items():
        assert not rcl.takes(text), name
    texts = ["\n".join(lines(random.Random(seed), 1, 0)) + "\n" for seed in range(3000)]
    different = [text for text in texts if rcl.takes(text) is not (refusal(text.encode()) is None)]
    # Second tables of parameters of one node are followed no further than the first line.
    assert [one for one in different if one.count("ros__parameters") < 2] == []
    assert len(different) <= 6
