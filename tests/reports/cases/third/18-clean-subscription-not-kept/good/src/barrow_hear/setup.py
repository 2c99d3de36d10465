from setuptools import setup

setup(
    name='barrow_hear',
    version='0.4.0',
    packages=['barrow_hear'],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/barrow_hear']),
        ('share/barrow_hear', ['package.xml']),
    ],
    install_requires=['setuptools'],
    entry_points={'console_scripts': ['hear = barrow_hear.hear:main']},
)
