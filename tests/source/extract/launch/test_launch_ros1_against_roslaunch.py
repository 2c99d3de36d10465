"""Launch files that a machine writes, read here and by roslaunch itself: nodes, parameters, remappings, words."""

import json
import os
import shlex
import shutil
import subprocess

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.launch.launch_ros1 import evaluate_ros1

pytestmark = [
    pytest.mark.real,
    pytest.mark.skipif(not shutil.which("roslaunch"), reason="roslaunch is not installed: apt-get install ros-base"),
]
SERVER = """
import json, sys
from roslaunch.config import ROSLaunchConfig
from roslaunch.xmlloader import XmlLoader
print("ready", flush=True)
for line in sys.stdin:
    path, words = json.loads(line)
    found = ROSLaunchConfig()
    try:
        XmlLoader(resolve_anon=False).load(path, found, argv=words, verbose=False)
        nodes = [
            [one.package, one.type, one.namespace, one.name, one.args, [list(pair) for pair in one.remap_args]]
            for one in found.nodes + found.tests
        ]
        answer = [nodes, {name: one.value for name, one in found.params.items()}, ""]
    except Exception as error:
        answer = [[], {}, str(error) or repr(error)]
    print(json.dumps(answer, default=str), flush=True)
"""
FEW, MANY = 25, 300
NAMES = st.sampled_from(["a", "b", "c/d", "$(arg x)", "$(arg who)_end"])
NAMESPACES = st.sampled_from(["n", "/m", "n/o", "n/", "$(arg x)", "/$(arg who)", "$(eval arg('x') + '_e')"])
TRUTHS = st.sampled_from(
    ["true", "false", "1", "0", "True", "$(arg flag)", "$(eval arg('number') == 3)", "$(eval not arg('flag'))",
     "$(eval x == 'left' and number > 2)"]
)  # fmt: skip
VALUES = st.sampled_from(
    ["1", "-2", "1.5", "1e5", "1.e5", ".5", "0x10", "1_000", "017", "true", "False", "yes", "off", " padded ", "nan",
     "inf", ".inf", "text", "two words", "$(arg x)", "$(arg number)", "$(arg who)/$(arg x)", "$(eval number * 2)",
     "$(eval arg('number') / 2.0)", "$(eval 'a' + x)", "$(find robot)/x.yaml",
     "[1, 2]", "{k: 1}", "$(eval ','.join([x, who]))", "$(eval 1 if flag else 0)", "+3", "1,5"]
)  # fmt: skip
TYPES = st.sampled_from([None, "auto", "str", "string", "yaml"])
TABLES = st.sampled_from(
    ["k: 1", "k: {l: 2, m: [1, 2.5]}", "k: 1e5", "k: 1.0e5", "k: 1.0e+5", "k: yes", "k: 'yes'", "k: deg(90)",
     "k: rad(2*pi)", "k: 0x1F", "k: 0o17", "k: 017", "k: 1_000", "k: 12:30:45", "k: null", "k: ~", "k: ''", "k: .inf",
     "k: nan", "/abs: 3", "/abs: {k: 1}", "k: [a, 1]", "k: {}", "k: []", "k: On", "k: y", "a: 7", "k: '1'", "k: .5",
     "k: &t {u: 1}\nl: *t", "k: &t {u: 1}\nl: {<<: *t, v: 2}", "a: {k: 1}\na: {l: 2}", "k: |\n  two\n  lines", ""]
)  # fmt: skip
WORDS = st.sampled_from(
    ["--fast 1", "'two words' x", "$(arg words)", "$(arg x):=$(arg who)", "_rate:=5 --y", "--at=$(arg number)",
     '"$(arg words)"', "  spaced   out  ", "$(eval 'a b')", "a\\ b", ""]
)  # fmt: skip
GLOBALS = st.sampled_from(["scan", "/scan", "~own", "odom", "odom/", "a//b", "$(arg x)/scan"])


def attributes(**given):
    return "".join(
        f' {name.strip("_").replace("_", "-" if name == "test_name" else "_")}="{value.replace(chr(34), "&quot;")}"'
        for name, value in given.items()
        if value is not None
    )


@st.composite
def conditions(draw):
    kind = draw(st.sampled_from(["", "", "", "if", "unless"]))
    return f' {kind}="{draw(TRUTHS)}"' if kind else ""


@st.composite
def params(draw, *, inside=False):
    name = draw(NAMES)
    if draw(st.booleans()) and not inside:
        name = "~" + name
    shape = draw(st.sampled_from(["value", "value", "value", "textfile"]))
    given = {"value": draw(VALUES)} if shape == "value" else {"textfile": "$(find robot)/config/number.txt"}
    return f"<param{attributes(name=name, type=draw(TYPES), **given)}{draw(conditions())}/>"


@st.composite
def rosparams(draw):
    command = draw(st.sampled_from([None, None, None, "load", "delete"]))
    where = {
        "ns": draw(st.sampled_from([None, None, "space", "/top"])),
        "param": draw(st.sampled_from([None, "inner", "inner/most", "/other"])),
    }
    if command == "delete":
        return f"<rosparam{attributes(command=command, **where)}{draw(conditions())}/>"
    if draw(st.booleans()):
        given = attributes(command=command, file="$(find robot)/config/gains.yaml", **where)
        return f"<rosparam{given}{draw(conditions())}/>"
    subst = draw(st.sampled_from([None, "true", "True", "false"]))
    text = draw(TABLES) if subst != "true" else "k: $(arg number)\nl: $(arg x)"
    if where["param"] is not None and draw(st.booleans()):
        text = draw(st.sampled_from(["5", "[1, 2]", "word", "{k: 1}"]))
    return f"<rosparam{attributes(command=command, subst_value=subst, **where)}{draw(conditions())}>{text}</rosparam>"


@st.composite
def remaps(draw):
    return f'<remap from="{draw(GLOBALS)}" to="{draw(GLOBALS)}"{draw(conditions())}/>'


@st.composite
def nodes(draw):
    inside = "".join(draw(st.lists(st.one_of(params(inside=True), rosparams(), remaps()), max_size=4)))
    tag, more = draw(st.sampled_from([("node", {}), ("node", {}), ("test", {"test_name": "t#"})]))
    given = attributes(
        pkg="robot", type="program", name="node@", ns=draw(st.one_of(st.none(), NAMESPACES)),
        args=draw(st.one_of(st.none(), WORDS)), machine=draw(st.sampled_from([None, None, "other"])),
        clear_params=draw(st.sampled_from([None, "true"])), **more,
    )  # fmt: skip
    return f"<{tag}{given}{draw(conditions())}>{inside}</{tag}>"


@st.composite
def includes(draw):
    inside = draw(
        st.sampled_from(["", '<arg name="given" value="$(arg x)"/>', '<arg name="given" default="d"/>',
                         '<arg name="given" value="1" if="$(arg flag)"/>', "<env name='A' value='b'/>"])
    )  # fmt: skip
    everything = draw(st.sampled_from([None, None, "true", "True", "$(arg flag)"]))
    given = attributes(file="$(dirname)/included.launch", ns=draw(st.one_of(st.none(), NAMESPACES)),
                       pass_all_args=everything)  # fmt: skip
    return f"<include{given}{draw(conditions())}>{inside}</include>"


OTHERS = st.sampled_from(
    ['<env name="E" value="$(arg x)"/>', '<machine name="other" address="localhost" env-loader="/bin/true"/>',
     '<arg name="late@" default="$(arg x)"/><param name="late" value="$(arg late#)"/>',
     '<arg name="number" value="4"/>',
     '<arg name="fixed@" value="$(arg who)"/><param name="f#" value="$(arg fixed#)"/>',
     '<group><arg name="late" value="1"/></group>',
     '<group><arg name="in" value="1"/><param name="i" value="$(arg in)"/></group>',
     "<!-- said -->"]
)  # fmt: skip


def groups(inner):
    given = st.one_of(st.just(""), NAMESPACES.map(lambda ns: f' ns="{ns}"'))
    inside = st.lists(inner, max_size=4).map("".join)
    return st.builds(lambda ns, when, text: f"<group{ns}{when}>{text}</group>", given, conditions(), inside)


ELEMENTS = st.recursive(st.one_of(nodes(), nodes(), params(), rosparams(), remaps(), OTHERS, includes()), groups)
HEAD = (
    '<arg name="x" default="left"/><arg name="who" default="r2"/><arg name="number" default="3"/>'
    '<arg name="flag" default="true"/><arg name="words" default="one two:=three" doc="several"/>'
)
INNER = st.lists(st.one_of(nodes(), params(), rosparams(), remaps()), max_size=3).map("".join)
INNER_HEAD = st.sampled_from(
    [HEAD + '<arg name="given" default="g"/>', '<arg name="x" value="inner"/>' + HEAD.partition("/>")[2],
     HEAD + '<arg name="given"/><param name="given" value="$(arg given)"/>']
)  # fmt: skip
GIVEN = st.fixed_dictionaries(
    {}, optional={"x": st.sampled_from(["right", "back"]), "number": st.sampled_from(["1", "2.5"]),
                  "flag": st.sampled_from(["0", "true", "False"])},
)  # fmt: skip


def numbered(text):
    """Return a text with a number of its own for each ``@``; ``#`` stands for the last of them."""
    numbers, pieces = -1, []
    for sign in text:
        numbers += sign == "@"
        pieces.append(str(numbers) if sign in "@#" else sign)
    return "".join(pieces)


@pytest.fixture(scope="module")
def robot(tmp_path_factory):
    """A workspace with one package, and roslaunch waiting for files of it."""
    root = tmp_path_factory.mktemp("workspace")
    for name in ("launch", "config"):
        (root / "robot" / name).mkdir(parents=True)
    (root / "robot/package.xml").write_text("<package><name>robot</name></package>")
    (root / "robot/config/gains.yaml").write_text("gains: {p: 1, i: 0.5}\na: {k: 1e3}\nlist: [1, 2]\n")
    (root / "robot/config/number.txt").write_text("17")
    environment = {**os.environ, "ROS_PACKAGE_PATH": str(root), "PYTHONPATH": "", "ROS_LOG_DIR": str(root / "log")}
    environment.pop("ROS_NAMESPACE", None)
    with subprocess.Popen(
        ["/usr/bin/python3", "-c", SERVER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment,
        stderr=subprocess.DEVNULL,
    ) as server:  # fmt: skip
        assert server.stdout.readline() == "ready\n"
        yield root, server
        server.stdin.close()


def told(server, path, arguments):
    words = ["roslaunch", *(f"{name}:={value}" for name, value in arguments.items())]
    server.stdin.write(json.dumps([str(path), words]) + "\n")
    server.stdin.flush()
    while not (line := server.stdout.readline()).startswith("[["):
        assert line
    return json.loads(line)


KINDS = {bool: "bool", int: "int", float: "double", str: "string"}


def typed(value):
    return [KINDS[type(value)], value] if type(value) in KINDS else ["", value]


def value_of(setting):
    text = str(setting.value)
    if setting.type == "string":
        return ["string", text]
    if setting.type == "double":
        return ["double", float(text.replace("_", "").lower().replace(".inf", "inf").replace(".nan", "nan"))]
    value = yaml.safe_load(text)
    return [setting.type if setting.type in KINDS.values() else "", value]


def found_here(whole):
    nodes = [
        [str(one.package), str(one.executable), str(one.namespace).rstrip("/") + "/", str(one.name),
         [str(word) for word in one.arguments], [[str(pair.source), str(pair.target)] for pair in one.remaps]]
        for one in whole.nodes
    ]  # fmt: skip
    parameters = {str(one.name): value_of(one) for one in whole.settings}
    for node in whole.nodes:
        before = f"{str(node.namespace).rstrip('/')}/{node.name}/"
        parameters |= {str(one.name).replace("~", before): value_of(one) for one in node.settings}
    return sorted(nodes, key=by_name), parameters


def flat(prefix, values):
    """Yield parameters by name; what is within a table is one of its own, and an empty one is none."""
    for name, value in values.items():
        if isinstance(value, dict) and value:
            yield from flat(f"{prefix}{name}/", value)
        else:
            yield f"{prefix}{name}", value


@pytest.mark.parametrize("files", [FEW, pytest.param(MANY, marks=pytest.mark.nightly)])
def test_roslaunch_says_the_same_of_any_file(robot, files):
    @settings(max_examples=files, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
    @given(st.lists(ELEMENTS, min_size=1, max_size=6).map("".join), INNER_HEAD, INNER, GIVEN)
    def any_file(written, inner_head, inner, arguments):
        said_the_same(robot, written, inner_head, inner, arguments)

    any_file()


def said_the_same(robot, written, inner_head, inner, arguments):
    root, server = robot
    main = numbered(f"<launch>{HEAD}{written}</launch>")
    (root / "robot/launch/main.launch").write_text(main)
    # Nodes of both files have names of their own.
    within = numbered(inner).replace('name="node', 'name="inner')
    (root / "robot/launch/included.launch").write_text(f"<launch>{inner_head}{within}</launch>")
    nodes, parameters, refused = told(server, root / "robot/launch/main.launch", arguments)
    whole = evaluate_ros1("robot/launch/main.launch", FolderFiles(root, {"robot": "robot"}), arguments)
    if refused:
        # Two nodes of one name are a finding of the graph, not of its file.
        assert whole.unresolved or "multiple nodes named" in refused, (refused, main)
        return
    assert whole.unresolved == (), main
    here, set_here = found_here(whole)
    assert here == sorted(([*one[:4], shlex.split(below(root, one[4])), one[5]] for one in nodes), key=by_name), main
    there = {name: typed(below(root, value)) for name, value in flat("", parameters)}
    assert {name: comparable(one) for name, one in set_here.items()} == {
        name: comparable(one) for name, one in there.items()
    }, main


def below(root, value):
    return value.replace(f"{root}/", "") if isinstance(value, str) else value


def by_name(node):
    return node[3]


def comparable(one):
    kind, value = one
    return [kind, "not a number" if value != value else value]
