from setuptools import setup

setup(
    name='barrow_wait',
    version='0.4.0',
    packages=['barrow_wait'],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/barrow_wait']),
        ('share/barrow_wait', ['package.xml']),
    ],
    install_requires=['setuptools'],
)
