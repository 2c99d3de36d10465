"""What is kept between runs, in SQLite: results (``runs``, ``read``) and what earlier runs learned (``cache``)."""
