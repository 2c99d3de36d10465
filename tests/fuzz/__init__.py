"""Whatever comes in from strangers is answered in time: mutated files of every kind that roslens reads, and frames.

``make test`` tries a hundred cases of each kind and all that ever failed (``tests/fixtures/fuzz``), ``make nightly`` a
hundred thousand, ``python -m fuzz KIND --minutes 5`` as many as fit and keeps what fails.
"""
