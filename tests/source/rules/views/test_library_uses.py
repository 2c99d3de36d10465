import pytest

from roslens.source.rules.views.library_uses import libraries_of

MANIFEST = "<package format='3'><name>arm</name><depend>rclpy</depend></package>"


@pytest.fixture
def libraries(tmp_path, package_view):
    """Modules and keys of what a package of some files imports."""

    def look(files, package=""):
        for path, text in {f"{package}package.xml": MANIFEST, **files}.items():
            (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / path).write_text(text)
        return [one[:2] for one in libraries_of(package_view(tmp_path / package if package else tmp_path))]

    return look


def test_a_library_that_is_imported_is_found_by_its_key(libraries):
    assert libraries({"arm/port.py": "import rclpy\nimport serial\nfrom PIL import Image\n"}) == [
        ("serial", "python3-serial"),
        ("PIL", "python3-pil"),
    ]


@pytest.mark.parametrize(
    "files",
    [
        {"arm/port.py": "try:\n    import serial\nexcept ImportError:\n    serial = None\n"},
        {"arm/port.py": "import numpy\nimport yaml\nimport os\n"},
        {"arm/port.py": "import serial\n", "arm/serial.py": "A = 1\n"},
        {"arm/port.py": "import serial\n", "setup.py": "setup(install_requires=['pyserial'])\n"},
        {"arm/port.py": "import serial\n", "requirements.txt": "PySerial>=3\n"},
        {"test/test_port.py": "import serial\n"},
        {"arm/port.py": "# import serial\n"},
    ],
)
def test_what_may_be_missing_or_comes_another_way_is_not(libraries, files):
    assert not libraries(files)
