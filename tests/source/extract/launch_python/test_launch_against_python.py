"""Launch files of Python that are made up by chance, evaluated and executed: what is certain is so in every run."""

import pytest
from python_truth import launch_programs
from python_truth.node_comparison import may_be

from roslens.source.extract.launch.launch_ros2 import evaluate_ros2

PROGRAMS, FEW, RUNS = 400, 80, 14


class One:
    """A workspace of one file."""

    def __init__(self, program):
        self.program = program

    def package(self, name):
        return None

    def content(self, path):
        return self.program.encode() if path == "made_up.launch.py" else None


def wrong_in(program):
    """Return nodes that no fact tells of, and those that are told to start in any case but do not."""
    launch = evaluate_ros2("made_up.launch.py", One(program))
    runs = [launch_programs.run(program, seed) for seed in range(RUNS)]
    names = [one.name for one in launch.nodes]
    missed = {name for run in runs for name in run if not any(may_be(text, name) for text in names)}
    sure = {one.name.known for one in launch.nodes if not one.conditions and one.name.known is not None}
    return sorted(missed), sorted(name for name in sure if not all(name in run for run in runs))


@pytest.mark.heavy
@pytest.mark.parametrize("seeds", [range(FEW), pytest.param(range(FEW, PROGRAMS), marks=pytest.mark.nightly)], ids=str)
def test_made_up_launch_files(seeds):
    wrong = {seed: found for seed in seeds if any(found := wrong_in(launch_programs.program(seed)))}
    assert not wrong


NODE = 'nodes.append(Node(package="p", executable="e", name={}))'
BODIES = {
    "one of two names": ["if ask():", '    name = "second"', NODE.format("name")],
    "break": ["for one in names:", f"    {NODE.format('one')}", "    break"],
    "open break": ["for one in names:", "    if ask():", "        break", f"    {NODE.format('one')}"],
    "continue": ["for one in names:", "    if ask():", "        continue", f"    {NODE.format('one')}"],
    "else": ["for one in names:", "    if ask():", "        break", "else:", f"    {NODE.format('name')}"],
    "return within": ["if True:", "    if ask():", "        return LaunchDescription(nodes)", NODE.format("name")],
    "return otherwise": ["if ask():", "    pass", "else:", "    return LaunchDescription([])", NODE.format("name")],
    "format": [NODE.format('f"{len(names):03d}"')],
    "a list with two names": ["more = nodes", f"more += [{NODE[13:-1].format('name')}]"],
    "a deep copy": [
        "given = [{'n': 'a'}]",
        "for suffix in names:",
        "    copies = copy.deepcopy(given)",
        "    for one in copies:",
        "        one['n'] += suffix",
        f"        {NODE.format('one[' + repr('n') + ']')}",
    ],
    "a change of one of two lists": [
        "other = ['a']",
        "chosen = names if ask() else other",
        "chosen[0] = 'c'",
        "for one in (*names, *other):",
        f"    {NODE.format('one')}",
    ],
    "a change of items of one of two lists": [
        "more, other = [{'n': 'a'}], [{'n': 'b'}]",
        "for one in more if ask() else other:",
        "    one['n'] += '1'",
        "for one in more + other:",
        f"    {NODE.format('one[' + repr('n') + ']')}",
    ],
    "filled": ["nodes += [Node(package='p', executable='e', name=one) for one in names if ask()]"],
}


@pytest.mark.parametrize("name", BODIES)
def test_what_was_wrong_once(name):
    lines = [*BODIES[name], "return LaunchDescription(nodes)"]
    assert wrong_in(launch_programs.HEAD + "".join(f"    {line}\n" for line in lines)) == ([], [])
