from setuptools import find_packages, setup

setup(
    name='barrow_bell',
    version='0.4.0',
    packages=find_packages(exclude=['test']),
    include_package_data=True,
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='Barrow team',
    maintainer_email='barrow@field-of-robots.net',
    description='Part of the barrow, a robot that carries crates in a field.',
    license='BSD-3-Clause',
    entry_points={
        'console_scripts': [
            'bell = barrow_bell.bell:main',
        ],
    },
)
