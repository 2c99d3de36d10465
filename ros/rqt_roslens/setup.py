"""Where the Python of the package is, for catkin."""

from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["rqt_roslens"], package_dir={"": "src"}))
