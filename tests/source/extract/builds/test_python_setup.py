"""setup.py, setup.cfg and pyproject.toml, read without running them."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.extract.builds.python_setup import read_pyproject, read_setup_config, read_setup_script

LISTING = ["pkg/launch/a.launch.py", "pkg/launch/b.launch.py", "pkg/config/c.yaml", "pkg/launch/deep/d.launch.py"]


def read(text):
    return read_setup_script(text.encode(), "pkg/setup.py", LISTING)


def programs(found):
    return [(one.name, one.entry) for one in found.programs]


@pytest.mark.parametrize(
    "text",
    [
        "setup(entry_points={'console_scripts': ['talk = pkg.talk:main']})",
        "import setuptools\nsetuptools.setup(entry_points={'console_scripts': 'talk=pkg.talk:main'})",
        "package_name = 'pkg'\nsetup(entry_points={'console_scripts': ['talk = ' + package_name + '.talk:main']})",
        "p = 'pkg'\nsetup(entry_points={'console_scripts': [f'talk = {p}.talk:main']})",
        "p = 'pkg'\nsetup(entry_points={'console_scripts': ['talk = {}.talk:main'.format(p)]})",
        "p = 'pkg'\nsetup(entry_points={'console_scripts': ['talk = %s.talk:main' % p]})",
        "setup(entry_points={'console_scripts': [f'{n} = pkg.{n}:main' for n in ['talk']]})",
        "nodes = ['talk = pkg.talk:main']\nsetup(entry_points={'console_scripts': nodes + []})",
        "points = {'console_scripts': ['talk = pkg.talk:main [extra]']}\nsetup(entry_points=points)",
        "a = dict(entry_points={'console_scripts': ['talk = pkg.talk:main']})\nsetup(**a)",
        "if True:\n    setup(entry_points={'console_scripts': ['talk = pkg.talk:main']})",
        "def go():\n    setup(entry_points={'console_scripts': ['talk = pkg.talk:main']})\ngo()",
        "setup(entry_points={'console_scripts': '''\n# none\ntalk = pkg.talk:main\n'''})",
    ],
)
def test_ways_to_write_programs(text):
    found = read(text)
    assert programs(found) == [("talk", "pkg.talk:main")]
    assert not found.unresolved


def test_what_is_unknown_costs_itself_alone():
    found = read("setup(entry_points={'console_scripts': [read(), 'a = p:m', x + '=p:n'], other(): []}, **more())")
    assert programs(found) == [("a", "p:m")]
    assert sorted(one.text for one in found.unresolved) == ["more()", "other()", "read()", "x + '=p:n'"]


def test_catkin():
    found = read(
        "from catkin_pkg.python_setup import generate_distutils_setup\n"
        "d = generate_distutils_setup(packages=['pkg'], package_dir={'': 'src'}, scripts=['scripts/go'])\nsetup(**d)"
    )
    assert [name for name, _ in found.scripts] == ["scripts/go"]
    assert found.folders == (("", "src"),)


def test_data():
    found = read(
        "import os\nfrom glob import glob\nname = 'pkg'\n"
        "setup(data_files=[('share/' + name, ['package.xml']),\n"
        "(os.path.join('share', name, 'launch'), glob('launch/*.py')),\n"
        "(os.path.join('share', name), glob(os.path.join('config', '*.yaml'))),\n"
        "('all', glob('launch/**/*.py')), 5])"
    )
    assert found.data == (
        ("share/pkg", ("package.xml",)),
        ("share/pkg/launch", ("launch/a.launch.py", "launch/b.launch.py")),
        ("share/pkg", ("config/c.yaml",)),
        ("all", ("launch/a.launch.py", "launch/b.launch.py", "launch/deep/d.launch.py")),
    )
    assert len(found.unresolved) == 1


@pytest.mark.parametrize("text", ["setup(", "\0", "setup(scripts=" + "[" * 300 + "]" * 300 + ")",
                                  "x = y\ny = x\nsetup(scripts=x)",
                                  "setup(scripts=" + "'a'+" * 2000 + "'a')",
                                  "a = a\nsetup(entry_points=a)"])  # fmt: skip
def test_what_is_hostile(text):
    assert read(text).unresolved


def test_long_texts_are_not_made():
    assert read("a = 'x' * 9999999\nsetup(scripts=[a])").unresolved


def test_configuration():
    found = read_setup_config(
        b"[develop]\nscript_dir=$base/lib/pkg\n[install]\ninstall-scripts = $base/lib/pkg\n[options]\n"
        b"scripts =\n  bin/go\n"
        b"[options.entry_points]\n# none\nconsole_scripts =\n    a = p.a:main\n    b = p.b:main\n"
        b"other =\n    c = p.c:main\n",
        "setup.cfg",
    )
    assert programs(found) == [("a", "p.a:main"), ("b", "p.b:main")]
    assert [one.evidence.line for one in found.programs] == [11, 12]
    assert found.script_folder == "$base/lib/pkg"
    assert [name for name, _ in found.scripts] == ["bin/go"]


def test_pyproject():
    text = b'[project]\nname = "p"\n[project.scripts]\ngo = "p.go:main"\n'
    text += b'[project.entry-points.console_scripts]\nmore = "p:more"\n'
    found = read_pyproject(text, "pyproject.toml")
    assert programs(found) == [("go", "p.go:main"), ("more", "p:more")]
    assert [one.evidence.line for one in found.programs] == [4, 6]
    assert read_pyproject(b"scripts = [", "pyproject.toml").unresolved
    assert programs(read_pyproject(b"project = 1\nscripts = 2", "pyproject.toml")) == []


@settings(max_examples=150, deadline=None)
@given(st.lists(st.sampled_from(["setup(", ")", "[", "]",
                                 "{", "}", "'a = b:c'", "entry_points=", "'console_scripts':", ",", "x", "=",
                                 "\n",
                                 "for x in ", "+", "**", "f'{x}'",
                                 "glob('*')", "data_files="]), max_size=25))  # fmt: skip
def test_any_pieces_are_read(pieces):
    read("x = 1\n" + "".join(pieces))


@given(st.binary(max_size=120))
def test_any_bytes_are_read(content):
    read_setup_script(content, "setup.py", [])
    read_setup_config(content, "setup.cfg")
    read_pyproject(content + b"\nscripts", "pyproject.toml")


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("generate_parameter_module('m', 'pkg/p.yaml')", (("m", "pkg/p.yaml"),)),
        (
            "generate_parameter_module(module_name='m', yaml_file='./pkg/p.yaml', validation_module='v')",
            (("m", "pkg/p.yaml"),),
        ),
        ("f = 'pkg/p.yaml'\nhelper.generate_parameter_module('m', f)", (("m", "pkg/p.yaml"),)),
        ("generate_parameter_module('m', unknown())", ()),
        ("generate_parameter_module('m')", ()),
    ],
)
def test_modules_that_declare_parameters(call, expected):
    assert read(f"{call}\nsetup()").parameters == expected
    assert read(call).parameters == expected
