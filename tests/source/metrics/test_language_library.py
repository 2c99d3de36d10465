from __future__ import annotations

import builtins

import pytest

from roslens.source.metrics.class_model.language_library import in_cpp_library, in_python_library

LIBRARY_OF_CPP = """std::vector std::chrono::seconds string size_t uint8_t pthread_mutex_t T K1 FILE boost::shared_ptr
boost::container::array unique_ptr"""


@pytest.mark.parametrize("name", LIBRARY_OF_CPP.split())
def test_the_library_of_cpp_is_known(name):
    assert in_cpp_library(name)


@pytest.mark.parametrize(
    "name", ["ros::NodeHandle", "boost::asio::io_service", "stdx::vector", "QWidget", "TF", "my::string", "Vector3"]
)
def test_other_libraries_count(name):
    assert not in_cpp_library(name)


@pytest.mark.parametrize("name", ["int", "ValueError", "List", "typing.List", "object", "builtins.object"])
def test_the_library_of_python_is_known(name):
    assert in_python_library(name)


@pytest.mark.parametrize("name", ["rospy.Publisher", "Thread", "threading.Lock", "my.List"])
def test_other_modules_count(name):
    assert not in_python_library(name)


def test_no_built_in_exception_is_forgotten():
    exceptions = {name for name, one in vars(builtins).items() if isinstance(one, type) and issubclass(one, Exception)}
    forgotten = {name for name in exceptions if not name.startswith("_") and not in_python_library(name)}
    assert forgotten == set()
