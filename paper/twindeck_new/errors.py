class InputError(Exception):
    """One line: file, what was expected, how to mend it."""
