from setuptools import setup

setup(
    name='barrow_push',
    version='0.4.0',
    packages=['barrow_push'],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/barrow_push']),
        ('share/barrow_push', ['package.xml']),
    ],
    install_requires=['setuptools'],
    entry_points={'console_scripts': ['push = barrow_push.push:main']},
)
