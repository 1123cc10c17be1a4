"""Two runs beside each other, for people: a short page on the terminal, a CSV file, and a self-contained HTML page in the report's look.

What is compared, and how, is decided by python/twindeck/comparison."""
