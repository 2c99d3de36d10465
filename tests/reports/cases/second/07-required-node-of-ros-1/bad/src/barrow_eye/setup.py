from glob import glob

from setuptools import find_packages, setup

setup(
    name='barrow_eye',
    version='0.4.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/barrow_eye']),
        ('share/barrow_eye', ['package.xml']),
        ('share/barrow_eye/launch', glob('launch/*')),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='Barrow team',
    maintainer_email='barrow@field-of-robots.net',
    description='Part of the barrow, a robot that carries crates in a field.',
    license='BSD-3-Clause',
    entry_points={
        'console_scripts': [
            'camera = barrow_eye.camera:main',
        ],
    },
)
