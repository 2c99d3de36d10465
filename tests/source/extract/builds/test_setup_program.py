"""What a setup.py gives to setup(), followed as a program."""

import pytest

from roslens.source.extract.builds.python_setup import read_setup_script
from roslens.source.extract.builds.setup_program import SetupProgram

LISTING = ["pkg/launch/a.launch.py", "pkg/pkg/talk.py"]


def read(text):
    return read_setup_script(text.encode(), "pkg/setup.py", LISTING)


def test_what_is_appended_and_what_functions_return():
    found = read(
        "from setuptools import setup\ndata = [('share/pkg', ['package.xml'])]\n"
        "data.append(('share/pkg/launch', ['launch/a.launch.py']))\n"
        "def entry(name):\n    return f'{name} = pkg.{name}:main'\n"
        "setup(data_files=data, entry_points={'console_scripts': [entry('talk'), *[entry(n) for n in ('listen',)]]})\n"
    )
    assert [folder for folder, _ in found.data] == ["share/pkg", "share/pkg/launch"]
    assert [one.entry for one in found.programs] == ["pkg.talk:main", "pkg.listen:main"]
    assert found.unresolved == ()


def test_a_program_stands_where_its_entry_is_written():
    (one,) = read(
        "x = 1\nsetup(entry_points={\n    'console_scripts': [\n        'talk = pkg.talk:main',\n    ]})\n"
    ).programs
    assert (one.evidence.line, one.evidence.column) == (4, 9)


def test_functions_of_the_script_keep_their_own_meaning():
    assert read("def setup(**given):\n    pass\nsetup(scripts=['go'])").scripts == ()


@pytest.mark.parametrize(
    "text", ["while True:\n    x = [x]\n", "setup(scripts=['a'] * 10 ** 9)", "import os\nos.abort()"]
)
def test_nothing_is_run_and_everything_ends(text):
    assert SetupProgram(text.encode(), "setup.py", []) is not None
