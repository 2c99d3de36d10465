"""What variables of CMake are made of is looked at as far as it stays small."""

import time

MANIFEST = (
    "<package format='3'><name>base</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@example.org'>a</maintainer><license>MIT</license>"
    "<export><build_type>ament_cmake</build_type></export></package>"
)
DOUBLED = "set(a b)\n" + 'set(a "${a}${a}")\n' * 10_000


def test_texts_that_double_again_and_again_end_and_what_is_behind_them_is_read(tmp_path, package_view):
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "CMakeLists.txt").write_text(DOUBLED + "add_executable(drive drive.cpp)\n")
    begun = time.process_time()
    view = package_view(tmp_path).cmake
    took = time.process_time() - begun
    assert view.commands[-1].words == ("drive", "drive.cpp")
    assert took < 5, f"{took:.1f} s; each of 10,000 commands made 400 texts"


def test_a_variable_is_put_where_it_is_named(tmp_path, package_view):
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "CMakeLists.txt").write_text("set(name drive)\nadd_executable(${name} src/${name}.cpp)\n")
    assert package_view(tmp_path).cmake.commands[-1].words == ("drive", "src/drive.cpp")
