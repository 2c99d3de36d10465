from setuptools import setup

setup(
    name='barrow_call',
    version='0.4.0',
    packages=['barrow_call'],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/barrow_call']),
        ('share/barrow_call', ['package.xml']),
    ],
    install_requires=['setuptools'],
    entry_points={'console_scripts': ['caller = barrow_call.caller:main']},
)
