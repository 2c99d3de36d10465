"""What setup.py comes to is found out only where it may install a program."""

import pytest

from roslens.source.rules.package.programs.console_script import found

MANIFEST = """<package format="2"><name>arm</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license></package>"""


@pytest.mark.parametrize(
    ("script", "asked"),
    [
        ("setup(**generate_distutils_setup(packages=['arm']))", False),
        ("setup(name='arm', scripts=['bin/arm'])", False),
        ("setup(name='arm', entry_points={'console_scripts': ['arm = arm.nowhere:main']})", True),
    ],
)
def test_a_script_without_programs_is_not_followed(tmp_path, package_view, script, asked):
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "setup.py").write_text(f"from setuptools import setup\n{script}\n")
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm" / "__init__.py").write_text("")
    view = package_view(tmp_path)
    assert len(list(found(view))) == asked
    assert ("setup" in vars(view)) == asked
